// SPDX-License-Identifier: Apache-2.0
// What the program says about cameras, whether this machine has some or not.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/app/run_binary.h"

namespace nt {
namespace {

TEST(CamerasCommand, ListsThemWithAndWithoutACommand) {
  for (const char* arguments : {"--list-cameras", "capture --list-cameras", "live --list-cameras"}) {
    const Outcome outcome = neontetra(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << arguments;
    EXPECT_EQ(outcome.err, "") << arguments;
    EXPECT_TRUE(outcome.out.starts_with("Available cameras\n") || outcome.out == "No cameras available!\n")
        << outcome.out;
  }
}

TEST(CamerasCommand, ACameraThatIsNotThereIsOneLineAndExitCode3) {
  const Outcome outcome = neontetra("capture --camera v4l2:/dev/video98");
  EXPECT_EQ(outcome.exit_code, 3);
  EXPECT_EQ(outcome.error_lines(), 1) << outcome.err;
  EXPECT_NE(outcome.err.find("/dev/video98: opening the camera failed"), std::string::npos) << outcome.err;
}

TEST(CamerasCommand, DoctorSaysWhatThereIsAndWhatToDoWithoutOne) {
  const Outcome outcome = neontetra("doctor --json");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  const nlohmann::json report = nlohmann::json::parse(outcome.out);
  EXPECT_TRUE(report.at("cameras").at("list").is_array());
  EXPECT_EQ(report.at("cameras").at("good").get<bool>(), !report.at("cameras").contains("advice"));
  EXPECT_EQ(report.at("jpeg_cameras").at("value"), "libjpeg-turbo");
  EXPECT_NE(report.at("machine").at("value").get<std::string>().find("processors"), std::string::npos);
}

// A frame's fingerprint is that of its pixels: the same clip has the same ones, another has others.
TEST(CamerasCommand, FrameHashesTellClipsApart) {
  const auto hashes = [](const std::string& camera) {
    return neontetra("capture --background vibe --camera " + camera + " --frame-hashes -").out;
  };
  const std::string once = hashes("sim:frames=5,size=320x180"), again = hashes("sim:frames=5,size=320x180");
  EXPECT_TRUE(once.starts_with("frame,sequence,timestamp_ns,luma_fnv1a64\n0,0,0,")) << once;
  EXPECT_EQ(once, again);
  EXPECT_NE(once, hashes("sim:frames=5,size=320x180,seed=2"));
}

}  // namespace
}  // namespace nt
