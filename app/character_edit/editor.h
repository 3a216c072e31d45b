// SPDX-License-Identifier: Apache-2.0
// What the character editor holds and does, without a window: pointer and buttons -> corrections, undo and redo.
//
// Input: a rig (what was found), corrections so far, and pointer positions in figure pixels (rig.h). Output: the corrected
// rig. Every change is one step of undo; a drag, and a slider that is pulled, are one step until end_gesture().
// Changes that corrections refuse (two points of the midline on each other) are not made.
// Cost: microseconds a call.
#pragma once
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "app/author/corrections.h"

namespace nt {

enum class Tool : uint8_t { move, midline, fins };

// Head end, tail, ...: as a user calls it, "left fin tip".
std::string plain_name(PointId id);

class Editor {
 public:
  // Finds the control points anew with S harmonics, keeping the head where it is.
  using Propose = std::function<Rig(const Rig& now, int harmonics)>;
  Editor(const Rig& found, const Corrections& corrections, Propose propose);

  const Rig& rig() const { return rig_; }
  const Corrections& corrections() const { return state_.corrections; }
  uint64_t revision() const { return revision_; }  // grows with each change of rig or corrections
  bool unsaved() const { return revision_ != saved_; }
  void mark_saved() { saved_ = revision_; }

  Tool tool() const { return tool_; }
  void choose(Tool tool);
  bool mirror() const { return state_.corrections.mirror.value_or(false); }

  // The pointer; `reach` is how near it must come to a point to hold it.
  void press(Vec2 at, float reach);
  void drag(Vec2 at);
  void release();
  std::optional<PointId> held() const { return held_; }          // while it is dragged
  std::optional<PointId> selected() const { return selected_; }  // the last one held
  std::span<const Vec2> stroke() const { return stroke_; }       // the midline that is being drawn
  // The point that a press there would hold.
  std::optional<PointId> hit(Vec2 at, float reach) const;

  void set_mirror(bool on);
  void set_flip(bool on);
  void set_tail_fin(bool on);
  void set_deformer(MlsKind kind);
  void set_fin_pairs(int pairs);
  int fin_pairs() const;  // that are there, in part at least
  void set_axis(int u_num, int l_num);
  void set_harmonics(int harmonics);
  void swap_head_and_tail();
  void propose_anew();  // all corrections of points away
  void nudge(Vec2 by);  // the selected point
  void end_gesture() { gesture_.clear(); }

  bool can_undo() const { return !past_.empty(); }
  bool can_redo() const { return !future_.empty(); }
  void undo();
  void redo();

 private:
  struct State {
    Rig found;
    Corrections corrections;
  };
  // Makes the change and applies it; `gesture`: together with the last change of the same name it is one step.
  void change(const std::string& gesture, const std::function<void(State&)>& make);
  void show(const State& state);
  void move_to(PointId id, Vec2 at);
  void keep_shape(State& state) const;
  void finish_stroke();
  void press_fin(Vec2 at, float reach);
  int fin_for(Vec2 at) const;

  Propose propose_;
  State state_;
  Rig rig_;
  std::vector<State> past_, future_;
  std::string gesture_;
  Tool tool_ = Tool::move;
  std::optional<PointId> held_, selected_;
  Vec2 grip_;            // from the pointer to the point held
  bool tapped_ = false;  // a fin's tip was pressed and has not moved yet
  Vec2 pressed_at_;
  float tap_reach_ = 0;
  std::vector<Vec2> stroke_;
  uint64_t revision_ = 0, saved_ = 0;
};

}  // namespace nt
