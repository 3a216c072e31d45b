# SPDX-License-Identifier: Apache-2.0
# Run by CPack when the files to be packed are in place: which Debian packages their libraries come from.
#
# The program, windows and cameras: Depends. What reads and writes videos, pictures and meshes brings 300 packages, and a board
# that only watches a camera does without: Recommends, which apt installs unless it is told not to.
# In a cross build the packages are looked up among those of the sysroot (toolchains/make_sysroot.sh).
file(GLOB_RECURSE modules ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/libneontetra_*.so)
file(GLOB_RECURSE program ${CPACK_TEMPORARY_INSTALL_DIRECTORY}/*/bin/neontetra)
set(needed ${program})
set(recommended "")
foreach(module ${modules})
  if(module MATCHES "libneontetra_(codecs|libcamera)")
    list(APPEND recommended -dRecommends -e${module})
  else()
    list(APPEND needed ${module})
  endif()
endforeach()
list(TRANSFORM needed PREPEND "-e")

set(options "")
if(CPACK_NEONTETRA_SYSROOT)
  set(dpkg ${CPACK_NEONTETRA_SYSROOT}/var/lib/dpkg)
  list(APPEND options --admindir=${dpkg} -L${dpkg}/shlibs -l${CPACK_NEONTETRA_SYSROOT}/usr/lib/${CPACK_NEONTETRA_TRIPLET})
endif()

# dpkg-shlibdeps wants a source package around it.
set(place ${CPACK_TOPLEVEL_DIRECTORY}/shlibdeps)
file(MAKE_DIRECTORY ${place}/debian)
file(WRITE ${place}/debian/control "Source: neontetra\n\nPackage: neontetra\nArchitecture: any\n")
execute_process(COMMAND dpkg-shlibdeps ${options} -O -dDepends ${needed} ${recommended}
                WORKING_DIRECTORY ${place} OUTPUT_VARIABLE found ERROR_VARIABLE said RESULT_VARIABLE result)
if(NOT result EQUAL 0 OR NOT found MATCHES "shlibs:Depends=([^\n]+)")
  message(FATAL_ERROR "dpkg-shlibdeps: ${said}")
endif()
# The editors' font, and the drivers that EGL loads by name.
set(CPACK_DEBIAN_PACKAGE_DEPENDS "${CMAKE_MATCH_1}, fonts-dejavu-core, libegl-mesa0, libgl1-mesa-dri")
if(found MATCHES "shlibs:Recommends=([^\n]+)")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "${CMAKE_MATCH_1}")
endif()
message(STATUS "Depends: ${CPACK_DEBIAN_PACKAGE_DEPENDS}")
message(STATUS "Recommends: ${CPACK_DEBIAN_PACKAGE_RECOMMENDS}")
