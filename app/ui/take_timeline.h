// SPDX-License-Identifier: Apache-2.0
// The curves of a clip over time, and the strip that shows the whole of it, in colours that say how sure the capture was.
//
// ClipEditor + areas -> scene items; places on the screen <-> frames and values. The selected number's curve is thick, with
// its recorded course beside it, its keys, and the window [p, q] that an edit at the current frame moves along, as a hill
// of its influence ([F] Eq 21); the others are thin. Angles share a scale of degrees from the rest pose; each number of the path has its own.
// Colours: teal is sure, amber is not, dark grey is a frame without a pose; in the strip each column is the mean of its frames.
// What the scene points to lives here until the next draw(). Cost: one pass over the visible frames for each curve.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "app/character_edit/figure_view.h"
#include "app/take_edit/clip_editor.h"
#include "app/take_edit/curves.h"
#include "app/ui/pane.h"
#include "core/scene/scene.h"

namespace nt {

Colour confidence_colour(float confidence);  // of a frame with a pose
Colour curve_colour(std::size_t index);      // of named_curves()

class TakeTimeline {
 public:
  explicit TakeTimeline(std::vector<NamedCurve> curves) : curves_(std::move(curves)) {}

  // Keeps the current frame in sight and the scales as they are while something is held.
  void lay_out(const Area& plot, const Area& strip, const ClipEditor& editor);
  void draw(Scene& scene, const ClipEditor& editor, float line_px);

  void zoom(bool in, const ClipEditor& editor);
  int64_t shown_frames() const { return shown_; }
  int64_t first_frame() const { return first_; }
  int64_t plot_frame(float x) const;
  int64_t strip_frame(float x, const ClipEditor& editor) const;
  Vec2 on_plot(const ClipEditor& editor, MotionProperty property, int64_t frame) const;  // a point of a curve
  float value_at(float y, const ClipEditor& editor) const;                               // of the selected number

 private:
  struct Scale {
    float least = -1, most = 1;  // as people read them
  };
  Scale scale_of(const ClipEditor& editor, MotionProperty property) const;
  float x_of(double frame) const;
  float y_of(float shown, Scale scale) const;
  void add_curve(Scene& scene, const ClipEditor& editor, MotionProperty property, Colour colour, float width_px,
                 bool recorded = false);
  void add_window(Scene& scene, const ClipEditor& editor);
  void add_keys(Scene& scene, const ClipEditor& editor, float line_px);
  void add_strip(Scene& scene, const ClipEditor& editor, float line_px);
  void add_confidences(Scene& scene, const ClipEditor& editor, const Area& area, FrameRange range, PictureId slot);
  void line(Scene& scene, Vec2 from, Vec2 to, Colour colour, float width_px);
  std::span<const Vec2> keep(std::vector<Vec2> points);

  std::vector<NamedCurve> curves_;
  Area plot_, strip_;
  int64_t first_ = 0, shown_ = 240;
  float reach_deg_ = 30;  // of the angles' scale, to either side
  uint64_t scaled_revision_ = ~uint64_t{0};
  // What the scene points to.
  std::vector<std::vector<Vec2>> points_;
  std::vector<uint32_t> hill_;
  struct Strip {
    std::vector<uint8_t> rgb;
    uint64_t revision = 0;
  };
  std::array<Strip, 2> strips_;
};

}  // namespace nt
