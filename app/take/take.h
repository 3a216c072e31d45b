// SPDX-License-Identifier: Apache-2.0
// A take: every frame's motion and pose of a recording, in one SQLite file (docs/FORMATS.md).
//
// While it is written the file is in WAL mode with a second file beside it; close() folds everything into one portable
// file. A take whose writer was killed is complete up to the last commit: opening it repairs it, and recovered() says so.
// Frame of reference: pixels of the working frame, as core has them; TakeInfo says how they lead back to the source.
// Errors: UserError, one line: not a take, made by a newer program, damaged, in use by another program, disk full.
// One thread at a time.
#pragma once
#include <optional>
#include <string>
#include <vector>

#include "app/take/database.h"
#include "app/take/thumbnail.h"
#include "core/landmarks/fish_pose.h"
#include "core/motion/motion.h"

namespace nt {

inline constexpr int kTakeVersion = 1;

struct TakeInfo {
  std::string name, camera, character, tags, notes;
  std::string created;  // UTC, "2026-11-22T09:30:00Z"
  int source_width = 0, source_height = 0;
  int width = 0, height = 0;  // working frame
  double fps = 0;
  double px_per_mm = 0;  // source pixels; 0: not known
  int u_num = 3, l_num = 15;
  std::string video;    // name of the camera's pictures beside the take; empty: not kept
  int video_first = 0;  // the take's frame that its first picture shows
};

struct TakeFrame {
  int64_t frame = 0;
  int fish = 0;
  uint32_t flags = 0;  // StepFlag
  float init_len = 0;  // of this fish, pixels
  Motion motion;       // its status and time are the frame's
  FishPose pose;
  bool recorded = true;  // false: Take::frames() has put it in a place where nothing was recorded
};

struct TakeSummary {
  TakeInfo info;
  int64_t frames = 0;  // of all fish together, one each
  int64_t posed = 0;
  int fish = 0;
  double seconds = 0;
};

class Take {
 public:
  // A new file; refuses to write over an existing one.
  static Take create(const std::string& path, const TakeInfo& info);
  enum class Access : uint8_t { read, edit };
  static Take open(const std::string& path, Access access);

  const TakeInfo& info() const { return info_; }
  void set_info(const TakeInfo& info);
  bool recovered() const { return recovered_; }

  void append(std::span<const TakeFrame> frames);  // one transaction
  TakeSummary summary();
  std::vector<int> fish();
  // One for every frame from the take's first to its last, in order: where nothing was recorded of this fish (it came
  // later, or the frame was dropped) without a pose, `absent` before its first and `lost` with its last motion after.
  std::vector<TakeFrame> frames(int fish);
  // The edit list, a line each (edits.h), kept beside the untouched recording.
  std::vector<std::string> edits();
  void set_edits(const std::vector<std::string>& lines);
  void add_thumbnails(std::span<const Thumbnail> thumbnails);
  std::vector<Thumbnail> thumbnails();  // in order
  // Keeps frames first..last and numbers them anew from 0.
  void trim(int64_t first, int64_t last);
  void close();  // to one file, synchronised; the destructor does without the check

 private:
  Take(const std::string& path, Database::Mode mode);
  void make(const TakeInfo& info);
  void check();
  void read_info();
  void lock();
  bool has_thumbnails();
  [[noreturn]] void explain(const DatabaseError& error) const;

  std::string path_;
  std::unique_ptr<Database> database_;
  TakeInfo info_;
  bool recovered_ = false;
};

// The file with the camera's pictures that belongs to the take `path`; empty where they were not kept.
std::string video_beside(const std::string& path, const TakeInfo& info);

// Copies every frame that can still be read of a damaged take to `to`; the number of frames saved.
int64_t repair_take(const std::string& from, const std::string& to);

}  // namespace nt
