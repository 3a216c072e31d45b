// SPDX-License-Identifier: Apache-2.0
// Motion M + character -> the character's vertices, [F] sections 5.1-5.3 (Algorithms 1, 3, 4, Eq 15).
//
// Input: Motion (angles in the fish-local frame, centre in frame pixels). Output: one Vec2 per vertex in scene
// coordinates: x right, y down, the character's centre at `scale * M.centre` (Eq 15: scale = L.body_len / init_len), its
// head turned to M.dir. The caller may place and zoom the result with `placement`.
// Steps: body control points from bone lengths and angles (Alg 3) -> moving least squares moves the four junctions ->
// fin tips (Alg 4) -> Kalman filter per control-point coordinate -> moving least squares moves all vertices.
// Differs from [F]:
// - Only the junctions of the implicit model are deformed; its other vertices are never shown.
// - Algorithm 4 gives the drawing's fin the fish's own angle. Here the range a fish's fins sweep (kFishFins) is laid over
//   the range this drawing's triangles bear (FinRange, found once), the fish's folded fin on the drawing's folded limit,
//   amplitudes kept where the drawing bears them and shrunk evenly where not. For a drawing is rooted, and at rest opened,
//   otherwise than the fish: the fish's own angle would run into the limit, where [F] section 6.3 calls distortion
//   inevitable and a clamp would hold the fin still.
// - The drawn fin turns about its lower junction, where it meets the body when it folds, not about the upper one: turned
//   about that, it would crush what lies between it and the body.
// - Each fin has kFinSpots more control points, spread over it, that turn with it, so that it turns as a whole, and its
//   junctions keep their distance while the body bends: so it keeps its area.
// - A second pair of fins follows the first: the fish has one.
// - The filter also runs over the centre and the direction, which [F] leaves to its points in the world.
// With Deformer::lattice the same control points move the lattice of a 3D character in place of the last step.
// Memory: fixed, from the arena; cost: vertices x control points x 8 flops (0.03 ms for 2,500 x 37).
#pragma once
#include <span>

#include "core/base/arena.h"
#include "core/character/character.h"
#include "core/character/distortion.h"
#include "core/character/lattice_pose.h"
#include "core/character/solid_pose.h"
#include "core/deform/mls.h"
#include "core/motion/filter.h"
#include "core/motion/motion.h"

namespace nt {

// [F] Eq 13: the simplified curve skeleton L, lengths in character units.
struct BoneLengths {
  float body_len = 0, head_len = 0, tail_len = 0;
  float fin_len[kMaxFins] = {};
  float up_len[kMaxUpAxis] = {};
  float low_len[kMaxLowAxis] = {};
};
BoneLengths bone_lengths(const Character& character);  // Algorithm 1

// What moves the vertices between the control points. The lattice is for 3D characters whose file has one for landmarks.
enum class Deformer : uint8_t { mls, lattice };

struct RetargetSettings {
  Deformer deformer = Deformer::mls;
  MlsKind mls = MlsKind::rigid;
  // Weights 1 / |p - v|^(2 alpha). Of 1, 1.5 and 2 on the bundled carp over nine poses, 1.5 keeps the least triangle
  // largest (0.29 of its rest area in a bend of +-0.9 rad with folded fins; 1 turns ten over) and draws no kinks.
  float mls_alpha = 1.5f;
  bool smooth = true;  // Kalman filter over the control points
  // false, with a lattice: a renderer places them (LatticePose::pack); vertices(), solid() and distortion() mean nothing then.
  bool vertices = true;
};

// Where the character goes: scene = offset + zoom * (Eq 15's position).
struct Placement {
  Vec2 offset;
  float zoom = 1.0f;
};

// How far a fin opens: 0 = straight back along the body, pi/2 = straight out, pi = straight ahead; radians, left and right
// alike, measured from the body where the fin is rooted.
struct FinRange {
  float folded = 0, open = 0;
  float width() const { return open - folded; }
};
// What a fish's fins sweep: from folded (where Motion puts a fin that is not seen) to straight out. Beyond they stay there.
inline constexpr FinRange kFishFins{kFoldedRightFin + 1.5707963f, 1.5f};

class Retarget {
 public:
  // Everything that depends only on the rest pose is computed here, once (about 20 ms for 2,500 vertices, most of it the
  // search for the fins' ranges). The arena may be measuring: then the pointer is null.
  static Result<Retarget*> create(Arena& arena, const Character& character, const RetargetSettings& settings);

  // Another one for the same character, with a pose and filters of its own; it shares what `of` has precomputed, so `of`
  // must outlive it. Null when the arena is measuring. Memory: 8 bytes per vertex.
  static Result<Retarget*> twin(Arena& arena, const Retarget& of);

  // Forgets the filters' state; init_len (pixels) is the fish's axis length in the first tracked frame (Eq 15).
  void start(float init_len_px);
  // Poses the character; the spans below stay valid until the next call. dt_s is the time since the last call; 0 or a
  // gap that the filter cannot bridge takes the motion as it is.
  void pose(const Motion& motion, float dt_s, const Placement& placement);

  std::span<const Vec2> vertices() const { return vertices_; }  // scene coordinates
  const SolidPose& solid() const { return solid_; }             // of a 3D character; empty for a flat one
  const LatticePose* lattice() const { return lattice_; }       // null with another deformer
  LatticePose* lattice() { return lattice_; }
  bool renderer_places() const { return lattice_ != nullptr && !settings_.vertices; }
  Vec2 origin() const { return origin_; }  // of the local frame, and its y of one character unit; scene coordinates
  Vec2 up() const { return up_; }
  const ControlPoints& control_points() const { return scene_points_; }  // scene coordinates
  const BoneLengths& lengths() const { return lengths_; }
  // All control points that move the vertices, at rest and as posed (and filtered) last; character units, local frame.
  std::span<const Vec2> rest_handles() const { return {rest_, control_count_}; }
  std::span<const Vec2> handles() const { return {points_, control_count_}; }
  // M0: the motion that poses the character as it was drawn (swimming up the screen, centre at 0), [F] section 6.2.
  Motion rest_motion() const;
  // Where the drawing's fins go while the fish's go through kFishFins; never wider than that.
  FinRange fin_range(FinIndex fin) const { return fin_range_[fin]; }
  // Of the vertices as posed last; computed when it is asked for.
  Distortion distortion() const { return meter_->measure(vertices_, zoom_, true); }

 private:
  // The control points that are used, one after the other: the body, then per fin the two junctions, the tip, the spots.
  static constexpr std::size_t kFinSpots = 6;
  static constexpr std::size_t kMaxControls = 3 + kMaxUpAxis + kMaxLowAxis + kMaxFins * (3 + kFinSpots);
  struct Fin {
    bool present = false;
    std::size_t first = 0;  // of its control points: junction at the top, at the bottom, tip, spots
    float side = 1;         // +1 on the x > 0 side of the drawing at rest, else -1
    float rest_open = 0;    // FinRange's measure, at rest
  };
  struct Frame {  // where local coordinates go
    Vec2 centre;  // character units
    float dir_rad = 0;
  };
  std::size_t body_count() const { return 3u + static_cast<std::size_t>(character_.u_num + character_.l_num); }
  void collect_rest();
  void add_fin(int index);
  void find_fin_range(int index);
  void spread_spots(const Fin& fin, const FinPoints& points);
  bool fin_fits(int index, float open);
  void turn_fin(const Fin& fin, float open, float body_turn);
  void pose_body(const Motion& motion);
  void keep_root(const Fin& fin);
  void pose_fin(int index, float motion_open);
  void smooth(Frame& frame, float dt_s);
  void deform();
  void place_vertices();
  void place(const Frame& frame, const Placement& placement);

  Character character_;
  BoneLengths lengths_;
  RetargetSettings settings_;
  Mls* junctions_ = nullptr;  // the implicit model: body control points move the junctions
  Mls* mesh_ = nullptr;       // the explicit model: all control points move the vertices
  SolidPose solid_;
  LatticePose* lattice_ = nullptr;  // null: mesh_ and solid_ alone
  DistortionMeter* meter_ = nullptr;
  float zoom_ = 1;  // of the last pose
  Vec2 origin_, up_{0, -1};
  KalmanBank filter_;
  float last_dir_rad_ = 0;
  bool started_ = false;
  float scale_ = 1;  // character units per frame pixel
  Fin fins_[kMaxFins];
  FinRange fin_range_[kMaxFins];
  std::size_t control_count_ = 0;
  Vec2 rest_[kMaxControls], points_[kMaxControls];  // character units, local frame
  std::span<Vec2> vertices_;
  ControlPoints scene_points_;
};

}  // namespace nt
