// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/v4l2_camera.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "platform/linux/frame_clock.h"
#include "platform/linux/settling.h"
#include "platform/linux/v4l2_stream.h"
#include "platform/linux/video_pixels.h"
#include "platform/working_size.h"

namespace nt {
namespace {

constexpr int64_t kSecond_ns = 1'000'000'000;
constexpr int kSlice_ms = 200;  // between two looks at whether to stop
constexpr int kReopenEvery_ms = 200;
constexpr int kDamagedInRow = 30;      // then the camera is started once more
constexpr double kStalePeriods = 3.5;  // the ring has run over: what waited gives way to what is new
constexpr double kLeastSilence_s = 2, kSilentPeriods = 10;

std::string seconds_text(double seconds) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g s", seconds);
  return text;
}

class V4l2Camera : public Camera {
 public:
  V4l2Camera(const V4l2Settings& settings, int work_width, int work_height, int64_t most_pixels,
             const CameraManners& manners, VideoCalls& calls)
      : settings_(settings), manners_(manners), calls_(calls) {
    stream_.emplace(calls_, settings_.path, settings_.wish);
    layout_ = stream_->layout();
    const WorkSize size = working_size(layout_.width, layout_.height, work_width, work_height, most_pixels);
    pixels_.emplace(layout_, size.width, size.height);
    info_.name = "v4l2:" + settings_.path;
    info_.source_width = layout_.width, info_.source_height = layout_.height;
    info_.width = size.width, info_.height = size.height;
    info_.fps = stream_->fps();
    info_.live = true;
    // When it comes back it must be what it was.
    settings_.wish.format = layout_.format;
    settings_.wish.width = layout_.width, settings_.wish.height = layout_.height, settings_.wish.fps = info_.fps;
    silence_ns_ = std::llround(std::max(kLeastSilence_s, kSilentPeriods / info_.fps) * 1e9);
  }

  ~V4l2Camera() override {
    if (stream_) lock_.release(stream_->device());
  }

  const CameraInfo& info() const override { return info_; }
  void give_chroma() override { with_chroma_ = true; }
  Picture picture() const override { return pixels_->picture(); }
  bool ready() override { return pump(0); }
  int64_t epoch_ns() const override { return clock_.epoch_ns(); }
  std::string failure() const override { return failure_; }

  std::optional<Frame> next() override {
    let_go(held_);
    try {
      return next_frame();
    } catch (const UserError& error) {
      end(error);
      return std::nullopt;
    }
  }

  std::string warning() const override {
    std::string line;
    const auto add = [&line](int64_t count, const char* what) {
      if (count > 0) line += (line.empty() ? "" : "; ") + std::to_string(count) + what;
    };
    add(damaged_, " damaged pictures were passed over: check the cable and the USB hub");
    add(clock_.odd_times(), " times of the camera's clock made no sense and were replaced by the machine's");
    add(came_back_, " times it was unplugged and came back");
    return line.empty() ? line : info_.name + ": " + line;
  }

 private:
  std::optional<Frame> next_frame() {
    while (!manners_.stop()) {
      if (!pump(kSlice_ms)) continue;
      if (!waiting_) break;  // it has ended
      Frame frame;
      if (!pixels_->unpack(waiting_->bytes, with_chroma_, frame)) {
        let_go(waiting_);
        damaged();
        continue;
      }
      damaged_in_row_ = 0, started_again_ = false;
      if (settling_ && !settle()) {
        let_go(waiting_);
        continue;
      }
      const FrameClock::Stamp stamp = clock_.take(waiting_->sequence, waiting_->timestamp_ns, calls_.now_ns());
      held_.swap(waiting_);
      frame.sequence = stamp.sequence, frame.timestamp_ns = stamp.timestamp_ns;
      ++delivered_;
      return frame;
    }
    return std::nullopt;
  }

  // One attempt to get on, at most timeout_ms long: true when a picture waits, or when it has ended.
  bool pump(int timeout_ms) {
    if (waiting_ || !failure_.empty()) return true;
    try {
      if (!stream_) return reopen(timeout_ms);
      if (!stream_->streaming()) start();
      return take(timeout_ms);
    } catch (const UserError& error) {
      end(error);
      return true;
    }
  }

  void start() {
    set_mains(stream_->device(), settings_.mains);
    stream_->start();
    heard_ns_ = calls_.now_ns();
    settling_.reset();
    if (settings_.lock && ControlLock::wanted(stream_->device())) settling_.emplace();
    else if (!told_) tell("");
  }

  void tell(const std::string& locked) {
    char text[160];
    std::snprintf(text, sizeof text, ", %dx%d %s at %.4g frames a second", layout_.width, layout_.height,
                  to_string(layout_.format), info_.fps);
    manners_.say("camera: " + stream_->device().card() + text + (locked.empty() ? "" : "; locked: " + locked));
    told_ = true;
  }

  // Looks at the picture that waits; true once the camera has settled and is locked.
  bool settle() {
    if (!settling_->settled(pixels_->brightness(), calls_.now_ns())) return false;
    if (!settling_->locked()) {
      tell(lock_.lock(stream_->device()));
      settling_->set_locked();
      return false;
    }
    settling_.reset();
    return true;
  }

  bool take(int timeout_ms) {
    RawFrame raw;
    switch (stream_->take(timeout_ms, raw)) {
      case V4l2Stream::Got::frame:
        waiting_ = freshest(raw);
        heard_ns_ = calls_.now_ns();
        return true;
      case V4l2Stream::Got::damaged:
        damaged();
        return false;
      case V4l2Stream::Got::unplugged:
        unplugged();
        return false;
      case V4l2Stream::Got::nothing:
        break;
    }
    if (calls_.now_ns() - heard_ns_ > silence_ns_) start_again("no picture for " + seconds_text(silence_s()));
    return false;
  }

  // Whoever watches is slow: what waited longest is dropped, so that the delay does not last.
  RawFrame freshest(RawFrame raw) {
    const auto stale_ns = std::llround(kStalePeriods * 1e9 / info_.fps);
    for (uint32_t i = 1; i < V4l2Stream::kRing && calls_.now_ns() - raw.timestamp_ns > stale_ns; ++i) {
      RawFrame newer;
      if (stream_->take(0, newer) != V4l2Stream::Got::frame) break;
      stream_->give_back(raw);
      raw = newer;
    }
    return raw;
  }

  void damaged() {
    ++damaged_;
    if (++damaged_in_row_ >= kDamagedInRow)
      start_again(std::to_string(kDamagedInRow) + " damaged pictures one after another");
  }

  void start_again(const std::string& why) {
    if (started_again_) {
      throw UserError(settings_.path + ": " + why +
                          ", though the camera was started again; check the cable, the power of " +
                          "the USB hub, and whether the machine is too busy",
                      3);
    }
    manners_.say(settings_.path + ": " + why + "; starting the camera again");
    stream_->stop();
    stream_->start();
    clock_.restart(info_.fps);
    heard_ns_ = calls_.now_ns();
    damaged_in_row_ = 0, started_again_ = true;
  }

  void unplugged() {
    manners_.say(settings_.path + ": the camera was unplugged; plug it in again within " +
                 seconds_text(settings_.wait_s));
    let_go(waiting_);
    drop_stream();
    lock_ = {};
    unplugged_ns_ = calls_.now_ns();
  }

  bool reopen(int timeout_ms) {
    try {
      stream_.emplace(calls_, settings_.path, settings_.wish);
    } catch (const UserError&) {
      // Not there yet, or not ready: its rights are given to it a moment after it appears.
    }
    if (stream_ && (stream_->layout().width != layout_.width || stream_->layout().height != layout_.height ||
                    stream_->layout().format != layout_.format || stream_->layout().stride != layout_.stride)) {
      throw UserError(settings_.path + ": another camera came back, with other pictures; start again", 3);
    }
    if (stream_) {
      clock_.restart(info_.fps);
      ++came_back_;
      manners_.say(settings_.path + ": the camera is back");
      return false;
    }
    if (static_cast<double>(calls_.now_ns() - unplugged_ns_) > settings_.wait_s * 1e9) {
      throw UserError(settings_.path + ": the camera was unplugged and did not come back within " +
                          seconds_text(settings_.wait_s) + "; plug it in and start again",
                      3);
    }
    calls_.poll(-1, std::min(timeout_ms, kReopenEvery_ms));
    return false;
  }

  void end(const UserError& error) {
    failure_ = error.what();
    let_go(waiting_);
    if (stream_) lock_.release(stream_->device());
    drop_stream();
    // Nothing was filmed: there is no camera, as if opening had failed.
    if (delivered_ == 0) throw error;
  }

  // The memory of its pictures goes with it.
  void drop_stream() {
    held_.reset();
    pixels_->forget();
    stream_.reset();
  }

  void let_go(std::optional<RawFrame>& raw) {
    if (raw && stream_) stream_->give_back(*raw);
    raw.reset();
  }

  double silence_s() const { return static_cast<double>(silence_ns_) / kSecond_ns; }

  V4l2Settings settings_;
  CameraManners manners_;
  VideoCalls& calls_;
  std::optional<V4l2Stream> stream_;  // none while it is unplugged
  VideoLayout layout_;
  std::optional<VideoPixels> pixels_;
  CameraInfo info_;
  std::optional<RawFrame> held_;     // handed out: core looks at it
  std::optional<RawFrame> waiting_;  // to be handed out next
  FrameClock clock_;
  ControlLock lock_;
  std::optional<Settling> settling_;
  std::string failure_;
  bool with_chroma_ = false, told_ = false, started_again_ = false;
  int damaged_in_row_ = 0;
  int64_t damaged_ = 0, came_back_ = 0, delivered_ = 0;
  int64_t silence_ns_ = 0, heard_ns_ = 0, unplugged_ns_ = 0;
};

}  // namespace

std::unique_ptr<Camera> open_v4l2_camera(const V4l2Settings& settings, int work_width, int work_height,
                                         int64_t most_pixels, const CameraManners& manners, VideoCalls& calls) {
  return std::make_unique<V4l2Camera>(settings, work_width, work_height, most_pixels, manners, calls);
}

}  // namespace nt
