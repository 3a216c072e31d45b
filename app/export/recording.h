// SPDX-License-Identifier: Apache-2.0
// What `live` records between two presses of r: PREFIX-N.csv (poses) and PREFIX-N.mp4 (the window, without the HUD), N = 1
// or the next that is free.
#pragma once
#include <filesystem>
#include <string>

#include "app/export/film.h"
#include "app/export/pose_csv.h"
#include "app/session.h"

namespace nt {

class Recording {
 public:
  Recording(const std::string& prefix, Session& session, const Scene& scene)
      : Recording(free_name(prefix), session, scene, 0) {}

  // Once a video frame.
  void add(Session& session, const Scene& scene) {
    csv_.add(session.frame_index(), session.frame().timestamp_ns, session.capture().pose(), session.capture().order());
    // Frames that were dropped are filled, so the video keeps the fish's own speed.
    const uint64_t sequence = session.frame().sequence;
    film_.add(scene, last_ < 0 ? 1 : static_cast<int>(static_cast<int64_t>(sequence) - last_));
    last_ = static_cast<int64_t>(sequence);
  }
  void finish() {
    csv_.close();
    csv_.look_back();
    film_.finish();
  }

 private:
  Recording(const std::string& name, Session& session, const Scene& scene, int /* the name is final */)
      : csv_(name + ".csv", session.scale(), session.calibration()),
        film_(name + ".mp4", "", scene.width(), scene.height(), session.info().fps) {}

  // PREFIX-N with the smallest N that no file has yet: an earlier recording is never overwritten.
  static std::string free_name(const std::string& prefix) {
    for (int n = 1;; ++n) {
      const std::string name = prefix + "-" + std::to_string(n);
      if (!std::filesystem::exists(name + ".csv") && !std::filesystem::exists(name + ".mp4")) return name;
    }
  }

  PoseCsv csv_;
  Film film_;
  int64_t last_ = -1;  // sequence number of the frame added last
};

}  // namespace nt
