// SPDX-License-Identifier: Apache-2.0
// bench_capture [--frames N] [--warm-up N] [--size WxH] [--scene NAME] [--json]
// Each stage's median against the same chain made of OpenCV calls, in one run, on one thread, on the same frames.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/base/simd_target.h"
#include "core/pipeline/pipeline.h"
#include "platform/sim/tank.h"
#include "tests/bench/accuracy.h"
#include "tests/bench/opencv_chain.h"
#include "tests/bench/opencv_stabilise.h"
#include "tests/support/block.h"

namespace {

using nt::kStages;
using nt::Stage;
using nt::StageTimes;

struct Options {
  nt::TankSettings tank;
  int frames = 200;
  int warm_up = 100;
  bool json = false;
};

// Times of one chain, microseconds.
struct Timing {
  std::vector<float> stage[kStages];
  std::vector<float> total;
  int poses = 0;
  void add(const StageTimes& times, bool pose) {
    for (std::size_t s = 0; s < kStages; ++s) stage[s].push_back(static_cast<float>(times.ns[s]) * 1e-3f);
    total.push_back(static_cast<float>(times.total()) * 1e-3f);
    poses += pose;
  }
  double median(std::size_t s) const { return nt::test::quantile(stage[s], 0.5); }
  double median() const { return nt::test::quantile(total, 0.5); }
};

int64_t now_ns() { return std::chrono::steady_clock::now().time_since_epoch() / std::chrono::nanoseconds(1); }

[[noreturn]] void usage(const char* why) {
  std::fprintf(
      stderr,
      "bench_capture: %s\nusage: bench_capture [--frames N] [--warm-up N] [--size WxH] [--scene NAME] [--json]\n", why);
  std::exit(2);
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--json") o.json = true;
    else if (i + 1 == argc) usage("an option is unknown or lacks its value");
    else if (key == "--frames") o.frames = std::atoi(argv[++i]);
    else if (key == "--warm-up") o.warm_up = std::atoi(argv[++i]);
    else if (key == "--scene") o.tank.scene = argv[++i];
    else if (key == "--size") {
      if (std::sscanf(argv[++i], "%dx%d", &o.tank.width, &o.tank.height) != 2) usage("--size takes WxH");
    } else usage("an option is unknown");
  }
  if (o.frames < 1 || o.warm_up < 0) usage("--frames starts at 1, --warm-up at 0");
  if (nt::find_tank_scene(o.tank.scene) == nullptr) usage("no such scene");
  return o;
}

std::vector<cv::Mat> film(const Options& o) {
  nt::Tank tank(o.tank);
  std::vector<cv::Mat> frames;
  for (int n = 0; n < o.warm_up + o.frames; ++n) {
    const nt::LumaView luma = tank.render_next();
    cv::Mat copy(luma.height, luma.width, CV_8U);
    for (int y = 0; y < luma.height; ++y) std::copy_n(luma.row(y), luma.width, copy.ptr(y));
    frames.push_back(copy);
  }
  return frames;
}

Timing time_ours(const Options& o, const std::vector<cv::Mat>& frames, nt::Stabilise stabilise) {
  nt::Limits limits;
  limits.max_width = o.tank.width, limits.max_height = o.tank.height;
  nt::CaptureSettings settings;
  settings.stabilise = stabilise;
  const nt::test::Block block(nt::Capture::bytes_needed(limits, settings));
  auto made = nt::Capture::create(block.span(), limits, settings, o.tank.width, o.tank.height);
  if (!made.ok()) throw std::runtime_error(made.status().message);
  Timing timing;
  for (int n = 0; n < static_cast<int>(frames.size()); ++n) {
    const cv::Mat& m = frames[static_cast<std::size_t>(n)];
    nt::Frame frame;
    frame.luma = {m.ptr(), m.cols, m.rows, static_cast<std::ptrdiff_t>(m.step)};
    frame.sequence = static_cast<uint64_t>(n);
    frame.timestamp_ns = static_cast<int64_t>(1e9 * n / o.tank.fps);
    const nt::StepReport report = made.value()->step(frame, now_ns);
    if (n >= o.warm_up) timing.add(report.times, made.value()->pose().ok());
  }
  return timing;
}

// A camera in the hand, on frames of its own: what --stabilise on adds, against the OpenCV calls that do the same.
struct HandTiming {
  Timing ours;
  std::vector<float> opencv_us;
  double ours_us() const { return ours.median(static_cast<std::size_t>(Stage::stabilise)); }
  double opencv_median_us() const { return nt::test::quantile(opencv_us, 0.5); }
};

HandTiming time_hand(Options o) {
  o.tank.scene = "shake";
  o.frames = std::min(o.frames, 100);
  const std::vector<cv::Mat> frames = film(o);
  HandTiming timing{time_ours(o, frames, nt::Stabilise::on), {}};
  nt::test::OpenCvStabiliser theirs(frames[0]);
  for (std::size_t n = 1; n < frames.size(); ++n) {
    const int64_t before_ns = now_ns();
    theirs.step(frames[n]);
    if (static_cast<int>(n) >= o.warm_up) timing.opencv_us.push_back(static_cast<float>(now_ns() - before_ns) * 1e-3f);
  }
  return timing;
}

Timing time_opencv(const Options& o, const std::vector<cv::Mat>& frames, nt::test::OpenCvModel model) {
  nt::test::OpenCvChain chain(model);
  Timing timing;
  for (int n = 0; n < static_cast<int>(frames.size()); ++n) {
    StageTimes times;
    const bool pose = chain.step(frames[static_cast<std::size_t>(n)], now_ns, times);
    if (n >= o.warm_up) timing.add(times, pose);
  }
  return timing;
}

std::string machine() {
  std::ifstream cpu("/proc/cpuinfo");
  for (std::string line; std::getline(cpu, line);) {
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  }
  return "a machine that does not say its name";
}

const char* opencv_call(std::size_t stage) {
  static const char* const kCalls[kStages] = {"none: the camera stands still",
                                              "BackgroundSubtractor*::apply",
                                              "morphologyEx 3x3",
                                              "connectedComponentsWithStats",
                                              "the largest component",
                                              "threshold, Otsu",
                                              "findContours",
                                              "PCA, std::cos, std::vector",
                                              "std::atan2"};
  return kCalls[stage];
}

void print_hand(const HandTiming& hand, const Timing& mog2) {
  std::printf(
      "%-12s %9.1f %9.1f %8.1f   goodFeaturesToTrack, calcOpticalFlowPyrLK, estimateAffinePartial2D, warpAffine\n",
      "stabilise on", hand.ours_us(), hand.opencv_median_us(), hand.opencv_median_us() / hand.ours_us());
  std::printf("that is %.3f of the OpenCV chain's total (scene shake, %d frames, %d with a pose)\n\n",
              hand.ours_us() / mog2.median(), static_cast<int>(hand.ours.total.size()), hand.ours.poses);
}

void print_table(const Options& o, const Timing& ours, const Timing& mog2, const Timing& knn, const HandTiming& hand) {
  std::printf("%s, g++ %s, Highway %s, OpenCV %s on one thread; %dx%d, scene %s, %d frames; medians in us\n\n",
              machine().c_str(), __VERSION__, nt::simd_target(), CV_VERSION, o.tank.width, o.tank.height,
              o.tank.scene.c_str(), o.frames);
  std::printf("%-12s %9s %9s %8s   %s\n", "stage", "ours", "OpenCV", "ratio", "OpenCV's is");
  for (std::size_t s = 0; s < kStages; ++s) {
    std::printf("%-12s %9.1f %9.1f %8.1f   %s\n", nt::kStageNames[s], ours.median(s), mog2.median(s),
                mog2.median(s) / std::max(ours.median(s), 0.05), opencv_call(s));
  }
  std::printf("%-12s %9.1f %9.1f %8.1f   with MOG2\n", "total", ours.median(), mog2.median(),
              mog2.median() / ours.median());
  std::printf("%-12s %9.1f %9.1f %8.1f   with KNN (background alone: %.1f)\n", "", ours.median(), knn.median(),
              knn.median() / ours.median(), knn.median(static_cast<std::size_t>(Stage::background)));
  std::printf("poses in %d frames: ours %d, OpenCV %d with MOG2, %d with KNN\n\n", o.frames, ours.poses, mog2.poses,
              knn.poses);
  print_hand(hand, mog2);
  const auto sum = [&](const Timing& t, Stage first, Stage last) {
    double ms = 0;
    for (auto s = static_cast<std::size_t>(first); s <= static_cast<std::size_t>(last); ++s) ms += t.median(s) * 1e-3;
    return ms;
  };
  std::printf("as in Table 3 of the paper (ms)     ours   OpenCV   paper (Core i7-3970X)\n");
  const auto row = [&](const char* name, Stage first, Stage last, const char* paper) {
    std::printf("%-30s %9.3f %8.3f   %s\n", name, sum(ours, first, last), sum(mog2, first, last), paper);
  };
  row("background subtraction", Stage::background, Stage::background, "12.48");
  row("filter", Stage::clean, Stage::refine, " 9.11");
  row("feature extraction", Stage::outline, Stage::motion, " 6.34");
}

void print_json(const Options& o, const Timing& ours, const Timing& mog2, const Timing& knn, const HandTiming& hand) {
  std::printf("{\"machine\": \"%s\", \"compiler\": \"g++ %s\", \"simd\": \"%s\", \"opencv\": \"%s\",\n",
              machine().c_str(), __VERSION__, nt::simd_target(), CV_VERSION);
  std::printf(" \"width\": %d, \"height\": %d, \"scene\": \"%s\", \"frames\": %d, \"stages_us\": {\n", o.tank.width,
              o.tank.height, o.tank.scene.c_str(), o.frames);
  for (std::size_t s = 0; s < kStages; ++s) {
    std::printf("  \"%s\": {\"ours\": %.2f, \"mog2\": %.2f, \"knn\": %.2f}%s\n", nt::kStageNames[s], ours.median(s),
                mog2.median(s), knn.median(s), s + 1 == kStages ? "}," : ",");
  }
  std::printf(" \"total_us\": {\"ours\": %.2f, \"mog2\": %.2f, \"knn\": %.2f},\n", ours.median(), mog2.median(),
              knn.median());
  std::printf(" \"poses\": {\"ours\": %d, \"mog2\": %d, \"knn\": %d},\n", ours.poses, mog2.poses, knn.poses);
  std::printf(" \"stabilise_on_us\": {\"ours\": %.2f, \"opencv\": %.2f, \"of_mog2_total\": %.4f},\n", hand.ours_us(),
              hand.opencv_median_us(), hand.ours_us() / mog2.median());
  std::printf(" \"ratio\": %.2f}\n", std::min(mog2.median(), knn.median()) / ours.median());
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = parse(argc, argv);
  cv::setNumThreads(1);
  const std::vector<cv::Mat> frames = film(o);
  const Timing ours = time_ours(o, frames, nt::CaptureSettings{}.stabilise);
  const Timing mog2 = time_opencv(o, frames, nt::test::OpenCvModel::mog2);
  const Timing knn = time_opencv(o, frames, nt::test::OpenCvModel::knn);
  const HandTiming hand = time_hand(o);
  (o.json ? print_json : print_table)(o, ours, mog2, knn, hand);
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_capture: %s\n", e.what());
  return 1;
}
