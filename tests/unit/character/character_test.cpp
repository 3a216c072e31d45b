// SPDX-License-Identifier: Apache-2.0
#include "core/character/character.h"

#include <gtest/gtest.h>

#include <cstring>
#include <limits>
#include <string>

#include "core/base/hash.h"
#include "core/base/random.h"
#include "tests/support/drawn_character.h"

namespace nt {
namespace {

using test::DrawnCharacter;

Result<Character> open(std::span<const std::byte> bytes, const Limits& limits = {}) {
  return open_character(bytes, limits);
}

// Makes the checksum right again after a change, so that the checks behind it are reached.
void seal(DrawnCharacter& c) {
  CharacterHeader h;
  std::memcpy(&h, c.bytes().data(), sizeof h);
  h.checksum = hash_bytes(c.bytes().data() + kChecksumFrom, c.bytes().size() - kChecksumFrom);
  std::memcpy(c.bytes().data(), &h, sizeof h);
}

template <class T>
void put(DrawnCharacter& c, uint64_t offset, T value) {
  std::memcpy(c.bytes().data() + offset, &value, sizeof value);
  seal(c);
}

TEST(Character, OpensWhatWasWritten) {
  DrawnCharacter drawn;
  const auto opened = open(drawn.bytes());
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  const Character& c = opened.value();
  EXPECT_EQ(c.u_num, 3);
  EXPECT_EQ(c.l_num, 15);
  EXPECT_TRUE(c.rest.fins[kLeftFin].present && c.rest.fins[kRightFin].present);
  EXPECT_FALSE(c.rest.fins[kSecondLeftFin].present || c.rest.fins[kSecondRightFin].present);
  EXPECT_TRUE(c.has_tail_fin);
  EXPECT_FALSE(c.solid());
  EXPECT_EQ(c.harmonics, 5);
  EXPECT_EQ(c.confidences.size(), control_section_points(3, 15));
  EXPECT_EQ(c.confidences[0], 0.75f);
  EXPECT_EQ(c.vertices.size(), c.texcoords.size());
  EXPECT_GT(c.triangles.size(), 300u);
  EXPECT_LT(c.rest.fins[kLeftFin].tip.x, c.rest.fins[kRightFin].tip.x);
  EXPECT_EQ(c.texture.width, 4);
  EXPECT_EQ(c.texture.pixels[3], 255);
}

TEST(Character, KnowsWhereItLiesInItsFigureAndItsDeformer) {
  DrawnCharacter drawn;
  put(drawn, offsetof(CharacterHeader, deformer), uint32_t{2});
  put(drawn, offsetof(CharacterHeader, flags), drawn.header().flags | kCharacterMirror);
  const auto opened = open(drawn.bytes());
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  EXPECT_EQ(opened.value().figure.centre.x, 100);
  EXPECT_EQ(opened.value().figure.dir.y, -1);
  EXPECT_TRUE(opened.value().figure.mirror);
  EXPECT_EQ(opened.value().deformer, MlsKind::affine);
  put(drawn, offsetof(CharacterHeader, deformer), uint32_t{3});
  EXPECT_FALSE(open(drawn.bytes()).ok());
  put(drawn, offsetof(CharacterHeader, deformer), uint32_t{0});
  put(drawn, offsetof(CharacterHeader, figure_dir), 1.0f);  // (1, -1): not of unit length
  EXPECT_FALSE(open(drawn.bytes()).ok());
  put(drawn, offsetof(CharacterHeader, figure_dir), std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(open(drawn.bytes()).ok());
}

TEST(Character, ASolidHasHeightsAndNormals) {
  DrawnCharacter drawn(true, 3, 15, true);
  const auto opened = open(drawn.bytes());
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  EXPECT_TRUE(opened.value().solid());
  EXPECT_EQ(opened.value().heights.size(), opened.value().vertices.size());
  EXPECT_EQ(opened.value().heights[0], 5.0f);
  EXPECT_EQ(opened.value().normals[1].z, 1.0f);
  const CharacterHeader h = drawn.header();
  const auto refused = [](uint64_t offset, auto value) {
    DrawnCharacter c(true, 3, 15, true);
    put(c, offset, value);
    return !open(c.bytes()).ok();
  };
  EXPECT_FALSE(refused(h.heights_offset, 6.0f));
  EXPECT_TRUE(refused(h.heights_offset, 1e30f));
  EXPECT_TRUE(refused(h.heights_offset, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_TRUE(refused(h.normals_offset + 4, -1.5f));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, heights_offset), uint64_t{0}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, flags), uint32_t{kCharacterTailFin}));
}

TEST(Character, AnOlderFileSaysSo) {
  DrawnCharacter drawn;
  put(drawn, offsetof(CharacterHeader, version), uint32_t{1});
  const auto opened = open(drawn.bytes());
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(std::string(opened.status().message).find("older"), std::string::npos);
}

TEST(Character, EveryByteFlippedIsRefused) {
  DrawnCharacter drawn;
  for (std::size_t i = 0; i < drawn.bytes().size(); i += i < sizeof(CharacterHeader) ? 1 : 97) {
    drawn.bytes()[i] ^= std::byte{0x41};
    const auto opened = open(drawn.bytes());
    EXPECT_FALSE(opened.ok()) << i;
    EXPECT_EQ(std::string(opened.status().message).find('\n'), std::string::npos);
    EXPECT_GT(std::strlen(opened.status().message), 10u);
    drawn.bytes()[i] ^= std::byte{0x41};
  }
  EXPECT_TRUE(open(drawn.bytes()).ok());
}

TEST(Character, EveryTruncationIsRefused) {
  DrawnCharacter drawn;
  for (std::size_t n = 0; n < drawn.bytes().size(); n += n < 200 ? 1 : 61)
    EXPECT_FALSE(open(drawn.bytes().first(n)).ok()) << n;
}

TEST(Character, ANewerFileSaysSo) {
  DrawnCharacter drawn;
  put(drawn, offsetof(CharacterHeader, version), kCharacterVersion + 1);
  const auto opened = open(drawn.bytes());
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(std::string(opened.status().message).find("newer"), std::string::npos);
}

TEST(Character, ValuesOutOfRangeAreRefusedBehindARightChecksum) {
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  DrawnCharacter good;
  const CharacterHeader h = good.header();
  const auto refused = [](uint64_t offset, auto value) {
    DrawnCharacter c;
    put(c, offset, value);
    return !open(c.bytes()).ok();
  };
  EXPECT_TRUE(refused(h.triangles_offset + 8, h.vertex_count));
  EXPECT_TRUE(refused(h.vertices_offset + 4, nan));
  EXPECT_TRUE(refused(h.vertices_offset, inf));
  EXPECT_TRUE(refused(h.controls_offset, nan));
  EXPECT_TRUE(refused(h.controls_offset + 4, 1e30f));
  EXPECT_TRUE(refused(h.texcoords_offset, 1.01f));
  EXPECT_TRUE(refused(h.texcoords_offset, nan));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, u_num), uint32_t{0}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, l_num), uint32_t{33}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, flags), uint32_t{0x80}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, harmonics), uint32_t{17}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, heights_offset), h.vertices_offset));
  EXPECT_TRUE(refused(h.confidences_offset, 1.5f));
  EXPECT_TRUE(refused(h.confidences_offset + 4, nan));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, vertex_count), uint32_t{0xffffffff}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, triangle_count), uint32_t{0x55555556}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, texture_width), uint32_t{8192}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, vertices_offset), h.vertices_offset + 4));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, vertices_offset), ~uint64_t{63}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, texture_offset), uint64_t{0}));
}

TEST(Character, LimitsAreNamed) {
  DrawnCharacter drawn;
  Limits limits;
  limits.max_vertices = static_cast<int>(drawn.header().vertex_count) - 1;
  EXPECT_NE(std::string(open(drawn.bytes(), limits).status().message).find("max_vertices"), std::string::npos);
  limits = {};
  limits.max_triangles = static_cast<int>(drawn.header().triangle_count) - 1;
  EXPECT_NE(std::string(open(drawn.bytes(), limits).status().message).find("max_triangles"), std::string::npos);
  limits = {};
  limits.max_control_points = 32;
  EXPECT_NE(std::string(open(drawn.bytes(), limits).status().message).find("max_control_points"), std::string::npos);
}

// Random damage, sealed with a right checksum half of the time: refused, or every index and number is still usable.
TEST(Character, SurvivesRandomDamage) {
  Random random(11);
  int opened_count = 0;
  for (int round = 0; round < 3000; ++round) {
    DrawnCharacter c(true, 3, 15, round % 3 == 0);
    const uint32_t changes = 1 + random.below(6);
    for (uint32_t k = 0; k < changes; ++k) {
      const bool header = random.below(2) == 0;
      const auto size = static_cast<uint32_t>(header ? sizeof(CharacterHeader) : c.bytes().size());
      c.bytes()[random.below(size)] = static_cast<std::byte>(random.below(256));
    }
    if (round % 2 == 0) seal(c);
    const auto opened = open(c.bytes());
    if (!opened.ok()) continue;
    ++opened_count;
    float sum = 0;
    for (const uint32_t t : opened.value().triangles) sum += opened.value().vertices[t].x;
    for (const float z : opened.value().heights) sum += z;
    for (const float p : opened.value().confidences) sum += p;
    const Picture& p = opened.value().texture;
    EXPECT_LE(static_cast<std::size_t>(p.stride) * static_cast<std::size_t>(p.height), c.bytes().size());
    EXPECT_EQ(sum - sum, 0.0f);
  }
  EXPECT_GT(opened_count, 0);  // colours and small moves of points are nobody's damage
}

}  // namespace
}  // namespace nt
