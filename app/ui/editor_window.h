// SPDX-License-Identifier: Apache-2.0
// What every editor's window does: events in, one pointer for mouse and finger, widgets over a scene, the question whether
// to save, 60 pictures a second.
//
// An editor derives from it, lays out its areas, and answers press, drag and release with what it edits.
// Sizes are scene pixels and follow unit(), the height of a button: a fingertip covers 44 of them on a screen of 800x480.
#pragma once
#include <memory>
#include <string>
#include <vector>

#include "app/ui/panel.h"
#include "app/ui/pointer.h"
#include "platform/display.h"

namespace nt {

class EditorWindow {
 public:
  virtual ~EditorWindow() = default;
  EditorWindow(const EditorWindow&) = delete;
  EditorWindow& operator=(const EditorWindow&) = delete;

  // Events, one picture. False when the user is done. dt_s since the last call.
  bool frame(float dt_s);
  bool asking() const { return asking_; }  // whether to save

 protected:
  explicit EditorWindow(Display& display) : display_(display) {}

  virtual void lay_out() = 0;  // the areas, with use_units(); first of all in each frame
  virtual void press_key(const InputEvent& event) = 0;
  // The pointer goes down where the editor may want it; `reach`: how near is near enough. False: it is for the widgets.
  virtual bool press(Vec2 at, float reach) = 0;
  virtual void drag(Vec2 at) = 0;
  virtual void release() = 0;
  virtual void show() = 0;               // the widgets
  virtual void compose(float dt_s) = 0;  // the scene under them
  virtual void pointer_is_up() = 0;
  virtual uint64_t revision() const = 0;  // grows with each change
  virtual bool unsaved() const = 0;
  virtual void write() = 0;  // saves; may throw UserError: then it is shown
  virtual std::string saved_words() const = 0;
  virtual bool saves_by_itself() const { return false; }  // then nobody is asked, unless it fails

  // Buttons of such a height that `units` of them, gaps included, fit into the window's height.
  void use_units(float units);
  float unit() const { return unit_; }
  float gap() const { return gap_; }
  Vec2 window() const;
  // The index-th of `count` equal parts of a row, with gaps between them.
  Area part(const Area& row, int index, int count) const;
  // The index-th row of buttons from the top of an area.
  Area row(const Area& side, int index) const;
  Panel& panel() { return *panel_; }
  Scene& scene() { return scene_; }
  const PointerState& pointer() const { return pointer_; }

  void save();
  void leave();  // asks first where something is not saved
  void say(const std::string& message) { message_ = message, message_revision_ = revision(); }
  // What was said last, "" once something has changed since.
  std::string message() const { return message_revision_ == revision() ? message_ : ""; }

 private:
  void read_events();
  void use_pointer();
  void show_question();

  Display& display_;
  std::unique_ptr<Panel> panel_ = open_panel();
  PointerQueue pointers_;
  PointerState pointer_;
  std::vector<InputEvent> events_;
  Scene scene_;
  float unit_ = 44, gap_ = 6;
  bool pressed_ = false;  // the pointer was down in the last frame
  bool holding_ = false;  // and the editor took it
  bool quit_ = false, asking_ = false;
  std::string message_;
  uint64_t message_revision_ = 0;
};

// Shows it until the user is done, or the program is interrupted.
void run(EditorWindow& window);

}  // namespace nt
