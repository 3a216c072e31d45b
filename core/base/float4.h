// SPDX-License-Identifier: Apache-2.0
// Four floats that are worked on lane by lane: a point with a spare lane, or one value for each of four vertices.
//
// Not Highway, because its scalar target, which the deterministic build uses, has no vector of four lanes, and a solver
// that keeps x, y, z in one vector needs exactly four everywhere. GCC's and Clang's vector extension gives SSE, NEON or
// plain code; every operation is IEEE 754's on each lane, so all targets give the same bits. The deterministic build
// takes the plain struct, which shows that.
// No reductions across lanes here: a caller that needs one adds the lanes in order.
#pragma once
#include <cstddef>
#include <cstring>

#include "core/base/vec3.h"

namespace nt {

#if defined(HWY_COMPILE_ONLY_SCALAR)
struct Float4 {
  float lane[4];
  float& operator[](int i) { return lane[i]; }
  float operator[](int i) const { return lane[i]; }
};
#define NT_FLOAT4_OPERATOR(op)                                                                                 \
  inline Float4 operator op(Float4 a, Float4 b) {                                                              \
    return {{a.lane[0] op b.lane[0], a.lane[1] op b.lane[1], a.lane[2] op b.lane[2], a.lane[3] op b.lane[3]}}; \
  }
NT_FLOAT4_OPERATOR(+)
NT_FLOAT4_OPERATOR(-)
NT_FLOAT4_OPERATOR(*)
NT_FLOAT4_OPERATOR(/)
#undef NT_FLOAT4_OPERATOR
inline Float4& operator+=(Float4& a, Float4 b) { return a = a + b; }
inline Float4& operator-=(Float4& a, Float4 b) { return a = a - b; }
inline Float4 splat4(float v) { return {{v, v, v, v}}; }
inline Float4 make4(float a, float b, float c, float d) { return {{a, b, c, d}}; }
template <int kA, int kB, int kC, int kD>
Float4 shuffle4(Float4 a, Float4 b) {  // lanes 0 to 3 are a's, 4 to 7 are b's
  const float both[8] = {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]};
  return {{both[kA], both[kB], both[kC], both[kD]}};
}
#else
typedef float Float4 __attribute__((vector_size(16)));
inline Float4 splat4(float v) { return Float4{v, v, v, v}; }
inline Float4 make4(float a, float b, float c, float d) { return Float4{a, b, c, d}; }
template <int kA, int kB, int kC, int kD>
Float4 shuffle4(Float4 a, Float4 b) {  // lanes 0 to 3 are a's, 4 to 7 are b's
  return __builtin_shufflevector(a, b, kA, kB, kC, kD);
}
#endif

template <int kLane>
Float4 broadcast4(Float4 v) {
  return shuffle4<kLane, kLane, kLane, kLane>(v, v);
}
// Any address; 16 bytes are read or written.
inline Float4 load4(const float* from) {
  Float4 v;
  std::memcpy(&v, from, sizeof v);
  return v;
}
inline void store4(float* to, Float4 v) { std::memcpy(to, &v, sizeof v); }
inline Vec3 xyz(Float4 v) { return {v[0], v[1], v[2]}; }
inline Float4 to4(Vec3 v) { return make4(v.x, v.y, v.z, 0.0f); }
inline Float4 sqrt4(Float4 v) { return make4(det::sqrt(v[0]), det::sqrt(v[1]), det::sqrt(v[2]), det::sqrt(v[3])); }

// Rows become columns.
inline void transpose4(Float4& a, Float4& b, Float4& c, Float4& d) {
  const Float4 ab_low = shuffle4<0, 4, 1, 5>(a, b), ab_high = shuffle4<2, 6, 3, 7>(a, b);
  const Float4 cd_low = shuffle4<0, 4, 1, 5>(c, d), cd_high = shuffle4<2, 6, 3, 7>(c, d);
  a = shuffle4<0, 1, 4, 5>(ab_low, cd_low);
  b = shuffle4<2, 3, 6, 7>(ab_low, cd_low);
  c = shuffle4<0, 1, 4, 5>(ab_high, cd_high);
  d = shuffle4<2, 3, 6, 7>(ab_high, cd_high);
}

}  // namespace nt
