// SPDX-License-Identifier: Apache-2.0
// The man page and the completions, judged by man and by the shells themselves.
#include <gtest/gtest.h>

#include "tests/app/run_binary.h"

namespace nt {
namespace {

bool has(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

std::string output_of(const std::string& command) {
  const TempDir dir;
  EXPECT_EQ(std::system((command + " >" + (dir / "out") + " 2>&1").c_str()), 0) << read_text(dir / "out");
  return read_text(dir / "out");
}

// What bash offers for the last of these words.
std::string bash_offers(const std::string& words) {
  const TempDir dir;
  std::ofstream(dir / "script") << "source <(" NEONTETRA_BINARY
                                   " --completions bash)\n"
                                   "compopt() { echo \"compopt $*\"; }\n"
                                   "COMP_WORDS=(neontetra "
                                << words
                                << ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n"
                                   "_neontetra\necho \"${COMPREPLY[*]}\"\n";
  return output_of("bash " + (dir / "script"));
}

TEST(Manual, BashCompletesCommandsOptionsChoicesAndFiles) {
  EXPECT_EQ(bash_offers("ani"), "animate\n");
  EXPECT_EQ(bash_offers("live --lay"), "--layout\n");
  EXPECT_EQ(bash_offers("live --layout ''"), "beside behind alone\n");
  EXPECT_EQ(bash_offers("live --display k"), "kms\n");
  EXPECT_EQ(bash_offers("--completions f"), "fish\n");
  EXPECT_EQ(bash_offers("capture -c s"), "compopt -o default\nsim\n");
  EXPECT_EQ(bash_offers("capture --csv ''"), "compopt -o default\n\n");
  EXPECT_EQ(bash_offers("live --school ''"), "\n");  // a number: nothing to offer
}

TEST(Manual, ZshAndFishTakeTheirs) {
  const TempDir dir;
  if (!has("zsh") || !has("fish")) GTEST_SKIP() << "no zsh or no fish";
  for (const std::string shell : {"zsh", "fish"})
    ASSERT_EQ(neontetra("--completions " + shell + " >" + (dir / shell)).exit_code, 0);
  EXPECT_EQ(output_of("zsh -n " + (dir / "zsh")), "");
  const std::string fish = "HOME=" + (dir / "") + " fish -c 'source " + (dir / "fish") + "; complete -C \"neontetra ";
  EXPECT_NE(output_of(fish + "live --layout \"'").find("beside\t"), std::string::npos);
  EXPECT_EQ(output_of(fish + "ca\"'"), "capture\tFilm without a window: poses to CSV, overlay video, report\n");
}

TEST(Manual, TheManPageHasEveryCommandAndNoWarning) {
  if (!has("man")) GTEST_SKIP() << "no man";
  const TempDir dir;
  ASSERT_EQ(neontetra("--man-page >" + (dir / "neontetra.1")).exit_code, 0);
  const std::string page =
      output_of("LC_ALL=C.UTF-8 MANWIDTH=100 MANPAGER=cat man --warnings -l " + (dir / "neontetra.1"));
  for (const char* text :
       {"neontetra live [OPTIONS]", "--rotation 0|90|180|270", "EXIT STATUS", "--completions bash|zsh|fish"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  EXPECT_EQ(page.find("warning"), std::string::npos) << page.substr(0, 400);
}

}  // namespace
}  // namespace nt
