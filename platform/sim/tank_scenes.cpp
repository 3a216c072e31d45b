// SPDX-License-Identifier: Apache-2.0
#include "platform/sim/tank_scenes.h"

namespace nt {
namespace {

constexpr TankScene kScenes[] = {
    {.name = "calm", .about = "gentle swimming with slow turns, burst and coast, a forked tail"},
    {.name = "turns",
     .about = "C-starts and bends past 90 degrees",
     .burst_bl_s = 1.5f,
     .wander_rad_s = 0.9f,
     .bend_limit_rad = 1.3f,
     .c_start_every_s = 2.2f,
     .c_start_bend_rad = 2.3f,
     .c_start_turn_rad = 2.4f},
    {.name = "hover",
     .about = "the fish stops for a minute and sculls with its fins",
     .hover_every_s = 5.0f,
     .hover_s = 60.0f,
     .fin_open_share = 0.9f,
     .fin_beat_rad = 0.3f},
    {.name = "leave", .about = "out of the frame and back", .leave_every_s = 8.0f, .away_s = 2.0f},
    {.name = "shadow",
     .about = "a hard dark shadow beside the fish",
     .shadow_strength = 0.5f,
     .shadow_x_bl = 0.09f,
     .shadow_y_bl = 0.14f,
     .shadow_soft_bl = 0.008f},
    {.name = "night",
     .about = "low contrast and strong noise",
     .body_luma = 92.0f,
     .gravel_luma = 50.0f,
     .gravel_sd = 5.0f,
     .shadow_strength = 0.12f,
     .noise_sd = 6.0f},
    {.name = "far", .about = "a fish of 60 px", .body_length = 0.0625f},
    {.name = "near",
     .about = "a fish half the frame wide, drifting against a slow current",
     .body_length = 0.5f,
     .holds_station = true,
     .current_bl_s = 0.35f,
     .drift_x_bl = 0.2f,
     .drift_y_bl = 0.08f,
     .drift_rad = 0.22f},
    {.name = "forked", .about = "a forked tail, livelier than calm", .burst_bl_s = 1.4f, .wander_rad_s = 0.8f},
    {.name = "round",
     .about = "a rounded tail, livelier than calm",
     .caudal = CaudalFin::rounded,
     .burst_bl_s = 1.4f,
     .wander_rad_s = 0.8f},
    {.name = "ghost", .about = "the fish is there in frame 0 and swims off", .enters = false},
    {.name = "station",
     .about = "the fish holds its place from frame 0 and never shows what lies under it",
     .holds_station = true,
     .current_bl_s = 0.6f,
     .drift_x_bl = 0.008f,
     .drift_y_bl = 0.004f,
     .drift_rad = 0.02f,
     .enters = false},
    {.name = "lamp",
     .about = "a lamp switched on after six seconds, slow drift, flicker of 50 Hz mains",
     .lamp_on_s = 6.0f,
     .light_before_lamp = 0.62f,
     .light_drift = 0.05f,
     .flicker = 0.012f},
    {.name = "surface",
     .about = "caustics, ripples, reflections at the wall; the fish comes and goes",
     .leave_every_s = 8.0f,
     .away_s = 3.0f,
     .wait_s = 3.0f,
     .caustics = 0.5f,
     .ripples = 0.05f,
     .wall_mirror = 0.35f,
     .wall_depth = 0.075f},
    {.name = "dirt",
     .about = "bubbles rising and particles drifting; the fish comes and goes",
     .leave_every_s = 8.0f,
     .away_s = 3.0f,
     .wait_s = 3.0f,
     .bubbles = 12,
     .particles = 50},
    {.name = "shake",
     .about = "filmed by a phone held in the hand: shift, rotation, scale",
     .shake_shift = 0.02f,
     .shake_rad = 0.03f,
     .shake_scale = 0.03f},
    {.name = "ring",
     .about = "the fish closes into a ring until its head meets its tail, and opens again",
     .caudal = CaudalFin::rounded,
     .cruise_bl_s = 0.3f,
     .c_start_every_s = 2.5f,
     .c_start_s = 1.8f,
     .c_start_bend_rad = 4.9f,
     .c_start_turn_rad = 1.6f},
    {.name = "crossing",
     .about = "three fish; one of them swims over the target",
     .body_length = 0.15f,
     .companions = 2,
     .cross_every_s = 3.0f},
    {.name = "long", .about = "as calm; for runs of 100,000 frames"},
};

}  // namespace

std::span<const TankScene> tank_scenes() { return kScenes; }

const TankScene* find_tank_scene(const std::string& name) {
  for (const TankScene& scene : kScenes)
    if (name == scene.name) return &scene;
  return nullptr;
}

std::vector<std::string> tank_scene_names() {
  std::vector<std::string> names;
  for (const TankScene& scene : kScenes) names.emplace_back(scene.name);
  return names;
}

}  // namespace nt
