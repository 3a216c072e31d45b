// SPDX-License-Identifier: Apache-2.0
// The whole of core over the simulated tank: tank frame -> Capture -> Retarget, as the app runs it, in counted memory.
#pragma once
#include <memory>
#include <stdexcept>

#include "core/character/retarget.h"
#include "core/pipeline/pipeline.h"
#include "platform/sim/tank.h"
#include "tests/support/block.h"
#include "tests/support/drawn_fish.h"

namespace nt::test {

inline Limits limits_for(const TankSettings& tank) {
  Limits limits;
  limits.max_width = tank.width, limits.max_height = tank.height;
  return limits;
}

class TankRun {
 public:
  explicit TankRun(const TankSettings& settings) : TankRun(settings, limits_for(settings)) {}
  TankRun(const TankSettings& settings, const Limits& limits, const CaptureSettings& capture = {})
      : settings_(settings), tank_(settings), capture_block_(Capture::bytes_needed(limits, capture)) {
    capture_ = must(Capture::create(capture_block_.span(), limits, capture, settings.width, settings.height));
    character_ = must(open_character(drawing_.bytes(), Limits{}));
    Arena measure;
    (void)must(Retarget::create(measure, character_, {}));
    retarget_block_ = std::make_unique<Block>(measure.used());
    arena_ = Arena(retarget_block_->span());
    retarget_ = must(Retarget::create(arena_, character_, {}));
  }

  // Renders the next frame; this may allocate, as a camera may.
  void film() {
    frame_.luma = tank_.render_next();
    frame_.sequence = static_cast<uint64_t>(tank_.frame_index());
    frame_.timestamp_ns = static_cast<int64_t>(1e9 * static_cast<double>(tank_.frame_index()) / settings_.fps);
  }
  // Core's work on it; this may not.
  StepReport step() {
    const StepReport report = capture_->step(frame_);
    if (!capture_->pose().ok()) return report;
    if (poses_++ == 0) retarget_->start(capture_->init_len());
    retarget_->pose(capture_->motion(), static_cast<float>(1.0 / settings_.fps), {});
    return report;
  }

  const Frame& frame() const { return frame_; }
  Capture& capture() { return *capture_; }
  const Retarget& retarget() const { return *retarget_; }
  int poses() const { return poses_; }

 private:
  template <class T>
  static T must(Result<T> result) {
    if (!result.ok()) throw std::runtime_error(result.status().message);
    return result.value();
  }

  TankSettings settings_;
  Tank tank_;
  Block capture_block_;
  DrawnFish drawing_;
  Character character_;
  std::unique_ptr<Block> retarget_block_;
  Arena arena_;
  Capture* capture_ = nullptr;
  Retarget* retarget_ = nullptr;
  Frame frame_;
  int poses_ = 0;
};

}  // namespace nt::test
