# SPDX-License-Identifier: Apache-2.0
# 64-bit ARM: Raspberry Pi 3 and later with a 64-bit Debian, and the like.
set(CMAKE_SYSTEM_PROCESSOR aarch64)
set(triplet aarch64-linux-gnu)
set(emulator qemu-aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/debian_cross.cmake)
