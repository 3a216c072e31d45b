// SPDX-License-Identifier: Apache-2.0
#include "core/character/lattice_section.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/base/random.h"
#include "tests/support/lattice_character.h"
#include "tests/support/solve_once.h"

namespace nt::test {
namespace {

template <class T>
void expect_same_bytes(std::span<const T> a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size_bytes()), 0);
}

TEST(LatticeSection, OpensInPlaceWhatWasWritten) {
  LatticeCharacter c;
  const auto opened = open_character(c.bytes(), Limits{});
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  const CharacterLattice& l = opened.value().lattice;
  ASSERT_TRUE(l.present());
  expect_same_bytes(l.view.vertices, c.data().vertices);
  expect_same_bytes(l.view.tetrahedra, c.data().tetrahedra);
  expect_same_bytes(l.view.neighbour_start, c.data().neighbour_start);
  expect_same_bytes(l.view.neighbours, c.data().neighbours);
  expect_same_bytes(l.view.weights, c.data().weights);
  expect_same_bytes(l.view.column_start, c.data().column_start);
  expect_same_bytes(l.view.rows, c.data().rows);
  expect_same_bytes(l.view.markers, c.data().markers);
  expect_same_bytes(l.view.skeleton.chain, c.data().chain);
  EXPECT_EQ(l.slots.size(), opened.value().vertices.size());
  const auto* at = reinterpret_cast<const std::byte*>(l.view.rows.data());
  EXPECT_TRUE(at > c.bytes().data() && at < c.bytes().data() + c.bytes().size()) << "not in place";
  EXPECT_TRUE(std::isfinite(solve_once(l)));
}

TEST(LatticeSection, AFileOfTheVersionBeforeStillOpens) {
  DrawnCharacter c;
  const uint32_t version = 2;
  std::memcpy(c.bytes().data() + offsetof(CharacterHeader, version), &version, sizeof version);
  const auto opened = open_character(c.bytes(), Limits{});
  ASSERT_TRUE(opened.ok()) << opened.status().message;
  EXPECT_FALSE(opened.value().lattice.present());
}

TEST(LatticeSection, WhatDoesNotFitIsRefused) {
  LatticeCharacter good;
  const CharacterHeader h = good.header();
  const LatticeHeader l = good.lattice_header();
  const auto refused = [](uint64_t offset, auto value) {
    LatticeCharacter c;
    c.put(offset, value);
    const auto opened = open_character(c.bytes(), Limits{});
    EXPECT_TRUE(opened.ok() || std::string(opened.status().message).find('\n') == std::string::npos);
    return !opened.ok();
  };
  const uint64_t at = h.lattice_offset;
  EXPECT_TRUE(refused(offsetof(CharacterHeader, lattice_offset), h.lattice_offset + 8));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, lattice_offset), ~uint64_t{63}));
  EXPECT_TRUE(refused(offsetof(CharacterHeader, version), uint32_t{2}));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, form), uint32_t{2}));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, drive), uint32_t{2}));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, vertex_count), uint32_t{0}));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, vertex_count), l.vertex_count - 1));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, tetrahedron_count), uint32_t{0x40000001}));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, row_count), l.row_count - 1));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, name_bytes), l.name_bytes - 1));
  EXPECT_TRUE(refused(at + offsetof(LatticeHeader, rows_offset), l.rows_offset + 2));
  EXPECT_TRUE(refused(l.tetrahedra_offset, uint16_t{0xffff}));
  EXPECT_TRUE(refused(l.vertices_offset, std::numeric_limits<float>::quiet_NaN()));
  EXPECT_TRUE(refused(l.weights_offset, -1.0f));
  EXPECT_TRUE(refused(l.slots_offset, uint32_t{4} * l.block_count));  // one behind the last
  EXPECT_TRUE(refused(l.coordinates_offset, std::numeric_limits<float>::infinity()));
  EXPECT_TRUE(refused(l.block_tetrahedra_offset, uint16_t{0xfff0}));
  EXPECT_TRUE(refused(l.markers_offset, uint16_t{0xfff0}));
  EXPECT_TRUE(refused(l.chain_offset, uint16_t{0xfff0}));
  Limits limits;
  limits.max_lattice_vertices = static_cast<int>(l.vertex_count) - 1;
  const auto opened = open_character(good.bytes(), limits);
  ASSERT_FALSE(opened.ok());
  EXPECT_NE(std::string(opened.status().message).find("max_lattice_vertices"), std::string::npos);
}

// Random damage behind a right checksum: refused, or it can be solved.
TEST(LatticeSection, SurvivesRandomDamage) {
  Random random(29);
  LatticeCharacter good;
  const CharacterHeader h = good.header();
  const auto size = static_cast<uint32_t>(good.bytes().size());
  std::vector<std::byte> copy(good.bytes().begin(), good.bytes().end());
  int accepted = 0;
  for (int round = 0; round < 3000; ++round) {
    std::copy(copy.begin(), copy.end(), good.bytes().begin());
    const uint32_t changes = 1 + random.below(4);
    for (uint32_t k = 0; k < changes; ++k) {
      const uint32_t from = static_cast<uint32_t>(h.lattice_offset);
      const uint32_t reach = random.below(2) == 0 ? static_cast<uint32_t>(sizeof(LatticeHeader)) : size - from;
      good.bytes()[from + random.below(reach)] = static_cast<std::byte>(random.below(256));
    }
    good.seal();
    const auto opened = open_character(good.bytes(), Limits{});
    if (!opened.ok()) continue;
    ++accepted;
    solve_once(opened.value().lattice);
  }
  EXPECT_GT(accepted, 100);
  EXPECT_LT(accepted, 2900);
}

}  // namespace
}  // namespace nt::test
