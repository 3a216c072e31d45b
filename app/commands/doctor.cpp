// SPDX-License-Identifier: Apache-2.0
// neontetra doctor: what this machine has, what is missing and what to do about it.
#include <sys/utsname.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include <opencv2/core/version.hpp>

#include "app/camera_list.h"
#include "app/cli.h"
#include "app/export/report.h"
#include "app/session.h"
#include "app/text_file.h"
#include "app/ui/window.h"
#include "core/base/simd_target.h"
#include "core/pipeline/pipeline.h"
#include "platform/codecs.h"
#include "platform/display.h"
#include "platform/linux/jpeg_planes.h"
#include "platform/linux/libcamera_camera.h"
#include "platform/linux/v4l2_list.h"

namespace nt {
namespace {

constexpr std::size_t kMemoryBudget = 16'000'000;  // at 960x544, ViBe
constexpr int64_t kTrialFrames = 60;               // of the tank, to fill the high-water marks

struct Finding {
  const char* key;  // in the JSON
  std::string value;
  bool good = true;
  std::string advice;  // when it is not
};

Finding simd() {
  const std::string target = simd_target();
  const bool good = target != "SCALAR" && target != "EMU128";
  return {"simd", target, good, "built without SIMD: configure with -march=x86-64-v2 or better, or with NEON"};
}

Finding off_screen() {
  try {
    const std::unique_ptr<Display> display = open_headless_display(64, 64);
    return {"off_screen_renderer", display->name() + ", " + display->renderer(), true, ""};
  } catch (const UserError& error) {
    return {"off_screen_renderer", "none", false, error.what()};
  }
}

Finding window() {
  try {
    const std::unique_ptr<Display> display = find_display("neontetra doctor", 64, 64, {});
    return {"window", display->name() + ", " + display->renderer(), true, ""};
  } catch (const UserError& error) {
    return {"window", "none", false, std::string(error.what()) + " (only 'live' needs one)"};
  }
}

// What reads and writes videos, pictures and meshes need not be installed.
Finding ffmpeg() {
  try {
    return {"ffmpeg", codecs().ffmpeg_version(), true, ""};
  } catch (const UserError& error) {
    return {"ffmpeg", "none", false, error.what()};
  }
}

Finding h264() {
  const std::string advice = "videos are written as MPEG-4; for H.264 install libavcodec-extra";
  try {
    const char* name = codecs().h264_encoder();
    if (name != nullptr) return {"h264_encoder", name, true, ""};
    return {"h264_encoder", "none", false, advice};
  } catch (const UserError&) {
    return {"h264_encoder", "none", false, "without FFmpeg no videos are read or written"};
  }
}

Finding memory() {
  const Limits limits;
  const std::size_t bytes = Capture::bytes_needed(limits, CaptureSettings{});
  char text[160];
  std::snprintf(text, sizeof text, "%.2f MB at %dx%d (max_runs %d, max_blobs %d, max_contour_points %d)",
                static_cast<double>(bytes) * 1e-6, limits.max_width, limits.max_height, limits.max_runs,
                limits.max_blobs, limits.max_contour_points);
  return {"core_memory", text, bytes <= kMemoryBudget, "more than 16 MB: lower the limits in core/base/limits.h"};
}

Finding colour_memory() {
  const Limits limits;
  CaptureSettings settings;
  settings.background.kind = BackgroundKind::vibe_colour;
  char text[80];
  std::snprintf(text, sizeof text, "%.2f MB at %dx%d with --background vibe-colour",
                static_cast<double>(Capture::bytes_needed(limits, settings)) * 1e-6, limits.max_width,
                limits.max_height);
  return {"colour_memory", text, true, ""};
}

Finding trial() {
  CaptureOptions options;
  options.frames = kTrialFrames;
  options.camera.tank.scene = "ghost";  // its fish is there from the first frame
  options.background.kind = BackgroundOption::Kind::vibe;
  Session session(options);
  while (session.step()) {
  }
  const Statistics& statistics = session.statistics();
  char text[160];
  std::snprintf(
      text, sizeof text, "%s; at most %d of %d contour points, %d of %d blobs; %lld allocations after frame 0",
      summary_line(statistics).c_str(), session.capture().contour_points_high_water(), Limits{}.max_contour_points,
      statistics.most_blobs, Limits{}.max_blobs, static_cast<long long>(statistics.allocations_after_frame_0));
  return {"trial_run", text, statistics.allocations_after_frame_0 == 0,
          "core allocated memory while running: report this"};
}

Finding machine() {
  utsname name{};
  uname(&name);
  return {"machine",
          std::string(name.sysname) + " " + name.release + ", " + name.machine + ", " +
              std::to_string(std::thread::hardware_concurrency()) + " processors",
          true, ""};
}

Finding cameras() {
  std::string names, problems;
  for (const ListedCamera& camera : list_v4l2_cameras()) {
    if (camera.problem.empty()) names += (names.empty() ? "" : "; ") + camera.card + " (v4l2:" + camera.path + ")";
    else problems += (problems.empty() ? "" : "; ") + camera.problem;
  }
  if (names.empty() && problems.empty())
    problems =
        "no camera is connected: plug one in ('neontetra --list-cameras' shows it); files and the tank do without";
  return {"cameras", names.empty() ? "none" : names, problems.empty(), problems};
}

Finding libcamera_cameras() {
  try {
    std::string names;
    for (const LibcameraEntry& camera : list_libcamera_cameras())
      names += (names.empty() ? "" : "; ") + camera.model + " (libcamera:" + camera.id + ")";
    return {"libcamera", names.empty() ? "sees no camera" : names, true, ""};
  } catch (const UserError& error) {
    return {"libcamera", "none", false, std::string(error.what()) + " (only --camera libcamera needs it)"};
  }
}

Finding jpeg_cameras() {
  try {
    (void)open_jpeg_planes();
    return {"jpeg_cameras", "libjpeg-turbo", true, ""};
  } catch (const UserError& error) {
    return {"jpeg_cameras", "none", false, error.what()};
  }
}

std::vector<Finding> look() {
  return {{"version", "neontetra " NEONTETRA_VERSION, true, ""},
          {"libraries", std::string("OpenCV ") + CV_VERSION, true, ""},
          ffmpeg(),
          machine(),
          simd(),
          cameras(),
          libcamera_cameras(),
          jpeg_cameras(),
          off_screen(),
          window(),
          h264(),
          memory(),
          colour_memory(),
          trial()};
}

void doctor(bool json) {
  const std::vector<Finding> findings = look();
  Json report = {{"format", kReportFormat}};
  std::string text;
  for (const Finding& finding : findings) {
    report[finding.key] = {{"value", finding.value}, {"good", finding.good}};
    std::string name = finding.key;
    std::replace(name.begin(), name.end(), '_', ' ');
    name.resize(20, ' ');
    text += (finding.good ? "ok  " : "!!  ") + name + finding.value + "\n";
    if (finding.good) continue;
    report[finding.key]["advice"] = finding.advice;
    text += "    " + std::string(20, ' ') + finding.advice + "\n";
  }
  report["cameras"]["list"] = camera_list_json();
  report["core_memory"]["bytes"] = Capture::bytes_needed(Limits{}, CaptureSettings{});
  write_text("-", json ? pretty(report) : text);
}

}  // namespace

void add_doctor(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("doctor", "Say what this machine has, what is missing and what to do");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "as JSON");
  command->footer("Example: neontetra doctor");
  command->callback([&action, json] { action = [json] { doctor(*json); }; });
}

}  // namespace nt
