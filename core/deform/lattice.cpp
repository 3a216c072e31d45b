// SPDX-License-Identifier: Apache-2.0
#include "core/deform/lattice.h"

#include <algorithm>
#include <new>

#include "core/deform/untangle.h"

namespace nt {
namespace {

// Loads of four floats at the last vertex must stay inside, and vectors are worked on four floats at a time.
std::size_t floats_for(std::size_t vertices) { return (3 * vertices + 1 + 3) / 4 * 4; }

float diagonal_of(std::span<const Vec3> points) {
  Vec3 low = points[0], high = points[0];
  for (const Vec3 p : points) {
    low = {det::min(low.x, p.x), det::min(low.y, p.y), det::min(low.z, p.z)};
    high = {det::max(high.x, p.x), det::max(high.y, p.y), det::max(high.z, p.z)};
  }
  const float d = length(high - low);
  return d > 0.0f ? d : 1.0f;
}

std::span<Float4> take4(Arena& arena, std::size_t count) {
  const auto span = arena.take_raw<Float4>(count);
  std::fill(span.begin(), span.end(), splat4(0.0f));
  return span;
}

}  // namespace

void Lattice::lay_out(Arena& arena) {
  n_ = view_.vertices.size();
  const std::size_t blocks = (n_ + 3) / 4;
  x_ = arena.take<float>(floats_for(n_));
  last_ = arena.take<float>(floats_for(n_));
  before_ = arena.take<float>(floats_for(n_));
  gradient_ = arena.take<float>(floats_for(n_));
  f_ = arena.take<float>(floats_for(n_));
  b_ = take4(arena, n_);
  if (view_.form == LatticeForm::stacked) h_ = take4(arena, n_);
  columns_ = arena.take<float>(9 * 4 * blocks + 4);
  q_ = arena.take_raw<Quat4>(blocks);
  rest_ = take4(arena, n_);
  markers_ = arena.take<Marker>(view_.markers.size());
  on_bone_ = arena.take<uint8_t>(n_);
  pose_ = arena.take<Vec3>(n_);
  factor_.create(arena, view_.column_start, view_.rows);
  anderson_.create(arena, floats_for(n_));
  skeleton_.create(arena, view_.skeleton, view_.vertices);
}

std::size_t Lattice::bytes_needed(const LatticeView& view) {
  Arena measure;
  measure.take<std::byte>(sizeof(Lattice));
  Lattice lattice;
  lattice.view_ = view;
  lattice.lay_out(measure);
  return measure.used();
}

Result<Lattice*> Lattice::create(Arena& arena, const LatticeView& view, const LatticeSettings& settings) {
  const auto memory = arena.take<std::byte>(sizeof(Lattice));
  if (memory.empty()) return Status{StatusCode::out_of_memory, "not enough memory for the lattice"};
  auto* lattice = new (memory.data()) Lattice;
  lattice->view_ = view;
  lattice->settings_ = settings;
  lattice->lay_out(arena);
  if (arena.full()) return Status{StatusCode::out_of_memory, "not enough memory for the lattice"};
  lattice->diagonal_ = diagonal_of(view.vertices);
  for (std::size_t i = 0; i < lattice->n_; ++i) {
    lattice->rest_[i] = to4(view.vertices[i]);
    lattice->pose_[i] = view.vertices[i];
  }
  for (Quat4& q : lattice->q_) q = {splat4(1.0f), splat4(0.0f), splat4(0.0f), splat4(0.0f)};
  for (const uint16_t v : view.skeleton.chain) lattice->on_bone_[v] = 1;
  return lattice;
}

void Lattice::reset() {
  started_ = factored_ = false;
  for (Marker& m : markers_) m = {};
}

Vec3 Lattice::marker_place(const MarkerBinding& b) const {
  Vec3 sum;
  for (int k = 0; k < 4; ++k) sum += b.weight[k] * at(b.vertex[k]);
  return sum;
}

// The rest pose, turned and shifted onto the markers that are seen (Horn 1987).
void Lattice::start_rigidly() {
  Vec3 rest_centre, centre;
  float count = 0.0f;
  const auto rest_place = [&](std::size_t m) {
    Vec3 sum;
    for (int k = 0; k < 4; ++k) sum += view_.markers[m].weight[k] * view_.vertices[view_.markers[m].vertex[k]];
    return sum;
  };
  for (std::size_t m = 0; m < markers_.size(); ++m) {
    if (!markers_[m].seen) continue;
    rest_centre += rest_place(m), centre += markers_[m].target, count += 1.0f;
  }
  rest_centre = rest_centre * (1.0f / count), centre = centre * (1.0f / count);
  float s[9] = {};
  for (std::size_t m = 0; m < markers_.size(); ++m) {
    if (!markers_[m].seen) continue;
    const Vec3 from = rest_place(m) - rest_centre, to = markers_[m].target - centre;
    const float row[3] = {from.x, from.y, from.z};
    for (int r = 0; r < 3; ++r) s[3 * r] += row[r] * to.x, s[3 * r + 1] += row[r] * to.y, s[3 * r + 2] += row[r] * to.z;
  }
  const Quat q = best_rotation(s);
  for (std::size_t i = 0; i < n_; ++i) {
    const Vec3 p = centre + rotate(q, view_.vertices[i] - rest_centre);
    x_[3 * i] = p.x, x_[3 * i + 1] = p.y, x_[3 * i + 2] = p.z;
  }
  for (Quat4& block : q_) block = {splat4(q.w), splat4(q.x), splat4(q.y), splat4(q.z)};
  std::copy(x_.begin(), x_.end(), last_.begin());
  std::copy(x_.begin(), x_.end(), before_.begin());
}

// The markers' change since the last frame as a mixture of their two changes before it, by least squares.
Lattice::Course Lattice::course() const {
  float s11 = 0.0f, s12 = 0.0f, s22 = 0.0f, r1 = 0.0f, r2 = 0.0f;
  if (steady_frames_ < 3) return {};
  for (const Marker& m : markers_) {
    const Vec3 now = m.target - m.before;
    s11 += dot(m.step, m.step), s12 += dot(m.step, m.step_before), s22 += dot(m.step_before, m.step_before);
    r1 += dot(now, m.step), r2 += dot(now, m.step_before);
  }
  constexpr float kRidge = 1e-3f;
  s11 += kRidge * (s11 + s22), s22 += kRidge * (s11 + s22);
  const float det = s11 * s22 - s12 * s12;
  if (!(det > 0.0f)) return {};
  return {det::clamp((s22 * r1 - s12 * r2) / det, -3.0f, 3.0f), det::clamp((s11 * r2 - s12 * r1) / det, -3.0f, 3.0f)};
}

void Lattice::extrapolate() {
  const Course course_now = settings_.extrapolate ? course() : Course{};
  const Float4 a = splat4(course_now.last), b = splat4(course_now.before);
  for (std::size_t i = 0; i < x_.size(); i += 4) {
    const Float4 now = load4(&x_[i]), last = load4(&last_[i]), before = load4(&before_[i]);
    store4(&before_[i], last);
    store4(&last_[i], now);
    store4(&x_[i], now + a * (now - last) + b * (last - before));
  }
}

void Lattice::add_shape() {
  const float w_l = view_.form == LatticeForm::arap ? settings_.w_l : settings_.w_l * settings_.w_l;
  const auto row = [&](std::size_t i, auto f) {  // of L
    float sum = 0.0f;
    for (uint32_t p = view_.neighbour_start[i]; p < view_.neighbour_start[i + 1]; ++p) sum += view_.weights[p];
    f(static_cast<uint16_t>(i), sum);
    for (uint32_t p = view_.neighbour_start[i]; p < view_.neighbour_start[i + 1]; ++p) {
      f(view_.neighbours[p], -view_.weights[p]);
    }
  };
  const auto add = [&](uint16_t i, uint16_t j, float v) {
    if (i == j) factor_.add_diagonal(i, w_l * v);
    if (i < j) factor_.add(i, j, w_l * v);
  };
  for (std::size_t i = 0; i < n_; ++i) {
    row(i, [&](uint16_t j, float v) {
      if (view_.form == LatticeForm::arap) return add(static_cast<uint16_t>(i), j, v);
      row(i, [&](uint16_t k, float u) { add(j, k, v * u); });
    });
  }
}

bool Lattice::factorise() {
  factor_.clear();
  add_shape();
  const float w_u2 = settings_.w_u * settings_.w_u, w_d2 = settings_.w_d * settings_.w_d;
  for (std::size_t m = 0; m < markers_.size(); ++m) {
    const MarkerBinding& b = view_.markers[m];
    const float w = w_u2 * markers_[m].weight;
    for (int k = 0; k < 4 && w > 0.0f; ++k) {
      factor_.add_diagonal(b.vertex[k], w * b.weight[k] * b.weight[k]);
      for (int l = 0; l < k; ++l) {
        const float v = w * b.weight[k] * b.weight[l];
        if (v != 0.0f) factor_.add(b.vertex[k], b.vertex[l], v);
      }
    }
  }
  skeleton_.each_edge([&](uint16_t a, uint16_t b, Vec3) {
    factor_.add_diagonal(a, w_d2);
    factor_.add_diagonal(b, w_d2);
    factor_.add(a, b, -w_d2);
  });
  return factor_.factorise(b_);
}

// S of four vertices (core/deform/rotations.h), and b = -L x on the way.
Matrix4x Lattice::gather_block(std::size_t block) {
  const float *x = x_.data(), *weights = view_.weights.data();
  const uint16_t* neighbours = view_.neighbours.data();
  const Float4* rest = rest_.data();
  Float4 s[3][4];
  for (std::size_t lane = 0; lane < 4; ++lane) {
    const std::size_t i = 4 * block + lane;
    if (i >= n_) {  // any matrix with a rotation
      s[0][lane] = make4(1, 0, 0, 0), s[1][lane] = make4(0, 1, 0, 0), s[2][lane] = make4(0, 0, 1, 0);
      continue;
    }
    Float4 sx = splat4(0.0f), sy = sx, sz = sx, sum = sx;
    const Float4 here = load4(x + 3 * i), rest_here = rest[i];
    for (uint32_t p = view_.neighbour_start[i]; p < view_.neighbour_start[i + 1]; ++p) {
      const std::size_t j = neighbours[p];
      const Float4 e = splat4(weights[p]) * (here - load4(x + 3 * j)), from = rest_here - rest[j];
      sx += broadcast4<0>(from) * e;
      sy += broadcast4<1>(from) * e;
      sz += broadcast4<2>(from) * e;
      sum += e;
    }
    s[0][lane] = sx, s[1][lane] = sy, s[2][lane] = sz;
    b_[i] = splat4(0.0f) - sum;
  }
  Matrix4x m;
  for (int r = 0; r < 3; ++r) {
    transpose4(s[r][0], s[r][1], s[r][2], s[r][3]);
    m.m[3 * r] = s[r][0], m.m[3 * r + 1] = s[r][1], m.m[3 * r + 2] = s[r][2];
  }
  return m;
}

// Rotations from the iterate (Eq 5).
void Lattice::turn_vertices() {
  for (std::size_t block = 0; block < q_.size(); ++block) {
    const Matrix4x m = gather_block(block);
    if (newton_rotations(m, 2, q_[block])) {
      for (int lane = 0; lane < 4; ++lane) {
        float one[9];
        for (int k = 0; k < 9; ++k) one[k] = m.m[k][lane];
        set_lane(q_[block], lane, best_rotation(one));
      }
    }
    const Matrix4x r = matrices(q_[block]);
    Float4 turned[3][4];
    for (int c = 0; c < 3; ++c) {
      turned[c][0] = r.m[c], turned[c][1] = r.m[3 + c], turned[c][2] = r.m[6 + c], turned[c][3] = splat4(0.0f);
      transpose4(turned[c][0], turned[c][1], turned[c][2], turned[c][3]);
    }
    // Each store's spare lane is overwritten by the next one.
    for (std::size_t lane = 0; lane < 4; ++lane) {
      for (std::size_t c = 0; c < 3; ++c) store4(&columns_[9 * (4 * block + lane) + 3 * c], turned[c][lane]);
    }
  }
}

// b += Delta, so that b = Delta - L x. What edge ij adds to i it takes from j.
void Lattice::sum_shape() {
  const float *columns = columns_.data(), *weights = view_.weights.data();
  const uint16_t* neighbours = view_.neighbours.data();
  const Float4* rest = rest_.data();
  Float4* b = b_.data();
  const Float4 half = splat4(0.5f);
  for (std::size_t i = 0; i < n_; ++i) {
    const float* r = columns + 9 * i;
    const Float4 x = load4(r), y = load4(r + 3), z = load4(r + 6), rest_here = rest[i];
    Float4 sum = splat4(0.0f);
    const uint32_t first = view_.neighbour_start[i];
    for (uint32_t p = view_.neighbour_start[i + 1]; p-- > first;) {
      const std::size_t j = neighbours[p];
      if (j < i) break;
      const float* other = columns + 9 * j;
      const Float4 e = splat4(weights[p]) * (half * (rest_here - rest[j]));
      const Float4 pull = broadcast4<0>(e) * (x + load4(other)) + broadcast4<1>(e) * (y + load4(other + 3)) +
                          broadcast4<2>(e) * (z + load4(other + 6));
      sum += pull;
      b[j] -= pull;
    }
    b[i] += sum;
  }
}

// The stacked form's b = L^T (Delta - L x).
void Lattice::stack_shape() {
  std::copy(b_.begin(), b_.end(), h_.begin());
  for (std::size_t i = 0; i < n_; ++i) {
    Float4 sum = splat4(0.0f);
    for (uint32_t p = view_.neighbour_start[i]; p < view_.neighbour_start[i + 1]; ++p) {
      sum += splat4(view_.weights[p]) * (h_[i] - h_[view_.neighbours[p]]);
    }
    b_[i] = sum;
  }
}

void Lattice::add_constraints() {
  const bool arap = view_.form == LatticeForm::arap;
  const float w_l = arap ? settings_.w_l : settings_.w_l * settings_.w_l;
  if (!arap) stack_shape();
  if (w_l != 1.0f) {
    for (Float4& v : b_) v = splat4(w_l) * v;
  }
  const float w_u2 = settings_.w_u * settings_.w_u, w_d2 = settings_.w_d * settings_.w_d;
  for (std::size_t m = 0; m < markers_.size(); ++m) {
    const MarkerBinding& b = view_.markers[m];
    const Float4 pull = to4((w_u2 * markers_[m].weight) * (markers_[m].target - marker_place(b)));
    for (int k = 0; k < 4; ++k) b_[b.vertex[k]] += splat4(b.weight[k]) * pull;
  }
  if (view_.skeleton.joints() == 0) return;
  skeleton_.project(x_.data(), q_);
  skeleton_.each_edge([&](uint16_t a, uint16_t c, Vec3 gamma) {
    const Float4 pull = to4(w_d2 * (gamma - (at(c) - at(a))));
    b_[c] += pull;
    b_[a] -= pull;
  });
}

// One round of [L] Algorithm 1's loop. Returns the squared change that a plain iteration makes.
double Lattice::iterate() {
  turn_vertices();
  sum_shape();
  add_constraints();
  const auto pack = [&](std::span<float> to) {
    for (std::size_t i = 0; i < n_; ++i) to[3 * i] = b_[i][0], to[3 * i + 1] = b_[i][1], to[3 * i + 2] = b_[i][2];
  };
  if (settings_.accelerate) pack(gradient_);
  factor_.solve(b_);
  pack(f_);
  if (!settings_.accelerate) return anderson_.plain(f_, x_);
  return anderson_.mix(gradient_, f_, x_);
}

// What the exact pass moved the bones by is spread over the vertices around them: eight sweeps of the harmonic mean.
void Lattice::spread_bone_shift() {
  for (std::size_t i = 0; i < n_; ++i) {
    b_[i] = on_bone_[i] ? to4(pose_[i] - at(i)) : splat4(0.0f);
  }
  for (int sweep = 0; sweep < 8; ++sweep) {
    for (std::size_t i = 0; i < n_; ++i) {
      if (on_bone_[i]) continue;
      Float4 sum = splat4(0.0f);
      float weight = 0.0f;
      for (uint32_t p = view_.neighbour_start[i]; p < view_.neighbour_start[i + 1]; ++p) {
        sum += splat4(view_.weights[p]) * b_[view_.neighbours[p]];
        weight += view_.weights[p];
      }
      b_[i] = splat4(1.0f / weight) * sum;
    }
  }
  for (std::size_t i = 0; i < n_; ++i) {
    if (!on_bone_[i]) pose_[i] += xyz(b_[i]);
  }
}

// The pose from the iterate. Returns how many tetrahedra are turned inside out.
int Lattice::finish() {
  for (std::size_t i = 0; i < n_; ++i) pose_[i] = at(i);
  if (view_.skeleton.joints() > 0 && settings_.exact_bones) {
    skeleton_.project(x_.data(), q_);
    static_assert(sizeof(Vec3) == 3 * sizeof(float));
    skeleton_.place(&pose_[0].x);
    spread_bone_shift();
  }
  return settings_.untangle_sweeps > 0 ? untangle(view_, on_bone_, settings_.untangle_sweeps, pose_) : 0;
}

LatticeReport Lattice::step(std::span<const Vec3> markers, std::span<const uint8_t> seen) {
  LatticeReport report;
  const bool changed = read_markers(markers, seen, report);
  if (report.markers == 0) {
    report.held = true;
    return report;
  }
  steady_frames_ = changed || blending_ ? 0 : steady_frames_ + (steady_frames_ < 3);
  if (!started_) {
    start_rigidly();
  } else {
    extrapolate();
  }
  if (changed || !factored_) {
    factored_ = factorise();
    report.factorised = true;
    if (!factored_) {
      report.singular = true;
      std::copy(last_.begin(), last_.end(), x_.begin());
      return report;
    }
  }
  anderson_.restart();
  const double scale = 1.0 / (static_cast<double>(diagonal_) * diagonal_ * static_cast<double>(n_));
  while (report.iterations < settings_.max_iterations) {
    report.residual = static_cast<float>(det::sqrt(iterate() * scale));
    ++report.iterations;
    if (report.residual < settings_.tolerance) break;
  }
  report.guarded = anderson_.guarded();
  started_ = true;
  report.inverted = finish();
  return report;
}

LatticeQuality Lattice::quality() const {
  LatticeQuality q;
  double off = 0.0, all = 0.0;
  for (std::size_t i = 0; i < n_; ++i) {
    const Quat turn = lane_of(q_[i / 4], static_cast<int>(i % 4));
    for (uint32_t p = view_.neighbour_start[i]; p < view_.neighbour_start[i + 1]; ++p) {
      const uint16_t j = view_.neighbours[p];
      const Vec3 rest = view_.vertices[i] - view_.vertices[j];
      off += view_.weights[p] * length_sq(pose_[i] - pose_[j] - rotate(turn, rest));
      all += view_.weights[p] * length_sq(rest);
    }
  }
  q.rrms = static_cast<float>(det::sqrt(off / all));
  const SkeletonView& s = view_.skeleton;
  for (std::size_t j = 0; j < s.joints(); ++j) {
    for (uint32_t p = s.chain_start[j] + 1; p < s.chain_start[j + 1]; ++p) {
      const float rest = skeleton_.edge_length(p), now = length(pose_[s.chain[p]] - pose_[s.chain[p - 1]]);
      const float error = det::abs(now - rest) / rest;
      q.bone_error_sum += error;
      q.bone_error_max = det::max(q.bone_error_max, error);
      ++q.bone_edges;
    }
  }
  const auto& tets = view_.tetrahedra;
  for (std::size_t t = 0; t < tets.size(); t += 4) {
    q.inverted += !(volume6(pose_[tets[t]], pose_[tets[t + 1]], pose_[tets[t + 2]], pose_[tets[t + 3]]) > 0.0f);
  }
  return q;
}

}  // namespace nt
