// SPDX-License-Identifier: Apache-2.0
#include "app/take/from_session.h"

#include <ctime>

namespace nt {
namespace {

std::string utc_now() {
  const std::time_t now = std::time(nullptr);
  std::tm utc{};
  gmtime_r(&now, &utc);
  char text[32];
  std::strftime(text, sizeof text, "%Y-%m-%dT%H:%M:%SZ", &utc);
  return text;
}

}  // namespace

TakeInfo take_info(const Session& session, const std::string& name) {
  const CameraInfo& camera = session.info();
  TakeInfo info;
  info.name = name, info.camera = camera.name, info.created = utc_now();
  info.source_width = camera.source_width, info.source_height = camera.source_height;
  info.width = camera.width, info.height = camera.height;
  info.fps = camera.fps, info.px_per_mm = session.calibration().px_per_mm;
  return info;
}

TakeFrame take_frame(const Observation& seen, int fish) {
  const FishSeen& of = seen.fish[static_cast<std::size_t>(fish)];
  TakeFrame frame;
  frame.frame = static_cast<int64_t>(seen.frame.sequence);
  frame.fish = fish;
  frame.flags = seen.report.flags;
  frame.init_len = of.init_len;
  frame.motion = of.motion;
  frame.pose = of.pose;
  frame.motion.time_ns = seen.frame.timestamp_ns;
  frame.motion.status = frame.pose.status;
  return frame;
}

}  // namespace nt
