// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank.h"

#include <stdexcept>

#include "platform/sim/tank_fish.h"
#include "platform/sim/tank_raster.h"
#include "platform/sim/tank_render.h"
#include "platform/sim/tank_scenes.h"
#include "platform/sim/tank_school.h"

namespace nt {
namespace {

const TankScene& checked_scene(const TankSettings& settings) {
  const TankScene* scene = find_tank_scene(settings.scene);
  if (scene == nullptr) throw std::invalid_argument("tank: there is no scene '" + settings.scene + "'");
  if (!Tank::size_fits(settings.width, settings.height))
    throw std::invalid_argument("tank: the size must lie between 64x48 and 7680x4320");
  if (!(settings.fps >= 1 && settings.fps <= 1000))
    throw std::invalid_argument("tank: the frame rate must lie between 1 and 1000");
  return *scene;
}

}  // namespace

struct Tank::Impl {
  explicit Impl(const TankSettings& s)
      : settings(s),
        scene(checked_scene(s)),
        school(scene, s.seed, s.width, s.height),
        hand(scene, s.seed, s.width, s.height),
        renderer(scene, s.seed, s.width, s.height) {}

  TankSettings settings;
  const TankScene& scene;
  tank::School school;
  tank::Hand hand;
  mutable tank::Renderer renderer;    // its colour picture is made when it is asked for
  std::vector<tank::FishShape> fish;  // as the camera sees them, the target first
  tank::Coverage cover;
  TankTruth truth;
  int64_t frame = -1;

  const tank::FishShape& target() const { return fish.front(); }
  void fill_mask();
};

// One half of a pixel covered makes it fish.
void Tank::Impl::fill_mask() {
  const int width = settings.width, height = settings.height;
  truth.mask.assign(static_cast<std::size_t>(width) * height, 0);
  const Box box = tank::box_of(target().contour, 1);
  cover.start(box);
  cover.add(target().contour);
  cover.finish();
  for (int y = max_int(box.y0, 0); y < min_int(box.y1, height); ++y)
    for (int x = max_int(box.x0, 0); x < min_int(box.x1, width); ++x)
      if (cover.at(x, y) >= 0.5f) truth.mask[static_cast<std::size_t>(y) * width + x] = 255;
}

Tank::Tank(const TankSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
Tank::~Tank() = default;

LumaView Tank::render_next() {
  Impl& t = *impl_;
  if (++t.frame > 0) t.school.advance(1.0 / t.settings.fps);
  const double t_s = static_cast<double>(t.frame) / t.settings.fps;
  const tank::Similarity frame_from_tank = t.hand.frame_from_tank(t_s);
  t.school.shape(t.fish);
  if (!t.hand.still())
    for (tank::FishShape& shape : t.fish) tank::move_shape(frame_from_tank, shape);
  return t.renderer.render(t.fish, t_s, frame_from_tank);
}

std::span<const uint8_t> Tank::rgb() const { return impl_->renderer.rgb(); }

const TankTruth& Tank::truth(bool with_mask) {
  Impl& t = *impl_;
  t.truth.midline.clear();
  t.truth.contour.clear();
  t.truth.mask.clear();
  if (t.frame < 0) return t.truth;
  tank::fill_pose(t.target(), t.settings.width, t.settings.height, t.truth.pose);
  t.truth.visible = t.truth.pose.ok();
  t.truth.covered = false;
  t.truth.others.resize(t.fish.size() - 1);
  for (std::size_t i = 1; i < t.fish.size(); ++i) {
    tank::fill_pose(t.fish[i], t.settings.width, t.settings.height, t.truth.others[i - 1]);
    const bool seen = t.truth.pose.status != PoseStatus::absent && t.truth.others[i - 1].status != PoseStatus::absent;
    t.truth.covered = t.truth.covered || (seen && tank::overlap(t.target(), t.fish[i]));
  }
  t.truth.midline.assign(t.target().midline().begin(), t.target().midline().end());
  if (with_mask) {
    t.truth.contour = t.target().contour;
    t.fill_mask();
  }
  return t.truth;
}

int64_t Tank::frame_index() const { return impl_->frame; }

}  // namespace nt
