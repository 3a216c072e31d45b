// SPDX-License-Identifier: Apache-2.0
// Constant-velocity Kalman filter: noisy positions of points, one after the other in time -> smooth positions.
//
// State per coordinate: position and velocity. Model: position'' is white noise of spectral density
// `acceleration_density` [unit^2/s^3]; each measurement carries white noise of standard deviation `noise_sd` [unit].
// The unit is whatever the coordinates are in. A gain that does not depend on the frame rate follows from dt being an
// argument: a filter stepped at 180 Hz and one at 30 Hz settle at the same bandwidth within a factor of 1.6.
// Cost: per coordinate 4 multiplications and 5 additions; the covariance is shared, because it depends on the times
// and the parameters only and every coordinate is measured at the same times.
// Source: [F] section 5.3 names the filter without its model; this is the textbook one (Bar-Shalom 2001, 6.2.2).
#pragma once
#include <span>

#include "core/base/arena.h"

namespace nt {

struct KalmanParameters {
  // Both for coordinates in body lengths L. A tail beat of 5 Hz and 0.1 L accelerates by up to 100 L/s^2, rms 70, and
  // keeps its sign for about 0.05 s: a density of order 70^2 x 0.05 = 250 at the tail tip and a tenth of it at mid-body.
  float acceleration_density = 60.0f;
  // Landmarks of a 400 px fish are good to 1-4 px.
  float noise_sd = 0.005f;
  // A longer silence than this (or a step back in time) says nothing about velocity: the filter starts again.
  float max_gap_s = 0.25f;
};
// The same parameters for coordinates in other units, `length` of which make one body length.
KalmanParameters scaled(const KalmanParameters& per_body_length, float length);

// The covariance of (position, velocity) and its gain, shared by all coordinates that are measured together.
class KalmanGain {
 public:
  void reset() { started_ = false; }
  // Prepares the gain for a measurement dt_s after the last one. False: start over at the measurement.
  bool advance(const KalmanParameters& parameters, float dt_s);
  float position_gain() const { return k0_; }
  float velocity_gain() const { return k1_; }  // 1/s

 private:
  void start(const KalmanParameters& parameters);
  bool started_ = false;
  float p00_ = 0, p01_ = 0, p11_ = 0;  // covariance after the last measurement
  float k0_ = 0, k1_ = 0;
};

// One coordinate.
class KalmanFilter {
 public:
  explicit KalmanFilter(const KalmanParameters& parameters) : parameters_(parameters) {}
  void reset() { gain_.reset(); }
  float update(float measured, float dt_s);
  float position() const { return position_; }
  float velocity() const { return velocity_; }

 private:
  KalmanParameters parameters_;
  KalmanGain gain_;
  float position_ = 0, velocity_ = 0;
};

// Many coordinates measured at the same times, as a structure of arrays.
class KalmanBank {
 public:
  void create(Arena& arena, std::size_t coordinates, const KalmanParameters& parameters);
  void reset() { gain_.reset(); }
  // Replaces each value by its filtered one; values.size() is the bank's number of coordinates.
  void update(std::span<float> values, float dt_s);

 private:
  KalmanParameters parameters_;
  KalmanGain gain_;
  std::span<float> position_, velocity_;
};

}  // namespace nt
