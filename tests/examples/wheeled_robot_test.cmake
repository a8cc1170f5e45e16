# Runs wheeled_robot: speed 0.5 m/s throughout, 0.8 rad/s in the turn (wheels at 0.5 -+ 0.8 * 0.2 m/s), and no sideways
# velocity but for rounding where the commands do not change. 16 steps of 0.2 s turn it by 2.56 rad = 146.7 degrees.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND "${PROGRAM}" RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
foreach(pattern IN ITEMS
    "is 32 bytes, 3 degrees"
    "\n 3[.]48 .* 0[.]5000 +-?0[.]0000 +0[.]8000 +0[.]340 0[.]660"
    "\n 5[.]80 +0[.]642 +1[.]477 +146[.]7 +0[.]5000 +-?0[.]0000 +-?0[.]0000"
    "at most 0[.]007[0-9] m/s .*, ([0-9]e-1[4-9]|0e[+]00) m/s within")
  if(NOT result EQUAL 0 OR NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "wheeled_robot: exit code ${result}, expected 0 and to match ${pattern}, printed\n${text}")
  endif()
endforeach()
