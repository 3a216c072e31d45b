# SPDX-License-Identifier: Apache-2.0
# 32-bit ARM with NEON and VFPv4 (Cortex-A7 and later: Raspberry Pi 2 and later) and Debian's armhf. Boards without NEON, which
# Debian's armhf still allows, are not supported.
set(CMAKE_SYSTEM_PROCESSOR armv7)
set(triplet arm-linux-gnueabihf)
set(emulator qemu-arm)
include(${CMAKE_CURRENT_LIST_DIR}/debian_cross.cmake)
