// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank.h"

#include <stdexcept>

#include "platform/sim/tank_fish.h"
#include "platform/sim/tank_raster.h"
#include "platform/sim/tank_render.h"
#include "platform/sim/tank_scenes.h"
#include "platform/sim/tank_swim.h"

namespace nt {
namespace {

const TankScene& checked_scene(const TankSettings& settings) {
  const TankScene* scene = find_tank_scene(settings.scene);
  if (scene == nullptr) throw std::invalid_argument("tank: there is no scene '" + settings.scene + "'");
  if (settings.width < 64 || settings.height < 48 || settings.width > 7680 || settings.height > 4320)
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
        swimmer(scene, s.seed, s.width, s.height),
        model(scene.body_length * static_cast<float>(s.width), scene.caudal),
        renderer(scene, s.seed, s.width, s.height) {}

  TankSettings settings;
  const TankScene& scene;
  tank::Swimmer swimmer;
  tank::FishModel model;
  mutable tank::Renderer renderer;  // its colour picture is made when it is asked for
  tank::FishShape shape;
  tank::Coverage cover;
  TankTruth truth;
  int64_t frame = -1;

  void fill_mask();
};

// One half of a pixel covered makes it fish.
void Tank::Impl::fill_mask() {
  const int width = settings.width, height = settings.height;
  truth.mask.assign(static_cast<std::size_t>(width) * height, 0);
  const Box box = tank::box_of(shape.contour, 1);
  cover.start(box);
  cover.add(shape.contour);
  cover.finish();
  for (int y = max_int(box.y0, 0); y < min_int(box.y1, height); ++y)
    for (int x = max_int(box.x0, 0); x < min_int(box.x1, width); ++x)
      if (cover.at(x, y) >= 0.5f) truth.mask[static_cast<std::size_t>(y) * width + x] = 255;
}

Tank::Tank(const TankSettings& settings) : impl_(std::make_unique<Impl>(settings)) {}
Tank::~Tank() = default;

LumaView Tank::render_next() {
  Impl& t = *impl_;
  if (++t.frame > 0) t.swimmer.advance(1.0 / t.settings.fps);
  t.model.shape(t.swimmer.posture(), t.shape);
  return t.renderer.render(t.shape);
}

std::span<const uint8_t> Tank::rgb() const { return impl_->renderer.rgb(); }

const TankTruth& Tank::truth(bool with_mask) {
  Impl& t = *impl_;
  t.truth.midline.clear();
  t.truth.contour.clear();
  t.truth.mask.clear();
  if (t.frame < 0) return t.truth;
  tank::fill_pose(t.shape, t.settings.width, t.settings.height, t.truth.pose);
  t.truth.visible = t.truth.pose.ok();
  t.truth.midline.assign(t.shape.midline().begin(), t.shape.midline().end());
  if (with_mask) {
    t.truth.contour = t.shape.contour;
    t.fill_mask();
  }
  return t.truth;
}

int64_t Tank::frame_index() const { return impl_->frame; }

}  // namespace nt
