# Runs own_group: a curve over control points of one twist is that motion, so after 1.3 s the scale is exp(0.13) and the
# angle 0.52 rad; everything else is off by no more than what central differences of step 1e-5 are (truncation 1e-10,
# rounding 1e-11, times derivatives of up to 100).
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND "${PROGRAM}" RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
set(rounding "[0-9]e-1[4-9]|0e[+]00")
set(small "[0-9]e-(09|1[0-9])|0e[+]00")
foreach(pattern IN ITEMS
    "scale 1[.]138828, angle 0[.]520000 rad at .1[.]144356, 1[.]022673."
    "velocity 1[.]000000 0[.]500000 0[.]100000 0[.]400000"
    "value off by (${rounding}), velocity by (${rounding})"
    "velocity off by (${small}), acceleration by (${small}), Jacobians of the velocity by (${small})\n")
  if(NOT result EQUAL 0 OR NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "own_group: exit code ${result}, expected 0 and to match ${pattern}, printed\n${text}")
  endif()
endforeach()
