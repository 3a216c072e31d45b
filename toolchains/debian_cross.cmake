# SPDX-License-Identifier: Apache-2.0
# Included by the toolchain file of one architecture: Linux with Debian's cross compiler; programs run here under QEMU user mode.
# In: CMAKE_SYSTEM_PROCESSOR, `triplet` (Debian's multiarch name), `emulator` (QEMU's).
# NEONTETRA_SYSROOT: a folder with Debian's packages of that architecture unpacked (toolchains/make_sysroot.sh makes one), for the
# whole program; without it only what needs no library, core and the tank, can be built.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_C_COMPILER ${triplet}-gcc)
set(CMAKE_CXX_COMPILER ${triplet}-g++)
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES NEONTETRA_SYSROOT)
if(NEONTETRA_SYSROOT)
  set(CMAKE_SYSROOT ${NEONTETRA_SYSROOT})
  set(CMAKE_LIBRARY_ARCHITECTURE ${triplet})
  set(ENV{PKG_CONFIG_SYSROOT_DIR} ${NEONTETRA_SYSROOT})
  set(ENV{PKG_CONFIG_LIBDIR} ${NEONTETRA_SYSROOT}/usr/lib/${triplet}/pkgconfig:${NEONTETRA_SYSROOT}/usr/share/pkgconfig)
  set(root ${NEONTETRA_SYSROOT})
  # Libraries in folders of their own (BLAS, LAPACK, PulseAudio) are found by the loader's configuration, not by the linker.
  set(CMAKE_EXE_LINKER_FLAGS_INIT "-Wl,--allow-shlib-undefined -Wl,-rpath-link,${root}/usr/lib/${triplet}")
  set(CMAKE_MODULE_LINKER_FLAGS_INIT "${CMAKE_EXE_LINKER_FLAGS_INIT}")
else()
  set(root /usr/${triplet})
endif()
set(CMAKE_FIND_ROOT_PATH ${root})
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
set(CMAKE_FIND_ROOT_PATH_MODE_LIBRARY ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_INCLUDE ONLY)
set(CMAKE_FIND_ROOT_PATH_MODE_PACKAGE BOTH)
find_program(NEONTETRA_QEMU_${CMAKE_SYSTEM_PROCESSOR} NAMES ${emulator} ${emulator}-static)
if(NEONTETRA_QEMU_${CMAKE_SYSTEM_PROCESSOR})
  set(CMAKE_CROSSCOMPILING_EMULATOR ${NEONTETRA_QEMU_${CMAKE_SYSTEM_PROCESSOR}} -L ${root})
endif()
