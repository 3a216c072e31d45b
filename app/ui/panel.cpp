// SPDX-License-Identifier: Apache-2.0
#include "app/ui/panel.h"

#include "platform/late_module.h"

namespace nt {

int Panel::choice(const Area& area, std::initializer_list<const char*> words, int on) {
  const float gap = 0.08f * area.size.y;
  const float each = (area.size.x - gap * static_cast<float>(words.size() - 1)) / static_cast<float>(words.size());
  int pressed = -1, index = 0;
  for (const char* word : words) {
    const Vec2 corner{area.corner.x + static_cast<float>(index) * (each + gap), area.corner.y};
    if (button({corner, {each, area.size.y}}, word, index == on ? Look::on : Look::plain)) pressed = index;
    ++index;
  }
  return pressed;
}

std::unique_ptr<Panel> open_panel() {
  using Make = void (*)(std::unique_ptr<Panel>&);
  static const LateModule module("libneontetra_panel.so", "which shows buttons");
  std::unique_ptr<Panel> panel;
  reinterpret_cast<Make>(module.function("neontetra_make_panel"))(panel);
  return panel;
}

}  // namespace nt
