// SPDX-License-Identifier: Apache-2.0
// How good each background model's masks are, on clips whose masks are known: ./dev bench masks [--ground-truth FOLDER]
// [--frames N] [--json].
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>

#include "app/export/report.h"
#include "app/progress.h"
#include "app/session.h"
#include "app/text_file.h"
#include "platform/camera.h"
#include "tests/bench/masks/mask_clip.h"
#include "tests/bench/masks/mask_model.h"
#include "tests/bench/masks/mask_score.h"

namespace nt {
namespace {

constexpr const char* kScenes[] = {"calm", "hover", "shadow", "night", "ghost", "station", "lamp", "surface", "dirt"};

struct Row {
  std::string clip, model;
  MaskScore score;
  TimeHistogram times;
  std::size_t bytes = 0;
};

// As capture --background still does: up to 20 pictures spread over the clip's
// first 600.
std::vector<cv::Mat> spread_pictures(MaskClip& clip) {
  constexpr int kLook = 600, kEvery = 15;
  std::vector<cv::Mat> pictures;
  MaskedFrame frame;
  for (int n = 0; n < kLook && clip.next(frame); ++n)
    if (n % kEvery == 0) pictures.push_back(frame.bgr.clone());
  clip.rewind();
  std::vector<cv::Mat> spread;
  const std::size_t count = std::min<std::size_t>(kLearnFrames, pictures.size());
  for (std::size_t i = 0; i < count; ++i) spread.push_back(pictures[i * pictures.size() / count]);
  return spread;
}

std::vector<Row> score_clip(MaskClip& clip, Progress& progress, int64_t& done) {
  const std::vector<cv::Mat> pictures = spread_pictures(clip);
  if (pictures.empty()) throw UserError(clip.name() + ": there is no frame in it that can be read");
  const std::vector<std::unique_ptr<MaskModel>> models = make_mask_models(pictures[0].size());
  std::vector<Row> rows;
  for (const auto& model : models) {
    if (model->name() == "still") model->learn(pictures);
    rows.push_back({clip.name(), model->name(), {}, {}, model->bytes()});
  }
  MaskedFrame frame;
  cv::Mat mask;
  while (clip.next(frame) && !interrupted()) {
    progress.show(++done);
    for (std::size_t i = 0; i < models.size(); ++i) {
      double us = 0;
      const bool means_something = models[i]->apply(frame.bgr, mask, us);
      rows[i].times.add(static_cast<int64_t>(us * 1e3));
      if (means_something && !frame.truth.empty()) rows[i].score.add(mask, frame.truth);
    }
  }
  return rows;
}

Json to_json(const Row& row) {
  return {{"clip", row.clip},
          {"model", row.model},
          {"frames", row.score.frames},
          {"f_measure", row.score.f_measure()},
          {"precision", row.score.precision()},
          {"recall", row.score.recall()},
          {"median_us", row.times.quantile_ns(0.5) * 1e-3},
          {"model_bytes", row.bytes > 0 ? Json(row.bytes) : Json(nullptr)}};
}

std::string line_of(const Row& row) {
  char text[160];
  std::snprintf(text, sizeof text, "%-16s %-12s %6d  %9.3f %9.3f %6.3f %9.0f %9s\n", row.clip.c_str(),
                row.model.c_str(), row.score.frames, row.score.f_measure(), row.score.precision(), row.score.recall(),
                row.times.quantile_ns(0.5) * 1e-3, row.bytes > 0 ? std::to_string(row.bytes / 1000).c_str() : "-");
  return text;
}

struct MaskBenchOptions {
  std::string ground_truth;  // folder of clips with masks (mask_clip.h); "" = only the simulated tank
  int tank_frames = 300;     // of each scene; 0 = none
  bool json = false;
};

void bench_masks(const MaskBenchOptions& options) {
  std::vector<std::unique_ptr<MaskClip>> clips;
  if (!options.ground_truth.empty()) clips = open_masked_clips(options.ground_truth);
  if (options.tank_frames > 0)
    for (const char* scene : kScenes) clips.push_back(open_tank_clip(scene, options.tank_frames));
  std::string text =
      "masks after a 3 x 3 opening; all pixels of a clip counted together\n"
      "clip             model        frames  F-measure precision recall median "
      "us  model kB\n";
  Json json = Json::array();
  Progress progress(-1);
  int64_t done = 0;
  for (const auto& clip : clips) {
    for (const Row& row : score_clip(*clip, progress, done)) text += line_of(row), json.push_back(to_json(row));
  }
  write_text("-", options.json ? pretty(json) : text);
}

}  // namespace
}  // namespace nt

int main(int argc, char** argv) {
  CLI::App app("F-measure, precision and recall of every background model", "bench_masks");
  nt::MaskBenchOptions options;
  app.add_option("--ground-truth", options.ground_truth, "a folder of clips with masks")->type_name("FOLDER");
  app.add_option("--frames", options.tank_frames, "of each scene of the simulated tank")->check(CLI::Range(0, 100000));
  app.add_flag("--json", options.json, "for machines");
  CLI11_PARSE(app, argc, argv);
  try {
    nt::bench_masks(options);
    return 0;
  } catch (const nt::UserError& error) {
    std::fprintf(stderr, "bench_masks: %s\n", error.what());
    return error.exit_code;
  }
}
