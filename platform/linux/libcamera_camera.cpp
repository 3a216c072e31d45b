// SPDX-License-Identifier: Apache-2.0
// Written for the API of libcamera 0.0.3 (Debian 12) in the parts that later versions kept: roles are given as a list,
// neither transform nor orientation is set, and the lock goes by the picture's own brightness, because what reports that the
// exposure has settled (AeLocked, later AeState) differs between versions. Only the lock itself (lock_exposure) differs.
#include "platform/linux/libcamera_camera.h"

#include <libcamera/camera.h>
#include <libcamera/camera_manager.h>
#include <libcamera/control_ids.h>
#include <libcamera/formats.h>
#include <libcamera/framebuffer_allocator.h>
#include <libcamera/logging.h>
#include <libcamera/property_ids.h>
#include <libcamera/request.h>
#include <libcamera/version.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <map>
#include <mutex>
#include <optional>
#include <utility>

#include "platform/linux/clock.h"
#include "platform/linux/frame_clock.h"
#include "platform/linux/plane_mapping.h"
#include "platform/linux/settling.h"
#include "platform/linux/video_pixels.h"
#include "platform/working_size.h"

namespace nt {
namespace {

namespace lc = libcamera;

constexpr unsigned kRing = 4;
constexpr int kSlice_ms = 200;
constexpr int64_t kSilence_ns = 2'000'000'000;
constexpr double kUsualFps = 30;
constexpr double kMostPixels = 960.0 * 544;

struct Format {
  lc::PixelFormat theirs;
  VideoFormat ours;
};
const std::array<Format, 4>& formats() {
  static const std::array<Format, 4> kFormats = {{{lc::formats::NV12, VideoFormat::nv12},
                                                  {lc::formats::YUYV, VideoFormat::yuyv},
                                                  {lc::formats::R8, VideoFormat::grey},
                                                  {lc::formats::MJPEG, VideoFormat::mjpeg}}};
  return kFormats;
}

// One for the process at a time, as libcamera demands, while somebody needs it; its messages stay off the terminal, ours say
// what is to be done.
std::shared_ptr<lc::CameraManager> manager() {
  static std::weak_ptr<lc::CameraManager> running;
  if (std::shared_ptr<lc::CameraManager> one = running.lock()) return one;
  lc::logSetTarget(lc::LoggingTargetNone);
  auto made = std::make_shared<lc::CameraManager>();
  const int error = made->start();
  if (error != 0)
    throw UserError(
        std::string("libcamera does not start (") + std::strerror(-error) + "); is another program using it?", 3);
  running = made;
  return made;
}

// Whether a device file that this process has open is no longer there: libcamera keeps those of its cameras open, and learns
// of an unplugged one by udev, later than the silence is noticed or never.
bool device_is_gone() {
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd", error)) {
    const std::string file = std::filesystem::read_symlink(entry.path(), error).string();
    if ((file.starts_with("/dev/video") || file.starts_with("/dev/media")) && file.ends_with(" (deleted)")) return true;
  }
  return false;
}

std::string model_of(const lc::Camera& camera) {
  const auto model = camera.properties().get(lc::properties::Model);
  return model ? std::string(*model) : camera.id();
}

std::shared_ptr<lc::Camera> find_camera(const lc::CameraManager& manager, const std::string& wanted) {
  std::string there;
  for (const std::shared_ptr<lc::Camera>& camera : manager.cameras()) {
    if (camera->id().find(wanted) != std::string::npos) return camera;
    there += (there.empty() ? "" : ", ") + camera->id();
  }
  throw UserError("libcamera:" + wanted + ": there is no such camera; " +
                      (there.empty() ? "libcamera sees none: check the cable, then switch the board off and on"
                                     : "there are: " + there),
                  3);
}

std::unique_ptr<PlaneMapping> mapped(const lc::FrameBuffer& buffer) {
  std::vector<PictureMemory> planes;
  for (const lc::FrameBuffer::Plane& plane : buffer.planes())
    planes.push_back({plane.fd.get(), plane.offset, plane.length});
  return std::make_unique<PlaneMapping>(planes);
}

bool has(const lc::Camera& camera, const lc::ControlId& control) {
  return camera.controls().find(&control) != camera.controls().end();
}

// Exposure time and gain stay what they are in `now`.
void lock_exposure(const lc::Camera& camera, const lc::ControlList& now, lc::ControlList& controls) {
#if LIBCAMERA_VERSION_MAJOR == 0 && LIBCAMERA_VERSION_MINOR < 5
  if (!has(camera, lc::controls::AeEnable)) return;
  controls.set(lc::controls::AeEnable, false);
#else
  if (has(camera, lc::controls::ExposureTimeMode))
    controls.set(lc::controls::ExposureTimeMode, lc::controls::ExposureTimeModeManual);
  if (has(camera, lc::controls::AnalogueGainMode))
    controls.set(lc::controls::AnalogueGainMode, lc::controls::AnalogueGainModeManual);
#endif
  if (!has(camera, lc::controls::ExposureTime) || !has(camera, lc::controls::AnalogueGain)) return;
  if (const auto time = now.get(lc::controls::ExposureTime)) controls.set(lc::controls::ExposureTime, *time);
  if (const auto gain = now.get(lc::controls::AnalogueGain)) controls.set(lc::controls::AnalogueGain, *gain);
}

bool exposes_by_itself(const lc::Camera& camera) {
#if LIBCAMERA_VERSION_MAJOR == 0 && LIBCAMERA_VERSION_MINOR < 5
  return has(camera, lc::controls::AeEnable);
#else
  return has(camera, lc::controls::ExposureTimeMode) || has(camera, lc::controls::AnalogueGainMode);
#endif
}

// What libcamera works with while a camera runs. Destroyed only once the camera has stopped.
struct Running {
  std::shared_ptr<lc::CameraManager> manager;
  std::shared_ptr<lc::Camera> camera;
  std::unique_ptr<lc::CameraConfiguration> config;
  std::optional<lc::FrameBufferAllocator> allocator;
  std::map<const lc::FrameBuffer*, std::unique_ptr<PlaneMapping>> mappings;
  std::vector<std::unique_ptr<lc::Request>> requests;
};

class LibcameraCamera : public Camera {
 public:
  LibcameraCamera(const LibcameraSettings& settings, int work_width, int work_height, int64_t most_pixels,
                  const CameraManners& manners)
      : settings_(settings), manners_(manners), lc_(std::make_unique<Running>()) {
    lc_->manager = manager();
    lc_->camera = find_camera(*lc_->manager, settings.id);
    camera_ = lc_->camera.get();
    info_.name = "libcamera:" + camera_->id();
    info_.live = true;
    info_.fps = settings.fps > 0 ? settings.fps : kUsualFps;
    if (camera_->acquire() != 0)
      throw UserError(info_.name + ": another program has the camera; end that one, or take another camera", 3);
    try {
      configure(most_pixels > 0 ? static_cast<double>(most_pixels) : static_cast<double>(work_width) * work_height);
      allocate();
    } catch (...) {
      give_up_camera();
      throw;
    }
    const WorkSize size = working_size(layout_.width, layout_.height, work_width, work_height, most_pixels);
    pixels_.emplace(layout_, size.width, size.height);
    info_.source_width = layout_.width, info_.source_height = layout_.height;
    info_.width = size.width, info_.height = size.height;
    camera_->requestCompleted.connect(this, &LibcameraCamera::completed);
    camera_->disconnected.connect(this, &LibcameraCamera::disconnected);
  }

  ~LibcameraCamera() override {
    stop();
    if (lc_ == nullptr) return;
    camera_->requestCompleted.disconnect(this);
    camera_->disconnected.disconnect(this);
    give_up_camera();
  }

  const CameraInfo& info() const override { return info_; }
  void give_chroma() override { with_chroma_ = true; }
  Picture picture() const override { return pixels_->picture(); }
  bool ready() override { return pump(0); }
  int64_t epoch_ns() const override { return clock_.epoch_ns(); }
  std::string failure() const override { return failure_; }
  std::string warning() const override {
    return damaged_ == 0 ? std::string()
                         : info_.name + ": " + std::to_string(damaged_) + " damaged or late pictures were passed over";
  }

  std::optional<Frame> next() override {
    queue_again(held_);
    while (!manners_.stop()) {
      if (!pump(kSlice_ms)) continue;
      if (waiting_ == nullptr) break;
      Frame frame;
      const bool whole = look_at(*waiting_, frame);
      if (!whole) ++damaged_;
      if (!whole || (settling_ && !settle(*waiting_))) {
        queue_again(waiting_);
        continue;
      }
      std::swap(held_, waiting_);
      ++delivered_;
      return frame;
    }
    return std::nullopt;
  }

 private:
  void configure(double pixels) {
    lc_->config = camera_->generateConfiguration({lc::StreamRole::VideoRecording});
    if (lc_->config == nullptr || lc_->config->empty())
      throw UserError(info_.name + ": the camera cannot film; take another", 3);
    lc::StreamConfiguration& stream = lc_->config->at(0);
    const std::vector<lc::PixelFormat> offered = stream.formats().pixelformats();
    for (const Format& format : formats()) {
      if (std::find(offered.begin(), offered.end(), format.theirs) == offered.end()) continue;
      stream.pixelFormat = format.theirs;
      break;
    }
    stream.size = wished_size(stream, pixels);
    stream.bufferCount = kRing;
    if (lc_->config->validate() == lc::CameraConfiguration::Invalid || camera_->configure(lc_->config.get()) != 0)
      throw UserError(info_.name + ": the camera refuses " + stream.toString() + "; try another size", 3);
    const auto known = std::find_if(formats().begin(), formats().end(),
                                    [&](const Format& format) { return format.theirs == stream.pixelFormat; });
    if (known == formats().end())
      throw UserError(info_.name + ": it gives pictures as " + stream.pixelFormat.toString() +
                          ", which cannot be read; NV12, YUYV, R8 and MJPEG can",
                      3);
    layout_.format = known->ours;
    layout_.width = static_cast<int>(stream.size.width), layout_.height = static_cast<int>(stream.size.height);
    layout_.stride = known->ours == VideoFormat::mjpeg ? 0 : static_cast<int>(stream.stride);
    const bool full = stream.colorSpace && stream.colorSpace->range == lc::ColorSpace::Range::Full;
    layout_.limited = !full && (known->ours == VideoFormat::nv12 || known->ours == VideoFormat::yuyv);
  }

  // As asked for; else the offered size with the most pixels that are not more than are worked on.
  lc::Size wished_size(const lc::StreamConfiguration& stream, double pixels) const {
    if (settings_.width > 0) return {static_cast<unsigned>(settings_.width), static_cast<unsigned>(settings_.height)};
    const double most = std::min(pixels, kMostPixels);
    lc::Size best;
    for (const lc::Size& size : stream.formats().sizes(stream.pixelFormat)) {
      const auto area = [](const lc::Size& s) { return static_cast<double>(s.width) * s.height; };
      if (area(size) <= most && area(size) > area(best)) best = size;
    }
    return best.isNull() ? lc::Size(960, 540) : best;
  }

  void allocate() {
    stream_ = lc_->config->at(0).stream();
    lc_->allocator.emplace(lc_->camera);
    if (lc_->allocator->allocate(stream_) < 0)
      throw UserError(
          info_.name + ": there is no memory for its pictures; choose a smaller size, or raise the CMA area", 3);
    for (const std::unique_ptr<lc::FrameBuffer>& buffer : lc_->allocator->buffers(stream_)) {
      std::unique_ptr<PlaneMapping> mapping = mapped(*buffer);
      const bool two_planes = layout_.format == VideoFormat::nv12 && mapping->chroma_at();
      const auto luma_bytes = static_cast<std::size_t>(layout_.stride) * static_cast<std::size_t>(layout_.height);
      if (!mapping->ok() || (two_planes && *mapping->chroma_at() != luma_bytes))
        throw UserError(info_.name + ": its pictures lie in memory in a way that cannot be read; try format or size",
                        3);
      std::unique_ptr<lc::Request> request = camera_->createRequest();
      if (request == nullptr || request->addBuffer(stream_, buffer.get()) != 0)
        throw UserError(info_.name + ": it takes no requests; switch the board off and on", 3);
      lc_->mappings[buffer.get()] = std::move(mapping);
      lc_->requests.push_back(std::move(request));
    }
  }

  void give_up_camera() {
    lc_->requests.clear();
    lc_->mappings.clear();
    lc_->allocator.reset();
    camera_->release();
  }

  // The camera was pulled out. libcamera can then neither be asked to stop it (0.0.3 aborts: requests are still out) nor may
  // what it works with go away. So all of that stays until the program ends, which must not tear libcamera down either.
  void abandon() {
    camera_->requestCompleted.disconnect(this);
    camera_->disconnected.disconnect(this);
    running_ = false;
    held_ = waiting_ = nullptr;
    pixels_->forget();
    static const int kRegistered = on_exit(
        [](int status, void*) {
          std::fflush(nullptr);
          std::_Exit(status);
        },
        nullptr);
    (void)kRegistered;
    (void)lc_.release();
  }

  void start() {
    lc::ControlList controls(camera_->controls());
    if (has(*camera_, lc::controls::FrameDurationLimits)) {
      const auto frame_us = static_cast<int64_t>(std::llround(1e6 / info_.fps));
      controls.set(lc::controls::FrameDurationLimits, lc::Span<const int64_t, 2>({frame_us, frame_us}));
    }
    // Started again: its pictures must stay as bright as they were. (A USB camera keeps that by itself.)
    if (locked_) controls.merge(*locked_);
    const int error = camera_->start(&controls);
    if (error != 0)
      throw UserError(info_.name + ": the camera does not start (" + std::strerror(-error) +
                          "); check its cable, then switch the board off and on",
                      3);
    running_ = true;
    heard_ns_ = steady_now_ns();
    for (const std::unique_ptr<lc::Request>& request : lc_->requests) {
      request->reuse(lc::Request::ReuseBuffers);
      camera_->queueRequest(request.get());
    }
    if (settings_.lock && !locked_) settling_.emplace();
    if (std::exchange(told_, true)) return;
    manners_.say("camera: " + model_of(*camera_) + ", " + std::to_string(layout_.width) + "x" +
                 std::to_string(layout_.height) + " " + to_string(layout_.format) + " through libcamera");
  }

  void stop() {
    if (!running_) return;
    if (pulled()) return abandon();
    running_ = false;
    camera_->stop();  // what is still out comes back as cancelled
    const std::lock_guard lock(mutex_);
    count_ = 0;
    held_ = waiting_ = nullptr;
    pixels_->forget();
  }

  // libcamera's own thread. What is cancelled was out when the camera stopped; but one that was refused for what it was to set
  // comes round again, without that.
  void completed(lc::Request* request) {
    if (request->status() == lc::Request::RequestCancelled && request->controls().empty()) return;
    const std::lock_guard lock(mutex_);
    if (count_ < done_.size()) done_[(first_ + count_++) % done_.size()] = request;
    wake_.notify_one();
  }
  void disconnected() {
    const std::lock_guard lock(mutex_);
    gone_ = true;
    wake_.notify_one();
  }

  lc::Request* take(int timeout_ms) {
    std::unique_lock lock(mutex_);
    wake_.wait_for(lock, std::chrono::milliseconds(timeout_ms), [this] { return count_ > 0 || gone_; });
    if (gone_) unplugged();
    if (count_ == 0) return nullptr;
    lc::Request* request = done_[first_];
    first_ = (first_ + 1) % done_.size();
    --count_;
    return request;
  }

  [[noreturn]] void unplugged() const {
    throw UserError(info_.name + ": the camera was unplugged; plug it in and start again", 3);
  }

  bool pump(int timeout_ms) {
    if (waiting_ != nullptr || !failure_.empty()) return true;
    try {
      if (!running_) start();
      waiting_ = take(timeout_ms);
      if (waiting_ != nullptr) heard_ns_ = steady_now_ns(), started_again_ = false;
      else if (steady_now_ns() - heard_ns_ > kSilence_ns) start_again();
    } catch (const UserError& error) {
      failure_ = error.what();
      stop();
      if (delivered_ == 0) throw;
      return true;
    }
    return waiting_ != nullptr;
  }

  bool pulled() {
    const std::lock_guard lock(mutex_);
    return gone_ || device_is_gone();
  }

  void start_again() {
    if (pulled()) unplugged();
    if (started_again_) {
      throw UserError(info_.name +
                          ": no picture for 2 s, though the camera was started again; check that its cable sits " +
                          "straight, that the power supply is strong enough, and that the machine is not too busy",
                      3);
    }
    manners_.say(info_.name + ": no picture for 2 s; starting the camera again");
    stop();
    start();
    clock_.restart(info_.fps);
    started_again_ = true;
  }

  bool look_at(lc::Request& request, Frame& frame) {
    lc::FrameBuffer* buffer = request.buffers().begin()->second;
    const lc::FrameMetadata& metadata = buffer->metadata();
    if (metadata.status != lc::FrameMetadata::FrameSuccess) return false;
    const PlaneMapping& mapping = *lc_->mappings.at(buffer);
    std::span<const uint8_t> bytes = mapping.bytes();
    if (layout_.format == VideoFormat::mjpeg)
      bytes = bytes.first(std::min<std::size_t>(bytes.size(), metadata.planes()[0].bytesused));
    mapping.begin_reading();
    if (!pixels_->unpack(bytes, with_chroma_, frame)) return false;
    if (settling_) return true;
    // Version 0.0.3 hands over the first few in another order where their requests had to be queued twice.
    if (clock_.is_late(metadata.sequence)) return false;
    const FrameClock::Stamp stamp =
        clock_.take(metadata.sequence, static_cast<int64_t>(metadata.timestamp), steady_now_ns());
    frame.sequence = stamp.sequence, frame.timestamp_ns = stamp.timestamp_ns;
    return true;
  }

  bool settle(lc::Request& request) {
    const bool automatic = exposes_by_itself(*camera_) || has(*camera_, lc::controls::AwbEnable);
    if (automatic && !settling_->settled(pixels_->brightness(), steady_now_ns())) return false;
    if (automatic && !settling_->locked()) {
      lock(request.metadata());
      settling_->set_locked();
      return false;
    }
    settling_.reset();
    if (!locked_) locked_.emplace(camera_->controls());
    if (automatic) return false;
    // Nothing to lock: the frame in hand is the first one.
    const lc::FrameMetadata& metadata = request.buffers().begin()->second->metadata();
    clock_.take(metadata.sequence, static_cast<int64_t>(metadata.timestamp), steady_now_ns());
    return true;
  }

  // From the next request on exposure and white balance are what they are now.
  void lock(const lc::ControlList& now) {
    lc::ControlList controls(camera_->controls());
    lock_exposure(*camera_, now, controls);
    if (has(*camera_, lc::controls::AwbEnable)) {
      controls.set(lc::controls::AwbEnable, false);
      if (const auto gains = now.get(lc::controls::ColourGains)) controls.set(lc::controls::ColourGains, *gains);
    }
    to_set_ = locked_ = std::move(controls);
    manners_.say(info_.name + ": exposure and white balance are locked");
  }

  void queue_again(lc::Request*& request) {
    if (request == nullptr) return;
    lc::Request* again = std::exchange(request, nullptr);
    lc_->mappings.at(again->buffers().begin()->second)->end_reading();
    again->reuse(lc::Request::ReuseBuffers);
    if (to_set_) again->controls() = *std::exchange(to_set_, std::nullopt);
    if (running_) camera_->queueRequest(again);
  }

  LibcameraSettings settings_;
  CameraManners manners_;
  std::unique_ptr<Running> lc_;   // null once the camera was pulled out
  lc::Camera* camera_ = nullptr;  // lc_'s
  lc::Stream* stream_ = nullptr;
  std::optional<lc::ControlList> to_set_;  // with the next request
  std::optional<lc::ControlList> locked_;  // what holds exposure and white balance; empty where the camera has neither

  std::mutex mutex_;  // of what libcamera's thread hands over
  std::condition_variable wake_;
  std::array<lc::Request*, 32> done_{};
  std::size_t first_ = 0, count_ = 0;
  bool gone_ = false;

  VideoLayout layout_;
  std::optional<VideoPixels> pixels_;
  CameraInfo info_;
  FrameClock clock_;
  std::optional<Settling> settling_;
  lc::Request* held_ = nullptr;     // handed out
  lc::Request* waiting_ = nullptr;  // to be handed out
  std::string failure_;
  bool with_chroma_ = false, running_ = false, told_ = false, started_again_ = false;
  int64_t heard_ns_ = 0, damaged_ = 0, delivered_ = 0;
};

}  // namespace
}  // namespace nt

extern "C" __attribute__((visibility("default"))) void neontetra_list_libcamera(std::vector<nt::LibcameraEntry>& list) {
  const auto manager = nt::manager();
  for (const std::shared_ptr<libcamera::Camera>& camera : manager->cameras())
    list.push_back({camera->id(), nt::model_of(*camera)});
}

extern "C" __attribute__((visibility("default"))) nt::Camera* neontetra_open_libcamera(
    const nt::LibcameraSettings& settings, int work_width, int work_height, int64_t most_pixels,
    const nt::CameraManners& manners) {
  return new nt::LibcameraCamera(settings, work_width, work_height, most_pixels, manners);
}
