// SPDX-License-Identifier: Apache-2.0
#include "platform/linux/mapped_file.h"

#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <fstream>

#include "tests/support/temp_dir.h"

namespace nt {
namespace {

std::string text_of(const MappedFile& file) {
  return {reinterpret_cast<const char*>(file.bytes().data()), file.bytes().size()};
}

void write(const std::string& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

TEST(MappedFile, HoldsTheFilesBytesOnAPage) {
  const TempDir dir;
  write(dir / "a", std::string(10'000, 'x') + "end");
  const std::optional<MappedFile> file = MappedFile::open(dir / "a");
  ASSERT_TRUE(file);
  EXPECT_EQ(text_of(*file), std::string(10'000, 'x') + "end");
  EXPECT_EQ(reinterpret_cast<uintptr_t>(file->bytes().data()) % 4096, 0u);
}

TEST(MappedFile, KeepsItsBytesWhenAnotherFileTakesItsName) {
  const TempDir dir;
  write(dir / "a", "old");
  write(dir / "b", "new and longer");
  MappedFile file = *MappedFile::open(dir / "a");
  std::filesystem::rename(dir / "b", dir / "a");
  EXPECT_EQ(text_of(file), "old");
  file = *MappedFile::open(dir / "a");
  EXPECT_EQ(text_of(file), "new and longer");
}

TEST(MappedFile, AnEmptyFileHasNoBytesAndWhatIsNoFileIsNone) {
  const TempDir dir;
  write(dir / "empty", "");
  ASSERT_TRUE(MappedFile::open(dir / "empty"));
  EXPECT_TRUE(MappedFile::open(dir / "empty")->bytes().empty());
  EXPECT_FALSE(MappedFile::open(dir / "missing"));
  EXPECT_FALSE(MappedFile::open(dir / "."));
  EXPECT_FALSE(MappedFile::open("/dev/null"));
}

}  // namespace
}  // namespace nt
