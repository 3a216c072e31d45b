// SPDX-License-Identifier: Apache-2.0
// The lattice solver against a plain one in Eigen double (tests/oracle), and the embeddings against memcpy, in one run on
// one thread. Ours and theirs take turns, so a busy machine slows both; medians. Then [L] Table I side by side on the meshes and
// recordings of ../shared/data, where they are (`--table` for that alone).
#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/author/character_lattice.h"
#include "app/author/marker_places.h"
#include "app/author/skeleton_file.h"
#include "app/author/triangle_mesh.h"
#include "app/bench/lattice_table.h"
#include "core/base/random.h"
#include "core/base/simd_target.h"
#include "core/deform/embed.h"
#include "platform/linux/clock.h"
#include "tests/oracle/deform/lattice_oracle.h"
#include "tests/support/test_lattice.h"

namespace nt::test {
namespace {

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
  const double ours = median_us(plain_us), theirs = median_us(eigen_us);
  std::printf("%5zu %6zu %8zu %9.1f %9.1f %9.1f %10.0f %12.0f\n", data.vertices.size(), data.tetrahedra.size() / 4,
              Lattice::bytes_needed(plain.view()), ours, theirs, theirs / ours, median_us(factor_us),
              median_us(mixed_us));
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
  const double copy = median_us(copy_us);
  std::printf("%5zu %9zu %9.0f %9.0f %7.1f %9.0f %7.1f\n", data.vertices.size(), kVertices, copy, median_us(linear_us),
              median_us(linear_us) / copy, median_us(phong_us), median_us(phong_us) / copy);
}

// A mesh of the shared data as it is, every edge cut in half until it has so many vertices, with a lattice.
class Actor {
 public:
  Actor(const std::string& mesh_path, const std::string& skeleton_path, const std::string& markers_path,
        std::size_t least_vertices, int lattice_vertices, bool joints_are_markers) {
    TriangleMesh mesh = read_triangles(mesh_path);
    const SkeletonSpec skeleton = skeleton_for(skeleton_path, mesh);
    std::vector<MarkerSpec> markers;
    if (!markers_path.empty()) markers = read_marker_places(markers_path, mesh);
    for (const auto& joint : skeleton.joints) {
      if (joints_are_markers) markers.push_back({joint.name, joint.position});
    }
    while (mesh.positions.size() < least_vertices) mesh = finer(mesh);
    for (const Vec3 p : mesh.positions) flat_.push_back({p.x, p.y}), heights_.push_back(p.z);
    triangles_ = mesh.triangles;
    character_.vertices = flat_, character_.heights = heights_, character_.triangles = triangles_;
    const int64_t before_ns = steady_now_ns();
    asset_.emplace(character_, skeleton, markers, LatticeDrive::markers,
                   LatticeOptions{lattice_vertices, LatticeForm::arap});
    build_s = static_cast<double>(steady_now_ns() - before_ns) * 1e-9;
    character_.lattice = asset_->view();
  }
  const Character& character() const { return character_; }
  double build_s = 0;

 private:
  static TriangleMesh finer(const TriangleMesh& mesh) {
    TriangleMesh out{mesh.positions, {}};
    std::map<std::pair<uint32_t, uint32_t>, uint32_t> middles;
    const auto middle = [&](uint32_t a, uint32_t b) {
      const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<uint32_t>(out.positions.size()));
      if (fresh) out.positions.push_back(0.5f * (mesh.positions[a] + mesh.positions[b]));
      return it->second;
    };
    for (std::size_t t = 0; t + 2 < mesh.triangles.size(); t += 3) {
      const uint32_t a = mesh.triangles[t], b = mesh.triangles[t + 1], c = mesh.triangles[t + 2];
      const uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
      out.triangles.insert(out.triangles.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
    }
    return out;
  }
  std::vector<Vec2> flat_;
  std::vector<float> heights_;
  std::vector<uint32_t> triangles_;
  Character character_;
  std::optional<LatticeAsset> asset_;
};

// Ours and the plain solver in turns, on the markers of a recording.
void bench_against_eigen(const Character& c, const MarkerFile& file, const MarkerChoice& choice) {
  const LaidMarkers laid = laid_markers(c, file, choice, 200);
  LatticeView view = c.lattice.view;
  view.markers = laid.bindings;
  LatticeSettings settings;
  settings.accelerate = settings.extrapolate = settings.exact_bones = false;
  settings.untangle_sweeps = 0;
  Block block(Lattice::bytes_needed(view));
  Arena arena(block.span());
  Lattice* ours = Lattice::create(arena, view, settings).value();
  oracle::LatticeOracle oracle(view, settings);
  const std::vector<uint8_t> seen(view.markers.size(), 1);
  std::vector<double> our_us, eigen_us;
  for (std::size_t f = 0; f < std::min<std::size_t>(laid.frames.size(), 40); ++f) {
    our_us.push_back(time_us([&] { (void)ours->step(laid.frames[f], seen); }) / settings.max_iterations);
    eigen_us.push_back(time_us([&] { oracle.iterate(laid.frames[f]); }));
  }
  std::printf("%10zu %9.1f %9.1f %9.1f\n", view.vertices.size(), median_us(our_us), median_us(eigen_us),
              median_us(eigen_us) / median_us(our_us));
}

// Ten accelerated iterations a frame against fifty plain ones: how far each is from the converged pose.
void bench_acceleration(const Character& c, const MarkerFile& file, const MarkerChoice& choice, int64_t frames) {
  const LaidMarkers laid = laid_markers(c, file, choice, frames);
  LatticeView view = c.lattice.view;
  view.markers = laid.bindings;
  LatticeSettings fast, plain, converged;
  fast.untangle_sweeps = plain.untangle_sweeps = converged.untangle_sweeps = 0;
  plain.accelerate = plain.extrapolate = false, plain.max_iterations = 50;
  converged.max_iterations = 400, converged.tolerance = 1e-8f;
  std::vector<std::unique_ptr<Block>> blocks;
  const auto solver = [&](const LatticeSettings& settings) {
    blocks.push_back(std::make_unique<Block>(Lattice::bytes_needed(view)));
    Arena arena(blocks.back()->span());
    return Lattice::create(arena, view, settings).value();
  };
  Lattice *a = solver(fast), *b = solver(plain), *goal = solver(converged);
  double mean[2] = {}, worst[2] = {};
  int farther = 0;
  Vec3 low = view.vertices[0], high = low;
  for (const Vec3 p : view.vertices) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
  }
  const double diagonal = static_cast<double>(length(high - low));
  for (std::size_t f = 0; f < laid.frames.size(); ++f) {
    for (Lattice* l : {a, b, goal}) (void)l->step(laid.frames[f], laid.seen[f]);
    if (f < 4) continue;
    const double off[2] = {static_cast<double>(rms_step(a->vertices(), goal->vertices())) / diagonal,
                           static_cast<double>(rms_step(b->vertices(), goal->vertices())) / diagonal};
    for (int k = 0; k < 2; ++k) mean[k] += off[k], worst[k] = std::max(worst[k], off[k]);
    farther += off[0] > off[1];
  }
  const auto n = static_cast<double>(std::max<std::size_t>(laid.frames.size(), 5) - 4);
  std::printf("%8.0f %11.1e %11.1e %11.1e %11.1e %9d\n", n, mean[0] / n, mean[1] / n, worst[0], worst[1], farther);
}

struct Case {
  std::string name;
  Actor actor;
  MarkerFile file;
  MarkerChoice choice;
};

void bench_table(const std::string& shared, const std::string& assets) {
  if (!std::filesystem::exists(shared + "/meshes")) {
    std::printf("no meshes and recordings in %s: Table I is left out\n", shared.c_str());
    return;
  }
  const std::string meshes = shared + "/meshes/", mocap = shared + "/mocap/";
  std::vector<std::unique_ptr<Case>> cases;
  const auto add = [&](const std::string& name, Actor actor, const std::string& recording, MarkerChoice choice) {
    cases.push_back(std::make_unique<Case>(Case{name, std::move(actor), {}, std::move(choice)}));
    Case& c = *cases.back();
    c.file = recording.empty() ? swaying_markers(c.actor.character()) : read_recording(mocap + recording, c.choice);
  };
  MarkerChoice hand, body;
  hand.only = "hand,thumb,little,ring,middle,index", hand.mirror = true;
  body.axes = "x,z,-y";
  add("armadillo", Actor(meshes + "armadillo.obj", "auto", "", 150000, 423, true), "", {});
  add("body", Actor(meshes + "human_man.obj", "auto", "", 0, 1946, false), "fullbody36_optitrack.c3d", body);
  add("hand", Actor(meshes + "hand_closed.obj", "auto", assets + "/skeletons/hand_left.markers", 0, 368, false),
      "hand21_qualisys_a.tsv", hand);
  std::vector<LatticeColumn> columns;
  for (const auto& c : cases) {
    columns.push_back({c->name, lattice_figures(c->actor.character(), c->file, c->choice, -1)});
    std::fprintf(stderr, "%s: lattice built in %.2f s\n", c->name.c_str(), c->actor.build_s);
  }
  std::fputs(lattice_table(columns, true).c_str(), stdout);
  std::printf("against Eigen: vertices iteration     Eigen     ratio\n");
  for (const auto& c : cases) {
    std::printf("%-12s", c->name.c_str());
    bench_against_eigen(c->actor.character(), c->file, c->choice);
  }
  std::printf(
      "rms from the converged pose / diagonal: 10 accelerated, 50 plain; mean, worst frame; frames in which 10 are "
      "farther\n");
  for (const auto& c : cases) {
    std::printf("%-12s", c->name.c_str());
    bench_acceleration(c->actor.character(), c->file, c->choice, -1);
  }
}

}  // namespace
}  // namespace nt::test

int main(int argc, char** argv) {
  using namespace nt::test;
  if (argc > 1 && std::string(argv[1]) == "--table") {
    bench_table(NEONTETRA_SHARED_DATA, NEONTETRA_ASSETS);
    return 0;
  }
  std::printf("lattice solver, %s build, one thread, us\n", nt::simd_target());
  std::printf("nodes   tets    bytes iteration     Eigen     ratio  factorise  frame of 10\n");
  for (const nt::LatticeData& data : {small_bar(), bar(40, 3, 4, 8), large_bar()}) bench_solver(data);
  std::printf("embedding\nnodes  vertices    memcpy    linear   ratio     Phong   ratio\n");
  for (const nt::LatticeData& data : {small_bar(), bar(40, 3, 4, 8)}) bench_embedding(data);
  bench_table(NEONTETRA_SHARED_DATA, NEONTETRA_ASSETS);
  return 0;
}
