# SPDX-License-Identifier: MIT
# Peers that are brought as packages, when they are asked for; each by itself, and missing where that fails.
if(NOT GJK_COMPARE_PACKAGES)
  foreach(name parry jolt coal mujoco)
    no_peer(${name} "set GJK_COMPARE_PACKAGES to ON")
  endforeach()
  return()
endif()
include(wheels.cmake)

build_crate(parry libparry_peer.a parry3d)
if(parry_library)
  find_package(Threads REQUIRED)
  peer(parry peer_parry.c "${parry_version}, from its crates" "${parry_library}" Threads::Threads ${CMAKE_DL_LIBS} m)
else()
  no_peer(parry "${parry_why}")
endif()

# Its GJK and EPA lie in headers.
fetch_crate(joltc-sys 0.3.1)
if(joltc-sys_dir AND CMAKE_CXX_COMPILER)
  set(jolt "${joltc-sys_dir}/JoltC/JoltPhysics")
  get_filename_component(crate "${joltc-sys_dir}" NAME)
  string(REGEX MATCH "Jolt-([0-9.]+)" found "${crate}")
  peer(jolt peer_jolt.cpp "${CMAKE_MATCH_1}, from the crate ${crate}")
  target_include_directories(peer_jolt SYSTEM PRIVATE "${jolt}")
  set_target_properties(peer_jolt PROPERTIES CXX_STANDARD 17)
else()
  no_peer(jolt "${joltc-sys_why}")
endif()

# Its own packages, with the Eigen that they are compiled with.
fetch_wheels(coal libcoal==3.0.3 cmeel-eigen)
find_library(COAL_LIBRARY coal PATHS "${coal_site}/cmeel.prefix/lib" NO_DEFAULT_PATH)
if(COAL_LIBRARY AND CMAKE_CXX_COMPILER)
  peer(coal peer_coal.cpp "${coal_version} of PyPI" "${COAL_LIBRARY}")
  target_include_directories(peer_coal SYSTEM PRIVATE "${coal_site}/cmeel.prefix/include"
    "${coal_site}/cmeel.prefix/include/eigen3")
  set_target_properties(peer_coal PROPERTIES CXX_STANDARD 17)
else()
  no_peer(coal "${coal_why}")
endif()

# The library alone, without what its bindings need.
fetch_wheels(mujoco mujoco-core==4.0.0 --no-deps)
file(GLOB mujoco_library "${mujoco_site}/mujoco/libmujoco.so.*")
if(mujoco_site AND mujoco_library)
  peer(mujoco peer_mujoco.c "${mujoco_version} of PyPI" "${mujoco_library}")
  target_include_directories(peer_mujoco SYSTEM PRIVATE "${mujoco_site}/mujoco/include")
else()
  no_peer(mujoco "${mujoco_why}")
endif()
