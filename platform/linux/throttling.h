// SPDX-License-Identifier: Apache-2.0
// Whether the machine slows its processors down, from heat or a weak power supply, and how hot it is.
//
// Read from /sys: the Raspberry Pi firmware's get_throttled, the kernel's cooling devices that act on processors, and its
// thermal zones. A machine that tells none of these is taken to be well. Cost: a few files, 0.1 ms, at most once a second.
#pragma once
#include <cstdint>
#include <string>

namespace nt {

struct ThrottleState {
  bool hot = false;    // slowed down by heat
  bool power = false;  // slowed down, or about to be, for too low a voltage
  double hottest_c = 0;
  bool knows_heat = false;  // hottest_c was read
  bool slowed() const { return hot || power; }
};

ThrottleState read_throttling(const std::string& sys = "/sys");

// "slowed down by heat (82 C): cool it, ..."; empty when all is well.
std::string throttling_line(const ThrottleState& state);

class ThrottleWatch {
 public:
  explicit ThrottleWatch(std::string sys = "/sys") : sys_(std::move(sys)) {}
  // Looks again when a second has passed. The line to say when it began or ended, else empty.
  std::string look(int64_t now_ns);
  const ThrottleState& state() const { return state_; }
  int64_t times() const { return times_; }  // how often it began

 private:
  std::string sys_;
  int64_t due_ns_ = 0;
  int64_t times_ = 0;
  ThrottleState state_;
};

}  // namespace nt
