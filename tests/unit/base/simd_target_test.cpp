// SPDX-License-Identifier: Apache-2.0
#include "core/base/simd_target.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <string>

#include "hwy/highway.h"

// A wrong -march builds scalar code without a word.
TEST(SimdTarget, IsTheOneThatThisBuildIsFor) {
  const std::string target = nt::simd_target();
#if defined(HWY_COMPILE_ONLY_SCALAR)
  EXPECT_EQ(target, "SCALAR");
#elif HWY_ARCH_ARM
  EXPECT_EQ(target, "NEON");
#else
  EXPECT_TRUE(target == "SSSE3" || target == "SSE4" || target == "AVX2" || target == "AVX3" || target == "AVX3_DL")
      << target;
#endif
}

TEST(SimdTarget, WorksOnSixteenBytesOrMoreAtOnce) {
#if defined(HWY_COMPILE_ONLY_SCALAR)
  EXPECT_EQ(HWY_LANES(uint8_t), 1u);
#else
  EXPECT_GE(HWY_LANES(uint8_t), 16u);
#endif
}
