// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/masks/mask_model.h"

#include <opencv2/imgproc.hpp>
#include <opencv2/video/background_segm.hpp>

#include "core/segment/background.h"
#include "core/segment/blobs.h"
#include "core/segment/clean.h"
#include "core/segment/first_sight.h"
#include "platform/camera.h"
#include "platform/linux/clock.h"
#include "platform/sim/half_chroma.h"

namespace nt {
namespace {

constexpr int kOpen = 3;
constexpr double kNsPerUs = 1e3;

LumaView view_of(const cv::Mat& grey) {
  return {grey.data, grey.cols, grey.rows, static_cast<std::ptrdiff_t>(grey.step[0])};
}

void open_in_place(cv::Mat& mask) {
  cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::getStructuringElement(cv::MORPH_RECT, {kOpen, kOpen}));
}

class OwnModel : public MaskModel {
 public:
  OwnModel(std::string name, BackgroundKind kind, cv::Size size)
      : name_(std::move(name)), colour_(kind == BackgroundKind::vibe_colour), size_(size) {
    Arena count;
    lay_out(count, kind);
    memory_ = AlignedBlock(count.used());
    Arena arena(memory_.bytes());
    lay_out(arena, kind);
  }
  const std::string& name() const override { return name_; }
  std::size_t bytes() const override { return model_bytes_; }
  void learn(const std::vector<cv::Mat>& pictures) override {
    if (model_->ready()) return;
    for (const cv::Mat& bgr : pictures) {
      cv::cvtColor(bgr, luma_, cv::COLOR_BGR2GRAY);
      model_->learn(view_of(luma_));
    }
  }
  bool apply(const cv::Mat& bgr, cv::Mat& mask, double& us) override {
    cv::cvtColor(bgr, luma_, cv::COLOR_BGR2GRAY);
    Frame frame;
    frame.luma = view_of(luma_);
    if (colour_) chroma_.give(bgr, false, frame);
    const int64_t before_ns = steady_now_ns();
    if (!model_->ready()) protected_ = first_sight_.find(frame.luma, least_area(), *blobs_, raw_, scratch_, keep_) > 0;
    model_->see_chroma(frame.cb, frame.cr);
    const bool means_something = model_->apply(frame.luma, protected_ ? &keep_ : nullptr, raw_);
    us = static_cast<double>(steady_now_ns() - before_ns) / kNsPerUs;
    protect_largest();
    mask.create(size_, CV_8U);
    for (int y = 0; y < size_.height; ++y)
      for (int x = 0; x < size_.width; ++x) mask.ptr<uint8_t>(y)[x] = raw_.at(x, y) ? 255 : 0;
    open_in_place(mask);
    return means_something;
  }

 private:
  void lay_out(Arena& arena, BackgroundKind kind) {
    Limits limits;
    limits.max_width = size_.width, limits.max_height = size_.height;
    BackgroundSettings settings;
    settings.kind = kind;
    const Result<Background*> made = Background::create(arena, limits, settings, size_.width, size_.height, 1);
    if (!made.ok()) throw UserError("bench --masks: " + std::string(made.status().message));
    model_ = made.value();
    model_bytes_ = arena.used();
    const int words = words_for(size_.width);
    for (BitMask* mask : {&raw_, &open_, &scratch_, &keep_}) {
      auto space = arena.take<uint64_t>(static_cast<std::size_t>(words) * static_cast<std::size_t>(size_.height));
      *mask = {space.data(), size_.width, size_.height, words};
    }
    blobs_ = Blobs::create(arena, limits);
  }

  int least_area() const { return size_.area() / 4000; }

  // As capture does with the fish that it follows: the largest blob, with a margin, is not learned.
  void protect_largest() {
    open_mask(raw_, scratch_, open_, kOpen);
    blobs_->find(open_, least_area());
    int largest = -1;
    for (int i = 0; i < static_cast<int>(blobs_->blobs().size()); ++i)
      if (largest < 0 || blob(i).area_px > blob(largest).area_px) largest = i;
    protected_ = largest >= 0;
    if (!protected_) return;
    clear_mask(scratch_);
    for (const Run& run : blobs_->runs())
      for (int x = run.x0; run.label == largest && x < run.x1; ++x) scratch_.set(x, run.y);
    spread(scratch_, keep_, 1);
    spread(keep_, scratch_, 2);
    spread(scratch_, keep_, 4);
  }
  const Blob& blob(int i) const { return blobs_->blobs()[static_cast<std::size_t>(i)]; }

  std::string name_;
  bool colour_;
  cv::Size size_;
  std::size_t model_bytes_ = 0;
  AlignedBlock memory_;
  Background* model_ = nullptr;
  Blobs* blobs_ = nullptr;
  FirstSight first_sight_;
  BitMask raw_, open_, scratch_, keep_;
  bool protected_ = false;
  HalfChroma chroma_;
  cv::Mat luma_;
};

// In colour, with its own detection of shadows, as it comes.
class Peer : public MaskModel {
 public:
  Peer(std::string name, cv::Ptr<cv::BackgroundSubtractor> model) : name_(std::move(name)), model_(std::move(model)) {}
  const std::string& name() const override { return name_; }
  bool apply(const cv::Mat& bgr, cv::Mat& mask, double& us) override {
    const int64_t before_ns = steady_now_ns();
    model_->apply(bgr, mask);
    us = static_cast<double>(steady_now_ns() - before_ns) / kNsPerUs;
    mask = mask == 255;  // 127 is shadow
    open_in_place(mask);
    return std::exchange(started_, true);
  }

 private:
  std::string name_;
  cv::Ptr<cv::BackgroundSubtractor> model_;
  bool started_ = false;
};

}  // namespace

std::vector<std::unique_ptr<MaskModel>> make_mask_models(cv::Size size) {
  std::vector<std::unique_ptr<MaskModel>> models;
  models.push_back(std::make_unique<OwnModel>("vibe", BackgroundKind::vibe, size));
  models.push_back(std::make_unique<OwnModel>("vibe-colour", BackgroundKind::vibe_colour, size));
  models.push_back(std::make_unique<OwnModel>("still", BackgroundKind::still, size));
  models.push_back(std::make_unique<OwnModel>("backlit", BackgroundKind::backlit, size));
  models.push_back(std::make_unique<Peer>("OpenCV MOG2", cv::createBackgroundSubtractorMOG2()));
  models.push_back(std::make_unique<Peer>("OpenCV KNN", cv::createBackgroundSubtractorKNN()));
  return models;
}

}  // namespace nt
