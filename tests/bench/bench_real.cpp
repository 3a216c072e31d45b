// SPDX-License-Identifier: Apache-2.0
// bench_real FOLDER [--clips A,B] [--odd] [--work-size WxH] [--pictures FOLDER]
// Capture over filmed fish, scored against the reference midlines, one row a clip. FOLDER holds the clips. --odd lists the
// frames that miss a limit; --pictures writes one picture a frame: reference yellow and white, capture cyan.
#include <cstdio>
#include <cstring>
#include <exception>
#include <string>

#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "tests/bench/accuracy.h"
#include "tests/oracle/real/real_video.h"

namespace {

using nt::test::quantile;
using nt::test::RealAccuracy;
using nt::test::RealClip;
using nt::test::RealFrame;

struct Options {
  std::string folder, clips, pictures;
  bool odd = false;
  std::optional<nt::Size> work;
};

void print_row(const RealAccuracy& a) {
  const auto q = [&](double RealFrame::*which, double at) { return quantile(a.errors(which), at); };
  std::printf("%-34s %-8s %5.0f %4d %6.1f %4d %4d  %5.2f %5.2f %6.1f  %5.2f %5.2f %6.1f  %5.2f %5.2f %6.1f\n",
              a.file.c_str(), a.background.c_str(), a.length, a.frames, 100 * a.pose_share(), a.wrong_end,
              a.false_poses, q(&RealFrame::midline, 0.5), q(&RealFrame::midline, 1),
              100 * a.share_within(&RealFrame::midline, 1.5), q(&RealFrame::head, 0.5), q(&RealFrame::head, 1),
              100 * a.share_within(&RealFrame::head, 3), q(&RealFrame::tail, 0.5), q(&RealFrame::tail, 1),
              100 * a.share_within(&RealFrame::tail, 3));
  std::fflush(stdout);
}

void print_fins(const RealAccuracy& a, const std::string& labels, bool odd) {
  for (const bool left : {true, false}) {
    const nt::test::FinAgreement f = nt::test::compare_fins(a, labels, left);
    std::printf(
        "  %s fin: seen by a person %d, of these by capture %d; not seen %d, of these not by capture %d; "
        "%d doubtful; agreement %.1f %%\n",
        left ? "left" : "right", f.seen, f.seen_by_us, f.unseen, f.unseen_by_us, f.doubtful, 100 * f.share());
    if (!odd) continue;
    for (const int frame : f.missed) std::fprintf(stderr, "  frame %d: missed\n", frame);
    for (const int frame : f.invented) std::fprintf(stderr, "  frame %d: invented\n", frame);
  }
}

void print_odd(const RealAccuracy& a) {
  for (const RealFrame& f : a.all) {
    if (!f.reference.found) continue;
    const bool good = f.pose.ok() && !f.wrong_end && f.midline <= 1.5 && f.head <= 3 && f.tail <= 3;
    if (good) continue;
    std::fprintf(stderr, "%s frame %d: %s%s, midline %.2f, head %.2f, tail %.2f\n", a.file.c_str(), f.index,
                 nt::to_string(f.pose.status), f.wrong_end ? " wrong end" : "", f.midline, f.head, f.tail);
  }
}

constexpr int kWide = 800, kHigh = 600;

void write_pictures(const RealAccuracy& a, const Options& o) {
  const std::vector<cv::Mat> frames = nt::test::read_grey(o.folder + "/" + a.file);
  for (const RealFrame& f : a.all) {
    cv::Mat picture;
    cv::cvtColor(frames[static_cast<std::size_t>(f.index)], picture, cv::COLOR_GRAY2BGR);
    cv::Rect box({}, picture.size());
    if (f.reference.found) {
      const cv::Rect fish = cv::boundingRect(f.reference.mask);
      const int margin = 8 + std::max(fish.width, fish.height) / 8;
      box &= cv::Rect(fish.x - margin, fish.y - margin, fish.width + 2 * margin, fish.height + 2 * margin);
    }
    const double scale = std::min(double{kWide} / box.width, double{kHigh} / box.height);
    cv::resize(picture(box), picture, {}, scale, scale, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
    const auto at = [&](double x, double y) {
      return cv::Point(cvRound((x - box.x + 0.5) * scale), cvRound((y - box.y + 0.5) * scale));
    };
    const std::vector<cv::Point2d>& line = f.reference.midline;
    for (std::size_t i = 1; i < line.size(); ++i)
      cv::line(picture, at(line[i - 1].x, line[i - 1].y), at(line[i].x, line[i].y), {0, 220, 255}, 1);
    if (f.reference.found) cv::circle(picture, at(line[0].x, line[0].y), 5, {255, 255, 255}, 1);
    if (f.pose.ok()) {
      std::vector<nt::Vec2> axis{f.pose.head};
      for (int i = f.pose.u_num - 1; i >= 0; --i) axis.push_back(f.pose.up_axis[i]);
      axis.push_back(f.pose.centre);
      for (int i = 0; i < f.pose.l_num; ++i) axis.push_back(f.pose.low_axis[i]);
      axis.push_back(f.pose.tail);
      for (std::size_t i = 1; i < axis.size(); ++i)
        cv::line(picture, at(axis[i - 1].x, axis[i - 1].y), at(axis[i].x, axis[i].y), {255, 255, 0}, 1);
      cv::circle(picture, at(f.pose.head.x, f.pose.head.y), 4, {0, 0, 255}, -1);
      cv::circle(picture, at(f.pose.tail.x, f.pose.tail.y), 4, {255, 0, 0}, -1);
      if (f.pose.confidence.l_fin > 0) cv::circle(picture, at(f.pose.l_fin.x, f.pose.l_fin.y), 6, {0, 255, 0}, 2);
      if (f.pose.confidence.r_fin > 0) cv::circle(picture, at(f.pose.r_fin.x, f.pose.r_fin.y), 6, {255, 0, 255}, 2);
    }
    cv::putText(picture, std::to_string(f.index) + " " + nt::to_string(f.pose.status), {4, 16},
                cv::FONT_HERSHEY_SIMPLEX, 0.5, {0, 0, 255});
    // One size for all, so that ffmpeg makes a film or a sheet of them.
    cv::copyMakeBorder(picture, picture, 0, kHigh - picture.rows, 0, kWide - picture.cols, cv::BORDER_CONSTANT);
    char name[64];
    std::snprintf(name, sizeof name, "/%.18s-%04d.png", a.file.c_str(), f.index);
    cv::imwrite(o.pictures + name, picture);
  }
}

Options parse(int argc, char** argv) {
  Options o;
  for (int i = 1; i < argc; ++i) {
    const std::string key = argv[i];
    if (key == "--odd") o.odd = true;
    else if (key == "--clips" && i + 1 < argc) o.clips = argv[++i];
    else if (key == "--pictures" && i + 1 < argc) o.pictures = argv[++i];
    else if (key == "--work-size" && i + 1 < argc) o.work = nt::parse_size(key.c_str(), argv[++i]);
    else if (!key.starts_with("-") && o.folder.empty()) o.folder = key;
    else o.folder.clear(), i = argc;
  }
  if (!o.folder.empty()) return o;
  std::fprintf(stderr, "usage: bench_real FOLDER [--clips A,B] [--odd] [--work-size WxH] [--pictures FOLDER]\n");
  std::exit(2);
}

}  // namespace

int main(int argc, char** argv) try {
  const Options o = parse(argc, argv);
  std::printf(
      "%% of the fish's length; share of frames within 1.5 %% (midline) and 3 %% (ends)\n%-34s %-8s %5s %4s %6s %4s "
      "%4s  "
      "%5s %5s %6s  %5s %5s %6s  %5s %5s %6s\n",
      "clip", "ground", "px", "fish", "pose%", "wrong", "false", "midl.", "worst", "within", "head", "worst", "within",
      "tail", "worst", "within");
  for (const RealClip& clip : nt::test::real_clips()) {
    if (!o.clips.empty() && (o.clips + ",").find(clip.file + ",") == std::string::npos &&
        clip.file.find(o.clips) == std::string::npos)
      continue;
    const RealAccuracy a = nt::test::measure_real(clip, o.folder, o.work);
    print_row(a);
    if (!clip.fins.empty()) print_fins(a, clip.fins, o.odd);
    if (o.odd) print_odd(a);
    if (!o.pictures.empty()) write_pictures(a, o);
  }
  return 0;
} catch (const std::exception& e) {
  std::fprintf(stderr, "bench_real: %s\n", e.what());
  return 1;
}
