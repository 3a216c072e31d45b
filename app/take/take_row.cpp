// SPDX-License-Identifier: Apache-2.0
#include "app/take/take_row.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace nt {
namespace {

static_assert(std::endian::native == std::endian::little, "rows are little-endian");

// The order of a row's numbers, for writing (M = const TakeFrame) and reading alike.
template <typename M, typename Visit>
void visit(M& frame, int u_num, int l_num, const Visit& number) {
  const auto point = [&](auto& p) { number(p.x), number(p.y); };
  auto& m = frame.motion;
  number(frame.init_len);
  point(m.centre), number(m.dir_rad);
  number(m.head_angle), number(m.tail_angle), number(m.l_fin_angle), number(m.r_fin_angle);
  for (int i = 0; i < u_num; ++i) number(m.up_axis_angle[i]);
  for (int i = 0; i < l_num; ++i) number(m.low_axis_angle[i]);
  auto& c = m.confidence;
  number(c.centre), number(c.head), number(c.tail), number(c.l_fin), number(c.r_fin), number(c.axis);
  auto& p = frame.pose;
  point(p.centre), point(p.dir), point(p.head), point(p.tail), point(p.l_fin), point(p.r_fin);
  point(p.jun_tl), point(p.jun_tr), point(p.jun_bl), point(p.jun_br);
  for (int i = 0; i < u_num; ++i) point(p.up_axis[i]);
  for (int i = 0; i < l_num; ++i) point(p.low_axis[i]);
  number(p.axis_len);
}

}  // namespace

std::size_t take_row_size(int u_num, int l_num) {
  std::size_t numbers = 0;
  const TakeFrame none;
  visit(none, u_num, l_num, [&](float) { ++numbers; });
  return numbers * sizeof(float);
}

void write_take_row(const TakeFrame& frame, std::vector<std::byte>& row) {
  row.resize(take_row_size(frame.motion.u_num, frame.motion.l_num));
  std::byte* to = row.data();
  visit(frame, frame.motion.u_num, frame.motion.l_num, [&](float value) {
    std::memcpy(to, &value, sizeof value);
    to += sizeof value;
  });
}

bool read_take_row(std::span<const std::byte> row, int u_num, int l_num, TakeFrame& frame) {
  if (row.size() != take_row_size(u_num, l_num)) return false;
  const std::byte* from = row.data();
  bool finite = true;
  visit(frame, u_num, l_num, [&](float& value) {
    std::memcpy(&value, from, sizeof value);
    finite &= std::isfinite(value);
    from += sizeof value;
  });
  frame.motion.u_num = frame.pose.u_num = u_num;
  frame.motion.l_num = frame.pose.l_num = l_num;
  frame.pose.confidence = frame.motion.confidence;
  return finite;
}

}  // namespace nt
