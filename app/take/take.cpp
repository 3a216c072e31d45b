// SPDX-License-Identifier: Apache-2.0
#include "app/take/take.h"

#include <sqlite3.h>

#include <algorithm>
#include <filesystem>

#include "app/take/take_row.h"
#include "core/motion/property.h"
#include "platform/camera.h"

namespace nt {
namespace {

namespace fs = std::filesystem;

constexpr int64_t kApplicationId = 0x4e54616b;  // "NTak"

// A take with more frames missing for each that is there was not made by us.
constexpr int64_t kMostMissing = 1000;

constexpr const char* kSchema =
    "CREATE TABLE info(key TEXT PRIMARY KEY, value) WITHOUT ROWID;"
    "CREATE TABLE frame(frame INTEGER NOT NULL, fish INTEGER NOT NULL, time_ns INTEGER NOT NULL,"
    " status INTEGER NOT NULL, flags INTEGER NOT NULL, data BLOB NOT NULL, PRIMARY KEY(frame, fish)) WITHOUT ROWID;"
    "CREATE TABLE edit(position INTEGER PRIMARY KEY, text TEXT NOT NULL);"
    "PRAGMA application_id = 1314152811;"
    "PRAGMA user_version = 1;";
static_assert(kApplicationId == 1314152811 && kTakeVersion == 1, "kSchema says the same");

constexpr const char* kInsert = "INSERT INTO frame VALUES(?, ?, ?, ?, ?, ?)";

int status_number(PoseStatus status) { return static_cast<int>(status); }

// A row of: frame, fish, time_ns, status, flags, data. False: not one of this take's.
bool read_frame(const Statement& row, const TakeInfo& info, TakeFrame& frame) {
  frame.frame = row.integer(0);
  frame.fish = static_cast<int>(row.integer(1));
  frame.flags = static_cast<uint32_t>(row.integer(4));
  const int64_t status = row.integer(3);
  if (status < 0 || status > status_number(PoseStatus::relearn)) return false;
  if (!read_take_row(row.blob(5), info.u_num, info.l_num, frame)) return false;
  frame.motion.time_ns = row.integer(2);
  frame.motion.status = frame.pose.status = static_cast<PoseStatus>(status);
  return true;
}

// Each field of a TakeInfo by its key.
template <typename Info, typename Text, typename Integer, typename Real>
void visit_info(Info& info, const Text& text, const Integer& integer, const Real& real) {
  text("name", info.name), text("camera", info.camera), text("character", info.character);
  text("tags", info.tags), text("notes", info.notes), text("created", info.created), text("video", info.video);
  integer("source_width", info.source_width), integer("source_height", info.source_height);
  integer("width", info.width), integer("height", info.height);
  integer("u_num", info.u_num), integer("l_num", info.l_num);
  integer("video_first", info.video_first);
  real("fps", info.fps), real("px_per_mm", info.px_per_mm);
}

bool is_sane(const TakeInfo& info) {
  return info.u_num >= 1 && info.u_num <= kMaxUpAxis && info.l_num >= 1 && info.l_num <= kMaxLowAxis &&
         info.width > 0 && info.height > 0 && info.source_width > 0 && info.fps > 0 && info.fps < 1e5;
}

}  // namespace

void Take::explain(const DatabaseError& error) const {
  switch (error.code) {
    case SQLITE_BUSY:
    case SQLITE_LOCKED:
      throw UserError(path_ + ": in use by another program; close it there first");
    case SQLITE_FULL:
      throw UserError(path_ + ": the disk is full; everything up to the last second is kept, free some space");
    case SQLITE_NOTADB:
      throw UserError(path_ + ": not a take (or its first bytes are damaged)");
    case SQLITE_CORRUPT:
      throw UserError(path_ + ": the take is damaged; 'neontetra takes --repair " + path_ + "' saves what can be read");
    case SQLITE_CANTOPEN:
      throw UserError(path_ + ": cannot open the take: no such file, or no permission for its folder");
    case SQLITE_READONLY:
      throw UserError(path_ + ": may not be written; check its permissions");
    case SQLITE_IOERR:
      throw UserError(path_ + ": reading or writing failed (" + error.what() + "); is the disk full or unplugged?");
    default:
      throw UserError(path_ + ": " + error.what());
  }
}

Take::Take(const std::string& path, Database::Mode mode) : path_(path) {
  try {
    database_ = std::make_unique<Database>(path, mode);
  } catch (const DatabaseError& error) {
    explain(error);
  }
}

Take Take::create(const std::string& path, const TakeInfo& info) {
  if (std::filesystem::exists(path))
    throw UserError(path + ": exists; a take is never overwritten, choose another name");
  Take take(path, Database::Mode::create);
  try {
    take.lock();
    take.database_->execute("PRAGMA journal_mode = WAL; PRAGMA synchronous = NORMAL;");
    take.make(info);
  } catch (const DatabaseError& error) {
    take.explain(error);
  }
  return take;
}

// Nobody else opens the file for writing until this program closes it.
void Take::lock() { database_->execute("PRAGMA locking_mode = EXCLUSIVE; BEGIN IMMEDIATE; COMMIT;"); }

void Take::make(const TakeInfo& info) {
  database_->execute("BEGIN");
  database_->execute(kSchema);
  database_->prepare("INSERT INTO info VALUES('open', 1)").run();
  database_->execute("COMMIT");
  set_info(info);
}

void Take::set_info(const TakeInfo& info) {
  try {
    Statement put = database_->prepare("INSERT OR REPLACE INTO info VALUES(?, ?)");
    database_->execute("BEGIN");
    visit_info(
        info, [&](const char* key, const std::string& text) { put.bind(1, std::string(key)).bind(2, text).run(); },
        [&](const char* key, int number) { put.bind(1, std::string(key)).bind(2, static_cast<int64_t>(number)).run(); },
        [&](const char* key, double number) { put.bind(1, std::string(key)).bind(2, number).run(); });
    database_->execute("COMMIT");
  } catch (const DatabaseError& error) {
    explain(error);
  }
  info_ = info;
}

Take Take::open(const std::string& path, Access access) {
  if (!std::filesystem::is_regular_file(path)) throw UserError(path + ": no such take");
  Take take(path, Database::Mode::write);
  try {
    take.check();
    Statement open = take.database_->prepare("SELECT value FROM info WHERE key = 'open'");
    take.recovered_ = open.step() && open.integer(0) != 0;
    open.reset();
    if (access == Access::edit || take.recovered_) take.lock();
    if (take.recovered_) take.database_->execute("UPDATE info SET value = 0 WHERE key = 'open'");
    if (take.recovered_) take.database_->execute("PRAGMA journal_mode = DELETE");
    take.read_info();
  } catch (const DatabaseError& error) {
    take.explain(error);
  }
  return take;
}

void Take::check() {
  if (database_->pragma("application_id") != kApplicationId) throw UserError(path_ + ": not a take");
  const int64_t version = database_->pragma("user_version");
  if (version > kTakeVersion)
    throw UserError(path_ + ": made by a newer neontetra (take version " + std::to_string(version) +
                    ", this one reads " + std::to_string(kTakeVersion) + "); update neontetra");
  Statement statement = database_->prepare("PRAGMA quick_check(1)");
  if (!statement.step() || statement.text(0) != "ok") throw DatabaseError(SQLITE_CORRUPT, "");
}

void Take::read_info() {
  Statement get = database_->prepare("SELECT value FROM info WHERE key = ?");
  const auto find = [&](const char* key) {
    get.reset();
    return get.bind(1, std::string(key)).step();
  };
  visit_info(
      info_, [&](const char* key, std::string& text) { text = find(key) ? get.text(0) : ""; },
      [&](const char* key, int& number) { number = find(key) ? static_cast<int>(get.integer(0)) : 0; },
      [&](const char* key, double& number) { number = find(key) ? get.real(0) : 0; });
  if (!is_sane(info_)) throw DatabaseError(SQLITE_CORRUPT, "");
}

void Take::append(std::span<const TakeFrame> frames) {
  if (frames.empty()) return;
  try {
    Statement insert = database_->prepare(kInsert);
    std::vector<std::byte> row;
    database_->execute("BEGIN");
    for (const TakeFrame& frame : frames) {
      write_take_row(frame, row);
      insert.bind(1, frame.frame).bind(2, static_cast<int64_t>(frame.fish)).bind(3, frame.motion.time_ns);
      insert.bind(4, static_cast<int64_t>(status_number(frame.motion.status)));
      insert.bind(5, static_cast<int64_t>(frame.flags)).bind(6, row).run();
    }
    database_->execute("COMMIT");
  } catch (const DatabaseError& error) {
    explain(error);
  }
}

TakeSummary Take::summary() {
  TakeSummary summary;
  summary.info = info_;
  try {
    Statement count = database_->prepare(
        "SELECT count(DISTINCT frame), sum(status = ?), count(DISTINCT fish), min(time_ns), max(time_ns) FROM frame");
    count.bind(1, static_cast<int64_t>(status_number(PoseStatus::ok)));
    if (count.step()) {
      summary.frames = count.integer(0), summary.posed = count.integer(1);
      summary.fish = static_cast<int>(count.integer(2));
      if (summary.frames > 0)
        summary.seconds = static_cast<double>(count.integer(4) - count.integer(3)) * 1e-9 + 1.0 / info_.fps;
    }
  } catch (const DatabaseError& error) {
    explain(error);
  }
  return summary;
}

std::vector<int> Take::fish() {
  std::vector<int> fish;
  try {
    Statement list = database_->prepare("SELECT DISTINCT fish FROM frame ORDER BY fish");
    while (list.step()) fish.push_back(static_cast<int>(list.integer(0)));
  } catch (const DatabaseError& error) {
    explain(error);
  }
  return fish;
}

namespace {

// Frames of one fish, up to the number `next`, that were not recorded.
void fill_up(std::vector<TakeFrame>& frames, int fish, int64_t next, const TakeInfo& info, int64_t first) {
  TakeFrame missing;
  missing.fish = fish;
  missing.motion = straight_motion(info.u_num, info.l_num);
  missing.pose.u_num = info.u_num, missing.pose.l_num = info.l_num;
  if (!frames.empty()) missing = frames.back();
  missing.flags = 0, missing.recorded = false;
  missing.motion.status = missing.pose.status = frames.empty() ? PoseStatus::absent : PoseStatus::lost;
  missing.motion.confidence = missing.pose.confidence = {};
  const int64_t from = frames.empty() ? first : frames.back().frame + 1, from_ns = missing.motion.time_ns;
  for (int64_t number = from; number < next; ++number) {
    missing.frame = number;
    missing.motion.time_ns = from_ns + static_cast<int64_t>(static_cast<double>(number - from + 1) * 1e9 / info.fps);
    frames.push_back(missing);
  }
}

}  // namespace

std::vector<TakeFrame> Take::frames(int fish) {
  std::vector<TakeFrame> frames;
  try {
    Statement ends = database_->prepare("SELECT min(frame), max(frame), count(*) FROM frame");
    if (!ends.step() || ends.integer(2) == 0) return frames;
    const int64_t first = ends.integer(0), last = ends.integer(1);
    if (first < 0 || last - first > kMostMissing * ends.integer(2)) throw DatabaseError(SQLITE_CORRUPT, "");
    Statement list =
        database_->prepare("SELECT frame, fish, time_ns, status, flags, data FROM frame WHERE fish = ? ORDER BY frame");
    list.bind(1, static_cast<int64_t>(fish));
    while (list.step()) {
      TakeFrame frame;
      if (!read_frame(list, info_, frame)) throw DatabaseError(SQLITE_CORRUPT, "");
      fill_up(frames, fish, frame.frame, info_, first);
      frames.push_back(frame);
    }
    if (!frames.empty()) fill_up(frames, fish, last + 1, info_, first);
  } catch (const DatabaseError& error) {
    explain(error);
  }
  return frames;
}

std::vector<std::string> Take::edits() {
  std::vector<std::string> lines;
  try {
    Statement list = database_->prepare("SELECT text FROM edit ORDER BY position");
    while (list.step()) lines.push_back(list.text(0));
  } catch (const DatabaseError& error) {
    explain(error);
  }
  return lines;
}

void Take::set_edits(const std::vector<std::string>& lines) {
  try {
    database_->execute("BEGIN; DELETE FROM edit;");
    Statement add = database_->prepare("INSERT INTO edit(text) VALUES(?)");
    for (const std::string& line : lines) add.bind(1, line).run();
    database_->execute("COMMIT");
  } catch (const DatabaseError& error) {
    explain(error);
  }
}

void Take::trim(int64_t first, int64_t last) {
  try {
    database_->execute("BEGIN");
    database_->prepare("DELETE FROM frame WHERE frame < ? OR frame > ?").bind(1, first).bind(2, last).run();
    database_->prepare("UPDATE frame SET frame = frame - ?").bind(1, first).run();
    if (has_thumbnails()) {
      database_->prepare("DELETE FROM thumbnail WHERE frame < ? OR frame > ?").bind(1, first).bind(2, last).run();
      database_->prepare("UPDATE thumbnail SET frame = frame - ?").bind(1, first).run();
    }
    database_->prepare("UPDATE info SET value = value - ? WHERE key = 'video_first'").bind(1, first).run();
    database_->execute("COMMIT; VACUUM;");
  } catch (const DatabaseError& error) {
    explain(error);
  }
}

std::string video_beside(const std::string& path, const TakeInfo& info) {
  return info.video.empty() ? "" : (fs::path(path).parent_path() / fs::path(info.video).filename()).string();
}

void Take::close() {
  try {
    database_->execute(
        "PRAGMA synchronous = FULL; UPDATE info SET value = 0 WHERE key = 'open'; PRAGMA journal_mode = DELETE;");
    database_.reset();
  } catch (const DatabaseError& error) {
    explain(error);
  }
}

namespace {

// Frames in one direction until the first page that cannot be read.
void salvage(Database& from, const TakeInfo& info, bool backwards, int64_t stop_at, std::vector<TakeFrame>& saved) {
  Statement list = from.prepare(
      backwards ? "SELECT frame, fish, time_ns, status, flags, data FROM frame ORDER BY frame DESC, fish DESC"
                : "SELECT frame, fish, time_ns, status, flags, data FROM frame ORDER BY frame, fish");
  try {
    while (list.step()) {
      TakeFrame frame;
      if (backwards && list.integer(0) <= stop_at) return;
      if (read_frame(list, info, frame)) saved.push_back(frame);
    }
  } catch (const DatabaseError&) {
    // The damaged page: what lies behind it is read from the other end.
  }
}

// The whole pages of a take. Of one that was cut within a page SQLite would read the rest as zeros, which are in rows then.
class WholePages {
 public:
  WholePages(const std::string& take, const std::string& beside) : path_(take) {
    constexpr std::uintmax_t kPage = 4096;
    const std::uintmax_t bytes = fs::file_size(take);
    if (bytes % kPage == 0) return;
    path_ = beside + ".part", is_copy_ = true;
    fs::copy_file(take, path_, fs::copy_options::overwrite_existing);
    fs::resize_file(path_, bytes / kPage * kPage);
    if (fs::exists(take + "-wal")) fs::copy_file(take + "-wal", path_ + "-wal", fs::copy_options::overwrite_existing);
  }
  ~WholePages() {
    std::error_code unused;
    for (const char* part : {"", "-wal", "-shm"})
      if (is_copy_) fs::remove(path_ + part, unused);
  }
  WholePages(const WholePages&) = delete;
  WholePages& operator=(const WholePages&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
  bool is_copy_ = false;
};

}  // namespace

int64_t repair_take(const std::string& from, const std::string& to) {
  if (!std::filesystem::is_regular_file(from)) throw UserError(from + ": no such take");
  TakeInfo info;
  std::vector<TakeFrame> head, tail;
  try {
    const WholePages pages(from, to);
    Database database(pages.path(), Database::Mode::write);
    database.execute("PRAGMA writable_schema = ON");  // else a file that ends early is refused as a whole
    Statement get = database.prepare("SELECT key, value FROM info");
    while (get.step()) {
      const std::string key = get.text(0);
      const auto same = [&](const char* name) { return key == name; };
      visit_info(
          info,
          [&](const char* name, std::string& text) {
            if (same(name)) text = get.text(1);
          },
          [&](const char* name, int& number) {
            if (same(name)) number = static_cast<int>(get.integer(1));
          },
          [&](const char* name, double& number) {
            if (same(name)) number = get.real(1);
          });
    }
    if (!is_sane(info)) throw DatabaseError(SQLITE_CORRUPT, "its description is lost");
    salvage(database, info, false, 0, head);
    salvage(database, info, true, head.empty() ? INT64_MIN : head.back().frame, tail);
    if (head.empty() && tail.empty()) throw DatabaseError(SQLITE_CORRUPT, "none of its frames can be read");
  } catch (const fs::filesystem_error& error) {
    throw UserError(to + ": cannot be written: " + error.code().message());
  } catch (const DatabaseError& error) {
    throw UserError(from + ": beyond repair (" + error.what() + ")");
  }
  Take repaired = Take::create(to, info);
  repaired.append(head);
  std::reverse(tail.begin(), tail.end());
  repaired.append(tail);
  repaired.close();
  return static_cast<int64_t>(head.size() + tail.size());
}

}  // namespace nt
