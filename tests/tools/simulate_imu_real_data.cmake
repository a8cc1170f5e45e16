# Runs simulate_imu along recorded trajectories.
# Real data: euroc_V1_02_medium_gt.csv tum_freiburg1_xyz_gt.txt
cmake_minimum_required(VERSION 3.22)
set(out "${WORK_DIR}/out")
file(REMOVE_RECURSE "${out}")
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

run(0 "16702 poses over 83.50499[0-9]* s.*ideal  Midpoint" "${TEST_DATA}/euroc_V1_02_medium_gt.csv" --output "${out}/V1_02")
run(0 "3000 poses over 30.0896[0-9]* s .*, longest interval 0.1101 s.*ideal  Midpoint" "${TEST_DATA}/tum_freiburg1_xyz_gt.txt"
  --output "${out}/freiburg1_xyz" --group se3)
