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
#include "app/export/pose_csv.h"
#include "app/export/report.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/take/from_session.h"
#include "app/take/recorder.h"
#include "app/ui/overlay.h"
#include "platform/sim/sim_camera.h"

namespace nt {
namespace {

struct Options {
  CaptureOptions capture;
  std::string csv, truth, overlay, json, contact_sheet, take;
  bool repair = true;
};

SimCamera& simulated(Session& session) {
  auto* sim = dynamic_cast<SimCamera*>(&session.camera());
  if (sim == nullptr) throw UserError("--truth: only the simulated tank knows the truth; use --camera sim", 2);
  return *sim;
}

void add_truth(PoseCsv& truth, Session& session) {
  const TankTruth& known = *simulated(session).truth();
  FishPose pose = known.pose;
  if (!known.visible && pose.ok()) pose.status = PoseStatus::partial;
  truth.add(session.frame_index(), session.frame().timestamp_ns, pose);
}

std::string take_name(const std::string& path) { return std::filesystem::path(path).stem().string(); }

void finish(TakeRecorder& take) {
  take.finish();
  if (take.not_recorded() > 0)
    std::fprintf(stderr, "take: %lld frames are missing, the disk was too slow for them\n",
                 static_cast<long long>(take.not_recorded()));
}

void finish(PoseCsv& csv, bool repair) {
  csv.close();
  const int64_t turned = repair ? csv.look_back() : 0;
  if (turned > 0) std::fprintf(stderr, "head and tail put right in %lld rows\n", static_cast<long long>(turned));
}

void capture(const Options& options) {
  check_outputs(inputs_of(options.capture),
                {options.csv, options.truth, options.overlay, options.json, options.contact_sheet, options.take});
  Session session(options.capture);
  std::optional<PoseCsv> csv, truth;
  if (!options.csv.empty()) csv.emplace(options.csv, session.scale());
  if (!options.truth.empty()) {
    simulated(session);
    truth.emplace(options.truth, 1.0f);  // the tank knows it in its own pixels: the source's
  }
  std::optional<TakeRecorder> take;
  if (!options.take.empty()) take.emplace(options.take, take_info(session, take_name(options.take)));
  const Pane pane = pane_for(session.info().width, session.info().height);
  Film film(options.overlay, options.contact_sheet, pane.width, pane.height, session.info().fps);
  Overlay overlay(pane);
  Scene scene;
  {
    Progress progress(session.info().frame_count);
    while (session.step()) {
      if (csv)
        csv->add(session.frame_index(), session.frame().timestamp_ns, session.capture().pose(),
                 session.capture().order());
      if (take) take->add(take_frame(session));
      if (truth) add_truth(*truth, session);
      if (film.wanted()) {
        overlay.update(session);
        scene.clear(pane.width, pane.height, {0, 0, 0, 1});
        overlay.draw(scene);
        film.add(scene);
      }
      progress.show(session.statistics().frames);
    }
  }
  expect_frames(session);
  if (csv) finish(*csv, options.repair);
  if (truth) truth->close();
  if (take) finish(*take);
  film.finish();
  if (!options.json.empty()) write_text(options.json, pretty(report_json(session)));
  std::fprintf(stderr, "%s\n", summary_line(session.statistics()).c_str());
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
  command->add_option("--take", options->take, "a take: motion and poses of every frame, to play and edit later")
      ->type_name("FILE.take");
  command->add_option("--overlay", options->overlay, "video with outline, midline and landmarks")
      ->type_name("FILE.mp4");
  command->add_option("--json", options->json, "report of the run ('-' = standard output)")->type_name("FILE");
  command->add_option("--truth", options->truth, "the tank's truth in the CSV's columns (sim only)")->type_name("FILE");
  command->add_option("--contact-sheet", options->contact_sheet, "twelve frames of the overlay in one picture")
      ->type_name("FILE.png");
  command->footer("Example: neontetra capture -c trout.avi --csv trout.csv --overlay trout.mp4 --json -");
  command->callback([&action, options] { action = [options] { capture(*options); }; });
}

}  // namespace nt
