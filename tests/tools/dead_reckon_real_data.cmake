# Runs dead_reckon on a recorded IMU, an ADIS16448 in the machine hall.
# Real data: euroc_MH_05_pair/imu0.txt euroc_MH_05_pair/gt.csv
cmake_minimum_required(VERSION 3.22)
set(out "${WORK_DIR}/out")
file(REMOVE_RECURSE "${out}")
file(MAKE_DIRECTORY "${out}")
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/dead_reckon_steps.cmake")

set(real "${TEST_DATA}/euroc_MH_05_pair")
reckon("22721 samples over 113.6 s\n.*22212 states over 111.055 s" "${real}/imu0.txt" "${real}/gt.csv" --windows 1 5)
expect(runs EQUAL 111 AND position_median GREATER 0.01 AND position_median LESS_EQUAL 0.03)
figures(2)
expect(runs EQUAL 22 AND position_median GREATER 0.1 AND position_median LESS_EQUAL 0.30)
