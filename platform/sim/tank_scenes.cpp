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
