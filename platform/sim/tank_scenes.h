// SPDX-License-Identifier: Apache-2.0
// The scenes of the simulated aquarium: what differs from one to another is data, one row each in tank_scenes.cpp.
//
// Units: BL = body lengths (snout to the tail point), s = seconds, rad = radians, luma = 0..255.
// Every field has the value of the scene `calm`; a row names only what it changes.
#pragma once
#include <span>

#include "platform/sim/tank.h"

namespace nt {

struct TankScene {
  const char* name = "";
  const char* about = "";  // one line for --help

  // The fish.
  float body_length = 0.229f;  // of the frame's width: 220 px at 960
  CaudalFin caudal = CaudalFin::forked;

  // Swimming: bursts of tail beats between coasts, while the heading wanders.
  float cruise_bl_s = 0.45f;    // speed that a coast decays to
  float burst_bl_s = 1.15f;     // speed that a burst reaches for
  float burst_s = 0.7f;         // mean duration of a burst
  float coast_s = 1.4f;         // mean duration of a coast
  float wander_rad_s = 0.55f;   // largest turning rate of the wandering
  float wander_s = 1.5f;        // mean time between changes of that rate
  float bend_limit_rad = 0.9f;  // largest bend (head direction against tail direction) of an ordinary turn

  // C-starts: a fast bend into a C, then a burst in a new direction.
  float c_start_every_s = 0.0f;   // mean time between them; 0 = none
  float c_start_s = 0.5f;         // duration of one
  float c_start_bend_rad = 0.0f;  // bend at its peak
  float c_start_turn_rad = 0.0f;  // largest change of heading by one

  // Resting: the fish stops and sculls with its pectoral fins.
  float hover_every_s = 0.0f;  // mean swimming time between rests; 0 = none
  float hover_s = 0.0f;        // duration of a rest

  // Leaving: the fish swims out of the frame, stays away, comes back.
  float leave_every_s = 0.0f;  // time in the frame between two leaves; 0 = never
  float away_s = 0.0f;         // time outside

  // Holding station: the fish beats against a current and only drifts about the middle of the frame.
  bool holds_station = false;
  float current_bl_s = 0.0f;  // speed of the water that it swims against
  float drift_x_bl = 0.0f;    // largest drift along and across the frame
  float drift_y_bl = 0.0f;
  float drift_rad = 0.0f;  // largest turn away from the frame's x direction

  // The start: outside the frame (so that a background model sees gravel first) or in its middle.
  bool enters = true;
  float wait_s = 0.3f;  // before it swims in

  // Pectoral fins.
  float fin_open_share = 0.65f;  // chance that a fin of a slow fish is open
  float fin_beat_rad = 0.16f;    // amplitude of the beat of an open fin
  float fin_beat_hz = 1.6f;      // its mean frequency; left and right differ

  // The picture.
  float body_luma = 175.0f;
  float gravel_luma = 95.0f;  // mean
  float gravel_sd = 12.0f;
  float shadow_strength = 0.25f;  // gravel in full shadow is multiplied by 1 - this
  float shadow_x_bl = 0.07f;      // offset of the shadow from the fish
  float shadow_y_bl = 0.11f;
  float shadow_soft_bl = 0.035f;  // standard deviation of its edge
  float noise_sd = 2.5f;          // sensor noise, luma
  float vignette = 0.07f;         // loss of light in the frame's corners

  // Light. Lumas above are those under the lamp.
  float lamp_on_s = 0.0f;          // when the lamp is switched on; 0 = it is on
  float light_before_lamp = 1.0f;  // share of the light that there is before
  float light_drift = 0.0f;        // amplitude of a slow drift, share of the light
  float flicker = 0.0f;            // amplitude of the flicker of 50 Hz mains, share of the light

  // The water's surface and walls.
  float caustics = 0.0f;     // light of the brightest line of the network, share of the light
  float ripples = 0.0f;      // amplitude, share of the light
  float wall_mirror = 0.0f;  // share of mirrored light in the strips of wall along the upper and lower edge
  float wall_depth = 0.0f;   // of those strips, share of the frame's width

  // What floats between fish and camera.
  int bubbles = 0;
  int particles = 0;

  // A phone in the hand: largest shift (share of the frame's width), rotation, change of scale.
  float shake_shift = 0.0f;
  float shake_rad = 0.0f;
  float shake_scale = 0.0f;

  // Other fish.
  int companions = 0;
  float cross_every_s = 0.0f;  // time between two passes of the first companion over the target; 0 = it keeps away
};

std::span<const TankScene> tank_scenes();

}  // namespace nt
