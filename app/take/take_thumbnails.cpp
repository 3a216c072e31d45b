// SPDX-License-Identifier: Apache-2.0
// Thumbnails in a take: a table of their own, made with the first one, so that takes without any stay as they are.
#include "app/take/take.h"

namespace nt {

bool Take::has_thumbnails() {
  return database_->prepare("SELECT 1 FROM sqlite_master WHERE type = 'table' AND name = 'thumbnail'").step();
}

void Take::add_thumbnails(std::span<const Thumbnail> thumbnails) {
  if (thumbnails.empty()) return;
  try {
    database_->execute("BEGIN; CREATE TABLE IF NOT EXISTS thumbnail(frame INTEGER PRIMARY KEY, bmp BLOB NOT NULL);");
    Statement put = database_->prepare("INSERT OR REPLACE INTO thumbnail VALUES(?, ?)");
    for (const Thumbnail& thumbnail : thumbnails)
      put.bind(1, thumbnail.frame).bind(2, std::as_bytes(std::span(thumbnail.bmp))).run();
    database_->execute("COMMIT");
  } catch (const DatabaseError& error) {
    explain(error);
  }
}

std::vector<Thumbnail> Take::thumbnails() {
  std::vector<Thumbnail> thumbnails;
  try {
    if (!has_thumbnails()) return thumbnails;
    Statement list = database_->prepare("SELECT frame, bmp FROM thumbnail ORDER BY frame");
    while (list.step()) {
      const std::span<const std::byte> bytes = list.blob(1);
      Thumbnail& thumbnail = thumbnails.emplace_back();
      thumbnail.frame = list.integer(0);
      for (const std::byte byte : bytes) thumbnail.bmp.push_back(static_cast<uint8_t>(byte));
    }
  } catch (const DatabaseError& error) {
    explain(error);
  }
  return thumbnails;
}

}  // namespace nt
