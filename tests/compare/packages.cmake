# SPDX-License-Identifier: MIT
# Peers that are brought as packages, when they are asked for; each by itself, and missing where that fails.
if(NOT GJK_COMPARE_PACKAGES)
  foreach(name parry)
    no_peer(${name} "set GJK_COMPARE_PACKAGES to ON")
  endforeach()
  return()
endif()

build_crate(parry libparry_peer.a parry3d)
if(parry_library)
  find_package(Threads REQUIRED)
  peer(parry peer_parry.c "${parry_version}, from its crates" "${parry_library}" Threads::Threads ${CMAKE_DL_LIBS} m)
else()
  no_peer(parry "${parry_why}")
endif()
