// SPDX-License-Identifier: Apache-2.0
#include "app/bench/lattice_bench.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "app/aligned_block.h"
#include "app/author/lattice_data.h"
#include "core/deform/sparse_ldlt.h"

namespace nt {
namespace {

// A solver in memory of its own.
class OwnSolver {
 public:
  OwnSolver(const LatticeView& view, const LatticeSettings& settings) : memory_(Lattice::bytes_needed(view)) {
    Arena arena(memory_.bytes());
    lattice_ = Lattice::create(arena, view, settings).value();
  }
  Lattice* operator->() { return lattice_; }

 private:
  AlignedBlock memory_;
  Lattice* lattice_;
};

Vec3 rest_place(const LatticeView& view, const MarkerBinding& b) {
  Vec3 sum;
  for (int k = 0; k < 4; ++k) sum += b.weight[k] * view.vertices[b.vertex[k]];
  return sum;
}

double order_ms(const LatticeView& view) {
  LatticeData data;
  data.form = view.form;
  data.vertices.assign(view.vertices.begin(), view.vertices.end());
  data.tetrahedra.assign(view.tetrahedra.begin(), view.tetrahedra.end());
  return time_us([&] { (void)put_in_order(data); }) * 1e-3;
}

void time_solver(const LatticeView& view, const LaidMarkers& laid, LatticeFigures& out) {
  constexpr int kIterations = 10;
  LatticeSettings plain;
  plain.accelerate = plain.extrapolate = plain.exact_bones = false;
  plain.untangle_sweeps = 0;
  plain.max_iterations = kIterations;
  LatticeSettings none = plain;
  none.max_iterations = 0;
  OwnSolver iterating(view, plain), following(view, LatticeSettings{}), factoring(view, none);
  std::vector<double> iteration, frame, factorise;
  for (std::size_t f = 0; f < std::min<std::size_t>(laid.frames.size(), 120); ++f) {
    const std::vector<Vec3>& markers = laid.frames[f];
    iteration.push_back(time_us([&] { (void)iterating->step(markers, laid.seen[f]); }) / kIterations);
    frame.push_back(time_us([&] { (void)following->step(markers, laid.seen[f]); }));
    // A marker that goes and comes back makes it factorise again.
    std::vector<uint8_t> blinking = laid.seen[f];
    blinking[f % blinking.size()] = 0;
    factorise.push_back(time_us([&] { (void)factoring->step(markers, blinking); }));
  }
  out.iteration_us = median_us(iteration), out.frame_us = median_us(frame), out.factorise_us = median_us(factorise);
}

void time_embedding(const CharacterLattice& l, LatticeFigures& out) {
  Arena measure;
  PhongEmbedding::create(measure, l.embedding, l.view);
  AlignedBlock memory(measure.used());
  Arena arena(memory.bytes());
  PhongEmbedding* phong = PhongEmbedding::create(arena, l.embedding, l.view);
  std::vector<float> places(12 * l.embedding.blocks()), from(3 * l.slots.size(), 1.0f), to(from.size());
  std::vector<double> copy, linear, bent;
  for (std::size_t round = 0; round < 60; ++round) {
    from[round % from.size()] += 1.0f;
    copy.push_back(time_us([&] { std::memcpy(to.data(), from.data(), to.size() * sizeof(float)); }));
    linear.push_back(time_us([&] { embed_linear(l.embedding, l.view, l.view.vertices, places); }));
    bent.push_back(time_us([&] { phong->embed(l.view.vertices, places); }));
  }
  out.memcpy_us = median_us(copy), out.linear_us = median_us(linear), out.phong_us = median_us(bent);
}

double step_of(const std::vector<float>& now, const std::vector<float>& last, float diagonal) {
  float most = 0.0f;
  for (std::size_t i = 0; i < last.size(); i += 3) {
    most = std::max(most, length_sq({now[i] - last[i], now[i + 1] - last[i + 1], now[i + 2] - last[i + 2]}));
  }
  return static_cast<double>(std::sqrt(most) / diagonal);
}

void measure_quality(MarkerPuppet& puppet, const MarkerFile& file, std::size_t first, std::size_t count,
                     LatticeFigures& out) {
  double volume = 0.0;
  std::vector<float> last;
  for (std::size_t f = first; f < first + count; ++f) {
    (void)puppet.step(file.frame(f));
    if (f == first) volume = puppet.volume();
    const LatticeQuality q = puppet.lattice().quality();
    const double change = std::abs(puppet.volume() / volume - 1.0);
    out.rrms += static_cast<double>(q.rrms), out.volume += change;
    out.bone_sum += static_cast<double>(q.bone_error_sum);
    out.worst_rrms = std::max(out.worst_rrms, static_cast<double>(q.rrms));
    out.worst_volume = std::max(out.worst_volume, change);
    out.worst_bone = std::max(out.worst_bone, static_cast<double>(q.bone_error_max));
    out.worst_inverted = std::max(out.worst_inverted, q.inverted);
    out.frames_inverted += q.inverted > 0;
    out.largest_step = std::max(out.largest_step, step_of(puppet.places(), last, puppet.diagonal()));
    last = puppet.places();
  }
  const auto n = static_cast<double>(std::max<std::size_t>(count, 1));
  out.frames = static_cast<int64_t>(count);
  out.rrms /= n, out.volume /= n, out.bone_sum /= n;
}

std::size_t frames_from(const MarkerFile& file, int64_t first, int64_t most) {
  const std::size_t left = file.frames() - static_cast<std::size_t>(first);
  return most < 0 ? left : std::min(left, static_cast<std::size_t>(most));
}

PuppetOptions options_for(const MarkerChoice& choice) {
  PuppetOptions options;
  if (!choice.axes.empty()) options.turns = {parse_axes(choice.axes)};
  return options;
}

}  // namespace

double median_us(std::vector<double> v) {
  if (v.empty()) return 0.0;
  const auto middle = v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2);
  std::nth_element(v.begin(), middle, v.end());
  return *middle;
}

MarkerFile swaying_markers(const Character& c) {
  constexpr int kFrames = 120, kRate = 60;
  constexpr float kSway_hz = 2.0f, kBend_rad = 0.6f;  // of each half of the body
  const LatticeView& view = c.lattice.view;
  MarkerFile file;
  file.rate_hz = kRate;
  float reach = 1e-9f;
  for (const Vec3 p : view.vertices) reach = std::max(reach, std::abs(p.y));
  const char* name = c.lattice.names.data();
  for (std::size_t m = 0; m < view.markers.size(); ++m, name += std::strlen(name) + 1) file.names.emplace_back(name);
  for (int f = 0; f < kFrames; ++f) {
    const float k = kBend_rad / reach * std::sin(det::kTwoPi * kSway_hz * static_cast<float>(f) / kRate);
    for (const MarkerBinding& b : view.markers) {
      const Vec3 p = rest_place(view, b);
      const float a = k * p.y, shorter = a * a > 1e-8f ? std::sin(a) / a : 1.0f;
      const float aside = k * k > 1e-12f ? (1.0f - std::cos(a)) / k : 0.0f;
      file.positions.push_back({p.x * std::cos(a) + aside, p.y * shorter - p.x * std::sin(a), p.z});
    }
  }
  return file;
}

LaidMarkers laid_markers(const Character& c, const MarkerFile& file, const MarkerChoice& choice, int64_t most) {
  const auto first = static_cast<std::size_t>(choice.frame);
  const auto used = chosen_markers(file, choice);
  const MarkerPuppet puppet(c, file, used, first, options_for(choice));
  LaidMarkers out;
  out.bindings.assign(puppet.view().markers.begin(), puppet.view().markers.end());
  for (std::size_t f = first; f < first + frames_from(file, choice.frame, most); ++f) {
    std::vector<Vec3> row;
    for (const std::size_t m : used) row.push_back(puppet.registration()(file.frame(f)[m]));
    out.seen.emplace_back();
    for (const Vec3 p : row) out.seen.back().push_back(is_seen(p));
    out.frames.push_back(std::move(row));
  }
  return out;
}

LatticeFigures lattice_figures(const Character& c, const MarkerFile& file, const MarkerChoice& choice, int64_t most) {
  LatticeFigures out;
  const LaidMarkers laid = laid_markers(c, file, choice, most);
  LatticeView view = c.lattice.view;
  view.markers = laid.bindings;
  out.mesh_vertices = c.vertices.size(), out.mesh_triangles = c.triangles.size() / 3;
  out.vertices = view.vertices.size(), out.tetrahedra = view.tetrahedra.size() / 4;
  out.joints = view.skeleton.joints(), out.markers = view.markers.size();
  out.solver_bytes = Lattice::bytes_needed(view);
  out.order_ms = order_ms(view);
  time_solver(view, laid, out);
  time_embedding(c.lattice, out);
  const auto first = static_cast<std::size_t>(choice.frame);
  MarkerPuppet puppet(c, file, chosen_markers(file, choice), first, options_for(choice));
  measure_quality(puppet, file, first, frames_from(file, choice.frame, most), out);
  return out;
}

}  // namespace nt
