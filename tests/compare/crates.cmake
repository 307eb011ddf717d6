# SPDX-License-Identifier: MIT
# Peers that cargo brings, under the names of their packages.
find_program(CARGO cargo)

# Sets <name>_dir to where the crate lies, fetched by cargo into its own cache; else it stays as it was, and why is
# said in <name>_why.
function(fetch_crate name version)
  if(NOT CARGO)
    set(${name}_why "cargo is not installed" PARENT_SCOPE)
    return()
  endif()
  set(crate "${CMAKE_CURRENT_BINARY_DIR}/${name}")
  file(WRITE "${crate}/src/lib.rs" "")
  file(WRITE "${crate}/Cargo.toml" "[package]\nname = \"fetch\"\nversion = \"0.0.0\"\nedition = \"2021\"\n
[dependencies]\n${name} = \"=${version}\"\n\n[workspace]\n")
  execute_process(COMMAND "${CARGO}" metadata --quiet --format-version 1 --manifest-path "${crate}/Cargo.toml"
    OUTPUT_VARIABLE metadata ERROR_VARIABLE problem RESULT_VARIABLE failed)
  string(REGEX MATCH "\"manifest_path\":\"([^\"]*/${name}-[^\"]*)/Cargo.toml\"" found "${metadata}")
  if(failed OR NOT found)
    message(STATUS "cargo could not fetch ${name}\n${problem}")
    set(${name}_why "cargo could not fetch ${name}" PARENT_SCOPE)
    return()
  endif()
  set(${name}_dir "${CMAKE_MATCH_1}" PARENT_SCOPE)
endfunction()

# Sets <name>_library to the static library of the crate in the folder <name>, built by cargo now, so that it is missing
# where that fails, and <name>_version to that of the package in it.
function(build_crate name library package)
  if(NOT CARGO)
    set(${name}_why "cargo is not installed" PARENT_SCOPE)
    return()
  endif()
  set(built "${CMAKE_CURRENT_BINARY_DIR}/${name}")
  message(STATUS "Peer ${name}: cargo builds it")
  execute_process(COMMAND "${CARGO}" build --quiet --release --locked --target-dir "${built}"
    --manifest-path "${CMAKE_CURRENT_SOURCE_DIR}/${name}/Cargo.toml"
    ERROR_VARIABLE problem RESULT_VARIABLE failed)
  if(failed)
    message(STATUS "cargo could not build ${name}\n${problem}")
    string(REGEX MATCH "[^ \n]+ requires rustc [0-9.]+" needs "${problem}") # which rustup brings
    string(JOIN ": " why "cargo could not build it" ${needs})
    set(${name}_why "${why}" PARENT_SCOPE)
    return()
  endif()
  file(READ "${CMAKE_CURRENT_SOURCE_DIR}/${name}/Cargo.lock" lock)
  string(REGEX MATCH "name = \"${package}\"\nversion = \"([^\"]*)\"" found "${lock}")
  set(${name}_version "${CMAKE_MATCH_1}" PARENT_SCOPE)
  set(${name}_library "${built}/release/${library}" PARENT_SCOPE)
endfunction()
