# SPDX-License-Identifier: MIT
# find_package(gjk): gjk::gjk, the shared library where it was built, and gjk::static.
include("${CMAKE_CURRENT_LIST_DIR}/gjkTargets.cmake")
if(NOT TARGET gjk::gjk)
  add_library(gjk::gjk INTERFACE IMPORTED)
  set_target_properties(gjk::gjk PROPERTIES INTERFACE_LINK_LIBRARIES gjk::static)
endif()
