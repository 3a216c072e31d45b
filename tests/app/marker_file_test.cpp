// SPDX-License-Identifier: Apache-2.0
#include "app/mocap/marker_file.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "app/mocap/marker_choice.h"
#include "app/mocap/registration.h"
#include "core/base/random.h"
#include "platform/camera.h"

namespace nt {
namespace {

template <class T>
void put(std::string& bytes, std::size_t at, T v) {
  if (bytes.size() < at + sizeof v) bytes.resize(at + sizeof v);
  std::memcpy(&bytes[at], &v, sizeof v);
}

// Two markers, three frames, the second marker missing in the second frame. scale < 0: floats, else integers.
std::string small_c3d(float scale, const char* unit = "mm", bool labels = true) {
  std::string b(1024, '\0');
  b[0] = 2, b[1] = 0x50;
  put<uint16_t>(b, 2, 2), put<uint16_t>(b, 6, 1), put<uint16_t>(b, 8, 3);
  put<float>(b, 12, scale);
  put<uint16_t>(b, 16, 3);
  put<float>(b, 20, 50.0f);
  b[514] = 1, b[515] = 84;
  std::string p("\x05\xffPOINT\x03\x00\x00", 10);
  const auto text_parameter = [&](const std::string& name, const std::string& dimensions, const std::string& data) {
    p += static_cast<char>(name.size());
    p += '\1';
    p += name;
    const auto offset = static_cast<uint16_t>(2 + 1 + dimensions.size() + data.size());
    p += static_cast<char>(offset & 0xff);
    p += static_cast<char>(offset >> 8);
    p += '\xff';
    p += dimensions + data;
  };
  if (labels) text_parameter("LABELS", std::string("\x02\x04\x02", 3), "hip knee");
  text_parameter("UNITS", std::string("\x01", 1) + static_cast<char>(std::strlen(unit)), unit);
  std::memcpy(&b[516], p.data(), p.size());
  for (int f = 0; f < 3; ++f) {
    for (int m = 0; m < 2; ++m) {
      const bool missing = f == 1 && m == 1;
      for (int c = 0; c < 4; ++c) {
        const int value = c == 3 ? (missing ? -1 : 0) : 10 * f + 100 * m + c + 1;
        if (scale < 0) {
          put<float>(b, b.size(), static_cast<float>(value));
        } else {
          put<int16_t>(b, b.size(), static_cast<int16_t>(value));
        }
      }
    }
  }
  return b;
}

MarkerFile parse(const std::string& bytes) { return parse_c3d(std::as_bytes(std::span(bytes)), "small.c3d"); }

TEST(MarkerFileTest, C3dFloatsAndIntegers) {
  for (const float scale : {-1.0f, 0.5f}) {
    const MarkerFile m = parse(small_c3d(scale));
    ASSERT_EQ(m.markers(), 2u);
    EXPECT_EQ(m.names[0], "hip");
    EXPECT_EQ(m.names[1], "knee");
    ASSERT_EQ(m.frames(), 3u);
    EXPECT_EQ(m.rate_hz, 50.0);
    const float s = scale < 0 ? 1.0f : scale;
    EXPECT_EQ(m.frame(2)[1].x, s * 121);
    EXPECT_EQ(m.frame(2)[1].z, s * 123);
    EXPECT_TRUE(is_seen(m.frame(1)[0]));
    EXPECT_FALSE(is_seen(m.frame(1)[1]));
  }
}

TEST(MarkerFileTest, C3dUnitsAndMissingLabels) {
  EXPECT_EQ(parse(small_c3d(-1.0f, "m")).frame(0)[0].x, 1000.0f);
  const MarkerFile m = parse(small_c3d(-1.0f, "mm", false));
  EXPECT_EQ(m.names[1], "M2");
  EXPECT_EQ(m.notes.size(), 1u);
}

TEST(MarkerFileTest, AC3dThatIsCutShortSaysSo) {
  const std::string whole = small_c3d(-1.0f);
  EXPECT_TRUE(parse(whole).notes.empty());
  const MarkerFile m = parse(whole.substr(0, whole.size() - 32));
  EXPECT_EQ(m.frames(), 2u);
  ASSERT_EQ(m.notes.size(), 1u);
  EXPECT_EQ(m.notes[0], "small.c3d ends early: of its 3 frames 2 are there");
}

TEST(MarkerFileTest, TextFormats) {
  const MarkerFile trc = parse_marker_text(
      "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tCameraRate\tNumFrames\tNumMarkers\tUnits\n"
      "60\t60\t2\t2\tm\nFrame#\tTime\thip\t\t\tknee\t\t\n\t\tX1\tY1\tZ1\tX2\tY2\tZ2\n"
      "1\t0.0\t1\t2\t3\t4\t5\t6\n2\t0.1\t1\t2\t3\t\t\t\n",
      "a.trc");
  EXPECT_EQ(trc.names, (std::vector<std::string>{"hip", "knee"}));
  EXPECT_EQ(trc.rate_hz, 60.0);
  EXPECT_EQ(trc.frame(0)[1].z, 6000.0f);
  EXPECT_FALSE(is_seen(trc.frame(1)[1]));
  const MarkerFile tsv = parse_marker_text(
      "NO_OF_FRAMES\t2\nFREQUENCY\t100\nMARKER_NAMES\thip\tknee\nFrame\tTime\thip X\thip Y\thip Z\tknee X\tknee "
      "Y\tknee "
      "Z\n1\t0.0\t1\t2\t3\t4\t5\t6\n2\t0.01\t0\t0\t0\t4\t5\t6\n",
      "a.tsv");
  EXPECT_EQ(tsv.frames(), 2u);
  EXPECT_FALSE(is_seen(tsv.frame(1)[0]));
  EXPECT_EQ(tsv.frame(1)[1].x, 4.0f);
  const MarkerFile csv = parse_marker_text("time,hip_x,hip_y,hip_z\n0,1,2,3\n0.04,1,nan,3\n", "a.csv");
  EXPECT_EQ(csv.names[0], "hip");
  EXPECT_NEAR(csv.rate_hz, 25.0, 1e-6);
  EXPECT_FALSE(is_seen(csv.frame(1)[0]));
}

TEST(MarkerFileTest, WhatIsNoMarkerFileIsOneLine) {
  for (const std::string text :
       {"", "hello", "a,b,c\n1,2,3\n", "PathFileType\n", "NO_OF_FRAMES\t2\n1\t2\t3\t4\n", "hip_x,hip_y,hip_z\n"}) {
    EXPECT_THROW(parse_marker_text(text, "x"), UserError) << text;
  }
  EXPECT_THROW(parse("short"), UserError);
  EXPECT_THROW(read_marker_file("nowhere.c3d"), UserError);
}

// Bytes of a sound file changed and cut at random: a result or UserError, nothing else.
TEST(MarkerFileTest, FuzzedFilesDoNoHarm) {
  Random r(3);
  const std::string sound = small_c3d(-1.0f);
  const std::string text = "NO_OF_FRAMES\t2\nFREQUENCY\t100\nMARKER_NAMES\thip\tknee\n1\t0.0\t1\t2\t3\t4\t5\t6\n";
  int read = 0;
  for (int k = 0; k < 20000; ++k) {
    std::string b = k % 4 == 3 ? text : sound;
    for (uint32_t n = r.below(12); n > 0; --n) {
      const std::size_t at =
          r.below(3) == 0 ? r.below(static_cast<uint32_t>(b.size())) : r.below(64) + (r.below(2) ? 512u : 0u);
      if (at < b.size()) b[at] = static_cast<char>(r.below(256));
    }
    if (r.below(4) == 0) b.resize(r.below(static_cast<uint32_t>(b.size())));
    try {
      const MarkerFile m = k % 4 == 3 ? parse_marker_text(b, "x") : parse(b);
      EXPECT_EQ(m.positions.size(), m.frames() * m.markers());
      ++read;
    } catch (const UserError&) {
    }
  }
  EXPECT_GT(read, 2000);
}

TEST(MarkerChoiceTest, AWholeNameIsOneMarkerAndItsBeginningAllThatBeginSo) {
  MarkerFile file;
  file.names = {"M4", "M40", "knee_l", "knee_r"};
  file.positions.resize(4);
  const auto picks = [&](const char* only) {
    MarkerChoice choice;
    choice.only = only;
    return chosen_markers(file, choice);
  };
  using Places = std::vector<std::size_t>;
  EXPECT_EQ(picks("M4"), (Places{0}));
  EXPECT_EQ(picks("M"), (Places{0, 1}));
  EXPECT_EQ(picks("knee,M40"), (Places{1, 2, 3}));
  EXPECT_EQ(picks(""), (Places{0, 1, 2, 3}));
  EXPECT_THROW((void)picks("hip"), UserError);
}

struct Real {
  const char* file;
  std::size_t markers, frames;
  double seen;
};

TEST(MarkerFileTest, RecordedFiles) {
  const std::filesystem::path folder = std::filesystem::path(NEONTETRA_SHARED_DATA) / "mocap";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no shared data";
  for (const Real& real :
       {Real{"fullbody36_optitrack.c3d", 36, 1380, 0.834}, Real{"walking2_44pt_250hz.c3d", 44, 1249, 0.498},
        Real{"phasespace40_noparams.c3d", 40, 701, 0.954}, Real{"hand21_qualisys_a.tsv", 21, 3000, 0.997}}) {
    const MarkerFile m = read_marker_file(folder / real.file);
    EXPECT_EQ(m.markers(), real.markers);
    EXPECT_EQ(m.frames(), real.frames);
    double seen = 0;
    for (const Vec3 p : m.positions) seen += is_seen(p);
    EXPECT_NEAR(seen / static_cast<double>(m.positions.size()), real.seen, 0.001) << real.file;
  }
  EXPECT_EQ(read_marker_file(folder / "fullbody36_optitrack.c3d").names[0], "Skeleton_Hip2");
}

TEST(RegistrationTest, FindsTurnScaleAndShift) {
  Random r(4);
  std::vector<Vec3> mesh;
  for (int k = 0; k < 3000; ++k) {
    const Vec3 d = normalised(Vec3{r.unit() - 0.5f, r.unit() - 0.5f, r.unit() - 0.5f});
    mesh.push_back({3 * d.x + (d.x > 0 ? d.y * d.y : 0.0f), d.y, 0.4f * d.z + 0.3f * d.x * d.x});
  }
  const Quat turn = parse_axes("x,z,-y");
  std::vector<Vec3> markers;
  for (std::size_t k = 0; k < mesh.size(); k += 50)
    markers.push_back(rotate(conjugate(turn), 1000.0f * mesh[k]) + Vec3{500, 0, 90});
  const Registration s = register_markers(markers, mesh, std::vector<Quat>{turn});
  EXPECT_LT(s.rms, 0.08f);
  float error = 0.0f;
  for (std::size_t k = 0; k < markers.size(); ++k) error += length(s(markers[k]) - mesh[50 * k]);
  EXPECT_LT(error / static_cast<float>(markers.size()), 0.25f);
  EXPECT_LT(register_markers(markers, mesh, {}).rms, 0.08f);
}

TEST(RegistrationTest, AxesAreATurnOrAnError) {
  EXPECT_LT(length(rotate(parse_axes("x,z,-y"), {1, 2, 3}) - Vec3{1, 3, -2}), 1e-5f);
  EXPECT_LT(length(rotate(parse_axes("x,y,z"), {1, 2, 3}) - Vec3{1, 2, 3}), 1e-5f);
  for (const char* bad : {"", "x", "x,y", "x,y,-z", "x,x,y", "a,b,c", "x,y,z,x"})
    EXPECT_THROW(parse_axes(bad), UserError);
}

}  // namespace
}  // namespace nt
