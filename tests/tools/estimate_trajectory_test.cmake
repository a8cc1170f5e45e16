# Runs estimate_trajectory: the errors that it starts with shrink to what the noise leaves, and bad input is refused.
cmake_minimum_required(VERSION 3.22)

include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

# expect_final(<table> <quantity> <limit>): the final error, in a csv file, must be below.
function(expect_final table quantity limit)
  file(STRINGS "${table}" line REGEX "^${quantity},")
  string(REPLACE "," ";" cells "${line}")
  list(LENGTH cells count)
  if(NOT count EQUAL 4)
    message(FATAL_ERROR "${table}: no row of ${quantity}")
  endif()
  list(GET cells 2 initial)
  list(GET cells 3 final)
  if(NOT final LESS limit OR NOT initial GREATER final)
    message(FATAL_ERROR "${quantity}: error ${initial} became ${final}, expected less than ${limit}")
  endif()
endfunction()

# Poses of 0.02 m and 0.57 deg, ten a second for ten seconds. Limits are about twice what a seed usually gives: a pose's
# noise over the square root of the few poses that tell about a stretch of the curve, and over √100 for the whole.
foreach(seed IN ITEMS 0 1 2)
  set(table "${WORK_DIR}/errors_${seed}.csv")
  run(0 "CONVERGENCE after [0-9] iterations, .* (0[.]9[0-9]+|1[.]0[0-9]+) per degree of freedom" --seed ${seed} --csv "${table}")
  expect_final("${table}" "position rms" 0.015)
  expect_final("${table}" "attitude rms" 0.25)
  expect_final("${table}" "velocity rms" 0.025)
  expect_final("${table}" "gyro bias" 0.003)
  expect_final("${table}" "accel bias" 0.06)
  expect_final("${table}" "gravity direction" 0.2)
endforeach()

# With next to no noise next to no error is left, from far away, too.
set(table "${WORK_DIR}/exact.csv")
run(0 "CONVERGENCE" --position-noise 1e-6 --attitude-noise 1e-6 --gyro-noise 1e-7 --accel-noise 1e-6 --gravity-tilt 60
  --duration 4 --csv "${table}")
expect_final("${table}" "position rms" 1e-5)
expect_final("${table}" "attitude rms" 1e-3)
expect_final("${table}" "gyro bias" 1e-5)
expect_final("${table}" "accel bias" 1e-4)
expect_final("${table}" "gravity direction" 1e-3)

# The same seed gives the same measurements, another seed others.
run(0 "seed 3" --seed 3)
set(first "${printed}")
run(0 "seed 3" --seed 3)
if(NOT printed STREQUAL first)
  message(FATAL_ERROR "the same seed gave\n${first}\nand then\n${printed}")
endif()

run(0 "Usage:.*--knot-interval.*--seed" --help)
run(2 "--duration: 0, expected a positive number" --duration 0)
run(2 "--knot-interval: 11, expected a positive number up to 10" --knot-interval 11)
run(2 "--imu-rate: nan, expected" --imu-rate nan)
run(2 "--gyro-noise: -1, expected" --gyro-noise -1)
run(2 "--gravity-tilt: 200, expected" --gravity-tilt 200)
run(2 "--pose-rate: 0.05 Hz gives fewer than 2 poses in 10 s" --pose-rate 0.05)
run(2 "no convergence" --iterations 1)
run(2 "--iterations" --iterations none)
run(2 "no/errors.csv: .*No such file" --csv "${WORK_DIR}/no/errors.csv")
run(2 "--seed: -1, expected a whole number" --seed -1)
run(2 "--seed: 18446744073709551616, expected a whole number" --seed 18446744073709551616)
