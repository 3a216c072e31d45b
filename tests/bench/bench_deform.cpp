// SPDX-License-Identifier: Apache-2.0
// bench_deform [--frames N] [--scene NAME] [--character FILE] [--timed FILE] [--vertices N] [--json]
// Our moving least squares on a filmed tank motion, in one run on one thread:
//   cost: a pose and five in-betweens of a 3D character, the bundled whale, against the same closed form in plain Eigen;
//   shape: area and angle distortion of a drawing, the carp, against as-rigid-as-possible deformation of the same mesh and handles.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "app/actor.h"
#include "app/author/mesh_character.h"
#include "app/author/mesh_file.h"
#include "app/author/picture_character.h"
#include "core/base/simd_target.h"
#include "core/character/distortion.h"
#include "core/motion/inbetween.h"
#include "core/pipeline/pipeline.h"
#include "platform/sim/tank.h"
#include "tests/bench/accuracy.h"
#include "tests/bench/arap.h"
#include "tests/bench/plain_mls.h"
#include "tests/support/block.h"

namespace {

using nt::Vec2;
using nt::test::quantile;

constexpr double kPaperOne_us = 7780;  // [F] Table 3, 3D whale of 6,003 vertices, one retargeting, Core i7-3970X
constexpr int kArapRounds = 10;
constexpr float kThinSpread = 0.15f;  // as core/character/retarget has it

struct Options {
  nt::TankSettings tank{.scene = "turns"};
  int frames = 300;
  std::string character = NEONTETRA_ASSETS "/characters/carp.png";
  std::string timed = NEONTETRA_ASSETS "/characters/whale.glb";
  int vertices = 6003;  // wanted of a drawing that is timed; of a mesh, at most
  bool json = false;
};

[[noreturn]] void usage(const char* why) {
  std::fprintf(stderr,
               "bench_deform: %s\nusage: bench_deform [--frames N] [--scene NAME] [--character FILE] [--timed FILE] "
               "[--vertices N] [--json]\n",
               why);
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--json") o.json = true;
    else if (i + 1 == argc) usage("an option is unknown or lacks its value");
    else if (key == "--frames") o.frames = std::atoi(argv[++i]);
    else if (key == "--scene") o.tank.scene = argv[++i];
    else if (key == "--character") o.character = argv[++i];
    else if (key == "--timed") o.timed = argv[++i];
    else if (key == "--vertices") o.vertices = std::atoi(argv[++i]);
    else usage("an option is unknown");
  }
  if (o.frames < 3 || o.vertices < 100) usage("--frames starts at 3, --vertices at 100");
  if (nt::find_tank_scene(o.tank.scene) == nullptr) usage("no such scene");
  return o;
}

double now_us() {
  return static_cast<double>(std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1)) * 1e-3;
}

template <class T>
T must(nt::Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.status().message);
  return result.value();
}

struct Swim {
  std::vector<nt::Motion> motions;  // of consecutive frames with a pose
  float init_len = 0;
};

Swim film(const Options& o) {
  nt::Tank tank(o.tank);
  nt::Limits limits;
  limits.max_width = o.tank.width, limits.max_height = o.tank.height;
  const nt::CaptureSettings settings;
  const nt::test::Block block(nt::Capture::bytes_needed(limits, settings));
  nt::Capture& capture = *must(nt::Capture::create(block.span(), limits, settings, o.tank.width, o.tank.height));
  Swim swim;
  for (int n = 0; static_cast<int>(swim.motions.size()) < o.frames && n < 4 * o.frames + 100; ++n) {
    nt::Frame frame;
    frame.luma = tank.render_next();
    frame.sequence = static_cast<uint64_t>(n);
    frame.timestamp_ns = static_cast<int64_t>(1e9 * n / o.tank.fps);
    capture.step(frame);
    if (capture.pose().ok()) swim.motions.push_back(capture.motion());
  }
  swim.init_len = capture.init_len();
  if (swim.motions.size() < 3) throw std::runtime_error("no fish in the tank");
  return swim;
}

std::vector<std::byte> authored(const std::string& path, int vertices) {
  if (nt::is_mesh_file(path)) {
    nt::MeshOptions options;
    options.vertices = vertices;
    return nt::author_mesh(path, options).bytes;
  }
  nt::PictureOptions options;
  options.vertices = vertices;
  return nt::author_picture(path, options).bytes;
}

// A character with its retargeter.
class Puppet {
 public:
  Puppet(const std::string& path, int vertices)
      : file_(authored(path, vertices), path, nt::Limits{}), block_(bytes_needed()) {
    nt::Arena arena(block_.span());
    retarget_ = must(nt::Retarget::create(arena, file_.character(), {}));
  }
  nt::Retarget& retarget() { return *retarget_; }
  const nt::Character& character() const { return file_.character(); }

 private:
  std::size_t bytes_needed() const {
    nt::Arena measuring;
    (void)must(nt::Retarget::create(measuring, file_.character(), {}));
    return measuring.used();
  }
  nt::LoadedCharacter file_;
  nt::test::Block block_;
  nt::Retarget* retarget_ = nullptr;
};

struct Cost {
  std::size_t vertices = 0, triangles = 0, handles = 0;
  double ours_us = 0, ours_worst_us = 0;            // a pose and five in-betweens
  double deform_us = 0, plain_us = 0, kept_us = 0;  // one deformation of the mesh alone
  double difference = 0;                            // largest, character units
};

Cost time_cost(const Options& o, const Swim& swim) {
  Puppet puppet(o.timed, o.vertices);
  nt::Retarget& retarget = puppet.retarget();
  const nt::Character& character = puppet.character();
  Cost cost;
  cost.vertices = character.vertices.size(), cost.triangles = character.triangles.size() / 3;
  cost.handles = retarget.rest_handles().size();
  const nt::RetargetSettings settings;
  nt::test::PlainMls plain(character.vertices, retarget.rest_handles(), settings.mls_alpha,
                           nt::test::Precomputed::nothing);
  nt::test::PlainMls kept(character.vertices, retarget.rest_handles(), settings.mls_alpha,
                          nt::test::Precomputed::weights);
  nt::Arena measuring;
  (void)nt::Mls::create(measuring, character.vertices, retarget.rest_handles(), settings.mls, settings.mls_alpha);
  const nt::test::Block block(measuring.used());
  nt::Arena arena(block.span());
  const nt::Mls& mls =
      *nt::Mls::create(arena, character.vertices, retarget.rest_handles(), settings.mls, settings.mls_alpha);
  std::vector<Vec2> a(character.vertices.size()), b(a.size());
  std::vector<double> ours, deform, slow, slower, warm_up;
  retarget.start(swim.init_len);
  const auto dt_s = static_cast<float>(1.0 / (o.tank.fps * (nt::kInBetweens + 1)));
  for (std::size_t n = 1; n < swim.motions.size(); ++n) {
    const double start = now_us();
    for (int k = 0; k < nt::kInBetweens; ++k)
      retarget.pose(nt::in_between(swim.motions[n - 1], swim.motions[n], nt::in_between_fraction(k)), dt_s, {});
    retarget.pose(swim.motions[n], dt_s, {});
    ours.push_back(now_us() - start);
    if (n % 4 != 0) continue;  // the plain ones take their time
    const std::span<const Vec2> handles = retarget.handles();
    const auto time = [&](std::vector<double>& into, auto&& f, std::vector<Vec2>& out) {
      const double from = now_us();
      f.deform(handles, out);
      into.push_back(now_us() - from);
    };
    // Each twice, the second counts: in a run of in-betweens the caches hold what the one before has read.
    for (std::vector<double>* into : {&warm_up, &slower}) time(*into, plain, a);
    for (std::vector<double>* into : {&warm_up, &slow}) time(*into, kept, b);
    for (std::vector<double>* into : {&warm_up, &deform}) time(*into, mls, b);
    for (std::size_t v = 0; v < a.size(); ++v)
      cost.difference = std::max<double>(cost.difference, nt::length(a[v] - b[v]));
  }
  cost.ours_us = quantile(std::vector<float>(ours.begin(), ours.end()), 0.5);
  cost.ours_worst_us = quantile(std::vector<float>(ours.begin(), ours.end()), 0.99);
  cost.deform_us = quantile(std::vector<float>(deform.begin(), deform.end()), 0.5);
  cost.kept_us = quantile(std::vector<float>(slow.begin(), slow.end()), 0.5);
  cost.plain_us = quantile(std::vector<float>(slower.begin(), slower.end()), 0.5);
  return cost;
}

// Of each triangle: how far its area and its angles are from the rest pose's. With singular values s1 >= s2 of the
// triangle's own map: area = |ln(s1 s2)|, angle = s1 / s2 - 1. A triangle that turned over counts by its magnitude, and once more.
struct Shape {
  std::vector<float> area, angle;
  int64_t inverted = 0, triangles = 0;
  double worst_fin = 0;  // largest |area ratio - 1| of a fin
  std::vector<float> time_us;
};

void add_triangle(Shape& shape, Vec2 p, Vec2 q, Vec2 u, Vec2 v) {
  const float rest = nt::cross(p, q);
  if (rest == 0.0f) return;
  // [u v] = J [p q]; c + i s and d + i t are J's conformal and anticonformal parts.
  const float a = (u.x * q.y - v.x * p.y) / rest, b = (v.x * p.x - u.x * q.x) / rest;
  const float c = (u.y * q.y - v.y * p.y) / rest, d = (v.y * p.x - u.y * q.x) / rest;
  const float with = std::hypot(a + d, c - b) / 2, against = std::hypot(a - d, c + b) / 2;
  const float s1 = with + against, s2 = std::max(std::abs(with - against), 1e-6f);
  shape.area.push_back(std::abs(std::log(s1 * s2)));
  shape.angle.push_back(s1 / s2 - 1);
  shape.inverted += with < against;
  ++shape.triangles;
}

void add_pose(Shape& shape, const nt::Character& character, const nt::DistortionMeter& meter,
              std::span<const Vec2> posed) {
  const auto t = character.triangles;
  const auto r = character.vertices;
  for (std::size_t i = 0; i < t.size(); i += 3) {
    add_triangle(shape, r[t[i + 1]] - r[t[i]], r[t[i + 2]] - r[t[i]], posed[t[i + 1]] - posed[t[i]],
                 posed[t[i + 2]] - posed[t[i]]);
  }
  const nt::Distortion d = meter.measure(posed, 1.0f, false);
  for (const float ratio : d.fin_area)
    shape.worst_fin = std::max(shape.worst_fin, std::abs(static_cast<double>(ratio) - 1));
}

constexpr int kShapes = 5;
constexpr const char* kShapeNames[kShapes] = {"MLS rigid (default)", "MLS similarity", "MLS affine",
                                              "ARAP, AnimatedDrawings'", "ARAP, 10 rounds"};

std::vector<Shape> compare_shapes(const Options& o, const Swim& swim) {
  Puppet puppet(o.character, nt::PictureOptions{}.vertices);
  nt::Retarget& retarget = puppet.retarget();
  const nt::Character& character = puppet.character();
  nt::test::Arap arap(character.vertices, character.triangles, retarget.rest_handles());
  nt::Arena measuring;
  const nt::MlsKind kinds[3] = {nt::MlsKind::rigid, nt::MlsKind::similarity, nt::MlsKind::affine};
  const float alpha = nt::RetargetSettings{}.mls_alpha;
  const auto lay_out = [&](nt::Arena& arena, std::vector<nt::Mls*>& mls) {
    for (const nt::MlsKind kind : kinds)
      mls.push_back(nt::Mls::create(arena, character.vertices, retarget.rest_handles(), kind, alpha, kThinSpread));
    return nt::DistortionMeter::create(arena, character);
  };
  std::vector<nt::Mls*> none, mls;
  (void)lay_out(measuring, none);
  const nt::test::Block block(measuring.used());
  nt::Arena arena(block.span());
  const nt::DistortionMeter& meter = *lay_out(arena, mls);
  std::vector<Shape> shapes(kShapes);
  std::vector<Vec2> posed(character.vertices.size());
  retarget.start(swim.init_len);
  for (std::size_t n = 0; n < swim.motions.size(); ++n) {
    retarget.pose(swim.motions[n], static_cast<float>(1 / o.tank.fps), {});
    if (n % 3 != 0) continue;
    for (std::size_t s = 0; s < kShapes; ++s) {
      const double from = now_us();
      if (s < 3) mls[s]->deform(retarget.handles(), posed);
      else arap.deform(retarget.handles(), s == 3 ? 1 : kArapRounds, posed);
      shapes[s].time_us.push_back(static_cast<float>(now_us() - from));
      add_pose(shapes[s], character, meter, posed);
    }
  }
  return shapes;
}

std::string machine() {
  std::ifstream cpu("/proc/cpuinfo");
  for (std::string line; std::getline(cpu, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "a machine that does not say its name";
}

void print_tables(const Options& o, const Cost& c, std::vector<Shape>& shapes) {
  std::printf("%s, g++ %s, Highway %s, Eigen %d.%d.%d, one thread; tank scene %s, %d frames\n\n", machine().c_str(),
              __VERSION__, nt::simd_target(), EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION,
              o.tank.scene.c_str(), o.frames);
  std::printf("cost of %s: %zu vertices, %zu triangles, %zu control points; medians in us\n",
              std::filesystem::path(o.timed).filename().c_str(), c.vertices, c.triangles, c.handles);
  std::printf("  a pose and five in-betweens        %9.1f  (p99 %.1f)\n", c.ours_us, c.ours_worst_us);
  std::printf("  that against the paper's 7,780 us for one pose: 1 / %.1f (wanted: 1 / 5)\n", kPaperOne_us / c.ours_us);
  std::printf("  one deformation, ours              %9.1f\n", c.deform_us);
  std::printf("  Eigen, nothing precomputed         %9.1f  ratio %.1f (wanted: 10)\n", c.plain_us,
              c.plain_us / c.deform_us);
  std::printf("  Eigen, weights and A_i precomputed %9.1f  ratio %.1f\n", c.kept_us, c.kept_us / c.deform_us);
  std::printf("  largest difference between them: %.4f character units\n\n", c.difference);
  std::printf("shape of the drawing, every third frame, %lld triangles in all\n",
              static_cast<long long>(shapes[0].triangles));
  std::printf("%-24s %18s %20s %9s %9s %9s\n", "", "area: median  p99", "angle: median  p99", "inverted", "fin area",
              "us a pose");
  for (std::size_t s = 0; s < kShapes; ++s) {
    Shape& x = shapes[s];
    std::printf("%-24s %12.4f %6.3f %13.4f %6.3f %9lld %7.1f %% %9.1f\n", kShapeNames[s], quantile(x.area, 0.5),
                quantile(x.area, 0.99), quantile(x.angle, 0.5), quantile(x.angle, 0.99),
                static_cast<long long>(x.inverted), 100 * x.worst_fin, quantile(x.time_us, 0.5));
  }
  std::printf(
      "area: |ln| of a triangle's area over its rest area; angle: long over short side of a unit square, less 1\n");
  std::printf("fin area: the largest change of a fin's whole area\n");
}

void print_json(const Options& o, const Cost& c, std::vector<Shape>& shapes) {
  std::printf("{\"machine\": \"%s\", \"simd\": \"%s\", \"scene\": \"%s\", \"frames\": %d,\n", machine().c_str(),
              nt::simd_target(), o.tank.scene.c_str(), o.frames);
  std::printf(
      " \"cost\": {\"vertices\": %zu, \"control_points\": %zu, \"pose_and_five_us\": %.2f, \"deform_us\": %.2f, "
      "\"eigen_us\": %.2f, \"eigen_precomputed_us\": %.2f, \"ratio\": %.2f, \"ratio_precomputed\": %.2f},\n",
      c.vertices, c.handles, c.ours_us, c.deform_us, c.plain_us, c.kept_us, c.plain_us / c.deform_us,
      c.kept_us / c.deform_us);
  std::printf(" \"shape\": {\n");
  for (std::size_t s = 0; s < kShapes; ++s) {
    Shape& x = shapes[s];
    std::printf(
        "  \"%s\": {\"area_median\": %.5f, \"area_p99\": %.5f, \"angle_median\": %.5f, \"angle_p99\": %.5f, "
        "\"inverted\": %lld, \"worst_fin_area\": %.4f, \"us\": %.2f}%s\n",
        kShapeNames[s], quantile(x.area, 0.5), quantile(x.area, 0.99), quantile(x.angle, 0.5), quantile(x.angle, 0.99),
        static_cast<long long>(x.inverted), x.worst_fin, quantile(x.time_us, 0.5), s + 1 == kShapes ? "" : ",");
  }
  std::printf(" }}\n");
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = parse(argc, argv);
  const Swim swim = film(o);
  const Cost cost = time_cost(o, swim);
  std::vector<Shape> shapes = compare_shapes(o, swim);
  (o.json ? print_json : print_tables)(o, cost, shapes);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_deform: %s\n", e.what());
  return 1;
}
