// SPDX-License-Identifier: Apache-2.0
#include "app/take/troupe.h"

#include <algorithm>
#include <cmath>

namespace nt {

Troupe::Troupe(const Wardrobe& wardrobe, std::vector<Performance> performances, const Pane& pane)
    : wardrobe_(wardrobe), performances_(std::move(performances)), pane_(pane) {
  actors_.reserve(performances_.size());
  for (std::size_t i = 0; i < performances_.size(); ++i) actors_.emplace_back(wardrobe, i % wardrobe.size());
  if (!performances_.front().loop) return;
  for (std::size_t i = 0; i < frames(); ++i) show(i, 1);
}

void Troupe::show(std::size_t i, int passed) {
  const auto dt_s = static_cast<float>(passed / fps());
  for (std::size_t k = 0; k < actors_.size(); ++k) {
    if (passed > 0) actors_[k].see(performances_[k].frames[i]);
    actors_[k].pose(1, dt_s, pane_);
  }
}

void Troupe::draw(Scene& scene) const {
  for (std::size_t k = actors_.size(); k-- > 0;) actors_[k].draw(scene);
}

void Troupe::next_character() {
  for (Actor& actor : actors_) actor.wear((actor.costume() + 1) % wardrobe_.size());
}

Pane take_pane(const TakeInfo& info, float scale) {
  Pane pane;
  pane.scale = scale;
  pane.width = std::max(2, static_cast<int>(std::lround(static_cast<float>(info.width) * scale)) & ~1);
  pane.height = std::max(2, static_cast<int>(std::lround(static_cast<float>(info.height) * scale)) & ~1);
  return pane;
}

}  // namespace nt
