// SPDX-License-Identifier: Apache-2.0
// `neontetra character --lattice` and `neontetra markers --character`, as a user types them.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/author/marker_places.h"
#include "platform/camera.h"
#include "tests/app/mesh_text.h"
#include "tests/app/run_binary.h"

namespace nt {
namespace {

class LatticeCommand : public ::testing::Test {
 protected:
  void SetUp() override {
    std::ofstream(mesh_) << fish_obj().text;
    std::ofstream(skeleton_) << "head - 0.8 0 0\nmiddle head 0.1 0 0 y -60 60 z -60 60\ntail middle -0.6 0 0\n";
    std::ofstream(places_) << "nose 0.95 0 0 # by place\nside 0.3 0 0.2\nback 0.3 0.25 0\nrear -0.6 0 0\nfirst 0\n";
    // The same places a hundred times as large with other axes, then swaying.
    std::ofstream csv(recording_);
    csv << "nose_x,nose_y,nose_z,side_x,side_y,side_z,back_x,back_y,back_z,rear_x,rear_y,rear_z\n";
    const double place[4][3] = {{0.95, 0, 0}, {0.3, 0, 0.2}, {0.3, 0.25, 0}, {-0.6, 0, 0}};
    for (int f = 0; f < 20; ++f) {
      for (int m = 0; m < 4; ++m) {
        const double sway = f * 0.01 * place[m][0] * place[m][0];
        csv << (m ? "," : "") << 100 * place[m][0] << "," << -100 * (place[m][2] + sway) << "," << 100 * place[m][1];
      }
      csv << "\n";
    }
  }
  void refused(const std::string& arguments, const std::string& part) const {
    const Outcome run = neontetra(arguments);
    EXPECT_EQ(run.exit_code, 2) << arguments;
    EXPECT_EQ(run.error_lines(), 1) << run.err;
    EXPECT_NE(run.err.find(part), std::string::npos) << run.err;
  }
  TempDir dir_;
  const std::string mesh_ = dir_ / "fish.obj", skeleton_ = dir_ / "fish.skeleton", places_ = dir_ / "fish.markers",
                    recording_ = dir_ / "swim.csv", out_ = dir_ / "fish.ntchar";
};

TEST_F(LatticeCommand, MarkersMoveACharacterByTheirNames) {
  const Outcome made = neontetra("character " + mesh_ + " --lattice --skeleton " + skeleton_ + " --markers " + places_ +
                                 " --vertices 300 --out " + out_);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("3 joints, 5 markers"), std::string::npos) << made.out;
  const Outcome run = neontetra("markers " + recording_ + " --character " + out_ + " --json");
  ASSERT_EQ(run.exit_code, 0) << run.err;
  const auto json = nlohmann::json::parse(run.out);
  EXPECT_EQ(json["frames"], 20);
  EXPECT_EQ(json["markers"], 4);
  EXPECT_TRUE(json["bound_by_name"]);
  EXPECT_LT(double{json["registration_rms"]}, 1e-4);
  EXPECT_EQ(json["inverted_worst"], 0);
  EXPECT_LT(double{json["bone_error_worst"]}, 1e-3);
}

// The rear's marker is called side and the other way round: no place of the fish goes with that.
TEST_F(LatticeCommand, MarkersThatDoNotFitTheMeshAreSaid) {
  ASSERT_EQ(neontetra("character " + mesh_ + " --lattice --skeleton " + skeleton_ + " --markers " + places_ +
                      " --vertices 300 --out " + out_)
                .exit_code,
            0);
  EXPECT_EQ(neontetra("markers " + recording_ + " --character " + out_ + " --json").err.find("away from"),
            std::string::npos);
  std::ifstream in(recording_);
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const auto rename = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos;) text.replace(at, from.size(), to);
  };
  rename("rear", "other"), rename("side", "rear"), rename("other", "side");
  std::ofstream(recording_) << text;
  const Outcome run = neontetra("markers " + recording_ + " --character " + out_ + " --json");
  EXPECT_EQ(run.exit_code, 0) << run.err;
  EXPECT_NE(run.err.find("in frame 0 the markers lie "), std::string::npos) << run.err;
}

TEST_F(LatticeCommand, ASwimmersLatticeIsMadeAnewForCorrectedPoints) {
  const Outcome made = neontetra("character " + mesh_ + " --lattice --out " + out_);
  ASSERT_EQ(made.exit_code, 0) << made.err;
  const Outcome corrected = neontetra("character " + out_ + " --set l_num=9");
  ASSERT_EQ(corrected.exit_code, 0) << corrected.err;
  EXPECT_NE(corrected.out.find("15 joints"), std::string::npos) << corrected.out;
  const Outcome run = neontetra("animate -c sim:scene=turns,seed=1,frames=60,size=480x272 --character " + out_ +
                                " --deformer lattice --out " + (dir_ / "a.mp4"));
  EXPECT_EQ(run.exit_code, 0) << run.err;
}

TEST_F(LatticeCommand, WhatDoesNotGoTogetherIsSaid) {
  refused("character " + mesh_ + " --skeleton " + skeleton_ + " --out " + out_, "--lattice");
  refused("markers " + recording_, "--mesh");
  refused("markers " + recording_ + " --mesh " + mesh_ + " --character " + out_, "--mesh");
  refused("markers " + recording_ + " --character " + out_ + " --skeleton " + skeleton_, "--skeleton");
  const Outcome plain = neontetra("character " + mesh_ + " --out " + out_);
  ASSERT_EQ(plain.exit_code, 0) << plain.err;
  const Outcome run = neontetra("markers " + recording_ + " --character " + out_);
  EXPECT_EQ(run.exit_code, 1);
  EXPECT_NE(run.err.find("no lattice"), std::string::npos) << run.err;
  refused("character " + out_ + " --lattice --markers " + places_, "give the mesh");
}

TEST_F(LatticeCommand, OnlyACharacterThatWasSavedIsSpokenOf) {
  refused("character " + mesh_ + " --lattice --vertices 2500 --out " + out_, "2000 at most");
  const Outcome unwritten = neontetra("character " + mesh_ + " --lattice --out " + out_, 1);
  EXPECT_EQ(unwritten.exit_code, 1);
  EXPECT_EQ(unwritten.out, "");
  const Outcome untold = neontetra("character " + mesh_ + " --out " + out_ + " >/dev/full");
  EXPECT_EQ(untold.exit_code, 1);
  EXPECT_NE(untold.err.find("standard output"), std::string::npos) << untold.err;
}

TEST(MarkerPlaces, MistakesNameTheLine) {
  const TriangleMesh mesh{{{1, 2, 3}, {4, 5, 6}}, {}};
  const auto places = parse_marker_places("a 1 2 3\n# none\nb 1\n", "m", mesh);
  ASSERT_EQ(places.size(), 2u);
  EXPECT_EQ(places[1].position.y, 5.0f);
  const auto message = [&](const std::string& text) {
    try {
      parse_marker_places(text, "m", mesh);
    } catch (const UserError& error) {
      return std::string(error.what());
    }
    return std::string("none");
  };
  EXPECT_NE(message("a 1 2\n").find("line 1"), std::string::npos);
  EXPECT_NE(message("a 2\n").find("0 to 1"), std::string::npos);
  EXPECT_NE(message("a 1 2 x\n").find("line 1"), std::string::npos);
  EXPECT_NE(message("a 0\na 1\n").find("already"), std::string::npos);
  EXPECT_NE(message("").find("no marker"), std::string::npos);
}

}  // namespace
}  // namespace nt
