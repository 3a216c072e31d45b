// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/throttling.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/temp_dir.h"

namespace nt {
namespace {

constexpr int64_t kSecond_ns = 1'000'000'000;

// A /sys of our own.
class Throttling : public ::testing::Test {
 protected:
  void write(const std::string& path, const std::string& text) {
    const std::filesystem::path file = dir_ / path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text << "\n";
  }
  void firmware(const std::string& word) { write("devices/platform/soc/soc:firmware/get_throttled", word); }
  std::string sys() { return dir_ / ""; }
  TempDir dir_;
};

TEST_F(Throttling, AMachineThatTellsNothingIsWell) {
  const ThrottleState state = read_throttling(sys() + "nowhere");
  EXPECT_FALSE(state.slowed());
  EXPECT_FALSE(state.knows_heat);
  EXPECT_EQ(throttling_line(state), "");
}

TEST_F(Throttling, ReadsTheHottestZone) {
  write("class/thermal/thermal_zone0/temp", "45123");
  write("class/thermal/thermal_zone1/temp", "61999");
  const ThrottleState state = read_throttling(sys());
  EXPECT_TRUE(state.knows_heat);
  EXPECT_NEAR(state.hottest_c, 61.999, 1e-9);
  EXPECT_FALSE(state.slowed());
}

TEST_F(Throttling, TheFirmwaresBitsSayWhy) {
  firmware("50000");  // both have been, long ago
  EXPECT_FALSE(read_throttling(sys()).slowed());
  firmware("50005");  // too low a voltage, and slowed down for it
  EXPECT_TRUE(read_throttling(sys()).power);
  EXPECT_NE(throttling_line(read_throttling(sys())).find("power supply is too weak"), std::string::npos);
  firmware("80008");
  EXPECT_TRUE(read_throttling(sys()).hot);
  EXPECT_FALSE(read_throttling(sys()).power);
}

TEST_F(Throttling, OnlyACoolerOfTheProcessorCounts) {
  write("class/thermal/cooling_device0/type", "pwm-fan");
  write("class/thermal/cooling_device0/cur_state", "3");
  write("class/thermal/cooling_device1/type", "cpufreq-cpu0");
  write("class/thermal/cooling_device1/cur_state", "0");
  EXPECT_FALSE(read_throttling(sys()).slowed());
  write("class/thermal/cooling_device1/cur_state", "2");
  EXPECT_TRUE(read_throttling(sys()).hot);
}

TEST_F(Throttling, TheWatchSaysWhenItBeginsAndWhenItEnds) {
  write("class/thermal/thermal_zone0/temp", "82400");
  firmware("0");
  ThrottleWatch watch(sys());
  EXPECT_EQ(watch.look(0), "");
  firmware("4");
  EXPECT_EQ(watch.look(kSecond_ns / 2), "") << "at most once a second";
  EXPECT_EQ(watch.look(kSecond_ns),
            "the processor is slowed down by heat (82 °C); cool it, or take a smaller --work-size or fewer fps");
  EXPECT_EQ(watch.look(2 * kSecond_ns), "") << "said once";
  EXPECT_TRUE(watch.state().slowed());
  firmware("0");
  EXPECT_EQ(watch.look(3 * kSecond_ns), "the processor runs at full speed again");
  EXPECT_EQ(watch.times(), 1);
}

}  // namespace
}  // namespace nt
