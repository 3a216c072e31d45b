// SPDX-License-Identifier: Apache-2.0
#include "app/ui/overlay.h"

#include <cstdio>
#include <string>

#include "app/export/pose_csv.h"

namespace nt {
namespace {

constexpr Colour kWhite{1, 1, 1, 0.9f};
constexpr Colour kCyan{0.2f, 0.9f, 1, 0.9f};
constexpr Colour kRed{0.95f, 0.15f, 0.1f, 1};
constexpr Colour kBlue{0.15f, 0.35f, 1, 1};
constexpr Colour kGreen{0.1f, 0.85f, 0.25f, 1};
constexpr Colour kYellow{1, 0.85f, 0.1f, 1};
constexpr Colour kOrange{1, 0.55f, 0.1f, 1};
constexpr Colour kMagenta{1, 0.2f, 0.9f, 0.9f};
constexpr Colour kGrey{0.7f, 0.7f, 0.7f, 0.7f};
constexpr float kPoint = 9, kLine = 2;  // scene pixels
constexpr std::size_t kMaxBoxes = 32;   // of other blobs; the scene holds 256 items

std::string confidences(const PoseConfidence& c) {
  char text[96];
  std::snprintf(text, sizeof text, "  head %.2f  tail %.2f  fins %.2f %.2f  axis %.2f", static_cast<double>(c.head),
                static_cast<double>(c.tail), static_cast<double>(c.l_fin), static_cast<double>(c.r_fin),
                static_cast<double>(c.axis));
  return text;
}

}  // namespace

void Overlay::update(const Observation& seen, bool show_blobs) {
  picture_ = seen.picture;
  picture_.id = kCameraPicture;
  picture_.revision = static_cast<uint64_t>(seen.frame_index) + 1;
  fish_.resize(seen.fish.size());
  for (std::size_t i = 0; i < fish_.size(); ++i) {
    take_pose(seen.fish[i], fish_[i]);
    fish_[i].target = static_cast<int>(i) == seen.target;
  }
  for (std::size_t i = numbers_.size(); fish_.size() > 1 && i < fish_.size(); ++i) {
    numbers_.emplace_back(kFirstNumberPicture + static_cast<uint32_t>(i));
    numbers_.back().set(std::to_string(i + 1));
  }
  blob_corners_.clear();
  truth_.clear();
  if (show_blobs) take_blobs(seen.blobs);
  text_.set("frame " + std::to_string(seen.frame_index) + "  " + to_string(seen.report.status) +
            (seen.report.status == PoseStatus::ok ? confidences(seen.pose().confidence) : ""));
}

void Overlay::show_truth(const TankTruth& truth, float scale) {
  for (const Vec2 p : truth.midline) truth_.push_back(pane_.to_scene(to_working(p, scale)));
}

void Overlay::take_pose(const FishSeen& fish, Drawn& drawn) const {
  const FishPose& pose = fish.pose;
  drawn.seen = pose.ok();
  if (!drawn.seen) return;
  const auto at = [this](Vec2 p) { return pane_.to_scene(p); };
  drawn.outline.clear(), drawn.midline.clear(), drawn.fins.clear(), drawn.junctions.clear();
  for (const Vec2 p : fish.contour) drawn.outline.push_back(at(p));
  drawn.midline.push_back(at(pose.head));
  for (int i = pose.u_num - 1; i >= 0; --i) drawn.midline.push_back(at(pose.up_axis[i]));
  drawn.midline.push_back(at(pose.centre));
  for (int i = 0; i < pose.l_num; ++i) drawn.midline.push_back(at(pose.low_axis[i]));
  drawn.midline.push_back(at(pose.tail));
  const auto fin = [&](float confidence, Vec2 tip, Vec2 top, Vec2 bottom) {
    if (confidence <= 0) return;
    drawn.fins.push_back(at(tip));
    drawn.junctions.push_back(at(top));
    drawn.junctions.push_back(at(bottom));
  };
  fin(pose.confidence.l_fin, pose.l_fin, pose.jun_tl, pose.jun_bl);
  fin(pose.confidence.r_fin, pose.r_fin, pose.jun_tr, pose.jun_br);
  drawn.head = at(pose.head), drawn.tail = at(pose.tail);
  const Vec2 from = at(pose.centre), along = pose.dir * (pose.axis_len * 0.35f * pane_.scale);
  const Vec2 tip = from + along, wing = right_of(along) * 0.15f;
  drawn.arrow = {from, tip, tip - along * 0.25f + wing, tip, tip - along * 0.25f - wing};
}

void Overlay::take_blobs(std::span<const BlobView> blobs) {
  for (const BlobView& blob : blobs) {
    if (blob.selected || blob_corners_.size() >= 4 * kMaxBoxes) continue;
    const Vec2 low = pane_.to_scene({static_cast<float>(blob.box.x0), static_cast<float>(blob.box.y0)});
    const Vec2 high = pane_.to_scene({static_cast<float>(blob.box.x1), static_cast<float>(blob.box.y1)});
    for (const Vec2 corner : {low, Vec2{high.x, low.y}, high, Vec2{low.x, high.y}}) blob_corners_.push_back(corner);
  }
}

void Overlay::draw_fish(const Drawn& fish, const Text* number, Scene& scene) const {
  scene.lines(fish.outline, fish.target ? kWhite : kGrey, kLine, true);
  scene.lines(fish.midline, kCyan, kLine);
  scene.lines(fish.arrow, kOrange, kLine);
  scene.points(fish.junctions, kYellow, kPoint * 0.7f);
  scene.points(fish.fins, kGreen, kPoint);
  scene.points({&fish.tail, 1}, kBlue, kPoint);
  scene.points({&fish.head, 1}, kRed, kPoint);
  if (number != nullptr) number->draw(scene, fish.head + Vec2{8, 8});
}

void Overlay::draw(Scene& scene) const {
  scene.image(picture_, pane_.corner, {static_cast<float>(pane_.width), static_cast<float>(pane_.height)});
  for (std::size_t i = 0; i < blob_corners_.size(); i += 4) {
    scene.lines({blob_corners_.data() + i, 4}, kGrey, 1, true);
  }
  for (std::size_t i = 0; i < fish_.size(); ++i) {
    if (fish_[i].seen) draw_fish(fish_[i], i < numbers_.size() ? &numbers_[i] : nullptr, scene);
  }
  if (truth_.size() > 1) scene.lines(truth_, kMagenta, 1);
  text_.draw(scene, pane_.corner + Vec2{8, 6});
}

}  // namespace nt
