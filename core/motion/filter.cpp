// SPDX-License-Identifier: Apache-2.0
#include "core/motion/filter.h"

namespace nt {
namespace {

void step(const KalmanGain& gain, float measured, float dt_s, float& position, float& velocity) {
  const float predicted = position + velocity * dt_s;
  const float error = measured - predicted;
  position = predicted + gain.position_gain() * error;
  velocity = velocity + gain.velocity_gain() * error;
}

}  // namespace

KalmanParameters scaled(const KalmanParameters& per_body_length, float length) {
  KalmanParameters out = per_body_length;
  out.acceleration_density *= length * length;
  out.noise_sd *= length;
  return out;
}

void KalmanGain::start(const KalmanParameters& parameters) {
  // Known to a measurement's noise; velocity unknown within the rms that the model gives over one max_gap.
  p00_ = parameters.noise_sd * parameters.noise_sd;
  p01_ = 0;
  p11_ = parameters.acceleration_density * parameters.max_gap_s;
  started_ = true;
}

bool KalmanGain::advance(const KalmanParameters& parameters, float dt_s) {
  if (!started_ || !(dt_s > 0.0f) || dt_s > parameters.max_gap_s) {
    start(parameters);
    return false;
  }
  const float q = parameters.acceleration_density, r = parameters.noise_sd * parameters.noise_sd;
  const float dt2 = dt_s * dt_s;
  const float m00 = p00_ + 2.0f * dt_s * p01_ + dt2 * p11_ + q * dt2 * dt_s * (1.0f / 3.0f);
  const float m01 = p01_ + dt_s * p11_ + q * dt2 * 0.5f;
  const float m11 = p11_ + q * dt_s;
  const float s = m00 + r;
  k0_ = s > 0.0f ? m00 / s : 1.0f;
  k1_ = s > 0.0f ? m01 / s : 0.0f;
  p00_ = (1.0f - k0_) * m00;
  p01_ = (1.0f - k0_) * m01;
  p11_ = m11 - k1_ * m01;
  return true;
}

float KalmanFilter::update(float measured, float dt_s) {
  if (gain_.advance(parameters_, dt_s)) {
    step(gain_, measured, dt_s, position_, velocity_);
  } else {
    position_ = measured, velocity_ = 0;
  }
  return position_;
}

void KalmanBank::create(Arena& arena, std::size_t coordinates, const KalmanParameters& parameters) {
  parameters_ = parameters;
  position_ = arena.take<float>(coordinates);
  velocity_ = arena.take<float>(coordinates);
}

void KalmanBank::update(std::span<float> values, float dt_s) {
  const bool running = gain_.advance(parameters_, dt_s);
  for (std::size_t i = 0; i < position_.size(); ++i) {
    if (running) {
      step(gain_, values[i], dt_s, position_[i], velocity_[i]);
    } else {
      position_[i] = values[i], velocity_[i] = 0;
    }
    values[i] = position_[i];
  }
}

}  // namespace nt
