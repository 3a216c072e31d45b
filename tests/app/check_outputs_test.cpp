// SPDX-License-Identifier: Apache-2.0
#include "app/check_outputs.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "platform/camera.h"
#include "tests/support/temp_dir.h"

namespace {

using nt::check_outputs;

int code_of(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  try {
    check_outputs(inputs, outputs);
  } catch (const nt::UserError& error) {
    return error.exit_code;
  }
  return 0;
}

TEST(CheckOutputs, AnInputIsNeverOverwritten) {
  const nt::TempDir dir;
  const std::string video = dir / "fish.avi", link = dir / "link.avi";
  std::ofstream(video) << "video";
  std::filesystem::create_symlink(video, link);
  EXPECT_EQ(code_of({video}, {dir / "fish.csv", dir / "fish.mp4"}), 0);
  EXPECT_EQ(code_of({video}, {dir / "fish.csv", video}), 2);
  EXPECT_EQ(code_of({video}, {link}), 2) << "a link to the video is the video";
  EXPECT_EQ(code_of({video}, {dir / "./fish.avi"}), 2) << "another spelling too";
}

TEST(CheckOutputs, AFolderThatIsNotThereIsSaidBeforeTheWork) {
  const nt::TempDir dir;
  EXPECT_EQ(code_of({}, {dir / "new/a.csv"}), 1);
  EXPECT_EQ(code_of({}, {dir / "a.csv", "here.csv", "-", ""}), 0);
}

TEST(CheckOutputs, FoldersAndTakesAreNotWrittenOver) {
  const nt::TempDir dir;
  for (const char* name : {"old.take", "old.take.mkv", "old.csv"}) std::ofstream(dir / name) << "old";
  EXPECT_EQ(code_of({}, {dir.path()}), 2);
  EXPECT_EQ(code_of({}, {dir / "old.take"}), 1);
  EXPECT_EQ(code_of({}, {dir / "old.take.mkv"}), 1);
  EXPECT_EQ(code_of({}, {dir / "new.take", dir / "old.csv"}), 0);
}

TEST(CheckOutputs, TwoOutputsAreTwoFiles) {
  const nt::TempDir dir;
  EXPECT_EQ(code_of({}, {dir / "a.csv", dir / "./a.csv"}), 2);
  EXPECT_EQ(code_of({}, {"-", "-", "", ""}), 0) << "standard output may be shared, none is none";
  EXPECT_EQ(code_of({"/dev/null"}, {"/dev/null", "/dev/null"}), 0) << "a device is no file";
}

}  // namespace
