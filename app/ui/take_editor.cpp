// SPDX-License-Identifier: Apache-2.0
#include "app/ui/take_editor.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "app/ui/theme.h"
#include "platform/camera.h"

namespace nt {
namespace {

constexpr int kSideRows = 9, kCurveColumns = 3;
constexpr float kRowUnits = 1.13f, kEdgeUnits = 0.13f;  // with the gaps
constexpr float kSideUnits = 6.4f;
constexpr float kVideoShare = 0.5f;                     // of what the character has
constexpr float kPlotShare = 0.25f;                     // of the window's height
constexpr float kDotShare = 0.3f, kLineShare = 0.035f;  // of a button's height
constexpr float kSaveAfter_s = 0.5f;
constexpr int kLongStep = 10, kMostRadius = 120;
constexpr double kStronger = 1.25, kCalmer = 0.8, kFaster = 1.25, kSlower = 0.8;

std::string time_of(int64_t frame, double fps) {
  const double seconds = static_cast<double>(frame) / fps;
  char text[32];
  std::snprintf(text, sizeof text, "%d:%05.2f", static_cast<int>(seconds / 60), std::fmod(seconds, 60.0));
  return text;
}

}  // namespace

TakeEditor::TakeEditor(Display& display, EditedClip clip, const Wardrobe& wardrobe, Save save)
    : EditorWindow(display),
      editor_(std::move(clip.recorded), std::move(clip.edits), clip.fps, clip.fish),
      fps_(clip.fps),
      curves_(named_curves(editor_.rest())),
      canvas_(wardrobe, clip.init_len_px, clip.frame_px),
      timeline_(curves_),
      save_(std::move(save)),
      frame_px_(clip.frame_px),
      init_len_px_(clip.init_len_px),
      video_path_(std::move(clip.video)),
      video_first_(clip.video_first) {
  const auto& m = editor_.motions();
  const auto seen = std::find_if(m.begin(), m.end(), [](const Motion& one) { return one.status == PoseStatus::ok; });
  if (seen != m.end()) editor_.go_to(seen - m.begin());
}

void TakeEditor::lay_out() {
  use_units(kSideRows * kRowUnits + kEdgeUnits);
  const Vec2 size = window();
  const float side = std::min(kSideUnits * unit(), 0.5f * size.x), left = size.x - side;
  const float bar = unit() + 2 * gap(), plot = std::floor(kPlotShare * size.y);
  side_ = {{left, 0}, {side, size.y}};
  bar_ = {{0, 0}, {left, bar}};
  transport_ = {{0, size.y - bar}, {left, bar}};
  const float beside = video_ != nullptr ? std::floor(kVideoShare * left) : 0, height = size.y - 2 * bar - plot;
  canvas_area_ = {{0, bar}, {left - beside, height}};
  video_area_ = {{left - beside, bar}, {beside, height}};
  const Area keys = row(transport_, 0);
  const float buttons = 2 * (unit() + gap());
  plot_area_ = {{0, size.y - bar - plot}, {left, plot}};
  strip_area_ = {{keys.corner.x + buttons, keys.corner.y}, {keys.size.x - 2 * buttons, unit()}};
}

Vec2 TakeEditor::on_screen(MotionProperty property) {
  for (const Handle& handle : canvas_.handles(editor_))
    if (handle.property == property) return handle.at;
  return {};
}

Vec2 TakeEditor::on_plot(int64_t frame) const { return timeline_.on_plot(editor_, editor_.selected(), frame); }

template <class Change>
void TakeEditor::try_to(Change change) {
  try {
    change();
  } catch (const UserError& error) {
    say(error.what());
  }
}

void TakeEditor::step(int64_t frames) {
  play(false);
  editor_.go_to(editor_.frame() + frames);
}

void TakeEditor::play(bool on) {
  playing_ = on;
  played_ = static_cast<double>(editor_.frame());
}

void TakeEditor::toggle_video() {
  if (video_path_.empty()) return;
  if (video_ == nullptr) video_ = std::make_unique<VideoPane>(video_path_, video_first_);
  else video_.reset();
}

void TakeEditor::press_key(const InputEvent& event) {
  if (event.ctrl) {
    if (event.key == 'z') event.shift ? editor_.redo() : editor_.undo();
    if (event.key == 'y') editor_.redo();
    if (event.key == 's') save();
    return;
  }
  const int64_t frames = event.shift ? kLongStep : 1;
  if (event.key == ' ') play(!playing_);
  if (event.key == kKeyLeft) step(-frames);
  if (event.key == kKeyRight) step(frames);
  if (event.key == 'b') look_.before = !look_.before;
  if (event.key == 'g') look_.ghosts = !look_.ghosts;
  if (event.key == 't') look_.far = !look_.far;
  if (event.key == 'v') toggle_video();
  if (event.key == '+' || event.key == '=') timeline_.zoom(true, editor_);
  if (event.key == '-') timeline_.zoom(false, editor_);
  if (event.key == '[') editor_.begin_range();
  if (event.key == ']') editor_.end_range();
  if (event.key == 'q' || event.key == 27) leave();
}

bool TakeEditor::press(Vec2 at, float reach) {
  grip_ = Grip::none;
  if (plot_area_.contains(at)) return press_plot(at, reach);
  if (strip_area_.contains(at)) {
    play(false);
    grip_ = Grip::strip;
    drag(at);
    return true;
  }
  if (!canvas_area_.contains(at)) return false;
  if (playing_ || look_.before) return true;
  const std::optional<Handle> handle = canvas_.hit(editor_, at, reach);
  if (!handle) return true;
  grip_ = Grip::handle;
  grip_offset_ = handle->at - at;
  editor_.hold(handle->property);
  return true;
}

// On the thick curve a frame is chosen and its number held; beside it the time goes to where the pointer is.
bool TakeEditor::press_plot(Vec2 at, float reach) {
  play(false);
  editor_.go_to(timeline_.plot_frame(at.x));
  for (const int64_t key : editor_.keys(editor_.selected()))
    if (length(on_plot(key) - at) < 0.5f * reach) editor_.go_to(key);
  const Vec2 curve = on_plot(editor_.frame());
  const bool held = !look_.before && std::abs(curve.y - at.y) < reach;
  grip_ = held ? Grip::curve : Grip::plot;
  grip_offset_ = curve - at;
  if (held) editor_.hold(editor_.selected());
  return true;
}

void TakeEditor::drag(Vec2 at) {
  const Vec2 to = at + grip_offset_;
  if (grip_ == Grip::strip) editor_.go_to(timeline_.strip_frame(at.x, editor_));
  if (grip_ == Grip::plot) editor_.go_to(timeline_.plot_frame(at.x));
  if (grip_ == Grip::handle) editor_.drag_to(canvas_.pulled(editor_, editor_.selected(), to));
  if (grip_ == Grip::curve) {
    const ClipEditor::Setting setting{editor_.selected(), timeline_.value_at(to.y, editor_)};
    editor_.drag_to({&setting, 1});
  }
}

void TakeEditor::release() {
  editor_.release();
  grip_ = Grip::none;
}

void TakeEditor::show() {
  show_bar();
  show_side();
  show_transport();
  show_video();
  show_words();
}

void TakeEditor::show_bar() {
  using Look = Panel::Look;
  const int buttons = video_path_.empty() ? 7 : 8;
  int index = 0;
  const auto button = [&](const char* words, Look look) {
    return panel().button(part(row(bar_, 0), index++, buttons), words, look);
  };
  const auto toggle = [&](const char* words, bool& on) {
    if (button(words, on ? Look::on : Look::plain)) on = !on;
  };
  if (button("Undo", editor_.can_undo() ? Look::plain : Look::off)) editor_.undo();
  if (button("Redo", editor_.can_redo() ? Look::plain : Look::off)) editor_.redo();
  if (button(playing_ ? "Pause" : "Play", playing_ ? Look::on : Look::plain)) play(!playing_);
  toggle("Before", look_.before);
  toggle("Ghosts", look_.ghosts);
  toggle("Tank", look_.far);
  if (!video_path_.empty() && button("Video", video_ != nullptr ? Look::on : Look::plain)) toggle_video();
  if (button("Close", Look::plain)) leave();
}

void TakeEditor::show_side() {
  int index = 0;
  show_curves(index);
  show_stretch(index);
  int radius = editor_.radius();
  if (panel().number(row(side_, index), "Path reach", radius, 1, kMostRadius)) editor_.set_radius(radius);
}

void TakeEditor::show_curves(int& index) {
  const int count = static_cast<int>(curves_.size());
  for (int i = 0; i < count; ++i) {
    const NamedCurve& curve = curves_[static_cast<std::size_t>(i)];
    const Area place = part(row(side_, index + i / kCurveColumns), i % kCurveColumns, kCurveColumns);
    const bool on = curve.property == editor_.selected();
    if (panel().button(place, curve.name, on ? Panel::Look::on : Panel::Look::plain)) editor_.select(curve.property);
    const float tab = 0.1f * unit();
    panel().fill(
        {{place.corner.x + tab, place.corner.y + place.size.y - 1.3f * tab}, {place.size.x - 2 * tab, 0.8f * tab}},
        curve_colour(static_cast<std::size_t>(i)), 0.4f * tab);
  }
  show_legend(part(row(side_, index + count / kCurveColumns), count % kCurveColumns, kCurveColumns));
  index += count / kCurveColumns + 1;
}

// In the place that the curves leave free.
void TakeEditor::show_legend(const Area& area) {
  const struct {
    const char* words;
    float confidence;
  } entries[] = {{"sure", 1}, {"not sure", 0}};
  const float height = 0.5f * area.size.y, size = 0.5f * height;
  for (int i = 0; i < 2; ++i) {
    const Vec2 corner{area.corner.x + gap(), area.corner.y + static_cast<float>(i) * height};
    panel().dot(corner + Vec2{0.5f * size, 0.5f * height}, size, confidence_colour(entries[i].confidence), kSide);
    panel().text({corner + Vec2{1.4f * size, 0}, {area.size.x - gap() - 1.4f * size, height}}, entries[i].words,
                 kInkSoft);
  }
}

void TakeEditor::show_stretch(int& index) {
  using Look = Panel::Look;
  int place = 0;
  const auto button = [&](const char* words, Look look = Look::plain) {
    const bool pressed = panel().button(part(row(side_, index + place / 3), place % 3, 3), words, look);
    ++place;
    return pressed;
  };
  const bool whole = editor_.range() == FrameRange{0, editor_.frames() - 1};
  const Look angle = editor_.selected().is_path() ? Look::off : Look::plain;
  if (button("From")) editor_.begin_range();
  if (button("To")) editor_.end_range();
  if (button("All", whole ? Look::off : Look::plain)) editor_.whole_range();
  if (button("Smooth")) try_to([&] { editor_.smooth(); });
  if (button("Stronger", angle)) try_to([&] { editor_.exaggerate(kStronger); });
  if (button("Calmer", angle)) try_to([&] { editor_.exaggerate(kCalmer); });
  if (button("Repair")) try_to([&] { editor_.repair(); });
  if (button("Trim", whole ? Look::off : Look::plain)) try_to([&] { editor_.trim(); });
  if (button("Loop")) try_to([&] { loop(); });
  if (button("Slower")) try_to([&] { editor_.retime(kSlower); });
  if (button("Faster")) try_to([&] { editor_.retime(kFaster); });
  index += (place + 2) / 3;
}

void TakeEditor::show_transport() {
  const Area keys = row(transport_, 0), strip = strip_area_;
  const Vec2 size{unit(), unit()};
  const float right = strip.corner.x + strip.size.x + gap();
  const auto place = [&](float x) { return Area{{x, keys.corner.y}, size}; };
  if (panel().button(place(keys.corner.x), "<##frame")) step(-1);
  if (panel().button(place(keys.corner.x + unit() + gap()), ">##frame")) step(1);
  if (panel().button(place(right), "-##time")) timeline_.zoom(false, editor_);
  if (panel().button(place(right + unit() + gap()), "+##time")) timeline_.zoom(true, editor_);
}

void TakeEditor::loop() {
  editor_.loop();
  const Seam& seam = editor_.seam();
  char text[96];
  std::snprintf(text, sizeof text, "The loop's seam: %.1f degrees and %.1f pixels bridged.",
                static_cast<double>(seam.angle_rad) * 57.2957795, static_cast<double>(seam.drift_px));
  say(text);
}

// Why there is no picture, where there is none.
void TakeEditor::show_video() {
  if (video_ == nullptr) return;
  const std::string problem = video_->video().problem();
  if (problem.empty()) return;
  // What, and what to do, a line each.
  const std::size_t colon = std::min(problem.find(": "), problem.size());
  const float height = 0.7f * unit();
  Vec2 corner{video_area_.corner.x + gap(), video_area_.centre().y - height};
  for (const std::string& line : {problem.substr(0, colon), problem.substr(std::min(colon + 2, problem.size()))}) {
    panel().text({corner, {video_area_.size.x - 2 * gap(), height}}, line, kOnAccent, Panel::Align::middle);
    corner.y += height;
  }
}

std::string TakeEditor::words() const {
  if (!message().empty()) return message();
  const MotionProperty selected = editor_.selected();
  const Motion& motion = editor_.motions()[static_cast<std::size_t>(editor_.frame())];
  const float shown = degrees_or_pixels(value_of(motion, selected), selected, editor_.rest());
  char text[96];
  std::snprintf(text, sizeof text, "%s  %.1f%s", plain_name(selected, curves_).c_str(), static_cast<double>(shown),
                unit_of(selected));
  const EditWindow window = editor_.window();
  if (window.p == window.q) return text;
  return std::string(text) + "   moves frames " + std::to_string(window.p) + " to " + std::to_string(window.q);
}

void TakeEditor::show_words() {
  const float height = 0.7f * unit();
  const Area top{{2 * gap(), canvas_area_.corner.y}, {canvas_area_.size.x - 4 * gap(), height}};
  const bool posed = editor_.motions()[static_cast<std::size_t>(editor_.frame())].status == PoseStatus::ok;
  const std::string when = "Frame " + std::to_string(editor_.frame()) + " of " + std::to_string(editor_.frames()) +
                           "   " + time_of(editor_.frame(), fps_) + (look_.before ? "   as recorded" : "") +
                           (posed ? "" : "   no pose");
  panel().text(top, when, kInkSoft);
  const Area low{{top.corner.x, canvas_area_.corner.y + canvas_area_.size.y - height}, top.size};
  panel().text(low, words(), kInk);
}

void TakeEditor::write() {
  editor_.release();
  save_(editor_.edits());
  editor_.mark_saved();
}

// While it plays the range is played, over and over.
void TakeEditor::advance(float dt_s) {
  if (!playing_) return;
  const FrameRange range = editor_.range();
  played_ += static_cast<double>(dt_s) * fps_;
  if (played_ >= static_cast<double>(range.last + 1) || played_ < static_cast<double>(range.first))
    played_ = static_cast<double>(range.first);
  editor_.go_to(static_cast<int64_t>(played_));
}

void TakeEditor::save_by_itself(float dt_s) {
  if (seen_revision_ != editor_.revision()) seen_revision_ = editor_.revision(), since_change_s_ = 0;
  const bool waited = since_change_s_ >= kSaveAfter_s;
  since_change_s_ += dt_s;
  // Once a change: where it fails the message stays, and the next change or Ctrl+S tries again.
  if (!waited && since_change_s_ >= kSaveAfter_s && unsaved() && !editor_.holding()) save();
}

// Near as the character is, at the same size; far the whole picture.
void TakeEditor::add_video() {
  if (video_ == nullptr) return;
  FigureView view = canvas_.view();
  view.to = video_area_.centre();
  if (look_.far) view = fit_figure({{0, 0}, frame_px_}, video_area_, gap(), false);
  video_->draw(scene(), video_area_, view, editor_.recorded_frame(editor_.frame()),
               editor_.motions()[static_cast<std::size_t>(editor_.frame())], init_len_px_,
               std::max(1.0f, kLineShare * unit()));
}

void TakeEditor::compose(float dt_s) {
  advance(dt_s);
  save_by_itself(dt_s);
  look_.dot_px = kDotShare * unit();
  look_.handles = !playing_;
  timeline_.lay_out(plot_area_, strip_area_, editor_);
  canvas_.lay_out(canvas_area_, editor_, look_);
  scene().clear(static_cast<int>(window().x), static_cast<int>(window().y), kPaper);
  canvas_.draw(scene(), editor_, look_);
  add_video();
  for (const Area& area : {bar_, transport_, side_})
    scene().area(area.corner, area.size, kSide);  // over what swims out
  timeline_.draw(scene(), editor_, std::max(1.0f, kLineShare * unit()));
}

}  // namespace nt
