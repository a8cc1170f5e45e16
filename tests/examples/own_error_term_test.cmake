# Runs own_error_term: in 600 s an axis jumps 120 times on average, with standard deviation 11.
cmake_minimum_required(VERSION 3.22)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
run(0 "  popcorn noise: height 0.01 rad/s, mean dwell time 5 s\n.*\n([89][0-9]|1[0-5][0-9]) jumps in 120001 samples\na thermometer is up to 0.5 degC off")
