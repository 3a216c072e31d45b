// SPDX-License-Identifier: Apache-2.0
#include "app/camera_list.h"

#include <CLI/CLI.hpp>

#include "platform/linux/libcamera_camera.h"
#include "platform/linux/v4l2_list.h"

namespace nt {
namespace {

std::string control_text(const CameraControl& control) {
  return control.name + " " + std::to_string(control.least) + ".." + std::to_string(control.most) + " (" +
         std::to_string(control.value) + ")";
}

std::string entry_text(std::size_t number, const ListedCamera& camera) {
  std::string text = std::to_string(number) + " : " + (camera.card.empty() ? "?" : camera.card) +
                     " [v4l2:" + camera.path + "] (" + camera.driver + ", " + camera.bus + ")\n";
  if (!camera.problem.empty()) text += "    " + camera.problem + "\n";
  for (const VideoFormat format : kVideoFormats) {
    const std::string sizes = sizes_text(camera.modes, format);
    if (!sizes.empty()) text += "    " + std::string(to_string(format)) + ": " + sizes + "\n";
  }
  std::string controls;
  for (const CameraControl& control : camera.controls)
    controls += (controls.empty() ? "    controls: " : ", ") + control_text(control);
  return text + (controls.empty() ? "" : controls + "\n");
}

// None where libcamera is not installed: V4L2 cameras do without.
std::vector<LibcameraEntry> of_libcamera() {
  try {
    return list_libcamera_cameras();
  } catch (const UserError&) {
    return {};
  }
}

Json modes_json(const ListedCamera& camera) {
  Json modes = Json::array();
  for (const VideoMode& mode : camera.modes) {
    Json rates = Json::array();
    for (const FrameInterval& interval : mode.intervals) rates.push_back(interval.fps());
    modes.push_back(
        {{"format", to_string(mode.format)}, {"width", mode.width}, {"height", mode.height}, {"fps", rates}});
  }
  return modes;
}

}  // namespace

std::string camera_list_text() {
  const std::vector<ListedCamera> cameras = list_v4l2_cameras();
  const std::vector<LibcameraEntry> others = of_libcamera();
  if (cameras.empty() && others.empty()) return "No cameras available!\n";
  std::string text = "Available cameras\n-----------------\n";
  for (std::size_t i = 0; i < cameras.size(); ++i) text += entry_text(i, cameras[i]);
  for (std::size_t i = 0; i < others.size(); ++i)
    text += std::to_string(cameras.size() + i) + " : " + others[i].model + " [libcamera:" + others[i].id + "]\n";
  return text;
}

Json camera_list_json() {
  Json list = Json::array();
  for (const ListedCamera& camera : list_v4l2_cameras()) {
    Json controls = Json::array();
    for (const CameraControl& control : camera.controls) {
      controls.push_back({{"name", control.name},
                          {"least", control.least},
                          {"most", control.most},
                          {"usual", control.usual},
                          {"value", control.value}});
    }
    list.push_back({{"camera", "v4l2:" + camera.path},
                    {"name", camera.card},
                    {"driver", camera.driver},
                    {"problem", camera.problem.empty() ? Json(nullptr) : Json(camera.problem)},
                    {"modes", modes_json(camera)},
                    {"controls", controls}});
  }
  for (const LibcameraEntry& camera : of_libcamera())
    list.push_back({{"camera", "libcamera:" + camera.id}, {"name", camera.model}});
  return list;
}

void add_list_cameras(CLI::App& app) {
  app.add_flag_callback(
      "--list-cameras", [] { throw ListCameras(); }, "print the cameras of this machine and what they offer");
}

}  // namespace nt
