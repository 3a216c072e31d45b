// SPDX-License-Identifier: Apache-2.0
#include "app/ui/character_editor.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "app/ui/pane.h"
#include "app/ui/theme.h"
#include "platform/camera.h"

namespace nt {
namespace {

// Scene pixels. A fingertip covers 44 of them on a screen of 800x480; larger windows get larger buttons.
constexpr float kLeastUnit = 44, kUnitShare = 0.075f;
constexpr int kSideRows = 8;
constexpr float kLegendUnits = 1.6f;
constexpr float kSideUnits = 6.4f;
constexpr float kGapShare = 0.13f;
// How near a pointer must come to a point, in units: a finger is blunter than a mouse.
constexpr float kMouseReach = 0.4f, kFingerReach = 0.7f;
constexpr float kDotShare = 0.3f;
constexpr float kSwimLength = 0.68f;  // of the canvas' shorter side

const char* hint_for(Tool tool) {
  if (tool == Tool::midline) return "Draw a line from head to tail.";
  if (tool == Tool::fins) return "Tap to place a fin; tap its tip to remove it.";
  return "Drag a point to where it belongs.";
}

}  // namespace

CharacterEditor::CharacterEditor(Display& display, std::string name, const Character& character,
                                 const Corrections& corrections, Save save)
    : display_(display),
      name_(std::move(name)),
      figure_(character),
      editor_(figure_.found_for(corrections), corrections,
              [this](const Rig& now, int harmonics) { return figure_.propose(now, harmonics); }),
      canvas_(figure_),
      save_(std::move(save)) {}

CharacterEditor::Layout CharacterEditor::lay_out() const {
  const DisplaySize size = display_.size();
  const float width = static_cast<float>(size.width), height = static_cast<float>(size.height);
  Layout l;
  // All rows must fit: nothing scrolls.
  const float fits = height / (static_cast<float>(kSideRows) * (1 + kGapShare) + kGapShare + kLegendUnits);
  l.unit = std::floor(std::min(std::max(kLeastUnit, kUnitShare * height), fits));
  l.gap = std::floor(kGapShare * l.unit);
  const float side = std::min(kSideUnits * l.unit, 0.5f * width);
  const float bar = l.unit + 2 * l.gap, status = 0.8f * l.unit;
  l.side = {{width - side, 0}, {side, height}};
  l.bar = {{0, 0}, {width - side, bar}};
  l.status = {{0, height - status}, {width - side, status}};
  l.canvas = {{0, bar}, {width - side, height - bar - status}};
  l.view = fit_figure({figure_.corner(), figure_.size()}, l.canvas, 0.6f * l.unit, editor_.rig().flip);
  return l;
}

bool CharacterEditor::frame(float dt_s) {
  const Layout layout = lay_out();
  canvas_area_ = layout.canvas;
  read_events();
  pointer_ = pointers_.next();
  if (!asking_) use_pointer(pointer_, layout);
  const DisplaySize size = display_.size();
  panel_->begin(size.width, size.height, dt_s, pointer_, layout.unit);
  if (asking_) {
    show_question(layout);
  } else {
    show_bar(layout);
    show_side(layout);
    show_status(layout);
  }
  panel_->end();
  if (!pointer_.down) editor_.end_gesture();
  compose(layout, dt_s);
  display_.draw_over(scene_, [this] { panel_->draw(); });
  return !quit_;
}

Vec2 CharacterEditor::on_screen(PointId id) const { return lay_out().view.to_scene(point_at(editor_.rig(), id)); }

void CharacterEditor::read_events() {
  display_.poll(events_);
  for (const InputEvent& event : events_) {
    PointerEvent pointer{PointerEvent::Kind::move, event.at, event.finger, event.finger_id};
    switch (event.kind) {
      case InputEvent::Kind::quit:
        leave();
        break;
      case InputEvent::Kind::key:
        press_key(event);
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

void CharacterEditor::press_key(const InputEvent& event) {
  if (asking_) {
    if (event.key == 27) asking_ = false;
    return;
  }
  if (event.ctrl) {
    if (event.key == 'z') event.shift ? editor_.redo() : editor_.undo();
    if (event.key == 'y') editor_.redo();
    if (event.key == 's') save();
    return;
  }
  const float flip = editor_.rig().flip ? -1.0f : 1.0f;
  if (event.key == '1') editor_.choose(Tool::move);
  if (event.key == '2') editor_.choose(Tool::midline);
  if (event.key == '3') editor_.choose(Tool::fins);
  if (event.key == 'm') editor_.set_mirror(!editor_.mirror());
  if (event.key == ' ') swim(!swimming_);
  if (event.key == kKeyLeft) editor_.nudge({-flip, 0});
  if (event.key == kKeyRight) editor_.nudge({flip, 0});
  if (event.key == kKeyUp) editor_.nudge({0, -1});
  if (event.key == kKeyDown) editor_.nudge({0, 1});
  if (event.key == 'q' || event.key == 27) leave();
}

void CharacterEditor::use_pointer(const PointerState& pointer, const Layout& layout) {
  const Vec2 at = layout.view.to_figure(pointer.at);
  if (!pointer.down) {
    if (on_canvas_) editor_.release();
    on_canvas_ = false;
    pressed_ = false;
    return;
  }
  if (!pressed_ && !swimming_ && layout.canvas.contains(pointer.at)) {
    on_canvas_ = true;
    const float reach = (pointer.finger ? kFingerReach : kMouseReach) * layout.unit;
    editor_.press(at, reach / layout.view.scale);
  } else if (on_canvas_) {
    editor_.drag(at);
  }
  pressed_ = true;
}

void CharacterEditor::show_bar(const Layout& l) {
  panel_->fill(l.bar, kSide);
  constexpr int kButtons = 5;
  const float each = (l.bar.size.x - l.gap * (kButtons + 1)) / kButtons;
  int index = 0;
  const auto button = [&](const char* words, Panel::Look look) {
    const Vec2 corner{l.gap + static_cast<float>(index++) * (each + l.gap), l.gap};
    return panel_->button({corner, {each, l.unit}}, words, look);
  };
  using Look = Panel::Look;
  if (button("Undo", editor_.can_undo() ? Look::plain : Look::off)) editor_.undo();
  if (button("Redo", editor_.can_redo() ? Look::plain : Look::off)) editor_.redo();
  if (button(swimming_ ? "Stop" : "Swim", swimming_ ? Look::on : Look::plain)) swim(!swimming_);
  if (button("Save", editor_.unsaved() ? Look::main : Look::plain)) save();
  if (button("Close", Look::plain)) leave();
}

Area CharacterEditor::row_area(const Layout& l, int row) const {
  return {{l.side.corner.x + l.gap, l.gap + static_cast<float>(row) * (l.unit + l.gap)},
          {l.side.size.x - 2 * l.gap, l.unit}};
}

void CharacterEditor::show_side(const Layout& l) {
  panel_->fill(l.side, kSide);
  int row = 0;
  show_tools(l, row);
  show_numbers(l, row);
  const int deformer =
      panel_->choice(row_area(l, row++), {"Rigid", "Similar", "Affine"}, static_cast<int>(editor_.rig().deformer));
  if (deformer >= 0) editor_.set_deformer(static_cast<MlsKind>(deformer));
  const Area last = row_area(l, row);
  const Vec2 half{0.5f * (last.size.x - l.gap), l.unit};
  if (panel_->button({last.corner, half}, "Swap ends")) editor_.swap_head_and_tail();
  if (panel_->button({{last.corner.x + half.x + l.gap, last.corner.y}, half}, "Start anew")) editor_.propose_anew();
  show_legend(l);
}

void CharacterEditor::show_legend(const Layout& l) {
  const struct {
    const char* words;
    Colour colour, rim;
  } entries[] = {{"head", kHeadPoint, kRim},   {"tail", kTailPoint, kRim},     {"midline", kAxisPoint, kRim},
                 {"fin tip", kTipPoint, kRim}, {"fin root", kRootPoint, kRim}, {"unsure", kSide, kUnsure}};
  const Vec2 cell{(l.side.size.x - 2 * l.gap) / 3, 0.5f * kLegendUnits * l.unit - l.gap};
  const float top = l.side.size.y - 2 * cell.y - l.gap;
  for (int i = 0; i < 6; ++i) {
    const Vec2 corner{l.side.corner.x + l.gap + static_cast<float>(i % 3) * cell.x,
                      top + static_cast<float>(i / 3) * cell.y};
    const float size = kDotShare * l.unit;
    panel_->dot(corner + Vec2{0.7f * size, 0.5f * cell.y}, size, entries[i].colour, entries[i].rim);
    panel_->text({corner + Vec2{1.6f * size, 0}, {cell.x - 1.7f * size, cell.y}}, entries[i].words, kInkSoft);
  }
}

void CharacterEditor::show_tools(const Layout& l, int& row) {
  const int tool = panel_->choice(row_area(l, row++), {"Move", "Midline", "Fins"}, static_cast<int>(editor_.tool()));
  if (tool >= 0) editor_.choose(static_cast<Tool>(tool));
  const Area fins = row_area(l, row++);
  const float words = 0.34f * fins.size.x;
  panel_->text({fins.corner, {words, fins.size.y}}, "Fin pairs", kInk);
  const int pairs = panel_->choice({{fins.corner.x + words, fins.corner.y}, {fins.size.x - words, fins.size.y}},
                                   {"0", "1", "2"}, editor_.fin_pairs());
  if (pairs >= 0) editor_.set_fin_pairs(pairs);
  const Area switches = row_area(l, row++);
  const float each = (switches.size.x - 2 * l.gap) / 3;
  int index = 0;
  const auto toggle = [&](const char* name, bool on) {
    const Vec2 corner{switches.corner.x + static_cast<float>(index++) * (each + l.gap), switches.corner.y};
    return panel_->button({corner, {each, l.unit}}, name, on ? Panel::Look::on : Panel::Look::plain);
  };
  if (toggle("Mirror", editor_.mirror())) editor_.set_mirror(!editor_.mirror());
  if (toggle("Flip", editor_.rig().flip)) editor_.set_flip(!editor_.rig().flip);
  if (toggle("Tail fin", editor_.rig().has_tail_fin)) editor_.set_tail_fin(!editor_.rig().has_tail_fin);
}

void CharacterEditor::show_numbers(const Layout& l, int& row) {
  int up = editor_.rig().u_num, low = editor_.rig().l_num;
  int harmonics = harmonics_.value_or(editor_.rig().harmonics);
  if (panel_->number(row_area(l, row++), "Head joints", up, 1, kMaxUpAxis)) editor_.set_axis(up, low);
  if (panel_->number(row_area(l, row++), "Tail joints", low, 1, kMaxLowAxis)) editor_.set_axis(up, low);
  if (panel_->number(row_area(l, row++), "Detail S", harmonics, 1, kMostHarmonics)) harmonics_ = harmonics;
  if (!harmonics_ || pointer_.down) return;
  editor_.set_harmonics(*harmonics_);
  harmonics_.reset();
}

std::string CharacterEditor::advice() const {
  if (!message_.empty() && message_revision_ == editor_.revision()) return message_;
  if (swimming_) return "So it swims. Stop to go on.";
  const int unsure = unsure_points(editor_.rig());
  if (unsure == 0 || editor_.tool() != Tool::move) return hint_for(editor_.tool());
  return std::to_string(unsure) + " unsure (orange). " + hint_for(editor_.tool());
}

void CharacterEditor::show_status(const Layout& l) {
  panel_->fill(l.status, kSide);
  panel_->text({{l.status.corner.x + 2 * l.gap, l.status.corner.y}, {l.status.size.x - 3 * l.gap, l.status.size.y}},
               advice(), kInkSoft);
  const std::optional<PointId> shown = editor_.held() ? editor_.held() : editor_.selected();
  if (!shown || swimming_) return;
  const Vec2 at = l.view.to_scene(point_at(editor_.rig(), *shown));
  panel_->tag({at.x, at.y - 1.5f * l.unit}, plain_name(*shown), l.canvas);
}

void CharacterEditor::show_question(const Layout& l) {
  const DisplaySize size = display_.size();
  const Vec2 full{static_cast<float>(size.width), static_cast<float>(size.height)};
  panel_->fill({{0, 0}, full}, kShade);
  const Vec2 box{9 * l.unit, 3.2f * l.unit};
  const Vec2 corner = full * 0.5f - box * 0.5f;
  panel_->fill({corner, box}, kSide, 0.25f * l.unit);
  panel_->text({{corner.x, corner.y + 0.3f * l.unit}, {box.x, l.unit}}, "Save what you have changed?", kInk,
               Panel::Align::middle);
  const float each = (box.x - 4 * 2 * l.gap) / 3;
  const auto place = [&](int i) {
    return Area{{corner.x + 2 * l.gap + static_cast<float>(i) * (each + 2 * l.gap), corner.y + 1.8f * l.unit},
                {each, l.unit}};
  };
  if (panel_->button(place(0), "Save", Panel::Look::main)) {
    asking_ = false;
    save();
    quit_ = !editor_.unsaved();
  }
  if (panel_->button(place(1), "Do not save")) quit_ = true;
  if (panel_->button(place(2), "Go on")) asking_ = false;
}

void CharacterEditor::save() {
  try {
    save_(figure_.with(editor_.rig()).character, editor_.corrections());
    editor_.mark_saved();
    message_ = "Saved: " + name_;
  } catch (const UserError& error) {
    message_ = error.what();
  }
  message_revision_ = editor_.revision();
}

void CharacterEditor::leave() {
  if (editor_.unsaved() && !asking_) asking_ = true;
  else quit_ = true;
}

void CharacterEditor::swim(bool on) {
  if (on && swim_ == nullptr) swim_ = std::make_unique<TestSwim>();
  swimming_ = on;
  worn_revision_.reset();
}

void CharacterEditor::compose(const Layout& l, float dt_s) {
  const DisplaySize size = display_.size();
  scene_.clear(size.width, size.height, kPaper);
  if (!swimming_) {
    canvas_.draw(scene_, editor_, l.view, l.canvas, kDotShare * l.unit);
    return;
  }
  if (worn_revision_ != editor_.revision()) {
    RiggedCharacter next = figure_.with(editor_.rig());
    try {
      swim_->wear(next.character);
    } catch (const UserError& error) {
      message_ = error.what(), message_revision_ = editor_.revision();
      swimming_ = false;
      return;
    }
    worn_ = std::move(next);
    worn_revision_ = editor_.revision();
  }
  swim_->step(dt_s, l.canvas.centre(), kSwimLength * std::min(l.canvas.size.x, l.canvas.size.y));
  Picture texture = worn_.character.texture;
  texture.id = kFirstCharacterPicture;
  scene_.mesh(texture, swim_->vertices(), worn_.character.texcoords, worn_.character.triangles);
}

}  // namespace nt
