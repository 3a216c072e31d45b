// SPDX-License-Identifier: Apache-2.0
#include "app/ui/editor_window.h"

#include <algorithm>
#include <cmath>

#include "app/session.h"
#include "app/ui/theme.h"
#include "platform/camera.h"
#include "platform/linux/clock.h"

namespace nt {
namespace {

constexpr int64_t kFramePeriod_ns = 1'000'000'000 / 60;
constexpr float kLeastUnit = 44, kUnitShare = 0.075f;  // of the window's height
constexpr float kGapShare = 0.13f;
// How near a pointer must come to a point, in units: a finger is blunter than a mouse.
constexpr float kMouseReach = 0.4f, kFingerReach = 0.7f;

}  // namespace

Vec2 EditorWindow::window() const {
  const DisplaySize size = display_.size();
  return {static_cast<float>(size.width), static_cast<float>(size.height)};
}

void EditorWindow::use_units(float units) {
  const float height = window().y;
  // Nothing scrolls: all rows must fit.
  unit_ = std::floor(std::min(std::max(kLeastUnit, kUnitShare * height), height / units));
  gap_ = std::floor(kGapShare * unit_);
}

Area EditorWindow::part(const Area& row, int index, int count) const {
  const float each = (row.size.x - gap_ * static_cast<float>(count - 1)) / static_cast<float>(count);
  return {{row.corner.x + static_cast<float>(index) * (each + gap_), row.corner.y}, {each, row.size.y}};
}

Area EditorWindow::row(const Area& side, int index) const {
  return {{side.corner.x + gap_, side.corner.y + gap_ + static_cast<float>(index) * (unit_ + gap_)},
          {side.size.x - 2 * gap_, unit_}};
}

bool EditorWindow::frame(float dt_s) {
  lay_out();
  read_events();
  pointer_ = pointers_.next();
  if (!asking_) use_pointer();
  const DisplaySize size = display_.size();
  panel_->begin(size.width, size.height, dt_s, pointer_, unit_);
  if (asking_) show_question();
  else show();
  panel_->end();
  if (!pointer_.down) pointer_is_up();
  compose(dt_s);
  display_.draw_over(scene_, [this] { panel_->draw(); });
  return !quit_;
}

void EditorWindow::read_events() {
  display_.poll(events_);
  for (const InputEvent& event : events_) {
    PointerEvent pointer{PointerEvent::Kind::move, event.at, event.finger, event.finger_id};
    switch (event.kind) {
      case InputEvent::Kind::quit:
        leave();
        break;
      case InputEvent::Kind::key:
        if (!asking_) press_key(event);
        else if (event.key == 27) asking_ = false;
        break;
      case InputEvent::Kind::click:
        pointer.kind = PointerEvent::Kind::press;
        pointers_.push(pointer);
        break;
      case InputEvent::Kind::move:
        pointers_.push(pointer);
        break;
      case InputEvent::Kind::release:
        pointer.kind = PointerEvent::Kind::release;
        pointers_.push(pointer);
        break;
    }
  }
}

void EditorWindow::use_pointer() {
  if (!pointer_.down) {
    if (holding_) release();
    holding_ = pressed_ = false;
    return;
  }
  if (!pressed_) holding_ = press(pointer_.at, (pointer_.finger ? kFingerReach : kMouseReach) * unit_);
  else if (holding_) drag(pointer_.at);
  pressed_ = true;
}

void EditorWindow::show_question() {
  panel_->fill({{0, 0}, window()}, kShade);
  const Vec2 size{9 * unit_, 3.2f * unit_};
  const Area box{window() * 0.5f - size * 0.5f, size};
  panel_->fill(box, kSide, 0.25f * unit_);
  panel_->text({{box.corner.x, box.corner.y + 0.3f * unit_}, {size.x, unit_}}, "Save what you have changed?", kInk,
               Panel::Align::middle);
  const Area answers{{box.corner.x + 2 * gap_, box.corner.y + 1.8f * unit_}, {size.x - 4 * gap_, unit_}};
  if (panel_->button(part(answers, 0, 3), "Save", Panel::Look::main)) {
    asking_ = false;
    save();
    quit_ = !unsaved();
  }
  if (panel_->button(part(answers, 1, 3), "Do not save")) quit_ = true;
  if (panel_->button(part(answers, 2, 3), "Go on")) asking_ = false;
}

void EditorWindow::save() {
  try {
    write();
    say(saved_words());
  } catch (const UserError& error) {
    say(error.what());
  }
}

void EditorWindow::leave() {
  if (saves_by_itself() && unsaved() && !asking_) save();
  if (unsaved() && !asking_) asking_ = true;
  else quit_ = true;
}

void run(EditorWindow& window) {
  int64_t last_ns = steady_now_ns();
  for (bool more = true; more && !interrupted();) {
    const int64_t now_ns = steady_now_ns();
    more = window.frame(static_cast<float>(now_ns - last_ns) * 1e-9f);
    last_ns = now_ns;
    sleep_until_ns(now_ns + kFramePeriod_ns);
  }
}

}  // namespace nt
