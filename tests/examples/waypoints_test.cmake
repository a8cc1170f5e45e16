# Runs waypoints: the curve goes through every one of them, its acceleration is zero at both ends, and it is as
# symmetric as they are.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND "${PROGRAM}" RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
foreach(pattern IN ITEMS
    "5 waypoints, 7 control points, 8 s"
    "\n 2[.]0 +4[.]00000 +-?0[.]00000 +1[.]8712 +1[.]2039\n"
    "\n 4[.]0 +6[.]00000 +3[.]00000 +1[.]8750 +1[.]2857\n 6[.]0 +4[.]00000 +6[.]00000 +1[.]8712 +1[.]2039\n"
    "\n 8[.]0 +-?0[.]00000 +6[.]00000 +2[.]1754 +0[.]0000\n"
    "within ([0-9]e-1[4-9]|0e[+]00) m of its waypoints, .* 0[.]80 m")
  if(NOT result EQUAL 0 OR NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "waypoints: exit code ${result}, expected 0 and to match ${pattern}, printed\n${text}")
  endif()
endforeach()
