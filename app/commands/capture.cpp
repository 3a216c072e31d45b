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
#include "app/frame_loop/capture_loop.h"
#include "app/frame_loop/loop_watch.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/take/from_session.h"
#include "app/take/take_recording.h"
#include "app/text_file.h"
#include "app/ui/overlay.h"
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
  ThreadPlan threads{};
};

constexpr int kFishOfAll = 8;
constexpr std::chrono::milliseconds kLook{50};

void expect_truth(Session& session, const char* option) {
  if (dynamic_cast<SimCamera*>(&session.camera()) == nullptr)
    throw UserError(std::string(option) + ": only the simulated tank knows the truth; use --camera sim", 2);
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
    if (!options.truth.empty()) expect_truth(session, "--truth");
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

  void add(const Observation& seen) {
    const int64_t frame = seen.frame_index, time_ns = seen.frame.timestamp_ns;
    if (one_) one_->add(frame, time_ns, seen.pose(), seen.of_target().order);
    for (std::size_t i = 0; all_ && i < seen.fish.size(); ++i)
      all_->add(static_cast<int>(i), frame, time_ns, seen.fish[i].pose, seen.fish[i].order);
    if (one_truth_ || all_truth_) add_truth(frame, time_ns, *seen.truth);
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
  void add_truth(int64_t frame, int64_t time_ns, const TankTruth& known) {
    FishPose pose = known.pose;
    if (!known.visible && pose.ok()) pose.status = PoseStatus::partial;
    if (one_truth_) one_truth_->add(frame, time_ns, pose);
    if (!all_truth_) return;
    all_truth_->add(0, frame, time_ns, pose);
    for (std::size_t i = 0; i < known.others.size(); ++i)
      all_truth_->add(static_cast<int>(i) + 1, frame, time_ns, known.others[i]);
  }

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
std::string hash_row(const Observation& seen) {
  char row[96];
  std::snprintf(row, sizeof row, "%lld,%llu,%lld,%016llx\n", static_cast<long long>(seen.frame_index),
                static_cast<unsigned long long>(seen.frame.sequence), static_cast<long long>(seen.frame.timestamp_ns),
                static_cast<unsigned long long>(seen.luma_hash));
  return row;
}

std::string take_name(const std::string& path) { return std::filesystem::path(path).stem().string(); }

// All that a run writes, frame by frame on the store thread.
class Outputs {
 public:
  Outputs(const Options& options, Session& session)
      : options_(options),
        scale_(session.scale()),
        tables_(options, session),
        pane_(pane_for(session.info().width, session.info().height)),
        film_(options.overlay, options.contact_sheet, pane_.width, pane_.height, session.info().fps),
        overlay_(pane_) {
    if (options.overlay_truth) expect_truth(session, "--overlay-truth");
    if (!options.take.empty())
      take_.emplace(options.take, take_info(session, take_name(options.take)), options.keep_video);
    if (!options.frame_hashes.empty()) hashes_.emplace(options.frame_hashes);
    if (hashes_) hashes_->write("frame,sequence,timestamp_ns,luma_fnv1a64\n");
  }

  Keep needs() const {
    Keep keep;
    keep.contours = film_.wanted();
    keep.picture = film_.wanted() || take_.has_value();
    keep.truth = options_.overlay_truth || !options_.truth.empty();
    keep.luma_hash = hashes_.has_value();
    return keep;
  }

  void write(const Observation& seen) {
    tables_.add(seen);
    if (take_) take_->add(seen, rows_.read(seen));
    if (hashes_) hashes_->write(hash_row(seen));
    if (!film_.wanted() || seen.picture.pixels == nullptr) return;
    overlay_.update(seen);
    if (options_.overlay_truth) overlay_.show_truth(*seen.truth, scale_);
    scene_.clear(pane_.width, pane_.height, {0, 0, 0, 1});
    overlay_.draw(scene_);
    // A frame whose picture found no place in the ring is stood for by the next one, so that the film keeps its pace.
    film_.add(scene_, static_cast<int>(seen.frame_index - filmed_));
    filmed_ = seen.frame_index;
  }
  void close_display() { film_.close_display(); }

  void finish() {
    tables_.close(options_.repair);
    if (take_) take_->finish(), std::fprintf(stderr, "%s\n", take_->summary().c_str());
    if (hashes_) hashes_->close();
    film_.finish();
  }

 private:
  const Options& options_;
  float scale_;
  Tables tables_;
  Pane pane_;
  Film film_;
  Overlay overlay_;
  Scene scene_;
  std::optional<TakeRecording> take_;
  FishRows rows_;
  std::optional<TextFile> hashes_;
  int64_t filmed_ = -1;  // the last frame of the film
};

// Until all frames are stored. How often the machine was slowed down meanwhile.
Json film(const Options& options, Session& session, Outputs& outputs) {
  CaptureLoop::Settings settings;
  settings.pace = options.real_time || session.info().live ? Pace::clock : Pace::every;
  settings.store = outputs.needs();
  settings.plan = options.threads;
  CaptureLoop loop(session, settings,
                   {[&](const Observation& seen) { outputs.write(seen); }, [&] { outputs.close_display(); }});
  Progress progress(session.info().frame_count);
  LoopWatch watch;
  do {
    watch.look();
    progress.show(loop.frames());
  } while (loop.wait(kLook));
  loop.finish();
  return watch.json(loop);
}

void capture(const Options& options) {
  if (options.max_fish && !options.all) throw UserError("--max-fish goes with --all: how many fish get a file", 2);
  if (options.keep_video && options.take.empty()) throw UserError("--keep-video goes with --take", 2);
  check_outputs(inputs_of(options.capture), outputs_of(options));
  CaptureOptions watched = options.capture;
  if (options.all) watched.max_fish = options.max_fish.value_or(kFishOfAll);
  Session session(watched);
  Outputs outputs(options, session);
  const Json loop = film(options, session, outputs);
  expect_frames(session);
  outputs.finish();
  if (!options.json.empty()) {
    Json json = report_json(session);
    json["loop"] = loop;
    write_text(options.json, pretty(json));
  }
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
  add_thread_options(*command, options->threads, false);
  command->footer("Example: neontetra capture -c trout.avi --csv trout.csv --overlay trout.mp4 --json -");
  command->callback([&action, options] { action = [options] { capture(*options); }; });
}

}  // namespace nt
