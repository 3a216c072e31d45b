// SPDX-License-Identifier: Apache-2.0
// `neontetra character` with corrections, as a user types it.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "tests/app/run_binary.h"

namespace nt {
namespace {

const std::string kCarp = NEONTETRA_ASSETS "/characters/carp.png";

class CharacterCommand : public ::testing::Test {
 protected:
  Outcome character(const std::string& arguments) const {
    const Outcome run = neontetra("character " + arguments);
    EXPECT_EQ(run.exit_code, 0) << run.err;
    return run;
  }
  void refused(const std::string& arguments, const std::string& part, int code = 2) const {
    const Outcome run = neontetra("character " + arguments);
    EXPECT_EQ(run.exit_code, code) << arguments;
    EXPECT_EQ(run.error_lines(), 1) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  }
  nlohmann::json points(const std::string& file) const {
    return nlohmann::json::parse(character(file + " --list --json").out);
  }
  TempDir dir_;
  const std::string file_ = dir_ / "koi.ntchar", notes_ = dir_ / "koi.corrections.txt";
};

TEST_F(CharacterCommand, CorrectionsOutliveTheCharacter) {
  character(kCarp + " --out " + file_);
  EXPECT_FALSE(std::filesystem::exists(notes_));
  const auto found = points(file_);
  EXPECT_EQ(found["points"].size(), 27u);
  character(file_ + " --set l_fin=590,20 --set tail=110,250 --fins 2 --l-num 9 --deformer affine");
  const auto corrected = points(file_);
  EXPECT_EQ(corrected["points"]["l_fin"]["x"], 590.0);
  EXPECT_EQ(corrected["points"]["l_fin"]["confidence"], 1.0);
  EXPECT_EQ(corrected["l_num"], 9);
  EXPECT_EQ(corrected["deformer"], "affine");
  EXPECT_TRUE(corrected["points"].contains("r_fin_2"));
  EXPECT_NE(read_text(notes_).find("l_fin = 590,20\n"), std::string::npos);

  std::filesystem::remove(file_);
  const Outcome again = character(kCarp + " --out " + file_);
  EXPECT_NE(again.err.find("taken up again"), std::string::npos);
  const auto anew = points(file_);
  for (const char* name : {"l_fin", "tail", "jun_tl", "r_fin_2", "low_axis_5"}) {
    EXPECT_NEAR(double{anew["points"][name]["x"]}, double{corrected["points"][name]["x"]}, 0.2) << name;
    EXPECT_NEAR(double{anew["points"][name]["y"]}, double{corrected["points"][name]["y"]}, 0.2) << name;
  }
  character(kCarp + " --out " + file_ + " --corrections none --set head_end=right");
  EXPECT_EQ(points(file_)["points"].size(), 27u);
}

TEST_F(CharacterCommand, AFileOfCorrectionsByHandKeepsItsComments) {
  std::ofstream(notes_) << "# my notes\nfins = 0   # it has none\n";
  character(kCarp + " --out " + file_);
  EXPECT_EQ(read_text(notes_), "# my notes\nfins = 0   # it has none\n");
  EXPECT_FALSE(points(file_)["points"].contains("l_fin"));
  character(kCarp + " --out " + file_ + " --corrections none");
  EXPECT_TRUE(points(file_)["points"].contains("l_fin"));
  EXPECT_FALSE(std::filesystem::exists(notes_));
  EXPECT_EQ(read_text(notes_ + ".before"), "# my notes\nfins = 0   # it has none\n") << "nothing is lost";
  const std::string other = dir_ / "other.txt";
  std::ofstream(other) << "flip = yes\n";
  character(kCarp + " --out " + (dir_ / "b.ntchar") + " --corrections " + other);
  EXPECT_EQ(points(dir_ / "b.ntchar")["flip"], true);
  EXPECT_TRUE(std::filesystem::exists(dir_ / "b.corrections.txt"));
}

TEST_F(CharacterCommand, FinsThatAreCountedReplaceThoseThatWerePlaced) {
  std::ofstream(notes_) << "l_fin = 512,80\nmirror = yes\n";
  character(kCarp + " --out " + file_ + " --fins 0");
  EXPECT_FALSE(points(file_)["points"].contains("l_fin"));
  EXPECT_EQ(read_text(notes_).find("l_fin"), std::string::npos);
  character(kCarp + " --out " + file_ + " --set r_fin_2=none --fins 2");
  EXPECT_TRUE(points(file_)["points"].contains("l_fin_2"));
  EXPECT_FALSE(points(file_)["points"].contains("r_fin_2"));
}

TEST_F(CharacterCommand, ListsOnTheirOwnWriteNothing) {
  const Outcome run = character(kCarp + " --list");
  EXPECT_NE(run.out.find("\nhead "), std::string::npos) << run.out;
  EXPECT_EQ(std::count(run.out.begin(), run.out.end(), '\n'), 27);
  character(kCarp + " --out " + file_);
  const std::string before = read_text(file_);
  character(file_ + " --list");
  EXPECT_EQ(read_text(file_), before);
}

TEST_F(CharacterCommand, MistakesAreOneLine) {
  character(kCarp + " --out " + file_);
  refused(file_ + " --set haed=1,2", "--set: there is no 'haed'; did you mean head?");
  refused(file_ + " --l-num 40", "--set: l_num must be a whole number from 1 to 32, not '40'");
  refused(file_ + " --set low_axis_20=1,2", "there is no low_axis_20");
  refused(file_ + " --head left", "are for pictures and meshes");
  refused(kCarp, "--out FILE.ntchar");
  refused(kCarp + " --edit", "--out FILE.ntchar");
  refused(kCarp + " --out " + (dir_ / "koi.png"), "must end in .ntchar");
  refused(file_ + " --corrections " + (dir_ / "none.txt"), "cannot read the corrections", 1);
  std::ofstream(notes_) << "fins = 0\nfin = 1\n";
  refused(kCarp + " --out " + file_, "koi.corrections.txt:2: there is no 'fin'; did you mean fins?");
  EXPECT_EQ(read_text(notes_), "fins = 0\nfin = 1\n");
  std::ofstream(dir_ / "cut.png", std::ios::binary) << read_text(kCarp).substr(0, 60000);
  refused((dir_ / "cut.png") + " --out " + (dir_ / "cut.ntchar"), "cut.png is not a picture", 1);
  std::filesystem::create_directory(dir_ / "folder.ntchar");
  refused((dir_ / "folder.ntchar") + " --list", "cannot read the character", 1);
  refused(file_ + " --edit --corrections none --window-size 12", "--window-size must be WIDTHxHEIGHT");
}

}  // namespace
}  // namespace nt
