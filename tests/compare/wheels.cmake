# SPDX-License-Identifier: MIT
# Peers that pip brings: headers and libraries lie in their wheels.

# Sets <name>_site to the folder that the wheels of these packages are unpacked to, in an environment of their own, and
# <name>_version to that of the first; else <name>_why.
function(fetch_wheels name)
  set(environment "${CMAKE_CURRENT_BINARY_DIR}/${name}")
  execute_process(COMMAND "${Python3_EXECUTABLE}" -m venv "${environment}" ERROR_VARIABLE problem OUTPUT_VARIABLE problem
    RESULT_VARIABLE failed)
  if(NOT failed)
    execute_process(COMMAND "${environment}/bin/pip" install --quiet --disable-pip-version-check ${ARGN}
      ERROR_VARIABLE problem RESULT_VARIABLE failed)
  endif()
  file(GLOB site "${environment}/lib/python3*/site-packages")
  if(failed OR NOT site)
    message(STATUS "pip could not bring ${name}\n${problem}")
    set(${name}_why "pip could not bring it" PARENT_SCOPE)
    return()
  endif()
  list(GET ARGN 0 first)
  string(REGEX REPLACE ".*==" "" version "${first}")
  set(${name}_version "${version}" PARENT_SCOPE)
  set(${name}_site "${site}" PARENT_SCOPE)
endfunction()
