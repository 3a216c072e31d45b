// SPDX-License-Identifier: Apache-2.0
#include "app/export/report.h"

#include <cmath>
#include <cstdio>

#include "core/base/simd_target.h"
#include "platform/linux/heap_count.h"

namespace nt {
namespace {

Json times_us(const TimeHistogram& times) {
  const auto us = [&](double q) { return std::round(times.quantile_ns(q) / 10.0) / 100.0; };
  return {{"median", us(0.5)}, {"p99", us(0.99)}};
}

Json status_counts(const Statistics& statistics) {
  Json counts;
  for (std::size_t i = 0; i < kStatuses; ++i) counts[to_string(static_cast<PoseStatus>(i))] = statistics.by_status[i];
  return counts;
}

Json flag_counts(const Statistics& statistics) {
  Json counts;
  for (std::size_t i = 0; i < kFlags; ++i) counts[kFlagNames[i]] = statistics.by_flag[i];
  return counts;
}

// Of every fish that was seen, by number from 1.
Json fish_json(Session& session) {
  Json fish = Json::array();
  for (int i = 0; i < session.capture().fish_count(); ++i) {
    const int64_t poses = session.statistics().poses_of_fish[static_cast<std::size_t>(i)];
    if (poses > 0) fish.push_back({{"number", i + 1}, {"frames_with_pose", poses}});
  }
  return fish;
}

Json memory_json(Session& session) {
  return {{"core_bytes", session.core_bytes()},
          {"used_bytes", session.capture().bytes_used()},
          {"contour_points_high_water", session.capture().contour_points_high_water()},
          {"blobs_high_water", session.statistics().most_blobs}};
}

}  // namespace

Json stage_times_json(const Statistics& statistics) {
  Json stages;
  for (std::size_t s = 0; s < kStages; ++s) stages[kStageNames[s]] = times_us(statistics.stages[s]);
  stages["total"] = times_us(statistics.total);
  return stages;
}

Json report_json(Session& session) {
  const Statistics& statistics = session.statistics();
  const CameraInfo& info = session.info();
  Json json;
  json["format"] = kReportFormat;
  json["program"] = "neontetra " NEONTETRA_VERSION;
  json["camera"] = {
      {"name", info.name}, {"width", info.source_width}, {"height", info.source_height}, {"fps", info.fps}};
  json["working_size"] = {{"width", info.width}, {"height", info.height}};
  json["background"] = {{"name", session.capture().background_name()}, {"why", session.background_why()}};
  json["stabilise"] = {{"mode", to_string(session.stabilise())}, {"active", session.capture().stabilising()}};
  json["frames"] = statistics.frames;
  json["frames_with_pose"] = statistics.poses;
  json["fish"] = fish_json(session);
  json["frames_dropped"] = statistics.dropped;
  json["status"] = status_counts(statistics);
  json["flags"] = flag_counts(statistics);
  json["stages_us"] = stage_times_json(statistics);
  json["memory"] = memory_json(session);
  json["allocations_after_frame_0"] =
      heap_count_available() ? Json(statistics.allocations_after_frame_0) : Json(nullptr);
  json["simd"] = simd_target();
  return json;
}

std::string pretty(const Json& json) { return json.dump(2) + "\n"; }

std::string summary_line(const Statistics& statistics) {
  char line[160];
  std::snprintf(line, sizeof line, "%lld frames, %lld with a pose (%.0f %%); %.2f ms a frame",
                static_cast<long long>(statistics.frames), static_cast<long long>(statistics.poses),
                statistics.frames > 0
                    ? 100.0 * static_cast<double>(statistics.poses) / static_cast<double>(statistics.frames)
                    : 0,
                statistics.total.quantile_ns(0.5) * 1e-6);
  return line;
}

}  // namespace nt
