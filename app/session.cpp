// SPDX-License-Identifier: Apache-2.0
#include "app/session.h"

#include <algorithm>
#include <csignal>
#include <cstdio>

#include <opencv2/imgcodecs.hpp>  // its constants alone
#include <opencv2/imgproc.hpp>

#include "app/author/choose_background.h"
#include "app/export/pose_csv.h"
#include "app/marker.h"
#include "app/tank_mask.h"
#include "platform/codecs.h"
#include "platform/linux/clock.h"
#include "platform/linux/heap_count.h"
#include "platform/linux/process_memory.h"

namespace nt {
namespace {

std::atomic<bool> stop_asked{false};  // free of locks, so a signal may set it

constexpr int kNoCamera = 3;       // exit code
constexpr int kMarkerFrames = 60;  // the marker must be seen in one of the first so many
constexpr int kSmallestSide = 32;  // an outline needs some 16 points

Frame frame_of(const cv::Mat& luma) {
  Frame frame;
  frame.luma = {luma.data, luma.cols, luma.rows, static_cast<std::ptrdiff_t>(luma.step)};
  return frame;
}

cv::Mat read_tank_picture(const std::string& path, const CameraInfo& info) {
  const cv::Mat picture = codecs().read_picture(path, cv::IMREAD_GRAYSCALE);
  if (picture.empty()) throw UserError("--background still: cannot read the picture " + path);
  cv::Mat fitted;
  cv::resize(picture, fitted, {info.width, info.height}, 0, 0, cv::INTER_AREA);
  return fitted;
}

const char* model_name(BackgroundKind kind) {
  constexpr const char* kNames[] = {"vibe", "still", "backlit", "vibe-colour"};
  return kNames[static_cast<std::size_t>(kind)];
}

CameraManners manners(const std::shared_ptr<std::atomic<bool>>& ending) {
  CameraManners manners;
  manners.stop = [ending] { return interrupted() || *ending; };
  manners.say = [](const std::string& line) { std::fprintf(stderr, "%s\n", line.c_str()); };
  return manners;
}

}  // namespace

bool interrupted() { return stop_asked; }

void interrupt() { stop_asked = true; }

void end_on_interrupt() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, [](int) { interrupt(); });
}

void die_of_interrupt() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) std::signal(signal, SIG_DFL);
}

Session::Session(const CaptureOptions& options)
    : camera_(open_camera(options.camera, options.work, options.fps, manners(ending_))),
      frames_wanted_(options.frames),
      stabilise_(options.stabilise) {
  if (info().width < kSmallestSide || info().height < kSmallestSide) {
    throw UserError(info().name + ": frames of " + std::to_string(info().width) + "x" + std::to_string(info().height) +
                    " pixels are too small; at least 32x32 are needed to see a fish");
  }
  calibrate(options);
  const BackgroundKind kind = choose_model(options);
  if (kind == BackgroundKind::vibe_colour) camera_->give_chroma();
  create_capture(options, kind);
  learn(options, kind);
  if (!options.select.automatic) select(options.select.at);
}

void Session::calibrate(const CaptureOptions& options) {
  if (!options.lens.empty()) calibration_.lens = read_lens(options.lens, info().source_width, info().source_height);
  if (options.scale_points.has_value() != (options.scale_mm > 0) && !(options.scale_by_clicks && options.scale_mm > 0))
    throw UserError("--scale-points and --scale-mm go together: two points, and how far they lie apart", 2);
  if (options.scale_mm > 0 && options.marker_mm > 0)
    throw UserError("--scale-mm and --marker-mm both give the scale; choose one", 2);
  if (options.scale_points) calibration_.set_scale(*options.scale_points, options.scale_mm);
  if (options.marker_mm <= 0) return;
  for (int n = 0; n < kMarkerFrames && calibration_.px_per_mm <= 0; ++n) {
    const std::optional<Frame> frame = camera_->next();
    if (!frame) break;
    std::optional<std::array<Vec2, 4>> corners = find_marker(frame->luma);
    if (!corners) continue;
    for (Vec2& corner : *corners) corner = to_source(corner, scale());
    calibration_.set_scale(*corners, options.marker_mm);
  }
  if (calibration_.px_per_mm <= 0)
    throw UserError(
        "--marker-mm: no AprilTag of family 36h11 is seen in the first frames; lay it flat, in the light, some 40 "
        "pixels wide, with its white rim");
  camera_->rewind();
}

void Session::select(Vec2 at) {
  const CameraInfo& picture = info();
  if (at.x > static_cast<float>(picture.source_width - 1) || at.y > static_cast<float>(picture.source_height - 1)) {
    throw UserError("--select: there is no such pixel; " + picture.name + " is " +
                        std::to_string(picture.source_width) + "x" + std::to_string(picture.source_height) +
                        ", so X is at most " + std::to_string(picture.source_width - 1) + " and Y " +
                        std::to_string(picture.source_height - 1),
                    2);
  }
  capture_->select_at(to_working(at, scale()));
}

BackgroundKind Session::choose_model(const CaptureOptions& options) {
  using Kind = BackgroundOption::Kind;
  why_ = "asked for";
  switch (options.background.kind) {
    case Kind::vibe:
      return BackgroundKind::vibe;
    case Kind::vibe_colour:
      return BackgroundKind::vibe_colour;
    case Kind::still:
      return BackgroundKind::still;
    case Kind::backlit:
      return BackgroundKind::backlit;
    case Kind::automatic:
      break;
  }
  if (options.stabilise == Stabilise::on) {
    // The test below compares pixels over time, which a moving camera makes meaningless.
    why_ = "a moving camera";
    return BackgroundKind::vibe;
  }
  const BackgroundChoice choice = choose_background(spread_small(*camera_));
  give_back_freed_memory();  // what the look ahead took, 15 MB
  why_ = choice.why;
  announcement_ = std::string("background: ") + model_name(choice.kind) + " (" + why_ + ")";
  return choice.kind;
}

void Session::create_capture(const CaptureOptions& options, BackgroundKind kind) {
  Limits limits;
  limits.max_width = info().width;
  limits.max_height = info().height;
  CaptureSettings settings;
  settings.background.kind = kind;
  settings.stabilise = options.stabilise;
  settings.harmonics = options.harmonics;
  settings.seed = options.seed;
  settings.max_fish = options.max_fish;
  const cv::Mat tank = tank_mask(options.area, info());
  if (!tank.empty()) settings.tank = frame_of(tank).luma;
  if (options.area.max_size > 0 && options.area.max_size < options.area.min_size)
    throw UserError("--max-size must be at least --min-size", 2);
  settings.min_area_px = working_area(options.area.min_size);
  settings.max_area_px = working_area(options.area.max_size);
  memory_ = AlignedBlock(Capture::bytes_needed(limits, settings));
  Result<Capture*> made = Capture::create(memory_.bytes(), limits, settings, info().width, info().height);
  if (!made.ok()) throw UserError(info().name + ": " + made.status().message);
  capture_ = made.value();
}

void Session::learn(const CaptureOptions& options, BackgroundKind kind) {
  if (kind != BackgroundKind::still) return;
  if (!options.background.picture.empty()) {
    capture_->learn(frame_of(read_tank_picture(options.background.picture, info())));
  } else {
    const std::vector<cv::Mat> frames = spread_frames(*camera_);
    if (frames.empty())
      throw UserError(info().name +
                          ": what a camera will see cannot be looked at beforehand; give a picture of the empty " +
                          "tank, --background still:PICTURE, or take vibe",
                      2);
    const std::size_t count = std::min<std::size_t>(kLearnFrames, frames.size());
    for (std::size_t i = 0; i < count; ++i) capture_->learn(frame_of(frames[i * frames.size() / count]));
  }
}

// Pixels of the source video -> of the working frame.
int Session::working_area(int64_t source_px) const {
  if (source_px == 0) return 0;
  const double area = static_cast<double>(source_px) / (static_cast<double>(scale()) * static_cast<double>(scale()));
  return std::max(1, static_cast<int>(std::min(area, 1e9)));
}

float Session::scale() const { return static_cast<float>(info().source_width) / static_cast<float>(info().width); }

void Session::count_gap(const Frame& frame) {
  if (statistics_.frames == 0 || frame.sequence <= frame_.sequence + 1) return;
  statistics_.dropped += static_cast<int64_t>(frame.sequence - frame_.sequence - 1);
}

// Once, when it begins or when it cannot.
void Session::tell_stabilising() {
  if (told_stabilising_ || stabilise_ == Stabilise::off) return;
  if (capture_->stabilising() && capture_->camera_unknowable()) {
    std::fprintf(stderr,
                 "stabilise: the picture has too little texture to see the camera move; frames are used as they are\n");
  } else if ((report_.flags & kStabilised) != 0) {
    std::fprintf(stderr,
                 stabilise_ == Stabilise::on ? "stabilise: the camera's motion is taken out\n"
                                             : "stabilise: the camera moves (frame %lld); its motion is taken out "
                                               "from here on\n",
                 static_cast<long long>(frame_index()));
  } else {
    return;
  }
  told_stabilising_ = true;
}

CameraThread& Session::film_on_a_thread(const CameraThread::Settings& settings) {
  auto thread = std::make_unique<CameraThread>(std::move(camera_), settings);
  CameraThread& camera = *thread;
  camera_ = std::move(thread);
  return camera;
}

bool Session::step() {
  if (interrupted() || *ending_ || (frames_wanted_ > 0 && statistics_.frames >= frames_wanted_)) return false;
  const std::optional<Frame> next = camera_->next();
  if (!next) return false;
  // Only now: whatever was wrong with the outputs has had its one line.
  if (!announcement_.empty()) std::fprintf(stderr, "%s\n", announcement_.c_str());
  announcement_.clear();
  count_gap(*next);
  frame_ = *next;
  {
    const HeapCount heap;
    report_ = capture_->step(frame_, &steady_now_ns);
    if (statistics_.frames > 0) statistics_.allocations_after_frame_0 += heap.allocations();
  }
  const int64_t epoch_ns = camera_->epoch_ns();
  had_ns_ = epoch_ns != 0 ? epoch_ns + frame_.timestamp_ns : 0;
  if (had_ns_ != 0) statistics_.latency.add(steady_now_ns() - had_ns_);
  statistics_.add(report_);
  for (int i = 0; i < capture_->fish_count(); ++i)
    statistics_.poses_of_fish[static_cast<std::size_t>(i)] += capture_->pose(i).ok();
  if (statistics_.frames == 1) statistics_.rss_start_bytes = resident_bytes();
  tell_stabilising();
  return true;
}

void end_of_frames(Session& session) {
  const std::string failure = session.camera().failure(), warning = session.camera().warning();
  const auto dropped = static_cast<long long>(session.statistics().dropped);
  if (!warning.empty()) std::fprintf(stderr, "%s\n", warning.c_str());
  if (session.info().live && dropped > 0)
    std::fprintf(stderr,
                 "%s: %lld frames were dropped; a smaller size or a lower fps is easier on camera and machine\n",
                 session.info().name.c_str(), dropped);
  if (!failure.empty()) throw UserError(failure, kNoCamera);
}

void expect_frames(const Session& session) {
  if (session.statistics().frames == 0 && !interrupted() && !session.info().live) {
    throw UserError(session.info().name + ": there is not one frame in it; is the video complete?");
  }
}

}  // namespace nt
