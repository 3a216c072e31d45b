// SPDX-License-Identifier: Apache-2.0
#include "app/author/mesh_character.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <fstream>
#include <opencv2/imgcodecs.hpp>
#include <sstream>

#include "app/author/character_file.h"
#include "app/author/mesh_file.h"
#include "platform/camera.h"
#include "tests/app/mesh_text.h"
#include "tests/app/run_binary.h"
#include "tests/support/temp_dir.h"

namespace nt {
namespace {

std::string asset(const std::string& name) { return std::string(NEONTETRA_ASSETS) + "/characters/" + name; }

class MeshCharacter : public ::testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(dir_ / name, std::ios::binary) << text;
    return dir_ / name;
  }
  static std::string refusal(const std::string& path, const MeshOptions& options = {}) {
    try {
      (void)author_mesh(path, options);
    } catch (const UserError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      EXPECT_GT(std::string(e.what()).size(), 20u);
      return e.what();
    }
    return "";
  }
  static bool noted(const PictureReport& report, const std::string& part) {
    for (const std::string& note : report.notes) {
      if (note.find(part) != std::string::npos) return true;
    }
    return false;
  }
  TempDir dir_;
};

void expect_sound(const Character& c) {
  ASSERT_TRUE(c.solid());
  for (const Vec3 n : c.normals) ASSERT_NEAR(n.x * n.x + n.y * n.y + n.z * n.z, 1, 1e-3f);
  EXPECT_GT(c.rest.head.y, 0);
  EXPECT_LT(c.rest.tail.y, 0);
  float low = 0, high = 0;
  for (const float z : c.heights) low = std::min(low, z), high = std::max(high, z);
  EXPECT_NEAR(low, -high, 0.01f * high);  // the plane of the control points runs through the middle
}

TEST_F(MeshCharacter, TheWhaleHasTheVerticesOfThePapersAndItsFlippersAsFins) {
  const AuthoredCharacter a = author_mesh(asset("whale.glb"), {});
  const LoadedCharacter loaded(a.bytes, "whale", Limits{});
  const Character& c = loaded.character();
  expect_sound(c);
  EXPECT_NEAR(a.report.vertices, 6003, 300);
  EXPECT_TRUE(a.report.notes.size() <= 1) << a.report.notes.back();
  const FinPoints &l = c.rest.fins[kLeftFin], &r = c.rest.fins[kRightFin];
  ASSERT_TRUE(l.present && r.present);
  EXPECT_LT(l.tip.x, -200);
  EXPECT_GT(r.tip.x, 200);
  EXPECT_NEAR(l.tip.x, -r.tip.x, 15);
  EXPECT_NEAR(l.tip.y, r.tip.y, 15);
  EXPECT_LT(l.tip.y, l.top.y);  // swept back
  EXPECT_EQ(a.bytes, author_mesh(asset("whale.glb"), {}).bytes);
}

TEST_F(MeshCharacter, TheWhalesBackIsDarkAndItsBellyPale) {
  const AuthoredCharacter a = author_mesh(asset("whale.glb"), {});
  const LoadedCharacter loaded(a.bytes, "whale", Limits{});
  const Character& c = loaded.character();
  double back = 0, belly = 0;
  int backs = 0, bellies = 0;
  for (std::size_t i = 0; i < c.vertices.size(); ++i) {
    if (std::abs(c.vertices[i].x) > 60 || std::abs(c.vertices[i].y - 60) > 120) continue;
    const int x = static_cast<int>(c.texcoords[i].x * static_cast<float>(c.texture.width));
    const int y = static_cast<int>(c.texcoords[i].y * static_cast<float>(c.texture.height));
    const uint8_t green = c.texture.pixels[y * c.texture.stride + 4 * x + 1];
    if (c.normals[i].z > 0.9f) back += green, ++backs;
    if (c.normals[i].z < -0.9f) belly += green, ++bellies;
  }
  ASSERT_GT(backs, 20);
  ASSERT_GT(bellies, 20);
  EXPECT_GT(belly / bellies, 80 + back / backs);
}

TEST_F(MeshCharacter, TheLobstersClawsAreItsFins) {
  const AuthoredCharacter a = author_mesh(asset("lobster.glb"), {});
  const LoadedCharacter loaded(a.bytes, "lobster", Limits{});
  const Character& c = loaded.character();
  expect_sound(c);
  EXPECT_NEAR(a.report.vertices, 3924, 400);
  for (const FinIndex i : {kLeftFin, kRightFin}) {
    ASSERT_TRUE(c.rest.fins[i].present);
    EXPECT_GT(c.rest.fins[i].tip.y, c.rest.head.y);  // they reach ahead of the head
  }
}

TEST_F(MeshCharacter, AFishIsLaidDownHeadForwardBackUp) {
  const std::string path = file("fish.obj", fish_obj().text);
  const AuthoredCharacter a = author_mesh(path, {});
  const LoadedCharacter loaded(a.bytes, "fish", Limits{});
  const Character& c = loaded.character();
  expect_sound(c);
  EXPECT_TRUE(c.rest.fins[kLeftFin].present && c.rest.fins[kRightFin].present);
  EXPECT_NEAR(c.rest.head.y - c.rest.tail.y, 900 * 1.95 / 2, 60);
  // Its right (x > 0) is the file's +z when its head is at +x and its back at +y.
  const SourceMesh mesh = read_mesh(path, {});
  float right = 0;
  for (const Vec3 p : mesh.positions) right = std::max(right, p.x);
  EXPECT_NEAR(right, 0.66f, 1e-3f);
}

TEST_F(MeshCharacter, HeadAndUpGoWhereTheUserSays) {
  const std::string path = file("fish.obj", fish_obj().text);
  MeshOptions options;
  for (const char* head : {"+x", "-x"}) {
    options.told.head = parse_axis("--head", head);
    const AuthoredCharacter a = author_mesh(path, options);
    const LoadedCharacter loaded(a.bytes, "fish", Limits{});
    // The tail fin's tips lie at the told head's far end, or not.
    float farthest = 0;
    for (const Vec2 v : loaded.character().vertices) {
      if (std::abs(v.x) > 80 && std::abs(v.x) < 105) farthest = std::max(farthest, -v.y);
    }
    EXPECT_EQ(farthest > 400, head[0] == '+') << farthest;
  }
  options.told.head = parse_axis("--head", "+x"), options.told.up = parse_axis("--up", "+z");
  const AuthoredCharacter side = author_mesh(path, options);  // lies on its side: no fins stand out
  EXPECT_FALSE(LoadedCharacter(side.bytes, "fish", Limits{}).character().rest.fins[kLeftFin].present &&
               LoadedCharacter(side.bytes, "fish", Limits{}).character().rest.fins[kRightFin].present);
  options.told.up = parse_axis("--up", "-x");
  EXPECT_NE(refusal(path, options).find("--up"), std::string::npos);
  for (const char* wrong : {"", "x", "+w", "left", "+xx"}) EXPECT_THROW((void)parse_axis("--up", wrong), UserError);
}

TEST_F(MeshCharacter, TwoHundredThousandTrianglesAreReducedToLimits) {
  const AuthoredCharacter a = author_mesh(file("big.obj", fish_obj(320).text), {});
  EXPECT_TRUE(noted(a.report, "reduced from 204"));
  EXPECT_LE(a.report.vertices, Limits{}.max_vertices);
  EXPECT_LE(a.report.triangles, Limits{}.max_triangles);
  EXPECT_GT(a.report.vertices, 2000);
  expect_sound(LoadedCharacter(a.bytes, "big", Limits{}).character());
}

TEST_F(MeshCharacter, LooseTrianglesAreReducedToo) {
  // Every triangle has its own, slightly different, corners: no edge is shared, so nothing can be collapsed.
  ObjText loose, whole = fish_obj(72);
  std::istringstream lines(whole.text);
  std::vector<std::array<double, 3>> v;
  std::string line;
  int n = 0;
  while (std::getline(lines, line)) {
    double x = 0, y = 0, z = 0;
    int f[3];
    if (std::sscanf(line.c_str(), "v %lf %lf %lf", &x, &y, &z) == 3) v.push_back({x, y, z});
    if (std::sscanf(line.c_str(), "f %d %d %d", f, f + 1, f + 2) != 3) continue;
    for (const int i : f) {
      const auto& p = v[static_cast<std::size_t>(i - 1)];
      loose.vertex(p[0] + 1e-5 * (n % 97), p[1], p[2]);
    }
    loose.face(3 * n + 1, 3 * n + 2, 3 * n + 3);
    ++n;
  }
  const AuthoredCharacter a = author_mesh(file("loose.obj", loose.text), {});
  EXPECT_TRUE(noted(a.report, "reduced from"));
  EXPECT_LE(a.report.vertices, Limits{}.max_vertices);
}

TEST_F(MeshCharacter, DirtAndHelpersAreDroppedAndSaid) {
  ObjText obj = fish_obj();
  const AuthoredCharacter clean = author_mesh(file("clean.obj", obj.text), {});
  obj.face(1, 2, 2), obj.face(1, 1, 1);    // no area
  obj.face(1, 2, 18), obj.face(1, 2, 18);  // doubled
  const int first = obj.vertices + 1;
  obj.vertex(40, 0, 0), obj.vertex(40, 50, 0), obj.vertex(60, 0, 0);
  obj.text += "g helper-skirt\n";
  obj.face(first, first + 1, first + 2);
  const AuthoredCharacter dirty = author_mesh(file("dirty.obj", obj.text), {});
  EXPECT_TRUE(noted(dirty.report, "helper"));
  EXPECT_TRUE(noted(dirty.report, "dropped"));
  EXPECT_NEAR(dirty.report.triangles, clean.report.triangles, 2);
  EXPECT_NEAR(dirty.report.proposal.pose.axis_len, clean.report.proposal.pose.axis_len, 3);
}

TEST_F(MeshCharacter, AMeshWithHolesAndBrokenNumbersGoesThrough) {
  std::istringstream lines(fish_obj(24).text);
  std::string line, holed;
  for (int n = 0; std::getline(lines, line); ++n) {
    if (line[0] == 'f' && n % 5 == 0) continue;  // a fifth of the triangles is missing
    holed += (line[0] == 'v' && n % 61 == 7 ? "v nan nan nan" : line) + "\n";
  }
  const AuthoredCharacter a = author_mesh(file("holes.obj", holed), {});
  expect_sound(LoadedCharacter(a.bytes, "holes", Limits{}).character());
}

TEST_F(MeshCharacter, AnExternalTextureIsTakenAndAMissingOneSaid) {
  ObjText obj = fish_obj();
  std::string text = "mtllib fish.mtl\nusemtl skin\nvt 0.25 0.75\nvt 0.75 0.75\nvt 0.5 0.25\n";
  std::istringstream lines(obj.text);
  std::string line;
  while (std::getline(lines, line)) {
    int f[3];
    if (std::sscanf(line.c_str(), "f %d %d %d", f, f + 1, f + 2) == 3) {
      line = "f " + std::to_string(f[0]) + "/1 " + std::to_string(f[1]) + "/2 " + std::to_string(f[2]) + "/3";
    }
    text += line + "\n";
  }
  const std::string path = file("fish.obj", text);
  file("fish.mtl", "newmtl skin\nKd 0.2 0.4 0.6\nmap_Kd C:\\art\\skin.png\n");
  const AuthoredCharacter without = author_mesh(path, {});
  EXPECT_TRUE(noted(without.report, "skin.png"));
  cv::Mat skin(40, 64, CV_8UC3, cv::Scalar(10, 20, 200));  // BGR: red
  skin(cv::Rect(0, 20, 64, 20)).setTo(cv::Scalar(200, 20, 10));
  cv::imwrite(dir_ / "skin.png", skin);
  const AuthoredCharacter with = author_mesh(path, {});
  EXPECT_FALSE(noted(with.report, "skin.png"));
  const LoadedCharacter loaded(with.bytes, "fish", Limits{});
  const Character& c = loaded.character();
  EXPECT_GE(c.texture.width, 64);
  // vt v is up: 0.75 is the red upper half.
  int red = 0, blue = 0;
  for (const Vec2 uv : c.texcoords) {
    const int x = static_cast<int>(uv.x * static_cast<float>(c.texture.width));
    const int y = static_cast<int>(uv.y * static_cast<float>(c.texture.height));
    const uint8_t* p = c.texture.pixels + y * c.texture.stride + 4 * x;
    (p[0] > p[2] ? red : blue) += 1;
  }
  EXPECT_GT(red, blue);
  EXPECT_GT(blue, 0);
}

TEST_F(MeshCharacter, WhatIsNoMeshGetsOneLine) {
  EXPECT_NE(refusal(dir_ / "none.obj").find("no such file"), std::string::npos);
  EXPECT_NE(refusal(file("empty.obj", "")), "");
  EXPECT_NE(refusal(file("text.glb", "this is text\n")), "");
  EXPECT_NE(refusal(file("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")), "");
  EXPECT_NE(refusal(file("line.obj", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n")), "");
  EXPECT_NE(refusal(file("out.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")), "");
  EXPECT_NE(refusal(file("nan.obj", "v nan 0 0\nv 1 nan 0\nv 0 1 inf\nf 1 2 3\n")), "");
  EXPECT_NE(refusal(file("dot.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n")), "");
  EXPECT_NE(
      refusal(file("header.ply", "ply\nformat ascii 1.0\nelement vertex 99999999\nproperty float x\nend_header\n")),
      "");
  EXPECT_NE(refusal(file("no.gltf", "{\"asset\":{\"version\":\"2.0\"}}")), "");
}

TEST_F(MeshCharacter, ASheetSeenOnEdgeSaysWhichOptionHelps) {
  MeshOptions options;
  options.told.head = parse_axis("--head", "+x"), options.told.up = parse_axis("--up", "+y");
  const std::string sheet = file("sheet.obj", "v 0 0 0\nv 2 0 0\nv 2 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n");
  EXPECT_NE(refusal(sheet, options).find("--up"), std::string::npos);
  options.told.up = parse_axis("--up", "+z");
  EXPECT_EQ(refusal(sheet, options), "");
}

// Some hundreds of damaged files: each is read or refused with one line, none crashes or hangs.
TEST_F(MeshCharacter, DamagedFilesAreReadOrRefused) {
  uint32_t state = 12345;
  const auto random = [&](uint32_t below) {
    state = state * 1664525u + 1013904223u;
    return (state >> 8) % below;
  };
  const std::string lobster = read_text(asset("lobster.glb")), fish = fish_obj(8).text;
  int read = 0, refused = 0;
  for (int round = 0; round < 240; ++round) {
    std::string bytes = round % 2 == 0 ? lobster : fish;
    // Half of the damage hits the beginning, where the structure is.
    const uint32_t changes = 1 + random(8);
    for (uint32_t k = 0; k < changes; ++k) {
      const auto size = static_cast<uint32_t>(bytes.size());
      bytes[random(k % 2 == 0 ? std::min(size, 1200u) : size)] = static_cast<char>(random(256));
    }
    if (round % 5 == 0) bytes.resize(random(static_cast<uint32_t>(bytes.size())));
    const std::string path = file(round % 2 == 0 ? "damaged.glb" : "damaged.obj", bytes);
    try {
      const SourceMesh mesh = read_mesh(path, {});
      for (const uint32_t i : mesh.triangles) ASSERT_LT(i, mesh.positions.size());
      ++read;
    } catch (const UserError& e) {
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << e.what();
      ++refused;
    }
  }
  EXPECT_GT(read, 20);
  EXPECT_GT(refused, 20);
}

TEST_F(MeshCharacter, TheCommandTakesMeshesAndRefusesWhatIsForPictures) {
  const Outcome made =
      neontetra("character " + asset("whale.glb") + " --out " + (dir_ / "w.ntchar") + " --preview " + (dir_ / "w.png"));
  EXPECT_EQ(made.exit_code, 0) << made.err;
  EXPECT_NE(made.out.find("3D mesh"), std::string::npos);
  EXPECT_GT(cv::imread(dir_ / "w.png").cols, 300);
  EXPECT_EQ(neontetra("character " + asset("carp.png") + " --up +y --out " + (dir_ / "c.ntchar")).exit_code, 2);
  EXPECT_EQ(neontetra("character " + asset("whale.glb") + " --head left --out " + (dir_ / "c.ntchar")).exit_code, 2);
}

}  // namespace
}  // namespace nt
