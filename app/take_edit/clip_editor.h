// SPDX-License-Identifier: Apache-2.0
// What the take editor holds and does, without a window: a recorded motion, the list of edits, undo and redo.
//
// Input: one fish's recorded motion, the edits so far, and what a hand does: numbers that are dragged at a frame, stretches
// that are smoothed. Output: the list of edits (app/take/edits.h), no more than a text file could hold, and the clip that it
// makes of the recording. Frames count from 0 in the clip as it stands.
// While a number is held its edit changes with every drag_to(); release() makes one step of undo of it. Undo takes the
// last edit from the list, also one of an earlier day.
// Cost: drag_to() O(frames of its window); undo applies the whole list anew.
#pragma once
#include <cstdint>
#include <span>
#include <vector>

#include "app/take/edits.h"
#include "core/motion/finetune.h"

namespace nt {

struct FrameRange {
  int64_t first = 0, last = 0;  // both inside
  friend bool operator==(const FrameRange&, const FrameRange&) = default;
};

class ClipEditor {
 public:
  // `recorded` has a frame at least. Throws UserError for edits that do not fit.
  // New edits are for `fish`; of the list those for other fish are kept and have no effect. -1: the take has one fish.
  ClipEditor(std::vector<Motion> recorded, std::vector<Edit> edits, double fps, int fish = -1);

  const std::vector<Motion>& motions() const { return clip_.motions; }
  const std::vector<Motion>& recorded() const { return recorded_; }
  int64_t recorded_frame(int64_t frame) const;  // what a frame of the clip was made of
  const Motion& recorded_at(int64_t frame) const { return recorded_[static_cast<std::size_t>(recorded_frame(frame))]; }
  const Motion& rest() const { return rest_; }
  const std::vector<Edit>& edits() const { return edits_; }  // without what is held
  const Seam& seam() const { return clip_.seam; }
  uint64_t revision() const { return revision_; }  // grows with each change of the clip
  bool unsaved() const { return edits_revision_ != saved_; }
  void mark_saved() { saved_ = edits_revision_; }

  int64_t frames() const { return static_cast<int64_t>(clip_.motions.size()); }
  int64_t frame() const { return frame_; }
  void go_to(int64_t frame);  // the nearest there is
  MotionProperty selected() const { return selected_; }
  void select(MotionProperty property) { selected_ = property; }
  int radius() const { return radius_; }  // of path edits, frames to either side
  void set_radius(int frames) { radius_ = frames; }
  // What smooth and its like change; the whole clip unless told otherwise.
  FrameRange range() const { return range_; }
  void begin_range();  // at the current frame
  void end_range();
  void whole_range() { range_ = {0, frames() - 1}; }

  // The frames that an edit of this number at the current frame moves along.
  EditWindow window() const;

  struct Setting {
    MotionProperty property;
    float value = 0;
  };
  // One number, or both of the position, at the current frame.
  void hold(MotionProperty property);
  void drag_to(std::span<const Setting> settings);
  void release();
  bool holding() const { return holding_; }

  // Of the range and the selected number's group; throw UserError where it cannot be done.
  void smooth();
  void exaggerate(double factor);  // 0.8: calmer
  void repair();
  void trim();
  void loop();
  void retime(double speed);

  bool can_undo() const { return last_own() > 0; }
  bool can_redo() const { return !undone_.empty(); }
  void undo();
  void redo();
  // Frames where the list sets this number, in the clip's own numbering.
  std::vector<int64_t> keys(MotionProperty property) const;

 private:
  bool concerns_us(const Edit& edit) const { return fish_ < 0 || edit.concerns(fish_); }
  std::size_t last_own() const;  // one past the last edit that concerns this fish; 0: there is none
  void add(const std::vector<Edit>& step);
  void commit(const Edit& edit);
  void apply_list();
  void changed();
  void mend_frames();
  Edit edit_of(const Setting& setting) const;
  EditWindow window_of(const Setting& setting) const;
  Edit of_range(Edit::Kind kind, const char* what, double value) const;

  std::vector<Motion> recorded_;
  Motion rest_;
  double fps_;
  int fish_;
  std::vector<Edit> edits_;
  std::vector<std::vector<Edit>> undone_;
  Clip clip_;
  int64_t frame_ = 0;
  MotionProperty selected_{MotionProperty::Kind::tail, 0};
  int radius_;
  FrameRange range_;
  bool holding_ = false;
  std::vector<Motion> before_;  // the clip without what is held
  std::vector<Edit> held_;
  EditWindow touched_;  // where the clip differs from before_
  uint64_t revision_ = 0, edits_revision_ = 0, saved_ = 0;
};

}  // namespace nt
