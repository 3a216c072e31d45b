// SPDX-License-Identifier: Apache-2.0
#include "app/author/skeleton_file.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>

#include "app/author/curve_skeleton.h"
#include "platform/camera.h"
#include "platform/codecs.h"

namespace nt {
namespace {

bool read_limit(const std::string& key, std::istringstream& in, JointLimits& limits) {
  float low = 0.0f, high = 0.0f;
  if (!(in >> low >> high) || !(low <= high) || low < -180.0f || high > 180.0f) return false;
  low *= det::kPi / 180.0f, high *= det::kPi / 180.0f;
  if (key == "twist") limits.twist_min = low, limits.twist_max = high;
  if (key == "y") limits.y_min = low, limits.y_max = high;
  if (key == "z") limits.z_min = low, limits.z_max = high;
  return key == "twist" || key == "y" || key == "z";
}

}  // namespace

SkeletonSpec parse_skeleton(const std::string& text, const std::string& name) {
  SkeletonSpec out;
  std::istringstream lines(text);
  int number = 0;
  for (std::string line; std::getline(lines, line);) {
    ++number;
    const auto bad = [&](const std::string& what) {
      return UserError(name + ", line " + std::to_string(number) + ": " + what);
    };
    std::istringstream in(line.substr(0, line.find('#')));
    SkeletonSpec::Joint joint;
    std::string parent;
    if (!(in >> joint.name)) continue;
    if (!(in >> parent >> joint.position.x >> joint.position.y >> joint.position.z)) {
      throw bad("NAME PARENT X Y Z is wanted");
    }
    if (parent != "-") {
      const auto at =
          std::find_if(out.joints.begin(), out.joints.end(), [&](const auto& j) { return j.name == parent; });
      if (at == out.joints.end()) throw bad("there is no joint '" + parent + "' above");
      joint.parent = static_cast<int>(at - out.joints.begin());
    }
    for (std::string key; in >> key;) {
      if (!read_limit(key, in, joint.limits)) throw bad("'" + key + "' wants two angles within -180 and 180 degrees");
    }
    out.joints.push_back(joint);
  }
  if (out.joints.empty()) throw UserError(name + " has no joint in it");
  return out;
}

SkeletonSpec read_skeleton(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (ending == ".bvh" || ending == ".glb" || ending == ".gltf") {
    using Read = void (*)(const std::string&, SkeletonSpec&);
    static const auto read = reinterpret_cast<Read>(codecs_function("neontetra_read_joints"));
    SkeletonSpec out;
    read(path, out);
    return out;
  }
  std::ifstream in(path);
  if (!in) throw UserError("cannot read " + path + "; is the name right?");
  return parse_skeleton(std::string((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>()), path);
}

std::string skeleton_text(const SkeletonSpec& skeleton) {
  std::string out;
  char line[200];
  for (const auto& j : skeleton.joints) {
    const std::string parent = j.parent < 0 ? "-" : skeleton.joints[static_cast<std::size_t>(j.parent)].name;
    std::snprintf(line, sizeof line, "%-12s %-12s %.6g %.6g %.6g", j.name.c_str(), parent.c_str(),
                  static_cast<double>(j.position.x), static_cast<double>(j.position.y),
                  static_cast<double>(j.position.z));
    out += line;
    const auto limit = [&](const char* key, float low, float high) {
      if (low <= -det::kPi && high >= det::kPi) return;
      std::snprintf(line, sizeof line, "  %s %.4g %.4g", key, static_cast<double>(low * 180.0f / det::kPi),
                    static_cast<double>(high * 180.0f / det::kPi));
      out += line;
    };
    limit("twist", j.limits.twist_min, j.limits.twist_max);
    limit("y", j.limits.y_min, j.limits.y_max);
    limit("z", j.limits.z_min, j.limits.z_max);
    out += "\n";
  }
  return out;
}

SkeletonSpec skeleton_for(const std::string& path, const TriangleMesh& mesh) {
  if (path.empty()) return {};
  return path == "auto" ? curve_skeleton(mesh) : read_skeleton(path);
}

}  // namespace nt
