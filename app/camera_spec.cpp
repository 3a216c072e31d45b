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

const std::vector<std::string> kKinds = {"sim", "file", "v4l2", "libcamera"};
const std::vector<std::string> kSimKeys = {"scene", "seed", "size", "fps", "frames"};
const std::vector<std::string> kLibcameraKeys = {"size", "fps", "lock"};
const std::vector<std::string> kV4l2Keys = {"size", "fps", "format", "lock", "mains", "wait"};

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

// One of the words, by its place; throws UserError with the nearest.
std::size_t choice(const std::string& what, const std::string& value, const std::vector<std::string>& words) {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] == value) return i;
  }
  throw UserError(one_of(what + ": unknown", value, words), 2);
}

void set_v4l2_key(CameraSpec& spec, const std::string& key, const std::string& value) {
  const std::string what = "--camera v4l2: " + key;
  V4l2Settings& v4l2 = spec.v4l2;
  if (key == "size") {
    const Size size = parse_size(what, value);
    v4l2.wish.width = size.width, v4l2.wish.height = size.height;
  } else if (key == "fps") {
    v4l2.wish.fps = parse_number(what, value, 0.1, 1000);
  } else if (key == "format") {
    std::vector<std::string> names;
    for (const VideoFormat format : kVideoFormats) names.emplace_back(to_string(format));
    v4l2.wish.format = kVideoFormats[choice(what, value, names)];
  } else if (key == "lock") {
    v4l2.lock = choice(what, value, {"off", "on"}) == 1;
  } else if (key == "mains") {
    constexpr Mains kMains[] = {Mains::off, Mains::hz50, Mains::hz60, Mains::automatic};
    v4l2.mains = kMains[choice(what, value, {"off", "50", "60", "auto"})];
  } else if (key == "wait") {
    v4l2.wait_s = parse_number(what, value, 0, 86400);
  } else {
    throw UserError(one_of("--camera v4l2: unknown key", key, kV4l2Keys), 2);
  }
}

// "KEY=VALUE,KEY=VALUE"
template <class SetKey>
void parse_keys(const std::string& kind, const std::string& text, const std::vector<std::string>& keys,
                SetKey set_key) {
  std::set<std::string> given;
  std::size_t at = 0;
  while (at < text.size()) {
    const std::size_t comma = std::min(text.find(',', at), text.size());
    const std::string pair = text.substr(at, comma - at);
    const std::size_t equals = pair.find('=');
    if (equals == std::string::npos) {
      throw UserError("--camera " + kind + ": '" + pair + "' is no KEY=VALUE (keys: " + joined(keys) + ")", 2);
    }
    const std::string key = pair.substr(0, equals);
    set_key(key, pair.substr(equals + 1));
    if (!given.insert(key).second)
      throw UserError("--camera " + kind + ": '" + key + "' is given twice; give it once", 2);
    at = comma + 1;
  }
}

CameraSpec parse_sim(const std::string& text) {
  CameraSpec spec;
  parse_keys("sim", text, kSimKeys,
             [&](const std::string& key, const std::string& value) { set_sim_key(spec, key, value); });
  return spec;
}

// "/dev/video0,size=640x480"; without a path the first camera.
CameraSpec parse_v4l2(const std::string& text) {
  CameraSpec spec;
  spec.kind = CameraSpec::Kind::v4l2;
  const std::size_t comma = std::min(text.find(','), text.size());
  if (comma > 0) spec.v4l2.path = text.substr(0, comma);
  if (comma < text.size()) {
    parse_keys("v4l2", text.substr(comma + 1), kV4l2Keys,
               [&](const std::string& key, const std::string& value) { set_v4l2_key(spec, key, value); });
  }
  return spec;
}

// "imx219,size=640x480"; without a name the first camera.
CameraSpec parse_libcamera(const std::string& text) {
  CameraSpec spec;
  spec.kind = CameraSpec::Kind::libcamera;
  LibcameraSettings& settings = spec.libcamera;
  const std::size_t comma = std::min(text.find(','), text.size());
  settings.id = text.substr(0, comma);
  if (comma == text.size()) return spec;
  parse_keys("libcamera", text.substr(comma + 1), kLibcameraKeys,
             [&](const std::string& key, const std::string& value) {
               const std::string what = "--camera libcamera: " + key;
               if (key == "size") {
                 const Size size = parse_size(what, value);
                 settings.width = size.width, settings.height = size.height;
               } else if (key == "fps") {
                 settings.fps = parse_number(what, value, 0.1, 1000);
               } else if (key == "lock") {
                 settings.lock = choice(what, value, {"off", "on"}) == 1;
               } else {
                 throw UserError(one_of("--camera libcamera: unknown key", key, kLibcameraKeys), 2);
               }
             });
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
  if (text == "v4l2" || text == "v4l2:") return parse_v4l2("");
  if (text.starts_with("v4l2:")) return parse_v4l2(text.substr(5));
  if (text.starts_with("/dev/video") || text.starts_with("/dev/v4l/")) return parse_v4l2(text);
  if (text == "libcamera") return parse_libcamera("");
  if (text.starts_with("libcamera:")) return parse_libcamera(text.substr(10));
  if (text == "file:") throw UserError("--camera: the path is missing after 'file:'; give file:PATH", 2);
  if (text.starts_with("file:")) return file_spec(text.substr(5));
  std::error_code ignored;
  if (std::filesystem::exists(text, ignored)) return file_spec(text);
  const std::string kind = text.substr(0, text.find(':'));
  if (kind != text || edit_distance(kind, nearest_name(kind, kKinds)) <= 1) {
    throw UserError(one_of("--camera: unknown camera", kind, kKinds), 2);
  }
  throw UserError("--camera: there is no file '" + text +
                      "'; give sim, sim:KEY=VALUE,..., file:PATH, v4l2:/dev/videoN or libcamera:ID",
                  3);
}

std::unique_ptr<Camera> open_camera(const CameraSpec& spec, std::optional<Size> work, double fps,
                                    const CameraManners& manners) {
  using Kind = CameraSpec::Kind;
  constexpr int64_t kDefaultPixels = kDefaultWork.width * kDefaultWork.height;
  const Size box = work.value_or(spec.kind == Kind::sim ? kDefaultWork : Size{kLargestSide, kLargestSide});
  const int64_t most_pixels = work ? 0 : kDefaultPixels;
  if (spec.kind == Kind::file) return open_file_camera(spec.path, box.width, box.height, fps, most_pixels);
  if (spec.kind == Kind::v4l2) {
    V4l2Settings v4l2 = spec.v4l2;
    if (v4l2.wish.fps <= 0) v4l2.wish.fps = fps;
    v4l2.wish.work_pixels = work ? int64_t{1} * work->width * work->height : kDefaultPixels;
    return open_v4l2_camera(v4l2, box.width, box.height, most_pixels, manners);
  }
  if (spec.kind == Kind::libcamera) {
    LibcameraSettings libcamera = spec.libcamera;
    if (libcamera.fps <= 0) libcamera.fps = fps;
    return open_libcamera_camera(libcamera, box.width, box.height, most_pixels, manners);
  }
  TankSettings tank = spec.tank;
  if (fps > 0) tank.fps = fps;
  return open_sim_camera(tank, spec.frames, box.width, box.height);
}

}  // namespace nt
