// SPDX-License-Identifier: Apache-2.0
// The lattice solver against a plain one in Eigen double (tests/oracle), and the embeddings against memcpy, in one run on
// one thread. Ours and theirs take turns, so a busy machine slows both; medians.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <vector>

#include "core/base/random.h"
#include "core/base/simd_target.h"
#include "core/deform/embed.h"
#include "tests/oracle/deform/lattice_oracle.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

double now_us() {
  const auto t = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double, std::micro>(t).count();
}

template <class F>
double time_us(F f) {
  const double before = now_us();
  f();
  return now_us() - before;
}

double median(std::vector<double> v) {
  std::nth_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(v.size() / 2), v.end());
  return v[v.size() / 2];
}

void bench_solver(const LatticeData& data) {
  constexpr int kRounds = 40, kIterations = 10;
  LatticeSettings plain_settings;
  plain_settings.accelerate = false;
  plain_settings.exact_bones = plain_settings.extrapolate = false;
  LatticeSettings mixed_settings;
  LatticeSettings no_iterations = plain_settings;
  no_iterations.max_iterations = 0;
  Solver plain(data, plain_settings), mixed(data, mixed_settings), factored(data, no_iterations);
  oracle::LatticeOracle oracle(plain.view(), plain_settings);
  std::vector<double> plain_us, mixed_us, eigen_us, factor_us;
  for (int round = 0; round < kRounds; ++round) {
    const auto markers = bent_markers(plain.view(), 0.1f + 0.001f * static_cast<float>(round));
    plain_us.push_back(time_us([&] { plain.step(markers); }) / kIterations);
    mixed_us.push_back(time_us([&] { mixed.step(markers); }));
    eigen_us.push_back(time_us([&] { oracle.iterate(markers); }));
    // A marker that goes and comes back makes it factorise again.
    std::vector<uint8_t> seen(markers.size(), 1);
    seen[static_cast<std::size_t>(round) % seen.size()] = 0;
    factor_us.push_back(time_us([&] { factored->step(markers, seen); }));
  }
  const double ours = median(plain_us), theirs = median(eigen_us);
  std::printf("%5zu %6zu %8zu %9.1f %9.1f %9.1f %10.0f %12.0f\n", data.vertices.size(), data.tetrahedra.size() / 4,
              Lattice::bytes_needed(plain.view()), ours, theirs, theirs / ours, median(factor_us), median(mixed_us));
}

// Detail vertices spread evenly over the tetrahedra.
struct Detail {
  std::vector<float> coordinates;
  std::vector<uint16_t> tetrahedron;
  Detail(const LatticeData& data, std::size_t vertices) {
    Random r(1);
    const std::size_t tets = data.tetrahedra.size() / 4, blocks = (vertices + 3) / 4;
    for (std::size_t b = 0; b < blocks; ++b) {
      tetrahedron.push_back(static_cast<uint16_t>(b * tets / blocks));
      for (int k = 0; k < 12; ++k) coordinates.push_back(0.33f * r.unit());
    }
  }
};

void bench_embedding(const LatticeData& data) {
  constexpr std::size_t kVertices = 172966;
  const Detail detail(data, kVertices);
  const EmbeddingView embedding{detail.coordinates, detail.tetrahedron};
  std::vector<float> out(12 * embedding.blocks()), from(3 * kVertices, 1.0f), to(3 * kVertices);
  std::vector<Vec3> moved;
  for (const Vec3 p : data.vertices) moved.push_back(bent(p, 0.1f));
  Arena measure;
  PhongEmbedding::create(measure, embedding, data.view());
  Block block(measure.used());
  Arena arena(block.span());
  PhongEmbedding* phong = PhongEmbedding::create(arena, embedding, data.view());
  std::vector<double> copy_us, linear_us, phong_us;
  for (int round = 0; round < 100; ++round) {
    from[static_cast<std::size_t>(round)] += 1.0f;
    copy_us.push_back(time_us([&] { std::memcpy(to.data(), from.data(), to.size() * sizeof(float)); }));
    linear_us.push_back(time_us([&] { embed_linear(embedding, data.view(), moved, out); }));
    phong_us.push_back(time_us([&] { phong->embed(moved, out); }));
  }
  const double copy = median(copy_us);
  std::printf("%5zu %9zu %9.0f %9.0f %7.1f %9.0f %7.1f\n", data.vertices.size(), kVertices, copy, median(linear_us),
              median(linear_us) / copy, median(phong_us), median(phong_us) / copy);
}

}  // namespace
}  // namespace nt::test

int main() {
  using namespace nt::test;
  std::printf("lattice solver, %s build, one thread, us\n", nt::simd_target());
  std::printf("nodes   tets    bytes iteration     Eigen     ratio  factorise  frame of 10\n");
  for (const nt::LatticeData& data : {small_bar(), bar(40, 3, 4, 8), large_bar()}) bench_solver(data);
  std::printf("embedding\nnodes  vertices    memcpy    linear   ratio     Phong   ratio\n");
  for (const nt::LatticeData& data : {small_bar(), bar(40, 3, 4, 8)}) bench_embedding(data);
  return 0;
}
