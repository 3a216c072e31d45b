// SPDX-License-Identifier: Apache-2.0
// neontetra animate: the character swims like the filmed fish, in a video.
//
// In-betweens are placed in time, so the video plays at the fish's own speed: n of them between two video frames make
// (n + 1) times the source's frame rate. Unless asked for, as many as keep the video at or under 60 frames a second, at
// most [F]'s five: a clip of 10 frames a second gets 5 (60), one of 30 gets 1 (60), one of 60 none.
// m source frames make (m - 1)(n + 1) + 1 drawn ones.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "app/cast.h"
#include "app/check_outputs.h"
#include "app/cli.h"
#include "app/export/film.h"
#include "app/export/pose_csv.h"
#include "app/export/report.h"
#include "app/export/shape_report.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/ui/backdrop.h"
#include "app/ui/overlay.h"
#include "core/motion/inbetween.h"

namespace nt {
namespace {

constexpr double kSmoothFps = 60;  // more is not seen on most displays
constexpr int kAsManyAsFit = -1;

struct Options {
  CaptureOptions capture;
  CastOptions cast;
  BackdropOption backdrop;
  std::string out, contact_sheet, csv, json;
  bool side_by_side = false;
  int inbetweens = kAsManyAsFit;
};

int inbetweens_for(const Options& options, double fps) {
  if (options.inbetweens != kAsManyAsFit) return options.inbetweens;
  return std::clamp(static_cast<int>(kSmoothFps / fps + 0.01) - 1, 0, kInBetweens);
}

// The panes and what is in them.
class Stage {
 public:
  Stage(const Options& options, Session& session)
      : cast_(options.cast, session),
        overlay_pane_(pane_for(session.info().width, session.info().height)),
        actor_pane_(options.side_by_side ? beside(overlay_pane_) : overlay_pane_),
        overlay_(overlay_pane_),
        side_by_side_(options.side_by_side),
        backdrop_(options.backdrop, actor_pane_, session) {}

  int width() const { return actor_pane_.width * (side_by_side_ ? 2 : 1); }
  int height() const { return actor_pane_.height; }

  // The frame of the last step, after n in-betweens that lead to it from the frame before.
  void play(Session& session, int n, double fps, Film& film) {
    const Observation& seen = observer_.look(session, side_by_side_ || backdrop_.watches(), backdrop_.watches());
    cast_.see(seen);
    backdrop_.update(seen);
    const float dt_s = static_cast<float>(1.0 / (fps * (n + 1)));
    for (int k = 0; k < n && session.frame_index() > 0; ++k) show(in_between_fraction(k, n), dt_s, film);
    if (side_by_side_) overlay_.update(seen);
    show(1, dt_s, film);
    if (!cast_.leader().seen()) return;
    const Distortion distortion = cast_.leader().retarget().distortion();
    shape_.add(session.frame_index(), distortion, to_source(actor_pane_.to_frame(distortion.where), session.scale()));
  }
  // Of the first drawing, over all video frames with a pose.
  Json shape_json() const { return shape_.json(cast_.leader().character()); }

 private:
  void show(float t, float dt_s, Film& film) {
    scene_.clear(width(), height(), backdrop_.colour());
    cast_.pose(t, dt_s, actor_pane_);
    backdrop_.draw(scene_);
    cast_.draw(scene_);
    if (side_by_side_) overlay_.draw(scene_);  // last: it hides what of the character leaves its own pane
    film.add(scene_);
  }

  Observer observer_;
  Cast cast_;
  Pane overlay_pane_, actor_pane_;
  Overlay overlay_;
  bool side_by_side_;
  Backdrop backdrop_;
  ShapeReport shape_;
  Scene scene_;
};

void check(const Options& options) {
  const auto shown = static_cast<std::size_t>(options.cast.school * options.capture.max_fish);
  if (options.cast.characters.size() > shown) {
    throw UserError("--character: " + std::to_string(options.cast.characters.size()) + " characters for " +
                        std::to_string(shown) + " drawing" + (shown > 1 ? "s" : "") +
                        "; leave some out, or ask for --max-fish or --school " +
                        std::to_string(options.cast.characters.size()),
                    2);
  }
  std::vector<std::string> inputs = inputs_of(options.capture);
  inputs.insert(inputs.end(), options.cast.characters.begin(), options.cast.characters.end());
  inputs.push_back(options.backdrop.path);
  check_outputs(inputs, {options.out, options.contact_sheet, options.csv, options.json});
}

void animate(const Options& options) {
  check(options);
  Session session(options.capture);
  Stage stage(options, session);
  const double fps = session.info().fps;
  const int n = inbetweens_for(options, fps);
  std::optional<PoseCsv> csv;
  if (!options.csv.empty()) csv.emplace(options.csv, session.scale(), session.calibration());
  Film film(options.out, options.contact_sheet, stage.width(), stage.height(), fps * (n + 1));
  {
    Progress progress(session.info().frame_count);
    while (session.step()) {
      stage.play(session, n, fps, film);
      if (csv)
        csv->add(session.frame_index(), session.frame().timestamp_ns, session.capture().pose(),
                 session.capture().order());
      progress.show(session.statistics().frames);
    }
  }
  expect_frames(session);
  film.finish();
  if (csv) csv->close(), csv->look_back();
  if (!options.json.empty()) {
    Json json = report_json(session);
    json["character"] = stage.shape_json();
    write_text(options.json, pretty(json));
  }
  std::fprintf(stderr, "%s\n%s: %lld drawn frames at %g a second (%d in-betweens)\n",
               summary_line(session.statistics()).c_str(), options.out.c_str(), static_cast<long long>(film.frames()),
               fps * (n + 1), n);
  end_of_frames(session);
}

}  // namespace

void add_animate(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("animate", "Make a video in which the character swims like the fish");
  auto options = std::make_shared<Options>();
  add_capture_options(*command, options->capture);
  add_cast_options(*command, options->cast, options->capture);
  command->add_option("-o,--out", options->out, "the video")->type_name("FILE.mp4")->required();
  command->add_flag("--side-by-side", options->side_by_side, "the camera with its overlay on the left");
  command
      ->add_option("--inbetweens", options->inbetweens,
                   "drawn frames between two video frames; they make the video smoother, not slower "
                   "(default: up to 5, as long as it stays at or under 60 frames a second)")
      ->type_name("N")
      ->check(CLI::Range(0, 30));
  command->add_option("--contact-sheet", options->contact_sheet, "twelve frames of it in one picture")
      ->type_name("FILE.png");
  command->add_option("--csv", options->csv, "one row of pose a frame ('-' = standard output)")->type_name("FILE");
  command->add_option("--json", options->json, "report of the run ('-' = standard output)")->type_name("FILE");
  add_backdrop_option(*command, [options](const BackdropOption& backdrop) { options->backdrop = backdrop; });
  command->footer("Example: neontetra animate -c trout.avi --character carp.ntchar --out trout.mp4 --side-by-side");
  command->callback([&action, options] { action = [options] { animate(*options); }; });
}

}  // namespace nt
