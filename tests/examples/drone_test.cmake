# Runs drone: in a banked turn the specific force is along z, sqrt(g^2 + (v^2/r)^2), but for what smoothing leaves; the
# gyro sees the yaw rate of 0.5 rad/s, shared by y and z. The cubic's jerk jumps at knots, the quintic's does not, and
# the specific force jumps by rounding only.
cmake_minimum_required(VERSION 3.22)
execute_process(COMMAND "${PROGRAM}" RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
set(rounding "[0-9]e-1[3-9]|0e[+]00")
foreach(pattern IN ITEMS
    "10[.]1203 m/s.2"
    "cubic .order 4., 9[.]25 s.*1[.]00 +-?0[.]0000 +-0[.]1235 +0[.]4845 +-?0[.]0000 +-0[.]0032 +10[.]1195"
    "cubic.*force jumps by (${rounding}) m/s.2, the jerk by 2e-01.*quintic"
    "quintic .order 6., 8[.]75 s.*force jumps by (${rounding}) m/s.2, the jerk by (${rounding}) m/s.3")
  if(NOT result EQUAL 0 OR NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "drone: exit code ${result}, expected 0 and to match ${pattern}, printed\n${text}")
  endif()
endforeach()
