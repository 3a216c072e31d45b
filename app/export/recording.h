// SPDX-License-Identifier: Apache-2.0
// What `live` records between two presses of r: PREFIX-1.csv (poses) and PREFIX-1.mp4 (the window, without the HUD).
#pragma once
#include <memory>
#include <string>

#include "app/export/film.h"
#include "app/export/pose_csv.h"
#include "app/session.h"

namespace nt {

class Recording {
 public:
  Recording(const std::string& prefix, int number, Session& session, const Scene& scene)
      : csv_(prefix + "-" + std::to_string(number) + ".csv", session.scale()),
        film_(prefix + "-" + std::to_string(number) + ".mp4", "", scene.width(), scene.height(), session.info().fps) {}

  // Once a video frame.
  void add(Session& session, const Scene& scene) {
    csv_.add(session.frame_index(), session.frame().timestamp_ns, session.capture().pose());
    // Frames that were dropped are filled, so the video keeps the fish's own speed.
    const uint64_t sequence = session.frame().sequence;
    film_.add(scene, last_ < 0 ? 1 : static_cast<int>(static_cast<int64_t>(sequence) - last_));
    last_ = static_cast<int64_t>(sequence);
  }
  void finish() {
    csv_.close();
    film_.finish();
  }

 private:
  PoseCsv csv_;
  Film film_;
  int64_t last_ = -1;  // sequence number of the frame added last
};

}  // namespace nt
