// SPDX-License-Identifier: Apache-2.0
#include "app/camera_spec.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>
#include <vector>

#include "app/nearest_name.h"
#include "platform/sim/file_camera.h"
#include "platform/sim/sim_camera.h"

namespace nt {
namespace {

constexpr int kLargestSide = 8192;

const std::vector<std::string> kKinds = {"sim", "file"};
const std::vector<std::string> kSimKeys = {"scene", "seed", "size", "fps", "frames"};

std::string one_of(const std::string& what, const std::string& wrong, const std::vector<std::string>& names) {
  return what + " '" + wrong + "'; did you mean '" + nearest_name(wrong, names) + "'? (there are: " + joined(names) +
         ")";
}

void set_sim_key(CameraSpec& spec, const std::string& key, const std::string& value) {
  const std::string what = "--camera sim: " + key;
  if (key == "scene") {
    if (find_tank_scene(value) == nullptr) {
      throw UserError(one_of("--camera sim: unknown scene", value, tank_scene_names()), 2);
    }
    spec.tank.scene = value;
  } else if (key == "seed") {
    spec.tank.seed = static_cast<uint64_t>(parse_integer(what, value, 0, std::numeric_limits<int64_t>::max()));
  } else if (key == "size") {
    const Size size = parse_size(what, value);
    spec.tank.width = size.width, spec.tank.height = size.height;
  } else if (key == "fps") {
    spec.tank.fps = parse_number(what, value, 1, 1000);
  } else if (key == "frames") {
    spec.frames = parse_integer(what, value, 1, 1'000'000'000);
  } else {
    throw UserError(one_of("--camera sim: unknown key", key, kSimKeys), 2);
  }
}

CameraSpec parse_sim(const std::string& keys) {
  CameraSpec spec;
  std::set<std::string> given;
  std::size_t at = 0;
  while (at < keys.size()) {
    const std::size_t comma = std::min(keys.find(',', at), keys.size());
    const std::string pair = keys.substr(at, comma - at);
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos) {
      throw UserError("--camera sim: '" + pair + "' is no KEY=VALUE (keys: " + joined(kSimKeys) + ")", 2);
    }
    const std::string key = pair.substr(0, equals);
    set_sim_key(spec, key, pair.substr(equals + 1));
    if (!given.insert(key).second) throw UserError("--camera sim: '" + key + "' is given twice; give it once", 2);
    at = comma + 1;
  }
  return spec;
}

CameraSpec file_spec(const std::string& path) {
  CameraSpec spec;
  spec.kind = CameraSpec::Kind::file;
  spec.path = path;
  return spec;
}

}  // namespace

CameraSpec parse_camera_spec(const std::string& text) {
  if (text == "sim") return {};
  if (text.starts_with("sim:")) return parse_sim(text.substr(4));
  if (text == "file:") throw UserError("--camera: the path is missing after 'file:'; give file:PATH", 2);
  if (text.starts_with("file:")) return file_spec(text.substr(5));
  std::error_code ignored;
  if (std::filesystem::exists(text, ignored)) return file_spec(text);
  const std::string kind = text.substr(0, text.find(':'));
  if (kind != text || edit_distance(kind, nearest_name(kind, kKinds)) <= 1) {
    throw UserError(one_of("--camera: unknown camera", kind, kKinds), 2);
  }
  throw UserError("--camera: there is no file '" + text + "'; give sim, sim:KEY=VALUE,... or file:PATH", 3);
}

std::unique_ptr<Camera> open_camera(const CameraSpec& spec, std::optional<Size> work, double fps) {
  if (spec.kind == CameraSpec::Kind::file && !work) {
    return open_file_camera(spec.path, kLargestSide, kLargestSide, fps, kDefaultWork.width * kDefaultWork.height);
  }
  const Size size = work.value_or(kDefaultWork);
  if (spec.kind == CameraSpec::Kind::file) return open_file_camera(spec.path, size.width, size.height, fps);
  TankSettings tank = spec.tank;
  if (fps > 0) tank.fps = fps;
  return open_sim_camera(tank, spec.frames, size.width, size.height);
}

}  // namespace nt
