// SPDX-License-Identifier: Apache-2.0
// A camera and the capture that watches it: what live, capture, animate and bench have in common.
//
// Opens the camera, chooses the background, cuts core's memory, then hands out one step a frame and keeps count.
// Frame of reference: pixels of the working frame; `scale()` leads back to the source video.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "app/aligned_block.h"
#include "app/calibration.h"
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

  // The next frame goes through capture; false at the end of the video or of --frames, or when the user interrupts.
  // `due_ns`: when the camera had it, by the steady clock; then the time from there to the motion is counted as latency.
  bool step(std::optional<int64_t> due_ns = {});
  // Passes a frame over; the next step counts it as dropped. False at the end.
  bool skip() { return camera_->next().has_value(); }

  Camera& camera() { return *camera_; }
  Capture& capture() { return *capture_; }
  const Frame& frame() const { return frame_; }         // of the last step
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

  std::unique_ptr<Camera> camera_;
  AlignedBlock memory_;
  Capture* capture_ = nullptr;  // lives in memory_
  int64_t frames_wanted_ = 0;
  Frame frame_;
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

// Set by Ctrl-C (installed in main): the loops end as at the end of the video, so files are complete.
bool interrupted();
void end_on_interrupt();

}  // namespace nt
