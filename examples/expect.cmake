# SPDX-License-Identifier: MIT
# Runs a program; fails unless it ends with 0 and prints what the expression says.
#   cmake -Dprogram=PATH -Dexpected=REGEX -P expect.cmake
execute_process(COMMAND "${program}" RESULT_VARIABLE status OUTPUT_VARIABLE printed
  OUTPUT_STRIP_TRAILING_WHITESPACE)
if(NOT status EQUAL 0 OR NOT printed MATCHES "${expected}")
  message(FATAL_ERROR "status ${status}, printed:\n${printed}\nexpected:\n${expected}")
endif()
