// SPDX-License-Identifier: Apache-2.0
// Pull at a 3D character and see it follow: its lattice, moved by what a hand grabs.
//
// Input: clicks, moves, releases in scene pixels. A press takes hold of the joint or the vertex nearest to it, in the plane of the
// picture; moving pulls; letting go leaves it pinned there. Pressing a pin takes hold of it again. With one pin the whole body
// follows, with more it bends. u: the last pin goes; x: all of them. Output: a scene with the body seen from above, its joints and pins.
// Memory is taken once; a frame takes none but the scene's.
#pragma once
#include <optional>
#include <span>
#include <vector>

#include "app/aligned_block.h"
#include "core/character/character.h"
#include "core/deform/embed.h"
#include "core/deform/lattice.h"
#include "core/scene/scene.h"
#include "platform/display.h"

namespace nt {

class Drag {
 public:
  static constexpr std::size_t kMostPins = 16;
  // The character has a lattice and outlives this. The scene is `width` x `height` pixels.
  Drag(const Character& character, int width, int height);

  void handle(const InputEvent& event);
  // One step of the solver, and the picture of it.
  LatticeReport step();
  void draw(Scene& scene);

  Vec2 to_scene(Vec3 p) const { return {origin_.x + zoom_ * p.x, origin_.y - zoom_ * p.y}; }
  Vec3 vertex(std::size_t v) const;
  std::size_t pins() const;
  const Lattice& lattice() const { return *lattice_; }

 private:
  struct Grip {
    MarkerBinding binding;
    Vec3 at;
  };
  std::optional<std::size_t> pin_at(Vec2 p) const;
  std::optional<Grip> grip_at(Vec2 p) const;
  void press(Vec2 p);
  void turn_normals();

  const Character& character_;
  LatticeView view_;
  int width_, height_;
  Vec2 origin_;
  float zoom_ = 1;
  std::vector<MarkerBinding> bindings_;
  std::vector<Vec3> targets_;
  std::vector<uint8_t> seen_;
  std::vector<std::size_t> order_;  // pins, oldest first
  std::optional<std::size_t> held_;
  Vec3 held_offset_;
  AlignedBlock memory_;
  Lattice* lattice_ = nullptr;
  PhongEmbedding* embedding_ = nullptr;
  std::vector<float> places_, heights_;
  std::vector<Vec2> flat_, joints_, dots_;
  std::vector<Vec3> normals_;
};

}  // namespace nt
