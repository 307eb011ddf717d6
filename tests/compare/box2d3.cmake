# SPDX-License-Identifier: MIT
# Sets GJK_COMPARE_BOX2D3 to the sources of Box2D 3 inside the Rust crate boxdd-sys, fetched by cargo into its own cache.
find_program(CARGO cargo)
if(NOT CARGO)
  message(STATUS "cargo is not installed: no Box2D 3 by way of it")
  return()
endif()
set(crate "${CMAKE_CURRENT_BINARY_DIR}/box2d3")
file(WRITE "${crate}/src/lib.rs" "")
file(WRITE "${crate}/Cargo.toml" "[package]\nname = \"fetch\"\nversion = \"0.0.0\"\nedition = \"2021\"\n
[dependencies]\nboxdd-sys = \"=0.6.0\"\n\n[workspace]\n")
execute_process(COMMAND "${CARGO}" metadata --quiet --format-version 1 --manifest-path "${crate}/Cargo.toml"
  OUTPUT_VARIABLE metadata ERROR_VARIABLE problem RESULT_VARIABLE failed)
string(REGEX MATCH "\"manifest_path\":\"([^\"]*boxdd-sys-[^\"]*)/Cargo.toml\"" found "${metadata}")
if(failed OR NOT found)
  message(STATUS "cargo could not fetch boxdd-sys: no Box2D 3 by way of it\n${problem}")
  return()
endif()
set(GJK_COMPARE_BOX2D3 "${CMAKE_MATCH_1}/third-party/box2d")
