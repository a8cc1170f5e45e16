# Runs PROGRAM, whose SOURCE ends in a comment that says what it prints:
#   // prints
#   // the first line
# Each line of the comment, without "// ", must be what is printed, and nothing else may be.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND "${PROGRAM}" RESULT_VARIABLE result OUTPUT_VARIABLE printed ERROR_VARIABLE errors)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${PROGRAM}: exit code ${result}, printed\n${printed}${errors}")
endif()
file(READ "${SOURCE}" source)
string(FIND "${source}" "\n// prints\n" begin)
if(begin EQUAL -1)
  message(FATAL_ERROR "${SOURCE}: expected a comment at the end, of a line \"// prints\" and what is printed")
endif()
string(SUBSTRING "${source}" ${begin} -1 comment)
string(REGEX REPLACE "^\n// prints\n" "\n" comment "${comment}")
string(REGEX REPLACE "\n// ?" "\n" expected "${comment}")
string(REGEX REPLACE "^\n" "" expected "${expected}")
if(NOT printed STREQUAL expected)
  message(FATAL_ERROR "${SOURCE} says\n${expected}but it printed\n${printed}")
endif()
message("${printed}")
