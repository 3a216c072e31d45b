// SPDX-License-Identifier: Apache-2.0
#include "app/export/report.h"

#include <cmath>
#include <cstdio>

#include "core/base/simd_target.h"
#include "platform/linux/heap_count.h"
#include "platform/linux/process_memory.h"

namespace nt {
namespace {

Json times_us(const TimeHistogram& times) {
  const auto us = [&](double q) { return std::round(times.quantile_ns(q) / 10.0) / 100.0; };
  return {{"median", us(0.5)}, {"p99", us(0.99)}, {"p999", us(0.999)}};
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
          {"blobs_high_water", session.statistics().most_blobs},
          {"process_start_bytes", session.statistics().rss_start_bytes},
          {"process_end_bytes", resident_bytes()},
          {"process_peak_bytes", peak_resident_bytes()}};
}

Json calibration_json(const Calibration& calibration) {
  if (!calibration.any()) return nullptr;
  Json json;
  json["px_per_mm"] = calibration.px_per_mm > 0 ? Json(calibration.px_per_mm) : Json(nullptr);
  json["scale_from"] = calibration.px_per_mm > 0 ? Json(calibration.scale_from) : Json(nullptr);
  json["lens"] = calibration.lens.has_value();
  return json;
}

}  // namespace

Json latency_json(const TimeHistogram& latency, double fps) {
  if (latency.count() == 0) return nullptr;
  const double frame_ns = 1e9 / fps;
  const auto round3 = [](double v) { return std::round(v * 1e3) / 1e3; };
  const double median = latency.quantile_ns(0.5), p99 = latency.quantile_ns(0.99);
  const auto most = static_cast<double>(latency.max_ns());
  return {{"frames", latency.count()},
          {"median_ms", round3(median * 1e-6)},
          {"p99_ms", round3(p99 * 1e-6)},
          {"max_ms", round3(most * 1e-6)},
          {"median_frame_times", round3(median / frame_ns)},
          {"p99_frame_times", round3(p99 / frame_ns)},
          {"max_frame_times", round3(most / frame_ns)}};
}

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
  json["latency"] = latency_json(statistics.latency, info.fps);
  json["calibration"] = calibration_json(session.calibration());
  json["memory"] = memory_json(session);
  json["allocations_after_frame_0"] =
      heap_count_available() ? Json(statistics.allocations_after_frame_0) : Json(nullptr);
  json["simd"] = simd_target();
  return json;
}

std::string pretty(const Json& json) { return json.dump(2) + "\n"; }

std::string latency_line(const Statistics& statistics, double fps) {
  char line[160];
  const double frame_ns = 1e9 / fps;
  std::snprintf(line, sizeof line, "latency %.2f ms median, %.2f p99, %.2f at most (%.2f, %.2f, %.2f frame times)",
                statistics.latency.quantile_ns(0.5) * 1e-6, statistics.latency.quantile_ns(0.99) * 1e-6,
                static_cast<double>(statistics.latency.max_ns()) * 1e-6, statistics.latency.quantile_ns(0.5) / frame_ns,
                statistics.latency.quantile_ns(0.99) / frame_ns,
                static_cast<double>(statistics.latency.max_ns()) / frame_ns);
  return line;
}

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
