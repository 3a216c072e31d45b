// SPDX-License-Identifier: Apache-2.0
// bench_accuracy [--scenes A,B] [--seeds N] [--frames N] [--size WxH] [--background NAME] [--stabilise MODE] [--odd]
// [--json]
// Capture over the simulated tank, scored against its truth, one row per scene. --odd lists the frames to look at.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string>
#include <vector>

#include "tests/bench/accuracy.h"

namespace {

using nt::test::Accuracy;
using nt::test::quantile;

struct Options {
  std::vector<std::string> scenes = nt::tank_scene_names();
  nt::test::AccuracyRun run;
  int seeds = 3;
  bool odd = false;
  bool json = false;
};

[[noreturn]] void usage(const char* why) {
  std::fprintf(stderr,
               "bench_accuracy: %s\nusage: bench_accuracy [--scenes A,B] [--seeds N] [--frames N] [--size WxH] "
               "[--background vibe|still|backlit] [--stabilise off|on|auto] [--odd] [--json]\n",
               why);
  std::exit(2);
}

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> out;
  for (std::size_t at = 0; at <= list.size();) {
    const std::size_t comma = std::min(list.find(',', at), list.size());
    out.push_back(list.substr(at, comma - at));
    at = comma + 1;
  }
  return out;
}

nt::BackgroundKind background_kind(const std::string& name) {
  if (name == "vibe") return nt::BackgroundKind::vibe;
  if (name == "still") return nt::BackgroundKind::still;
  if (name == "backlit") return nt::BackgroundKind::backlit;
  usage("no such background model");
}

nt::Stabilise stabilise_mode(const std::string& name) {
  if (name == "off") return nt::Stabilise::off;
  if (name == "on") return nt::Stabilise::on;
  if (name == "auto") return nt::Stabilise::automatic;
  usage("--stabilise takes off, on or auto");
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--odd") o.odd = true;
    else if (key == "--json") o.json = true;
    else if (i + 1 == argc) usage("an option is unknown or lacks its value");
    else if (key == "--scenes") o.scenes = split(argv[++i]);
    else if (key == "--seeds") o.seeds = std::atoi(argv[++i]);
    else if (key == "--frames") o.run.frames = std::atoi(argv[++i]);
    else if (key == "--background") o.run.capture.background.kind = background_kind(argv[++i]);
    else if (key == "--stabilise") o.run.capture.stabilise = stabilise_mode(argv[++i]);
    else if (key == "--size") {
      if (std::sscanf(argv[++i], "%dx%d", &o.run.tank.width, &o.run.tank.height) != 2) usage("--size takes WxH");
    } else usage("an option is unknown");
  }
  if (o.seeds < 1 || o.run.frames < 1) usage("--seeds and --frames start at 1");
  return o;
}

void print_row(const Accuracy& a, double fps) {
  std::printf("%-14s %7d %7.2f %5d %5d %5d %5d %5.2f  %6.2f %6.2f %6.2f %6.2f %6.2f  %6.2f %6.2f %6.2f  %5.1f %5.1f\n",
              a.scene.c_str(), a.visible, 100 * a.pose_share(), a.wrong_end, a.wrong_after, a.false_poses, a.wrong_fish,
              a.longest_wait / fps, quantile(a.head, 0.5), quantile(a.tail, 0.5), quantile(a.centre, 0.5),
              quantile(a.midline, 0.5), quantile(a.fin_tip, 0.5), quantile(a.direction, 0.5),
              quantile(a.direction, 0.9), quantile(a.direction, 0.99), 100 * a.fin_recall(), 100 * a.fin_precision());
  std::fflush(stdout);
}

void print_json(const Accuracy& a, bool last) {
  std::printf(
      "  {\"scene\": \"%s\", \"frames\": %d, \"visible\": %d, \"posed\": %d, \"wrong_end\": %d, "
      "\"wrong_end_after_pass\": %d, \"false_poses\": %d,\n"
      "   \"wrong_fish\": %d, \"longest_wait_frames\": %d,\n"
      "   \"head_pct\": %.3f, \"tail_pct\": %.3f, \"centre_pct\": %.3f, \"midline_rms_pct\": %.3f, \"fin_tip_pct\": "
      "%.3f,\n"
      "   \"dir_median_deg\": %.3f, \"dir_p99_deg\": %.3f, \"fin_recall\": %.4f, \"fin_precision\": %.4f}%s\n",
      a.scene.c_str(), a.scored, a.visible, a.posed, a.wrong_end, a.wrong_after, a.false_poses, a.wrong_fish,
      a.longest_wait, quantile(a.head, 0.5), quantile(a.tail, 0.5), quantile(a.centre, 0.5), quantile(a.midline, 0.5),
      quantile(a.fin_tip, 0.5), quantile(a.direction, 0.5), quantile(a.direction, 0.99), a.fin_recall(),
      a.fin_precision(), last ? "" : ",");
}

// Is the confidence in head and tail what it says?
void print_confidence(const Accuracy& a) {
  constexpr const char* kNames[] = {"0.5-0.6", "0.6-0.7", "0.7-0.8", "0.8-0.9", "0.9-0.99", "0.99-1"};
  std::printf("\n%-15s %9s %9s\n", "head confidence", "poses", "right, %");
  for (int i = 0; i < Accuracy::kBins; ++i) {
    const int n = a.sure_poses[i];
    if (n > 0) std::printf("%-15s %9d %9.2f\n", kNames[i], n, 100.0 * (n - a.sure_wrong[i]) / n);
  }
}

Accuracy measure_scene(const Options& o, const std::string& scene) {
  Accuracy sum;
  sum.scene = scene;
  for (int seed = 1; seed <= o.seeds; ++seed) {
    nt::test::AccuracyRun run = o.run;
    run.tank.scene = scene;
    run.tank.seed = static_cast<uint64_t>(seed);
    const auto odd = [&](int64_t frame, const std::string& what) {
      if (o.odd)
        std::fprintf(stderr, "%s seed %d frame %lld: %s\n", scene.c_str(), seed, static_cast<long long>(frame),
                     what.c_str());
    };
    sum.add(nt::test::measure_accuracy(run, odd));
  }
  return sum;
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = parse(argc, argv);
  if (o.json) std::printf("[\n");
  else
    std::printf(
        "%d seeds x %d frames, %dx%d; medians, %% of the body length; direction in degrees; fins in %%; wait: longest "
        "without a pose, s\n"
        "%-14s %7s %7s %5s %5s %5s %5s %5s  %6s %6s %6s %6s %6s  %6s %6s %6s  %5s %5s\n",
        o.seeds, o.run.frames, o.run.tank.width, o.run.tank.height, "scene", "visible", "pose%", "wrong", "after",
        "false", "other", "wait", "head", "tail", "centre", "midl.", "fin", "dir50", "dir90", "dir99", "fRec", "fPrec");
  Accuracy all;
  all.scene = "all";
  for (std::size_t i = 0; i < o.scenes.size(); ++i) {
    const Accuracy a = measure_scene(o, o.scenes[i]);
    all.add(a);
    o.json ? print_json(a, i + 1 == o.scenes.size()) : print_row(a, o.run.tank.fps);
  }
  if (o.json) std::printf("]\n");
  else print_row(all, o.run.tank.fps), print_confidence(all);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_accuracy: %s\n", e.what());
  return 1;
}
