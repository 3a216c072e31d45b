// SPDX-License-Identifier: Apache-2.0
// A camera and the capture that watches it: what live, capture, animate and bench have in common.
//
// Opens the camera, chooses the background, cuts core's memory, then hands out one step a frame and keeps count.
// Frame of reference: pixels of the working frame; `scale()` leads back to the source video.
#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include <string>

#include "app/aligned_block.h"
#include "app/calibration.h"
#include "app/frame_loop/camera_thread.h"
#include "app/options.h"
#include "app/statistics.h"
#include "core/pipeline/pipeline.h"
#include "platform/camera.h"

namespace nt {

class Session {
 public:
  // Throws UserError: no camera, a picture that cannot be read, frames too small. Says on stderr which background `auto`
  // has chosen.
  explicit Session(const CaptureOptions& options);

  // From here on the camera films on a thread of its own; it is this session's camera() from then on.
  CameraThread& film_on_a_thread(const CameraThread::Settings& settings);
  // From any thread: a step that waits for a live camera ends, and it was the last one.
  void end_filming() { *ending_ = true; }

  // The next frame goes through capture; false at the end of the video or of --frames, or when the user interrupts. Where the
  // camera says when it had the frame, the time from there to the motion is counted as latency.
  bool step();

  Camera& camera() { return *camera_; }
  Capture& capture() { return *capture_; }
  const Capture& capture() const { return *capture_; }
  const Frame& frame() const { return frame_; }         // of the last step
  int64_t had_ns() const { return had_ns_; }            // when the camera had it, by the steady clock; 0: not known
  const StepReport& report() const { return report_; }  // of the last step
  const Statistics& statistics() const { return statistics_; }
  const CameraInfo& info() const { return camera_->info(); }
  float scale() const;  // source width / working width
  const Calibration& calibration() const { return calibration_; }
  void set_scale(const ScalePoints& points, double length_mm) { calibration_.set_scale(points, length_mm); }
  int64_t frame_index() const { return statistics_.frames - 1; }
  const std::string& background_why() const { return why_; }
  Stabilise stabilise() const { return stabilise_; }  // as asked for
  std::size_t core_bytes() const { return memory_.bytes().size(); }

 private:
  BackgroundKind choose_model(const CaptureOptions& options);
  void select(Vec2 at);  // of the source picture; throws UserError outside of it
  void create_capture(const CaptureOptions& options, BackgroundKind kind);
  int working_area(int64_t source_px) const;
  void learn(const CaptureOptions& options, BackgroundKind kind);
  void count_gap(const Frame& frame);
  void calibrate(const CaptureOptions& options);
  void tell_stabilising();

  std::shared_ptr<std::atomic<bool>> ending_ = std::make_shared<std::atomic<bool>>(false);
  std::unique_ptr<Camera> camera_;
  AlignedBlock memory_;
  Capture* capture_ = nullptr;  // lives in memory_
  int64_t frames_wanted_ = 0;
  Frame frame_;
  int64_t had_ns_ = 0;
  StepReport report_;
  Statistics statistics_;
  Stabilise stabilise_ = Stabilise::off;
  bool told_stabilising_ = false;
  Calibration calibration_;
  std::string why_;
  std::string announcement_;  // of the background that auto chose, until the first frame
};

// Throws UserError where not one frame came.
void expect_frames(const Session& session);

// At the very end, when all that was asked for is written: says on stderr what was wrong with the camera. Throws UserError
// where it ended before its time.
void end_of_frames(Session& session);

// Set by Ctrl-C, SIGTERM and a terminal that is closed (installed in main), or when nobody reads standard output any more: the
// loops end as at the end of the video, so files are complete.
bool interrupted();
void interrupt();
void end_on_interrupt();
void die_of_interrupt();  // for work that writes nothing before its end

}  // namespace nt
