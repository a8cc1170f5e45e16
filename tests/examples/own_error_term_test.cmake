# Runs own_error_term: of 12001 samples each sticks with probability 0.01, which makes 120 with standard deviation 11.
cmake_minimum_required(VERSION 3.22)
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
run(0 "  sticking: probability 0.01\naccel:.*[^0-9]([89]|1[0-5])[0-9] of 12001 gyroscope readings repeat the one before")
