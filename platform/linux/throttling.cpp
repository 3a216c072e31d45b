// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/throttling.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace nt {
namespace {

constexpr int64_t kPeriod_ns = 1'000'000'000;
constexpr const char* kFirmware = "/devices/platform/soc/soc:firmware/get_throttled";
// Bits of the firmware's word that say what is so now; those above bit 15 say what has been.
constexpr unsigned long kUnderVoltage = 1, kCapped = 2, kThrottled = 4, kSoftLimit = 8;

std::string first_line(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line;
  std::getline(file, line);
  return line;
}

bool cools_processors(const std::string& type) {
  return type == "Processor" || type.find("cpufreq") != std::string::npos || type.starts_with("cpu");
}

void read_zone(const std::filesystem::path& zone, ThrottleState& state) {
  const std::string text = first_line(zone / "temp");
  if (text.empty()) return;
  const double celsius = std::atof(text.c_str()) / 1000;
  state.hottest_c = state.knows_heat ? std::max(state.hottest_c, celsius) : celsius;
  state.knows_heat = true;
}

}  // namespace

ThrottleState read_throttling(const std::string& sys) {
  ThrottleState state;
  const std::string word = first_line(sys + kFirmware);
  const unsigned long bits = word.empty() ? 0 : std::strtoul(word.c_str(), nullptr, 16);
  state.power = (bits & kUnderVoltage) != 0;
  state.hot = (bits & (kThrottled | kSoftLimit)) != 0 || ((bits & kCapped) != 0 && !state.power);
  std::error_code none;  // no such folder: nothing to read
  std::filesystem::directory_iterator entry(sys + "/class/thermal", none);
  for (; entry != std::filesystem::directory_iterator(); entry.increment(none)) {
    const std::filesystem::path& path = entry->path();
    const std::string name = path.filename().string();
    if (name.starts_with("thermal_zone")) read_zone(path, state);
    if (name.starts_with("cooling_device") && cools_processors(first_line(path / "type")))
      state.hot = state.hot || std::atoi(first_line(path / "cur_state").c_str()) > 0;
  }
  return state;
}

std::string throttling_line(const ThrottleState& state) {
  const std::string degrees =
      state.knows_heat ? " (" + std::to_string(std::lround(state.hottest_c)) + " °C)" : std::string();
  if (state.power)
    return "the processor is slowed down: its power supply is too weak" + degrees +
           "; use a stronger one and a short cable";
  if (state.hot)
    return "the processor is slowed down by heat" + degrees + "; cool it, or take a smaller --work-size or fewer fps";
  return "";
}

std::string ThrottleWatch::look(int64_t now_ns) {
  if (now_ns < due_ns_) return "";
  due_ns_ = now_ns + kPeriod_ns;
  const ThrottleState before = state_;
  state_ = read_throttling(sys_);
  if (state_.hot == before.hot && state_.power == before.power) return "";
  if (state_.slowed() && !before.slowed()) ++times_;
  return state_.slowed() ? throttling_line(state_) : "the processor runs at full speed again";
}

}  // namespace nt
