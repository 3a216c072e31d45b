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
    film_.add(scene);
  }
  void finish() {
    csv_.close();
    film_.finish();
  }

 private:
  PoseCsv csv_;
  Film film_;
};

}  // namespace nt
