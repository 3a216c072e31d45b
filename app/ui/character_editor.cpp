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

constexpr float kSideRows = 8, kRowUnits = 1.13f, kEdgeUnits = 0.13f;  // with the gaps
constexpr float kLegendUnits = 1.6f;
constexpr float kSideUnits = 6.4f;
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
    : EditorWindow(display),
      name_(std::move(name)),
      figure_(character),
      editor_(figure_.found_for(corrections), corrections,
              [this](const Rig& now, int harmonics) { return figure_.propose(now, harmonics); }),
      canvas_(figure_),
      save_(std::move(save)) {}

void CharacterEditor::lay_out() {
  use_units(kSideRows * kRowUnits + kEdgeUnits + kLegendUnits);
  const Vec2 size = window();
  const float side = std::min(kSideUnits * unit(), 0.5f * size.x), left = size.x - side;
  const float bar = unit() + 2 * gap(), status = 0.8f * unit();
  side_ = {{left, 0}, {side, size.y}};
  bar_ = {{0, 0}, {left, bar}};
  status_ = {{0, size.y - status}, {left, status}};
  canvas_area_ = {{0, bar}, {left, size.y - bar - status}};
  view_ = fit_figure({figure_.corner(), figure_.size()}, canvas_area_, 0.6f * unit(), editor_.rig().flip);
}

void CharacterEditor::show() {
  show_bar();
  show_side();
  show_status();
}

void CharacterEditor::press_key(const InputEvent& event) {
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

bool CharacterEditor::press(Vec2 at, float reach) {
  if (swimming_ || !canvas_area_.contains(at)) return false;
  editor_.press(view_.to_figure(at), reach / view_.scale);
  return true;
}

void CharacterEditor::show_bar() {
  panel().fill(bar_, kSide);
  int index = 0;
  const auto button = [&](const char* words, Panel::Look look) {
    return panel().button(part(row(bar_, 0), index++, 5), words, look);
  };
  using Look = Panel::Look;
  if (button("Undo", editor_.can_undo() ? Look::plain : Look::off)) editor_.undo();
  if (button("Redo", editor_.can_redo() ? Look::plain : Look::off)) editor_.redo();
  if (button(swimming_ ? "Stop" : "Swim", swimming_ ? Look::on : Look::plain)) swim(!swimming_);
  if (button("Save", editor_.unsaved() ? Look::main : Look::plain)) save();
  if (button("Close", Look::plain)) leave();
}

void CharacterEditor::show_side() {
  panel().fill(side_, kSide);
  int index = 0;
  show_tools(index);
  show_numbers(index);
  const int deformer =
      panel().choice(row(side_, index++), {"Rigid", "Similar", "Affine"}, static_cast<int>(editor_.rig().deformer));
  if (deformer >= 0) editor_.set_deformer(static_cast<MlsKind>(deformer));
  const Area last = row(side_, index);
  if (panel().button(part(last, 0, 2), "Swap ends")) editor_.swap_head_and_tail();
  if (panel().button(part(last, 1, 2), "Start anew")) editor_.propose_anew();
  show_legend();
}

void CharacterEditor::show_legend() {
  const struct {
    const char* words;
    Colour colour, rim;
  } entries[] = {{"head", kHeadPoint, kRim},   {"tail", kTailPoint, kRim},     {"midline", kAxisPoint, kRim},
                 {"fin tip", kTipPoint, kRim}, {"fin root", kRootPoint, kRim}, {"unsure", kSide, kUnsure}};
  const Vec2 cell{(side_.size.x - 2 * gap()) / 3, 0.5f * kLegendUnits * unit() - gap()};
  const float top = side_.size.y - 2 * cell.y - gap();
  for (int i = 0; i < 6; ++i) {
    const Vec2 corner{side_.corner.x + gap() + static_cast<float>(i % 3) * cell.x,
                      top + static_cast<float>(i / 3) * cell.y};
    const float size = kDotShare * unit();
    panel().dot(corner + Vec2{0.7f * size, 0.5f * cell.y}, size, entries[i].colour, entries[i].rim);
    panel().text({corner + Vec2{1.6f * size, 0}, {cell.x - 1.7f * size, cell.y}}, entries[i].words, kInkSoft);
  }
}

void CharacterEditor::show_tools(int& index) {
  const int tool = panel().choice(row(side_, index++), {"Move", "Midline", "Fins"}, static_cast<int>(editor_.tool()));
  if (tool >= 0) editor_.choose(static_cast<Tool>(tool));
  const Area fins = row(side_, index++);
  const float words = 0.34f * fins.size.x;
  panel().text({fins.corner, {words, fins.size.y}}, "Fin pairs", kInk);
  const int pairs = panel().choice({{fins.corner.x + words, fins.corner.y}, {fins.size.x - words, fins.size.y}},
                                   {"0", "1", "2"}, editor_.fin_pairs());
  if (pairs >= 0) editor_.set_fin_pairs(pairs);
  const Area switches = row(side_, index++);
  int place = 0;
  const auto toggle = [&](const char* name, bool on) {
    return panel().button(part(switches, place++, 3), name, on ? Panel::Look::on : Panel::Look::plain);
  };
  if (toggle("Mirror", editor_.mirror())) editor_.set_mirror(!editor_.mirror());
  if (toggle("Flip", editor_.rig().flip)) editor_.set_flip(!editor_.rig().flip);
  if (toggle("Tail fin", editor_.rig().has_tail_fin)) editor_.set_tail_fin(!editor_.rig().has_tail_fin);
}

void CharacterEditor::show_numbers(int& index) {
  int up = editor_.rig().u_num, low = editor_.rig().l_num;
  int harmonics = harmonics_.value_or(editor_.rig().harmonics);
  if (panel().number(row(side_, index++), "Head joints", up, 1, kMaxUpAxis)) editor_.set_axis(up, low);
  if (panel().number(row(side_, index++), "Tail joints", low, 1, kMaxLowAxis)) editor_.set_axis(up, low);
  if (panel().number(row(side_, index++), "Detail S", harmonics, 1, kMostHarmonics)) harmonics_ = harmonics;
  if (!harmonics_ || pointer().down) return;
  editor_.set_harmonics(*harmonics_);
  harmonics_.reset();
}

std::string CharacterEditor::advice() const {
  if (!message().empty()) return message();
  if (swimming_) return "So it swims. Stop to go on.";
  const int unsure = unsure_points(editor_.rig());
  if (unsure == 0 || editor_.tool() != Tool::move) return hint_for(editor_.tool());
  return std::to_string(unsure) + " unsure (orange). " + hint_for(editor_.tool());
}

void CharacterEditor::show_status() {
  panel().fill(status_, kSide);
  panel().text({{status_.corner.x + 2 * gap(), status_.corner.y}, {status_.size.x - 3 * gap(), status_.size.y}},
               advice(), kInkSoft);
  const std::optional<PointId> shown = editor_.held() ? editor_.held() : editor_.selected();
  if (!shown || swimming_) return;
  const Vec2 at = view_.to_scene(point_at(editor_.rig(), *shown));
  panel().tag({at.x, at.y - 1.5f * unit()}, plain_name(*shown), canvas_area_);
}

void CharacterEditor::write() {
  save_(figure_.with(editor_.rig()).character, editor_.corrections());
  editor_.mark_saved();
}

void CharacterEditor::swim(bool on) {
  if (on && swim_ == nullptr) swim_ = std::make_unique<TestSwim>();
  swimming_ = on;
  worn_revision_.reset();
}

void CharacterEditor::compose(float dt_s) {
  scene().clear(static_cast<int>(window().x), static_cast<int>(window().y), kPaper);
  if (!swimming_) {
    canvas_.draw(scene(), editor_, view_, canvas_area_, kDotShare * unit());
    return;
  }
  if (worn_revision_ != editor_.revision()) {
    RiggedCharacter next = figure_.with(editor_.rig());
    try {
      swim_->wear(next.character);
    } catch (const UserError& error) {
      say(error.what());
      swimming_ = false;
      return;
    }
    worn_ = std::move(next);
    worn_revision_ = editor_.revision();
  }
  swim_->step(dt_s, canvas_area_.centre(), kSwimLength * std::min(canvas_area_.size.x, canvas_area_.size.y));
  Picture texture = worn_.character.texture;
  texture.id = kFirstCharacterPicture;
  scene().mesh(texture, swim_->vertices(), worn_.character.texcoords, worn_.character.triangles);
}

}  // namespace nt
