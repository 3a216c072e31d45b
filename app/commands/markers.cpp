// SPDX-License-Identifier: Apache-2.0
// neontetra markers: recorded markers move a mesh.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/author/character_file.h"
#include "app/author/character_lattice.h"
#include "app/author/skeleton_file.h"
#include "app/author/triangle_mesh.h"
#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/report.h"
#include "app/export/video_writer.h"
#include "app/mocap/drag.h"
#include "app/mocap/marker_choice.h"
#include "app/mocap/marker_puppet.h"
#include "app/mocap/mesh_recording.h"
#include "app/mocap/mesh_view.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/text_file.h"
#include "app/ui/window.h"
#include "app/wardrobe.h"
#include "platform/camera.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr int kWidth = 640, kHeight = 640;
constexpr float kOdd =
    0.1f;  // rms of the registration over the diagonal; an actor who stands as the mesh does gives 0.01 to 0.08

struct Options {
  std::string file, mesh, skeleton, character;
  std::vector<std::string> out;
  MarkerChoice choice;
  int vertices = 600, iterations = 10;
  int64_t frames = -1;
  float bone_weight = LatticeSettings{}.w_d;
  std::string embedding = "phong";
  bool stacked = false, json = false, drag = false;
  DisplayOptions display;  // --drag
};

struct Summary {
  int64_t frames = 0, held = 0, factorised = 0, guarded = 0;
  float largest_step = 0.0f;  // of a mesh vertex between two frames, over the diagonal
  int64_t largest_step_frame = 0;
  float worst_rrms = 0.0f, worst_bone = 0.0f, worst_volume = 0.0f;
  double rrms = 0.0, marker_error = 0.0, solve_us = 0.0, bone_error = 0.0, volume = 0.0;
  int worst_inverted = 0;
  int64_t frames_with_inverted = 0;
  std::optional<MeshRecordingReport> glb;
};

enum class Output { film, glb, csv };

Output kind_of(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  return ending == ".glb" ? Output::glb : ending == ".csv" ? Output::csv : Output::film;
}

void check_kinds(const std::vector<std::string>& paths) {
  for (auto a = paths.begin(); a != paths.end(); ++a) {
    if (std::any_of(paths.begin(), a, [&](const std::string& b) { return kind_of(*a) == kind_of(b); })) {
      throw UserError("markers: two --out of the same kind; one film, one GLB and one CSV at most", 2);
    }
  }
}

class Player {
 public:
  Player(const Options& options, MarkerPuppet& puppet, const MarkerFile& file)
      : options_(options), first_(options.choice.frame), file_(file), puppet_(&puppet), diagonal_(puppet.diagonal()) {
    const int64_t left = static_cast<int64_t>(file.frames()) - first_;
    end_ = first_ + (options.frames < 0 ? left : std::min(left, options.frames));
    for (const std::string& path : options.out) open(path);
  }
  Summary play() {
    Progress progress(end_ - first_);
    MeshView view(kWidth, kHeight, upright(), 0.55f * diagonal_);
    for (int64_t f = first_; f < end_; ++f) {
      take(f);
      if (video_ != nullptr) {
        const cv::Mat& picture = view.draw(puppet_->places(), puppet_->triangles(), puppet_->targets(), centre());
        video_->add({picture.data, picture.total() * 3});
      }
      if (csv_ != nullptr) write_row(f);
      if (glb_ != nullptr) glb_->add(*puppet_);
      progress.show(f - first_ + 1);
    }
    if (video_ != nullptr) video_->finish();
    if (csv_ != nullptr) csv_->close();
    if (glb_ != nullptr) sum_.glb = glb_->write(glb_path_);
    return sum_;
  }
  const MarkerPuppet& puppet() const { return *puppet_; }

 private:
  // A little from above and from the side; the mesh's own up is y, as in most files.
  static Quat upright() {
    return from_rotation_vector({0.15f, 0.0f, 0.0f}) * from_rotation_vector({0.0f, -0.5f, 0.0f});
  }
  Vec3 centre() const {
    Vec3 sum;
    for (const Vec3 p : puppet_->lattice().vertices()) sum += p;
    return sum * (1.0f / static_cast<float>(puppet_->lattice().vertices().size()));
  }
  void take(int64_t f) {
    last_ = puppet_->places();
    const int64_t before_ns = steady_now_ns();
    const LatticeReport report = puppet_->step(file_.frame(static_cast<std::size_t>(f)));
    sum_.solve_us += static_cast<double>(steady_now_ns() - before_ns) * 1e-3;
    ++sum_.frames;
    sum_.held += report.held, sum_.factorised += report.factorised, sum_.guarded += report.guarded;
    if (f == first_) volume_ = puppet_->volume();
    if (f > first_) measure_step(f);
    const LatticeQuality q = puppet_->lattice().quality();
    sum_.rrms += static_cast<double>(q.rrms);
    sum_.worst_rrms = std::max(sum_.worst_rrms, q.rrms);
    sum_.worst_bone = std::max(sum_.worst_bone, q.bone_error_max);
    sum_.bone_error += static_cast<double>(q.bone_error_sum);
    sum_.worst_inverted = std::max(sum_.worst_inverted, q.inverted);
    sum_.frames_with_inverted += q.inverted > 0;
    const double change = std::abs(puppet_->volume() / volume_ - 1.0);
    sum_.volume += change;
    sum_.worst_volume = std::max(sum_.worst_volume, static_cast<float>(change));
    sum_.marker_error += static_cast<double>(puppet_->marker_error() / diagonal_);
  }
  void measure_step(int64_t f) {
    const auto& now = puppet_->places();
    for (std::size_t i = 0; i < now.size(); i += 3) {
      const Vec3 moved{now[i] - last_[i], now[i + 1] - last_[i + 1], now[i + 2] - last_[i + 2]};
      const float step = length(moved) / diagonal_;
      if (step > sum_.largest_step) sum_.largest_step = step, sum_.largest_step_frame = f;
    }
  }
  void open(const std::string& path) {
    switch (kind_of(path)) {
      case Output::glb:
        glb_path_ = path;
        glb_ = std::make_unique<MeshRecording>(*puppet_, std::filesystem::path(path).stem().string(), file_.rate_hz,
                                               !options_.character.empty());
        break;
      case Output::csv:
        open_csv(path);
        break;
      case Output::film:
        video_ = std::make_unique<VideoWriter>(path, kWidth, kHeight, file_.rate_hz);
        break;
    }
  }
  void open_csv(const std::string& path) {
    csv_ = std::make_unique<TextFile>(path);
    std::string head = "frame,time";
    for (std::size_t v = 0; v < puppet_->lattice().vertices().size(); ++v) {
      for (const char* axis : {"_x", "_y", "_z"}) head += ",v" + std::to_string(v) + axis;
    }
    csv_->write(head + "\n");
  }
  void write_row(int64_t f) {
    char text[64];
    std::snprintf(text, sizeof text, "%lld,%.4f", static_cast<long long>(f), static_cast<double>(f) / file_.rate_hz);
    std::string row = text;
    for (const Vec3 p : puppet_->lattice().vertices()) {
      std::snprintf(text, sizeof text, ",%.6g,%.6g,%.6g", static_cast<double>(p.x), static_cast<double>(p.y),
                    static_cast<double>(p.z));
      row += text;
    }
    csv_->write(row + "\n");
  }

  const Options& options_;
  int64_t first_, end_ = 0;
  const MarkerFile& file_;
  MarkerPuppet* puppet_;
  float diagonal_;
  double volume_ = 1.0;
  std::unique_ptr<VideoWriter> video_;
  std::unique_ptr<TextFile> csv_;
  std::unique_ptr<MeshRecording> glb_;
  std::string glb_path_;
  std::vector<float> last_;
  Summary sum_;
};

std::unique_ptr<MarkerPuppet> puppet_of(const Options& options, const MarkerFile& file,
                                        const LoadedCharacter* character) {
  PuppetOptions puppet;
  puppet.lattice.vertices = options.vertices;
  puppet.lattice.form = options.stacked ? LatticeForm::stacked : LatticeForm::arap;
  puppet.solver.max_iterations = options.iterations;
  puppet.solver.w_d = options.bone_weight;
  if (!options.choice.axes.empty()) puppet.turns = {parse_axes(options.choice.axes)};
  puppet.embedding = options.embedding == "phong"   ? Embedding::phong
                     : options.embedding == "green" ? Embedding::green
                                                    : Embedding::linear;
  const auto markers = chosen_markers(file, options.choice);
  const auto frame = static_cast<std::size_t>(options.choice.frame);
  if (character != nullptr) {
    return std::make_unique<MarkerPuppet>(character->character(), file, markers, frame, puppet);
  }
  const TriangleMesh mesh = read_triangles(options.mesh);
  const SkeletonSpec skeleton = skeleton_for(options.skeleton, mesh);
  return std::make_unique<MarkerPuppet>(mesh, skeleton, file, markers, frame, puppet);
}

Json report_of(const Player& player, const MarkerFile& file, const Summary& s) {
  const MarkerPuppet& puppet = player.puppet();
  const LatticeView& view = puppet.view();
  const auto n = static_cast<double>(std::max<int64_t>(s.frames, 1));
  Json json;
  json["frames"] = s.frames;
  json["rate_hz"] = file.rate_hz;
  json["markers"] = view.markers.size();
  json["notes"] = file.notes;
  json["registration_rms"] = puppet.registration().rms / puppet.diagonal();
  json["bound_by_name"] = puppet.bound_by_name();
  json["lattice"] = {
      {"vertices", view.vertices.size()},        {"tetrahedra", view.tetrahedra.size() / 4},
      {"joints", view.skeleton.joints()},        {"solver_bytes", Lattice::bytes_needed(view)},
      {"mesh_vertices", puppet.mesh_vertices()}, {"mesh_vertices_outside", puppet.mesh_vertices_outside()}};
  json["frames_held"] = s.held;
  json["factorisations"] = s.factorised;
  json["mixed_steps_taken_back"] = s.guarded;
  json["largest_step"] = s.largest_step;
  json["largest_step_frame"] = s.largest_step_frame;
  json["rrms_mean"] = s.rrms / n;
  json["rrms_worst"] = s.worst_rrms;
  json["volume_error_mean"] = s.volume / n;
  json["volume_error_worst"] = s.worst_volume;
  json["bone_error_sum_mean"] = s.bone_error / n;
  json["bone_error_worst"] = s.worst_bone;
  json["inverted_worst"] = s.worst_inverted;
  json["frames_with_inverted"] = s.frames_with_inverted;
  json["marker_error_mean"] = s.marker_error / n;
  json["frame_us_mean"] = s.solve_us / n;
  if (s.glb) {
    json["glb"] = {{"joints", s.glb->joints},
                   {"keys", s.glb->keys},
                   {"error_rms", s.glb->error_rms},
                   {"error_most", s.glb->error_most}};
  }
  return json;
}

std::string line_of(const Json& json) {
  char text[300], held[100] = "";
  if (const auto frames = json["frames_held"].get<int64_t>(); frames > 0) {
    std::snprintf(held, sizeof held, "; in %lld frames no marker is seen, and the last pose stays",
                  static_cast<long long>(frames));
  }
  std::snprintf(text, sizeof text,
                "%lld frames, %zu markers, lattice of %zu vertices; largest step of a vertex %.2f %% of the mesh's "
                "diagonal (frame %lld), bones within %.4f %%, %.0f us a frame%s\n",
                static_cast<long long>(json["frames"].get<int64_t>()), json["markers"].get<std::size_t>(),
                json["lattice"]["vertices"].get<std::size_t>(), 100.0 * json["largest_step"].get<double>(),
                static_cast<long long>(json["largest_step_frame"].get<int64_t>()),
                100.0 * json["bone_error_worst"].get<double>(), json["frame_us_mean"].get<double>(), held);
  return text;
}

// A character with a lattice: as its file has it, or with curves along its limbs for a skeleton.
LoadedCharacter character_to_pull(const Options& options) {
  const std::string& path = options.character.empty() ? options.mesh : options.character;
  LoadedCharacter file = load_character(path);
  if (file.character().lattice.present()) return file;
  const LatticeAsset asset = limbed_lattice(file.character(), {options.vertices, LatticeForm::arap});
  std::fprintf(stderr, "%s: %s\n", path.c_str(), describe(asset).c_str());
  Character character = file.character();
  character.lattice = asset.view();
  return LoadedCharacter(character_bytes(character), path, Limits{});
}

void drag(const Options& options) {
  constexpr int kWindowWidth = 960, kWindowHeight = 720;
  constexpr int64_t kFramePeriod_ns = 1'000'000'000 / 60;
  const LoadedCharacter file = character_to_pull(options);
  Drag drag(file.character(), kWindowWidth, kWindowHeight);
  const std::unique_ptr<Display> display = open_window("neontetra: pull, u: last pin goes, x: all go, q: quit",
                                                       kWindowWidth, kWindowHeight, options.display);
  std::vector<InputEvent> events;
  Scene scene;
  for (bool more = true; more && !interrupted();) {
    const int64_t now_ns = steady_now_ns();
    display->poll(events);
    for (const InputEvent& event : events) {
      const bool key = event.kind == InputEvent::Kind::key;
      more = more && event.kind != InputEvent::Kind::quit && !(key && (event.key == 'q' || event.key == 27));
      drag.handle(event);
    }
    (void)drag.step();
    drag.draw(scene);
    display->draw(scene);
    sleep_until_ns(now_ns + kFramePeriod_ns);
  }
}

void markers(const Options& options) {
  if (options.mesh.empty() == options.character.empty()) {
    throw UserError("markers: say what to move: --mesh MESH, or --character FILE.ntchar with a lattice", 2);
  }
  if (!options.character.empty() && !options.skeleton.empty()) {
    throw UserError("markers: --skeleton goes with --mesh; a character's lattice has its own", 2);
  }
  if (options.drag) {
    if (!options.file.empty()) throw UserError("markers: --drag is without a recording; leave out its name", 2);
    return drag(options);
  }
  if (options.file.empty()) throw UserError("markers: which recording? Or --drag to pull by hand", 2);
  check_outputs({options.file, options.mesh, options.skeleton, options.character}, options.out);
  check_kinds(options.out);
  const MarkerFile file = read_recording(options.file, options.choice);
  for (const std::string& note : file.notes) std::fprintf(stderr, "neontetra: %s\n", note.c_str());
  std::optional<LoadedCharacter> character;
  if (!options.character.empty()) character.emplace(options.character, Limits{});
  const auto puppet = puppet_of(options, file, character ? &*character : nullptr);
  if (const float rms = puppet->registration().rms / puppet->diagonal(); rms > kOdd)
    std::fprintf(
        stderr,
        "neontetra: in frame %lld the markers lie %.0f %% of the mesh's size away from where they belong: the mesh "
        "must stand as the actor does there (--frame), and be of his kind and side (--mirror)\n",
        static_cast<long long>(options.choice.frame), 100.0 * static_cast<double>(rms));
  Player player(options, *puppet, file);
  const Summary summary = player.play();
  const Json json = report_of(player, file, summary);
  write_text("-", options.json ? pretty(json) : line_of(json));
}

}  // namespace

void add_markers(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("markers", "Move a mesh by recorded markers");
  auto options = std::make_shared<Options>();
  command->add_option("file", options->file, "recorded markers: C3D, TRC, Qualisys TSV or CSV")->type_name("FILE");
  command->add_flag("--drag", options->drag,
                    "in place of a recording: a window to pull at vertices and joints by hand");
  command->add_option("--mesh", options->mesh, "the mesh to move, standing in the pose of --frame")->type_name("MESH");
  command->add_option("--character", options->character, "or a character whose file has a lattice")
      ->type_name("FILE.ntchar");
  command
      ->add_option("--skeleton", options->skeleton,
                   "its joints: text (docs/FORMATS.md), a glTF skin, a BVH, or auto: curves along its limbs")
      ->type_name("FILE|auto");
  add_marker_choice(*command, options->choice);
  command->add_option("--frames", options->frames, "so many, from --frame on (default all)")->type_name("N");
  command->add_option("--vertices", options->vertices, "of the lattice, about (default 600)")
      ->type_name("N")
      ->check(CLI::Range(100, 2000));
  command->add_option("--iterations", options->iterations, "a frame (default 10)")
      ->type_name("N")
      ->check(CLI::Range(1, 1000));
  command->add_option("--bone-weight", options->bone_weight, "how stiff bones are before the exact pass (default 2)")
      ->type_name("W")
      ->check(CLI::Range(0.0f, 100.0f));
  command->add_option("--embedding", options->embedding, "linear, phong, or green as the paper has it (default phong)")
      ->type_name("KIND")
      ->check(CLI::IsMember({"linear", "phong", "green"}));
  command->add_flag("--stacked", options->stacked, "the paper's stacked equations in place of the ARAP energy");
  command
      ->add_option("--out", options->out,
                   "by its ending a film, an animated mesh (.glb) or the lattice's vertices, a row a frame (.csv); may "
                   "be repeated")
      ->type_name("FILE")
      ->take_all();
  command->add_flag("--json", options->json, "what was measured, as JSON");
  add_display_options(*command, options->display, false);
  command->footer("Example: neontetra markers walk.c3d --mesh human.obj --out walk.mp4 --out walk.glb");
  command->callback([&action, options] { action = [options] { markers(*options); }; });
}

}  // namespace nt
