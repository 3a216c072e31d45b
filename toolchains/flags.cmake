# SPDX-License-Identifier: Apache-2.0
# Flags for every target. Floating point is the same everywhere: no contraction to fused multiply-add, no fast-math.
add_compile_options(-Wall -Wextra -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64")
  # The x86-64 baseline would make Highway scalar.
  add_compile_options(-march=${NEONTETRA_X86_LEVEL})
  if(NEONTETRA_X86_LEVEL STREQUAL "x86-64-v3")
    # Highway's AVX2 target wants these too; every processor of that level has them.
    add_compile_options(-maes -mpclmul)
  endif()
endif()
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "aarch64")
  # Highway 1.0.3 marks its NEON operations +crypto, and they are inlined only into code of the same target. Core calls
  # none of the AES instructions, and compilers do not make them up, so a Raspberry Pi 4, which lacks them, is fine.
  add_compile_options(-march=armv8-a+crypto)
endif()
if(CMAKE_SYSTEM_PROCESSOR STREQUAL "armv7")
  # Debian's armhf compiler leaves NEON out, and Highway would be scalar. GCC itself does float arithmetic with VFP, as IEEE 754
  # says; Highway's float operations are NEON's, which take denormal numbers for zero (docs/ARCHITECTURE.md).
  # Highway names the type __fp16. GCC would note at each function with 64-bit values that GCC 6 had passed them otherwise.
  add_compile_options(-march=armv7-a+neon-vfpv4 -mfpu=auto -mfloat-abi=hard -mfp16-format=ieee -Wno-psabi)
  add_compile_definitions(_FILE_OFFSET_BITS=64)  # videos and takes of more than 2 GB
endif()
if(NEONTETRA_DETERMINISTIC)
  # Highway's scalar target: one lane, no vector instructions. The golden tests then show that results depend neither on
  # the instruction set nor on the number of lanes.
  add_compile_definitions(HWY_COMPILE_ONLY_SCALAR)
endif()
if(NEONTETRA_SANITIZE STREQUAL "address")
  # vptr needs RTTI, which core does without.
  add_compile_options(-fsanitize=address,undefined -fno-sanitize=vptr -fno-sanitize-recover=undefined
                      -fno-omit-frame-pointer)
  add_link_options(-fsanitize=address,undefined)
elseif(NEONTETRA_SANITIZE STREQUAL "thread")
  add_compile_options(-fsanitize=thread)
  add_link_options(-fsanitize=thread)
endif()
if(NEONTETRA_SANITIZE)
  # A sanitizer calls dlopen in the program's place, so only the old kind of run path, which holds for all, finds modules. Said
  # last, for a library asks for the new kind.
  string(APPEND CMAKE_CXX_STANDARD_LIBRARIES " -Wl,--disable-new-dtags")
endif()
