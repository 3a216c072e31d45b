// SPDX-License-Identifier: Apache-2.0
// neontetra capture: no window; poses to CSV, overlay video, report.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>

#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/film.h"
#include "app/export/fish_files.h"
#include "app/export/pose_csv.h"
#include "app/export/report.h"
#include "app/pacer.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/take/from_session.h"
#include "app/take/take_recording.h"
#include "app/text_file.h"
#include "app/ui/overlay.h"
#include "core/base/hash.h"
#include "platform/linux/clock.h"
#include "platform/sim/sim_camera.h"

namespace nt {
namespace {

struct Options {
  CaptureOptions capture;
  std::string csv, truth, overlay, json, contact_sheet, take, frame_hashes;
  bool repair = true;
  bool all = false;
  bool real_time = false;
  bool overlay_truth = false;
  bool keep_video = false;
  std::optional<int> max_fish;
};

constexpr int kFishOfAll = 8;

SimCamera& simulated(Session& session, const char* option) {
  auto* sim = dynamic_cast<SimCamera*>(&session.camera());
  if (sim == nullptr)
    throw UserError(std::string(option) + ": only the simulated tank knows the truth; use --camera sim", 2);
  return *sim;
}

void finish(PoseCsv& csv, bool repair) {
  csv.close();
  const int64_t turned = repair ? csv.look_back() : 0;
  if (turned > 0) std::fprintf(stderr, "head and tail put right in %lld rows\n", static_cast<long long>(turned));
}

// Poses and truth as CSV: of the target in one file each, or with --all of every fish.
class Tables {
 public:
  Tables(const Options& options, Session& session) {
    if (!options.truth.empty()) simulated(session, "--truth");
    constexpr float kTankScale = 1.0f;  // the tank knows the truth in its own pixels: the source's
    if (options.all) {
      if (!options.csv.empty())
        all_.emplace("--csv", options.csv, session.scale(), session.capture().fish_count(), session.calibration());
      if (!options.truth.empty()) all_truth_.emplace("--truth", options.truth, kTankScale, kMostFish);
    } else {
      if (!options.csv.empty()) one_.emplace(options.csv, session.scale(), session.calibration());
      if (!options.truth.empty()) one_truth_.emplace(options.truth, kTankScale);
    }
  }

  void add(Session& session) {
    const int64_t frame = session.frame_index(), time_ns = session.frame().timestamp_ns;
    const Capture& capture = session.capture();
    if (one_) one_->add(frame, time_ns, capture.pose(), capture.order());
    for (int i = 0; all_ && i < capture.fish_count(); ++i)
      all_->add(i, frame, time_ns, capture.pose(i), capture.order(i));
    if (!one_truth_ && !all_truth_) return;
    const TankTruth& known = *simulated(session, "--truth").truth();
    FishPose pose = known.pose;
    if (!known.visible && pose.ok()) pose.status = PoseStatus::partial;
    if (one_truth_) one_truth_->add(frame, time_ns, pose);
    if (!all_truth_) return;
    all_truth_->add(0, frame, time_ns, pose);
    for (int i = 0; i < static_cast<int>(known.others.size()); ++i)
      all_truth_->add(i + 1, frame, time_ns, known.others[static_cast<std::size_t>(i)]);
  }

  void close(bool repair) {
    if (one_) finish(*one_, repair);
    if (one_truth_) one_truth_->close();
    if (all_truth_) all_truth_->close();
    if (!all_) return;
    for (PoseCsv* csv : all_->files()) finish(*csv, repair);
    std::fprintf(stderr, "written: %s\n", all_->written().c_str());
  }

 private:
  std::optional<PoseCsv> one_, one_truth_;
  std::optional<FishFiles> all_, all_truth_;
};

// Every file that may be written.
std::vector<std::string> outputs_of(const Options& options) {
  std::vector<std::string> outputs = {options.overlay, options.json, options.contact_sheet, options.take,
                                      options.frame_hashes};
  if (options.keep_video) outputs.push_back(options.take + ".mkv");
  for (const std::string& table : {options.csv, options.truth}) {
    if (!options.all) outputs.push_back(table);
    for (int i = 1; options.all && !table.empty() && i <= kMostFish; ++i) outputs.push_back(fish_file(table, i));
  }
  return outputs;
}

// A row a frame: which pixels were looked at, so that two runs can be told to have seen the same.
std::string hash_row(const Session& session) {
  const LumaView& luma = session.frame().luma;
  uint64_t hash = kHashSeed;
  for (int y = 0; y < luma.height; ++y) hash = hash_bytes(luma.row(y), static_cast<std::size_t>(luma.width), hash);
  char row[96];
  std::snprintf(row, sizeof row, "%lld,%llu,%lld,%016llx\n", static_cast<long long>(session.frame_index()),
                static_cast<unsigned long long>(session.frame().sequence),
                static_cast<long long>(session.frame().timestamp_ns), static_cast<unsigned long long>(hash));
  return row;
}

// Steps through the camera's frames: as fast as can be, or each when a live camera would have it.
class Pace {
 public:
  Pace(Session& session, bool real_time)
      : session_(session),
        real_time_(real_time && !session.info().live),
        pacer_(static_cast<int64_t>(1e9 / session.info().fps)) {}
  bool next() {
    if (!real_time_) return session_.step();
    if (session_.statistics().frames == 0) pacer_.start(steady_now_ns());
    sleep_until_ns(pacer_.due_ns());
    const int64_t now_ns = steady_now_ns();
    const int64_t due_ns =
        pacer_.due_ns() + pacer_.skips(now_ns) * pacer_.period_ns();  // of the frame that is not skipped
    for (int skips = pacer_.take(now_ns); skips > 0; --skips) {
      if (!session_.skip()) return false;
    }
    return session_.step(due_ns);
  }

 private:
  Session& session_;
  bool real_time_;
  Pacer pacer_;
};

std::string take_name(const std::string& path) { return std::filesystem::path(path).stem().string(); }

void finish(TakeRecording& take) {
  take.finish();
  std::fprintf(stderr, "%s\n", take.summary().c_str());
}

void capture(const Options& options) {
  if (options.max_fish && !options.all) throw UserError("--max-fish goes with --all: how many fish get a file", 2);
  if (options.keep_video && options.take.empty()) throw UserError("--keep-video goes with --take", 2);
  check_outputs(inputs_of(options.capture), outputs_of(options));
  CaptureOptions watched = options.capture;
  if (options.all) watched.max_fish = options.max_fish.value_or(kFishOfAll);
  Session session(watched);
  Tables tables(options, session);
  std::optional<TakeRecording> take;
  if (!options.take.empty())
    take.emplace(options.take, take_info(session, take_name(options.take)), options.keep_video);
  FishRows rows;
  std::optional<TextFile> hashes;
  if (!options.frame_hashes.empty()) hashes.emplace(options.frame_hashes);
  if (hashes) hashes->write("frame,sequence,timestamp_ns,luma_fnv1a64\n");
  const Pane pane = pane_for(session.info().width, session.info().height);
  Film film(options.overlay, options.contact_sheet, pane.width, pane.height, session.info().fps);
  Overlay overlay(pane);
  Scene scene;
  {
    Progress progress(session.info().frame_count);
    Pace pace(session, options.real_time);
    while (pace.next()) {
      tables.add(session);
      if (take) take->add(session, rows.read(session));
      if (hashes) hashes->write(hash_row(session));
      if (film.wanted()) {
        overlay.update(session);
        if (options.overlay_truth) overlay.show_truth(*simulated(session, "--overlay-truth").truth(), session.scale());
        scene.clear(pane.width, pane.height, {0, 0, 0, 1});
        overlay.draw(scene);
        film.add(scene);
      }
      progress.show(session.statistics().frames);
    }
  }
  expect_frames(session);
  tables.close(options.repair);
  if (take) finish(*take);
  if (hashes) hashes->close();
  film.finish();
  if (!options.json.empty()) write_text(options.json, pretty(report_json(session)));
  std::fprintf(stderr, "%s\n", summary_line(session.statistics()).c_str());
  if (session.statistics().latency.count() > 0)
    std::fprintf(stderr, "%s\n", latency_line(session.statistics(), session.info().fps).c_str());
  end_of_frames(session);
}

}  // namespace

void add_capture(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("capture", "Film without a window: poses to CSV, overlay video, report");
  auto options = std::make_shared<Options>();
  add_capture_options(*command, options->capture);
  command->add_option("--csv", options->csv, "one row of pose a frame ('-' = standard output)")->type_name("FILE");
  command
      ->add_option_function<std::string>(
          "--repair", [options](const std::string& s) { options->repair = s == "on"; },
          "at the end put head and tail right in the CSV, seen over the whole recording (default on)")
      ->type_name("on|off")
      ->check(CLI::IsMember({"on", "off"}));
  command->add_flag(
      "--all", options->all,
      "every fish that swims, each with its own table: --csv fish.csv becomes fish-1.csv, fish-2.csv, ...");
  command
      ->add_option_function<std::string>(
          "--max-fish",
          [options](const std::string& s) {
            options->max_fish = static_cast<int>(parse_integer("--max-fish", s, 1, kMostFish));
          },
          "with --all: how many at a time (default 8)")
      ->type_name("N")
      ->option_text("N");
  command
      ->add_option("--take", options->take,
                   "a take: motion and poses of every frame, with --all of every fish, to play and edit later")
      ->type_name("FILE.take");
  command->add_flag("--keep-video", options->keep_video, "keep the camera's pictures beside the take: FILE.take.mkv");
  command->add_option("--overlay", options->overlay, "video with outline, midline and landmarks")
      ->type_name("FILE.mp4");
  command->add_option("--json", options->json, "report of the run ('-' = standard output)")->type_name("FILE");
  command->add_option("--truth", options->truth, "the tank's truth in the CSV's columns (sim only)")->type_name("FILE");
  command
      ->add_option("--frame-hashes", options->frame_hashes,
                   "a fingerprint of each frame's luma ('-' = standard output)")
      ->type_name("FILE");
  command->add_option("--contact-sheet", options->contact_sheet, "twelve frames of the overlay in one picture")
      ->type_name("FILE.png");
  command->add_flag("--overlay-truth", options->overlay_truth,
                    "draw the tank's true midline into the overlay (sim only)");
  command->add_flag(
      "--real-time", options->real_time,
      "take each frame when a live camera would have it, skip what comes too late, and report the latency");
  command->footer("Example: neontetra capture -c trout.avi --csv trout.csv --overlay trout.mp4 --json -");
  command->callback([&action, options] { action = [options] { capture(*options); }; });
}

}  // namespace nt
