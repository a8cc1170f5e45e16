# Runs PROGRAM --csv --calls 100 ARGUMENTS and checks that every line is a figure, name,value,unit, and that FIGURES, which
# others look for, are there.
execute_process(COMMAND "${PROGRAM}" --csv --calls 100 ${ARGUMENTS}
  RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE errors)
if(NOT result STREQUAL "0" OR NOT errors STREQUAL "")
  message(FATAL_ERROR "exit code ${result}\n${errors}")
endif()

set(number "[0-9]+([.][0-9]+)?(e[-+][0-9]+)?")
string(REGEX REPLACE "\n$" "" text "${text}")
string(REPLACE "\n" ";" lines "${text}")
foreach(line IN LISTS lines)
  if(NOT line MATCHES "^([A-Za-z0-9_]+),(${number}),[A-Za-z0-9/]+$")
    message(FATAL_ERROR "not a figure: ${line}")
  endif()
  set(value_of_${CMAKE_MATCH_1} "${CMAKE_MATCH_2}")
endforeach()

foreach(name IN LISTS FIGURES)
  if(NOT value_of_${name} MATCHES "[1-9]")
    message(FATAL_ERROR "${name} is '${value_of_${name}}', expected a positive number")
  endif()
endforeach()
