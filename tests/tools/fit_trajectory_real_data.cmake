# Runs fit_trajectory on recorded trajectories, one with the IMU that flew along.
# Real data: euroc_V1_02_medium_gt.csv tum_freiburg1_xyz_gt.txt euroc_MH_05_pair/gt.csv euroc_MH_05_pair/imu0.txt
cmake_minimum_required(VERSION 3.22)
set(out "${WORK_DIR}/out")
file(REMOVE_RECURSE "${out}")
include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")
include("${CMAKE_CURRENT_LIST_DIR}/fit_trajectory_steps.cmake")

fit("16702 poses over .*1674 control points.*converged.*holes: none" "${TEST_DATA}/euroc_V1_02_medium_gt.csv" --knot-interval 0.05)
figures("position .m.")
expect(rms LESS 1e-4 AND max LESS 1e-3)
fit("3000 poses over .*longest interval 0.1101 s.*converged.*" "${TEST_DATA}/tum_freiburg1_xyz_gt.txt" --group se3 --knot-interval 0.05)
figures("position .m.")
expect(rms LESS 3e-4 AND max LESS 2e-3)
fit("22212 poses over .*79.[0-9]+ - 79.[0-9]+ s .[0-9]+ poses, up to 0.03[0-9]* m.*imu0.txt: 22[0-9]+ of 22721 samples" "${TEST_DATA}/euroc_MH_05_pair/gt.csv"
  --imu "${TEST_DATA}/euroc_MH_05_pair/imu0.txt" --knot-interval 0.05)
between("gyroscope bias" 1e-3 -0.0024 -0.0012 0.0203 0.0215 0.0763 0.0775)   # the file says -0.0018 0.0209 0.0769
