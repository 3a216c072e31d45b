// SPDX-License-Identifier: Apache-2.0
#include "app/author/mesh_character.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <opencv2/imgproc.hpp>

#include "app/author/assemble.h"
#include "app/author/character_file.h"
#include "app/author/mesh_file.h"
#include "core/base/limits.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kView = 900, kMargin = 8;
constexpr float kThinnest = 0.004f;      // of the length: a line or a sheet on edge is no silhouette
constexpr float kSimplifyError = 0.05f;  // of the mesh's size; beyond it clustering takes over

std::size_t used_vertices(const std::vector<uint32_t>& triangles, std::size_t count) {
  std::vector<uint8_t> used(count, 0);
  for (const uint32_t i : triangles) used[i] = 1;
  return static_cast<std::size_t>(std::count(used.begin(), used.end(), 1));
}

// Drops vertices that no triangle uses.
void compact(SourceMesh& mesh) {
  std::vector<uint32_t> place(mesh.positions.size(), UINT32_MAX);
  std::vector<Vec3> positions;
  std::vector<Vec2> texcoords;
  for (uint32_t& i : mesh.triangles) {
    if (place[i] == UINT32_MAX) {
      place[i] = static_cast<uint32_t>(positions.size());
      positions.push_back(mesh.positions[i]), texcoords.push_back(mesh.texcoords[i]);
    }
    i = place[i];
  }
  mesh.positions = std::move(positions), mesh.texcoords = std::move(texcoords);
}

bool fits(const std::vector<uint32_t>& triangles, std::size_t vertices, std::size_t most_vertices) {
  return used_vertices(triangles, vertices) <= most_vertices &&
         triangles.size() / 3 <= static_cast<std::size_t>(Limits{}.max_triangles);
}

void reduce(const std::string& path, SourceMesh& mesh, std::size_t most_vertices) {
  compact(mesh);
  const std::size_t before = mesh.triangles.size() / 3;
  if (fits(mesh.triangles, mesh.positions.size(), most_vertices)) return;
  std::vector<uint32_t> out(mesh.triangles.size());
  bool done = false;
  const std::size_t target = std::min(
      mesh.triangles.size(), std::min(2 * most_vertices, static_cast<std::size_t>(Limits{}.max_triangles)) * 3);
  for (const bool sloppy : {false, true}) {
    for (std::size_t wanted = target; !done && wanted > 600; wanted = wanted * 4 / 5 / 3 * 3) {
      out.resize(mesh.triangles.size());
      const auto simplify = [&] {
        const float* at = &mesh.positions[0].x;
        return sloppy ? meshopt_simplifySloppy(out.data(), mesh.triangles.data(), mesh.triangles.size(), at,
                                               mesh.positions.size(), sizeof(Vec3), wanted, 1e9f, nullptr)
                      : meshopt_simplify(out.data(), mesh.triangles.data(), mesh.triangles.size(), at,
                                         mesh.positions.size(), sizeof(Vec3), wanted, kSimplifyError, 0, nullptr);
      };
      out.resize(simplify());
      done = !out.empty() && fits(out, mesh.positions.size(), most_vertices);
      if (!sloppy && out.size() > wanted * 5 / 4) break;  // it is stuck: seams, loose triangles
    }
    if (done) break;
  }
  if (!done)
    throw UserError(path + ": this mesh cannot be reduced to " + std::to_string(most_vertices) +
                    " vertices; reduce it first");
  mesh.triangles = out;
  compact(mesh);
  mesh.notes.push_back("reduced from " + std::to_string(before) + " triangles to " +
                       std::to_string(mesh.triangles.size() / 3));
}

// The lowest first, so that a renderer without a depth buffer paints the top last.
void sort_by_height(SourceMesh& mesh) {
  std::vector<std::array<uint32_t, 3>> order;
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    order.push_back({mesh.triangles[t], mesh.triangles[t + 1], mesh.triangles[t + 2]});
  }
  const auto height = [&](const std::array<uint32_t, 3>& t) {
    return mesh.positions[t[0]].z + mesh.positions[t[1]].z + mesh.positions[t[2]].z;
  };
  std::stable_sort(order.begin(), order.end(), [&](const auto& a, const auto& b) { return height(a) < height(b); });
  mesh.triangles.clear();
  for (const auto& t : order) mesh.triangles.insert(mesh.triangles.end(), t.begin(), t.end());
}

// Smooth across texture seams: vertices at one place share a normal.
std::vector<Vec3> smooth_normals(const SourceMesh& mesh) {
  std::map<std::array<float, 3>, Vec3> sums;
  const auto key = [&](uint32_t i) {
    return std::array<float, 3>{mesh.positions[i].x, mesh.positions[i].y, mesh.positions[i].z};
  };
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    const Vec3 a = mesh.positions[mesh.triangles[t]], b = mesh.positions[mesh.triangles[t + 1]],
               c = mesh.positions[mesh.triangles[t + 2]];
    const Vec3 u{b.x - a.x, b.y - a.y, b.z - a.z}, v{c.x - a.x, c.y - a.y, c.z - a.z};
    const Vec3 n{u.y * v.z - u.z * v.y, u.z * v.x - u.x * v.z, u.x * v.y - u.y * v.x};
    for (std::size_t k = 0; k < 3; ++k) {
      Vec3& sum = sums[key(mesh.triangles[t + k])];
      sum = {sum.x + n.x, sum.y + n.y, sum.z + n.z};
    }
  }
  std::vector<Vec3> out;
  for (uint32_t i = 0; i < mesh.positions.size(); ++i) {
    const Vec3 n = sums[key(i)];
    const float len = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
    out.push_back(len > 1e-20f ? Vec3{n.x / len, n.y / len, n.z / len} : Vec3{0, 0, 1});
  }
  return out;
}

// The mesh's way to pixels of its top view: x right, y down (the mesh's y is up), z towards the viewer.
struct TopView {
  float scale = 1;
  Vec3 least, most;
  cv::Size size;
  Vec3 operator()(Vec3 p) const {
    return {(p.x - least.x) * scale + kMargin, (most.y - p.y) * scale + kMargin,
            (p.z - 0.5f * (least.z + most.z)) * scale};
  }
};

FigureFromFile figure_from_file(const MeshAxes& axes, const TopView& view) {
  const float s = view.scale;
  return {axes.right * s, axes.forward * -s, axes.up * s, view({})};
}

TopView top_view(const std::string& path, const SourceMesh& mesh) {
  TopView v;
  v.least = v.most = mesh.positions.front();
  for (const Vec3 p : mesh.positions) {
    v.least = {std::min(v.least.x, p.x), std::min(v.least.y, p.y), std::min(v.least.z, p.z)};
    v.most = {std::max(v.most.x, p.x), std::max(v.most.y, p.y), std::max(v.most.z, p.z)};
  }
  const float wide = v.most.x - v.least.x, tall = v.most.y - v.least.y;
  if (!(std::max(wide, tall) > 1e-18f) || std::min(wide, tall) < kThinnest * std::max(wide, tall)) {
    throw UserError(path + ": seen from above this mesh is a line; say which way is up with --up");
  }
  v.scale = kView / std::max(wide, tall);
  v.size = {static_cast<int>(std::ceil(wide * v.scale)) + 2 * kMargin,
            static_cast<int>(std::ceil(tall * v.scale)) + 2 * kMargin};
  return v;
}

struct Silhouette {
  cv::Mat mask;
  std::vector<Vec2> outline;
};

Silhouette silhouette(const std::string& path, const SourceMesh& mesh, const TopView& view) {
  cv::Mat drawn = cv::Mat::zeros(view.size, CV_8U);
  for (std::size_t t = 0; t < mesh.triangles.size(); t += 3) {
    cv::Point corner[3];
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 p = view(mesh.positions[mesh.triangles[t + k]]);
      corner[k] = {static_cast<int>(std::lround(p.x)), static_cast<int>(std::lround(p.y))};
    }
    cv::fillConvexPoly(drawn, corner, 3, 255);
  }
  // Parts that touch nearly are one figure; threads are not part of it.
  cv::morphologyEx(drawn, drawn, cv::MORPH_CLOSE, cv::getStructuringElement(cv::MORPH_ELLIPSE, {9, 9}));
  cv::morphologyEx(drawn, drawn, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_ELLIPSE, {5, 5}));
  std::vector<std::vector<cv::Point>> contours;
  cv::findContours(drawn, contours, cv::RETR_EXTERNAL, cv::CHAIN_APPROX_NONE);
  const auto largest = std::max_element(contours.begin(), contours.end(), [](const auto& a, const auto& b) {
    return cv::contourArea(a) < cv::contourArea(b);
  });
  if (largest == contours.end() || largest->size() < 32 || cv::contourArea(*largest) < 200) {
    throw UserError(path + ": seen from above there is no body in this mesh; say which way is up with --up");
  }
  Silhouette out;
  out.mask = cv::Mat::zeros(view.size, CV_8U);
  cv::drawContours(out.mask, std::vector<std::vector<cv::Point>>{*largest}, 0, 255, cv::FILLED);
  for (const cv::Point p : *largest) out.outline.push_back({static_cast<float>(p.x), static_cast<float>(p.y)});
  return out;
}

Vec2 flat(Vec3 p) { return {p.x, p.y}; }

}  // namespace

AuthoredCharacter author_mesh(const std::string& path, const MeshOptions& options) {
  const LandmarkSettings settings{options.u_num, options.l_num, options.harmonics};
  SourceMesh mesh = read_mesh(path, options.told);
  const std::size_t limit = static_cast<std::size_t>(Limits{}.max_vertices);
  reduce(path, mesh, options.vertices > 0 ? std::min(limit, static_cast<std::size_t>(options.vertices)) : limit);
  sort_by_height(mesh);
  const TopView view = top_view(path, mesh);
  const Silhouette seen = silhouette(path, mesh, view);
  std::optional<ToldHead> told;
  if (options.told.head) told = ToldHead{std::nullopt, {0, -1}};
  const Proposal proposal = propose_landmarks(path, seen.mask, {}, seen.outline, told, settings);
  const CharacterFrame local(proposal.pose);

  std::vector<Vec2> vertices;
  std::vector<float> heights;
  std::vector<Vec3> normals = smooth_normals(mesh);
  for (const Vec3 p : mesh.positions) {
    const Vec3 at = view(p);
    vertices.push_back(local(flat(at))), heights.push_back(at.z);
  }
  for (Vec3& n : normals) {
    const Vec2 turned = local.direction({n.x, -n.y});
    n = {turned.x, turned.y, n.z};
  }
  Character character = character_of(proposal, local, settings);
  character.vertices = vertices, character.heights = heights, character.normals = normals;
  character.texcoords = mesh.texcoords, character.triangles = mesh.triangles;
  character.texture = picture_of(mesh.texture);
  AuthoredCharacter out;
  out.bytes = character_bytes(character);
  out.figure_from_file = figure_from_file(mesh.axes, view);
  out.report.vertices = static_cast<int>(vertices.size());
  out.report.triangles = static_cast<int>(mesh.triangles.size() / 3);
  out.report.texture_width = mesh.texture.cols, out.report.texture_height = mesh.texture.rows;
  out.report.made_from = "3D mesh";
  out.report.proposal = proposal;
  out.report.notes = mesh.notes;
  if (mesh.parts > 1) out.report.notes.push_back(std::to_string(mesh.parts) + " parts were put together");
  for (const std::string& doubt : doubts_about(proposal)) out.report.notes.push_back(doubt);
  return out;
}

}  // namespace nt
