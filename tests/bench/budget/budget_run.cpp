// SPDX-License-Identifier: Apache-2.0
// budget_run film FILE | count FILE [FLAT SOLID] | time FILE FLAT SOLID ROUNDS
// The work of a frame at 960x544, stage by stage, for budget.py to count under QEMU or to time on this machine.
//
// capture's own stages; a flat character posed by moving least squares (retarget); a 3D one posed by its lattice, ten
// iterations, packed for the renderer that places its vertices (lattice); the camera's picture and both characters put into
// buffers and handed over (upload, gl_sink.h). Besides, because films and exports do it so: the same 3D character with its
// vertices placed here (placed), and then handed over (placed_upload). Without characters capture alone.
// count prints, for each marker that it executes, the stage of the interval that this ends ('-' for none), a line each, in step
// with what count_plugin writes. time prints for each stage the nanoseconds that a tenth of the frames keep to, which other jobs disturb
// least, and how fast the processor's clock runs.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/character_skin.h"
#include "app/ui/posed_character.h"
#include "core/character/retarget.h"
#include "core/pipeline/pipeline.h"
#include "platform/display/gles_renderer.h"
#include "platform/linux/clock.h"
#include "platform/linux/mapped_file.h"
#include "tests/bench/budget/gl_sink.h"
#include "tests/bench/budget/marker.h"
#include "tests/bench/counted_film.h"
#include "tests/support/block.h"

namespace {

constexpr nt::FilmSize kSize{960, 544};
constexpr float kFrame_s = 1.0f / 30;
constexpr std::size_t kRetarget = nt::kStages, kLattice = kRetarget + 1, kUpload = kLattice + 1, kPlaced = kUpload + 1,
                      kPlacedUpload = kPlaced + 1, kAll = kPlacedUpload + 1;

std::string stage_name(std::size_t stage) {
  constexpr const char* kMore[] = {"retarget", "lattice", "upload", "placed", "placed_upload"};
  return stage < nt::kStages ? nt::kStageNames[stage] : kMore[stage - nt::kStages];
}

using StageSums = std::array<int64_t, kAll>;  // of one frame: nanoseconds, or a bit for each interval between markers

template <class T>
T must(nt::Result<T> result) {
  if (!result.ok()) throw std::runtime_error(result.status().message);
  return result.value();
}

nt::MappedFile mapped(const char* path) {
  std::optional<nt::MappedFile> file = nt::MappedFile::open(path);
  if (!file) throw std::runtime_error(std::string("cannot read ") + path);
  return std::move(*file);
}

enum class Kind { flat, skinned, placed };

// A character file and what poses it.
class Puppet {
 public:
  Puppet(const char* path, Kind kind, uint32_t slot)
      : file_(mapped(path)), character_(must(nt::open_character(file_.bytes(), nt::Limits{}))), slot_(slot) {
    nt::RetargetSettings settings;
    settings.mls = character_.deformer;
    settings.deformer = kind == Kind::flat ? nt::Deformer::mls : nt::Deformer::lattice;
    settings.vertices = kind != Kind::skinned;
    nt::Arena measuring;
    (void)must(nt::Retarget::create(measuring, character_, settings));
    block_ = std::make_unique<nt::test::Block>(measuring.used());
    nt::Arena arena(block_->span());
    retarget_ = must(nt::Retarget::create(arena, character_, settings));
    if (kind == Kind::flat) return;
    if (retarget_->lattice() == nullptr) throw std::runtime_error(std::string(path) + " has no lattice");
    lattice_vertices_ = character_.lattice.view.vertices.size();
    if (kind == Kind::placed) return;
    parts_ = std::make_unique<nt::CharacterSkin>(character_);
    skin_ = parts_->view(slot_);
    packed_.resize(12 * lattice_vertices_);
  }
  void start(float init_len_px) { retarget_->start(init_len_px); }
  void pose(const nt::Motion& motion) {
    retarget_->pose(motion, kFrame_s, {});
    if (!retarget_->renderer_places()) return;
    retarget_->lattice()->pack(packed_);
    skin_.lattice = packed_, skin_.origin = retarget_->origin(), skin_.up = retarget_->up();
  }
  void draw(nt::Scene& scene) const {
    if (!retarget_->renderer_places()) return nt::add_posed(scene, character_, *retarget_, slot_, {});
    nt::Picture texture = character_.texture;
    texture.id = slot_;
    scene.solid(texture, skin_);
  }
  void describe() const {
    std::printf("# character: %zu vertices, %zu control points, %zu lattice vertices\n", character_.vertices.size(),
                retarget_->rest_handles().size(), lattice_vertices_);
  }

 private:
  nt::MappedFile file_;
  nt::Character character_;
  uint32_t slot_;
  std::unique_ptr<nt::test::Block> block_;
  nt::Retarget* retarget_ = nullptr;
  std::size_t lattice_vertices_ = 0;
  std::unique_ptr<nt::CharacterSkin> parts_;
  nt::LatticeSkin skin_;
  std::vector<float> packed_;
};

class Pipeline {
 public:
  Pipeline(const char* flat, const char* solid) : block_(nt::Capture::bytes_needed(limits(), {})) {
    capture_ = must(nt::Capture::create(block_.span(), limits(), {}, kSize.width, kSize.height));
    if (flat == nullptr) return;
    flat_.emplace(flat, Kind::flat, 2);
    skinned_.emplace(solid, Kind::skinned, 3);
    placed_.emplace(solid, Kind::placed, 4);
    renderer_ = std::make_unique<nt::GlesRenderer>();
  }

  // `now` is read where a stage begins or ends.
  StageSums step(const nt::Frame& frame, nt::NowNs now) {
    StageSums sums{};
    const nt::StepReport report = capture_->step(frame, now);
    std::copy(report.times.ns.begin(), report.times.ns.end(), sums.begin());
    int64_t last = now();
    const auto lap = [&](std::size_t stage) {
      const int64_t t = now();
      sums[stage] = t - last;
      last = t;
    };
    if (!flat_ || !capture_->pose().ok()) return sums;
    if (poses_++ == 0)
      for (Puppet* puppet : {&*flat_, &*skinned_, &*placed_}) puppet->start(capture_->init_len());
    flat_->pose(capture_->motion());
    lap(kRetarget);
    skinned_->pose(capture_->motion());
    lap(kLattice);
    const uint64_t before = nt::budget::gl_bytes_taken();
    show(frame, *skinned_);
    lap(kUpload);
    uploaded_ = nt::budget::gl_bytes_taken() - before;
    placed_->pose(capture_->motion());
    lap(kPlaced);
    show(frame, *placed_);
    lap(kPlacedUpload);
    return sums;
  }
  int poses() const { return poses_; }
  void describe() const {
    if (!flat_) return;
    flat_->describe(), skinned_->describe();
    std::printf("# bytes handed to the graphics processor: %llu\n", static_cast<unsigned long long>(uploaded_));
  }

 private:
  static nt::Limits limits() {
    nt::Limits limits;
    limits.max_width = kSize.width, limits.max_height = kSize.height;
    return limits;
  }
  // As `live` has it: the camera's picture, and the characters on a ground beside it.
  void show(const nt::Frame& frame, const Puppet& solid) {
    nt::Picture picture;
    picture.pixels = frame.luma.data, picture.width = frame.luma.width, picture.height = frame.luma.height;
    picture.stride = static_cast<int>(frame.luma.stride), picture.id = 1, picture.revision = ++pictures_;
    scene_.clear(2 * kSize.width, kSize.height, {});
    scene_.image(picture, {}, {static_cast<float>(kSize.width), static_cast<float>(kSize.height)});
    flat_->draw(scene_);
    solid.draw(scene_);
    renderer_->draw(scene_, 2 * kSize.width, kSize.height, nt::RowOrder::bottom_up);
  }

  nt::test::Block block_;
  nt::Capture* capture_ = nullptr;
  std::optional<Puppet> flat_, skinned_, placed_;
  std::unique_ptr<nt::GlesRenderer> renderer_;
  nt::Scene scene_;
  uint64_t pictures_ = 0;
  int poses_ = 0;
  uint64_t uploaded_ = 0;  // bytes, in the last frame
};

int64_t no_clock() { return 0; }

// A clock that reads 1, 2, 4, 8 ...: what a stage takes by it is a sum of powers of two, one for each interval that was its
// own, the first interval of the frame being 1.
int markers = 0;
int64_t marker_clock() {
  nt::budget::mark_interval();
  return int64_t{1} << markers++;
}

void count(const char* film, const char* flat, const char* solid) {
  nt::FilmReader reader(film, kSize);
  Pipeline pipeline(flat, solid);
  std::vector<std::string> owners;
  int steps = 0;
  for (int n = 0; n < nt::kBefore + nt::kCounted; ++n) {
    const nt::Frame frame = reader.next();
    if (n < nt::kBefore) {
      pipeline.step(frame, no_clock);
      continue;
    }
    markers = 0;
    const StageSums sums = pipeline.step(frame, marker_clock);
    const std::size_t first = owners.size();  // the interval before the frame's first marker is nobody's
    owners.resize(first + static_cast<std::size_t>(markers), "-");
    for (std::size_t stage = 0; stage < kAll; ++stage)
      for (std::size_t bit = 0; bit + 1 < static_cast<std::size_t>(markers); ++bit)
        if ((sums[stage] >> bit & 1) != 0) owners[first + bit + 1] = stage_name(stage);
    ++steps;
  }
  std::printf("# frames: %d\n", steps);
  pipeline.describe();
  if (flat != nullptr && pipeline.poses() < nt::kCounted) throw std::runtime_error("the fish was not seen");
  for (const std::string& owner : owners) std::printf("%s\n", owner.c_str());
}

// Of a chain of rotations, each of which waits for the one before: one a cycle on every processor of the last twenty years.
double clock_ghz() {
  double best = 0;
  for (int run = 0; run < 5; ++run) {
    uint64_t x = 1;
    const int64_t before_ns = nt::steady_now_ns();
    for (int i = 0; i < 1000000; ++i) {
#if defined(__x86_64__)
      asm volatile(
          "ror $7, %0\n ror $9, %0\n ror $7, %0\n ror $9, %0\n ror $7, %0\n ror $9, %0\n ror $7, %0\n ror $9, %0"
          : "+r"(x));
#elif defined(__aarch64__)
      asm volatile(
          "ror %0, %0, 7\n ror %0, %0, 9\n ror %0, %0, 7\n ror %0, %0, 9\n ror %0, %0, 7\n ror %0, %0, 9\n"
          "ror %0, %0, 7\n ror %0, %0, 9"
          : "+r"(x));
#endif
    }
    best = std::max(best, 8e6 / static_cast<double>(nt::steady_now_ns() - before_ns));
  }
  return best;
}

void time(const char* film, const char* flat, const char* solid, int rounds) {
  std::array<std::vector<int64_t>, kAll> times_ns;
  for (int round = 0; round < rounds; ++round) {
    nt::FilmReader reader(film, kSize);
    Pipeline pipeline(flat, solid);
    for (int n = 0; n < nt::kBefore + nt::kCounted; ++n) {
      const StageSums sums = pipeline.step(reader.next(), nt::steady_now_ns);
      for (std::size_t stage = 0; n >= nt::kBefore && stage < kAll; ++stage) times_ns[stage].push_back(sums[stage]);
    }
  }
  std::printf("# ghz: %.3f\n", clock_ghz());
  for (std::size_t stage = 0; stage < kAll; ++stage) {
    std::vector<int64_t>& all = times_ns[stage];
    std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(all.size() / 10), all.end());
    std::printf("%s %lld\n", stage_name(stage).c_str(), static_cast<long long>(all[all.size() / 10]));
  }
}

}  // namespace

int main(int argc, char** argv) try {
  const std::string verb = argc > 2 ? argv[1] : "";
  if (verb == "film" && argc == 3) nt::shoot_film(argv[2], kSize);
  else if (verb == "count" && (argc == 3 || argc == 5))
    count(argv[2], argc == 5 ? argv[3] : nullptr, argc == 5 ? argv[4] : nullptr);
  else if (verb == "time" && argc == 6) time(argv[2], argv[3], argv[4], std::max(1, std::atoi(argv[5])));
  else {
    std::fprintf(stderr, "usage: budget_run film FILE | count FILE [FLAT SOLID] | time FILE FLAT SOLID ROUNDS\n");
    return 2;
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "budget_run: %s\n", e.what());
  return 1;
}
