// SPDX-License-Identifier: Apache-2.0
// A camera that films on a thread of its own, into a ring of four frames.
//
// Camera -> the same camera for its one user, whose slowness it no longer notices: pixels are copied once, into a slot of the
// ring. Pace `every`: nothing is lost, a full ring makes the clip wait. Pace `clock`: a clip or the tank plays at its own
// frame rate, and a live camera as it films; what finds the ring full is dropped, which leaves a gap in the frames' sequence.
// A clip that decodes more slowly than that plays as fast as it can (Pacer).
// Memory: four working frames, with their colour pictures where these are wanted. Nothing is allocated after the first round.
// Errors: what the camera throws comes out of next().
#pragma once
#include <atomic>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "app/frame_loop/ring.h"
#include "app/frame_loop/thread_plan.h"
#include "app/pacer.h"
#include "platform/camera.h"
#include "platform/sim/tank.h"

namespace nt {

enum class Pace : uint8_t { every, clock };

class CameraThread : public Camera {
 public:
  struct Settings {
    Pace pace = Pace::every;
    bool pictures = false, truth = false;  // that come with each frame
    ThreadPlan plan{};
  };
  static constexpr std::size_t kRing = 4;

  CameraThread(std::unique_ptr<Camera> camera, const Settings& settings);
  ~CameraThread() override;

  const CameraInfo& info() const override { return info_; }
  std::optional<Frame> next() override;
  Picture picture() const override;
  bool ready() override;
  bool wait_ready(std::chrono::milliseconds most);  // ready(), within that time
  int64_t epoch_ns() const override;
  const TankTruth* truth() override;
  std::string failure() const override { return camera_->failure(); }  // after stop()
  std::string warning() const override { return camera_->warning(); }  // after stop()

  void pause(bool on);
  // The thread ends; a camera that is being waited for must have been told so. From then on next() gives nothing.
  void stop();

 private:
  struct Slot {
    Frame frame;
    std::vector<uint8_t> luma, cb, cr, rgb;
    Picture picture;
    int64_t had_ns = 0;  // by the steady clock; 0: not known
    std::optional<TankTruth> truth;
  };

  void film();
  bool film_one();        // false at the end
  bool wait_until_due();  // false when the thread is to end
  void fill(Slot& slot, const Frame& frame);
  bool skip(int frames);

  std::unique_ptr<Camera> camera_;
  CameraInfo info_;
  Settings settings_;
  Ring<Slot> ring_{kRing};
  Pacer pacer_;
  int64_t due_ns_ = 0;
  Slot* held_ = nullptr;  // handed out
  std::atomic<bool> stop_{false}, paused_{false};
  bool was_paused_ = true;
  std::exception_ptr failed_;  // read after the ring was closed
  std::thread thread_;
};

}  // namespace nt
