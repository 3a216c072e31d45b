// SPDX-License-Identifier: Apache-2.0
// The window of `neontetra edit TAKE --character FILE`: the character at the left over curves and timeline, buttons at the right
// and above, 1280x720 or 800x480, mouse or touch.
//
// A recorded motion + edits -> edits, through `save`, by itself half a second after the last change. Drag a handle of the
// character or the thick curve: the neighbours inside the hill follow at once. Keys: space plays, left and right (with Shift ten)
// frames, b before, g ghosts, t tank, v video, + and - zoom, [ and ] range, Ctrl+Z and Ctrl+Y, Ctrl+S, q.
// Cost: a picture is drawn 60 times a second; a drag costs the frames of its window and some twelve poses.
#pragma once
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/take_edit/clip_editor.h"
#include "app/take_edit/curves.h"
#include "app/take_edit/edited_clip.h"
#include "app/ui/editor_window.h"
#include "app/ui/take_canvas.h"
#include "app/ui/take_timeline.h"
#include "app/ui/video_pane.h"

namespace nt {

class TakeEditor : public EditorWindow {
 public:
  using Save = std::function<void(const std::vector<Edit>&)>;  // may throw UserError: then it is shown
  // `wardrobe`: its first character is worn; must outlive this.
  TakeEditor(Display& display, EditedClip clip, const Wardrobe& wardrobe, Save save);

  const ClipEditor& editor() const { return editor_; }
  bool playing() const { return playing_; }
  const CanvasLook& look() const { return look_; }
  Vec2 on_screen(MotionProperty property);  // its handle, scene pixels
  Vec2 on_plot(int64_t frame) const;        // the thick curve, scene pixels
  const Area& canvas() const { return canvas_area_; }
  // The video that was kept, while it is shown beside the character.
  KeptVideo* video() { return video_ != nullptr ? &video_->video() : nullptr; }
  const Area& strip() const { return strip_area_; }

 private:
  enum class Grip : uint8_t { none, handle, curve, plot, strip };
  void lay_out() override;
  void press_key(const InputEvent& event) override;
  bool press(Vec2 at, float reach) override;
  void drag(Vec2 at) override;
  void release() override;
  void show() override;
  void compose(float dt_s) override;
  void pointer_is_up() override {}
  uint64_t revision() const override { return editor_.revision(); }
  bool unsaved() const override { return editor_.unsaved(); }
  void write() override;
  std::string saved_words() const override { return "Saved."; }
  bool saves_by_itself() const override { return true; }

  bool press_plot(Vec2 at, float reach);
  void show_bar();
  void show_side();
  void show_curves(int& index);
  void show_legend(const Area& area);
  void show_stretch(int& index);
  void show_transport();
  void loop();
  void show_video();
  void show_words();
  std::string words() const;
  void step(int64_t frames);
  void play(bool on);
  void toggle_video();
  void add_video();
  void advance(float dt_s);
  void save_by_itself(float dt_s);
  template <class Change>
  void try_to(Change change);

  ClipEditor editor_;
  double fps_;
  std::vector<NamedCurve> curves_;
  TakeCanvas canvas_;
  TakeTimeline timeline_;
  CanvasLook look_;
  Save save_;
  Vec2 frame_px_;  // the working frame
  float init_len_px_;
  std::string video_path_;
  int64_t video_first_;
  std::unique_ptr<VideoPane> video_;
  Area video_area_, canvas_area_, bar_, side_, transport_, plot_area_, strip_area_;
  Grip grip_ = Grip::none;
  Vec2 grip_offset_;  // from the pointer to what is held
  bool playing_ = false;
  double played_ = 0;  // the frame that is shown, with its fraction
  float since_change_s_ = 0;
  uint64_t seen_revision_ = 0;
};

}  // namespace nt
