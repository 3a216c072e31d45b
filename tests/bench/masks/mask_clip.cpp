// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/masks/mask_clip.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <map>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "platform/camera.h"
#include "platform/sim/frame_source.h"
#include "platform/sim/tank.h"

namespace nt {
namespace {

namespace fs = std::filesystem;

// The number in a name such as gt000685.png or frame_12.jpg; -1 where there is
// none.
int number_of(const fs::path& file) {
  const std::string stem = file.stem().string();
  const std::size_t at = stem.find_last_not_of("0123456789") + 1;
  return at < stem.size() && stem.size() - at < 9 ? std::stoi(stem.substr(at)) : -1;
}

std::map<int, fs::path> numbered_files(const fs::path& folder) {
  std::map<int, fs::path> files;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (const int n = number_of(entry.path()); n >= 0) files[n] = entry.path();
  return files;
}

cv::Mat read_picture(const fs::path& path, int flags) {
  cv::Mat picture = cv::imread(path.string(), flags);
  if (picture.empty()) throw UserError(path.string() + ": this picture cannot be read; fetch it again");
  return picture;
}

cv::Mat read_truth(const fs::path& path, const cv::Mat& like) {
  cv::Mat truth = read_picture(path, cv::IMREAD_GRAYSCALE);
  if (truth.size() != like.size()) throw UserError(path.string() + ": the mask has another size than its frame");
  return truth;
}

class VideoClip : public MaskClip {
 public:
  VideoClip(std::string name, const fs::path& video, std::map<int, fs::path> masks)
      : name_(std::move(name)), source_(open_frame_source(video.string())), masks_(std::move(masks)) {}
  const std::string& name() const override { return name_; }
  bool next(MaskedFrame& frame) override {
    constexpr int kShift = 2;
    if (!source_->read(frame.bgr)) return false;
    const auto mask = masks_.find(static_cast<int>(source_->index()) + kShift);
    frame.truth = mask == masks_.end() ? cv::Mat() : read_truth(mask->second, frame.bgr);
    return true;
  }
  void rewind() override { source_->rewind(); }

 private:
  std::string name_;
  std::unique_ptr<FrameSource> source_;
  std::map<int, fs::path> masks_;
};

class PicturesClip : public MaskClip {
 public:
  PicturesClip(std::string name, std::map<int, fs::path> frames, std::map<int, fs::path> masks)
      : name_(std::move(name)), frames_(std::move(frames)), masks_(std::move(masks)), at_(frames_.begin()) {}
  const std::string& name() const override { return name_; }
  bool next(MaskedFrame& frame) override {
    if (at_ == frames_.end()) return false;
    frame.bgr = read_picture(at_->second, cv::IMREAD_COLOR);
    const auto mask = masks_.find(at_->first);
    // The first frame is only learned from.
    const bool judged = mask != masks_.end() && at_ != frames_.begin();
    frame.truth = judged ? read_truth(mask->second, frame.bgr) : cv::Mat();
    ++at_;
    return true;
  }
  void rewind() override { at_ = frames_.begin(); }

 private:
  std::string name_;
  std::map<int, fs::path> frames_, masks_;
  std::map<int, fs::path>::const_iterator at_;
};

class TankClip : public MaskClip {
 public:
  TankClip(const std::string& scene, int frames) : name_("tank " + scene), frames_(frames) {
    settings_.scene = scene;
    rewind();
  }
  const std::string& name() const override { return name_; }
  bool next(MaskedFrame& frame) override {
    constexpr int kWarmUp = 30, kEvery = 5;
    if (tank_->frame_index() + 1 >= frames_) return false;
    tank_->render_next();
    const cv::Mat rgb(settings_.height, settings_.width, CV_8UC3, const_cast<uint8_t*>(tank_->rgb().data()));
    cv::cvtColor(rgb, frame.bgr, cv::COLOR_RGB2BGR);
    frame.truth = cv::Mat();
    if (tank_->frame_index() < kWarmUp || tank_->frame_index() % kEvery != 0) return true;
    const TankTruth& truth = tank_->truth(true);
    frame.truth = cv::Mat(settings_.height, settings_.width, CV_8U, const_cast<uint8_t*>(truth.mask.data())).clone();
    return true;
  }
  void rewind() override { tank_ = std::make_unique<Tank>(settings_); }

 private:
  std::string name_;
  int frames_;
  TankSettings settings_;
  std::unique_ptr<Tank> tank_;
};

std::unique_ptr<MaskClip> open_masked_clip(const fs::path& folder) {
  std::map<int, fs::path> masks = numbered_files(folder / "groundtruth");
  if (masks.empty()) return nullptr;
  const std::string name = folder.filename().string();
  std::map<int, fs::path> frames = numbered_files(folder / "input");
  if (!frames.empty()) return std::make_unique<PicturesClip>(name, std::move(frames), std::move(masks));
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.is_regular_file()) return std::make_unique<VideoClip>(name, entry.path(), std::move(masks));
  return nullptr;
}

}  // namespace

std::vector<std::unique_ptr<MaskClip>> open_masked_clips(const std::string& folder) {
  std::vector<fs::path> folders;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.is_directory()) folders.push_back(entry.path());
  std::sort(folders.begin(), folders.end());
  std::vector<std::unique_ptr<MaskClip>> clips;
  for (const fs::path& path : folders)
    if (std::unique_ptr<MaskClip> clip = open_masked_clip(path)) clips.push_back(std::move(clip));
  if (clips.empty()) {
    throw UserError("--ground-truth: " + folder +
                    " holds no clip with masks; give a folder of folders that "
                    "each have groundtruth/ beside a video or input/");
  }
  return clips;
}

std::unique_ptr<MaskClip> open_tank_clip(const std::string& scene, int frames) {
  return std::make_unique<TankClip>(scene, frames);
}

}  // namespace nt
