// SPDX-License-Identifier: Apache-2.0
// What `live` records between two presses of r: PREFIX-N.csv (poses), PREFIX-N.mp4 (the window, without the HUD) and
// PREFIX-N.take, which begins with the frames of the past seconds; N = 1 or the next that is free.
#pragma once
#include <filesystem>
#include <string>

#include "app/export/film.h"
#include "app/export/pose_csv.h"
#include "app/session.h"
#include "app/take/from_session.h"
#include "app/take/take_recording.h"

namespace nt {

class Recording {
 public:
  struct Settings {
    std::string prefix, character;
    bool keep_video = false;
  };
  Recording(const Settings& settings, const Session& session, const Scene& scene, std::vector<TakeFrame> past)
      : Recording(settings, free_name(settings.prefix), session, scene, std::move(past)) {}

  const std::string& name() const { return name_; }
  std::string summary() const { return take_.summary(); }

  // Take and table, once a frame; `rows`: of the take. On the thread that stores.
  void add(const Observation& seen, std::span<const TakeFrame> rows) {
    take_.add(seen, rows);
    csv_.add(seen.frame_index, seen.frame.timestamp_ns, seen.pose(), seen.of_target().order);
  }
  // The window, once a frame that is shown, on the thread that draws. Frames that were not are filled, so the video keeps the fish's own speed.
  void film(const Observation& seen, const Scene& scene) {
    const auto sequence = static_cast<int64_t>(seen.frame.sequence);
    film_.add(scene, last_ < 0 ? 1 : static_cast<int>(sequence - last_));
    last_ = sequence;
  }
  void finish() {
    take_.finish();
    csv_.close();
    csv_.look_back();
    film_.finish();
  }

 private:
  Recording(const Settings& settings, const std::string& name, const Session& session, const Scene& scene,
            std::vector<TakeFrame> past)
      : name_(name),
        take_(name + ".take", described(session, name, settings.character), settings.keep_video, std::move(past)),
        csv_(name + ".csv", session.scale(), session.calibration()),
        film_(name + ".mp4", "", scene.width(), scene.height(), session.info().fps) {}

  static TakeInfo described(const Session& session, const std::string& name, const std::string& character) {
    TakeInfo info = take_info(session, std::filesystem::path(name).filename().string());
    info.character = character;
    return info;
  }

  // PREFIX-N with the smallest N that no file has yet: an earlier recording is never overwritten.
  static std::string free_name(const std::string& prefix) {
    for (int n = 1;; ++n) {
      const std::string name = prefix + "-" + std::to_string(n);
      const auto is_free = [&](const char* ending) { return !std::filesystem::exists(name + ending); };
      if (is_free(".csv") && is_free(".mp4") && is_free(".take") && is_free(".take.mkv")) return name;
    }
  }

  std::string name_;
  TakeRecording take_;
  PoseCsv csv_;
  Film film_;
  int64_t last_ = -1;  // sequence number of the frame filmed last
};

}  // namespace nt
