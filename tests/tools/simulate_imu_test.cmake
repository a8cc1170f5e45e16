# Runs simulate_imu: the default motion, real trajectories where they are at hand, and everything that it must refuse.
cmake_minimum_required(VERSION 3.22)
set(out "${WORK_DIR}/out")
file(REMOVE_RECURSE "${out}")
file(MAKE_DIRECTORY "${out}")

include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

function(expect_equal got expected)
  if(NOT got STREQUAL expected)
    message(FATAL_ERROR "got ${got}, expected ${expected}")
  endif()
endfunction()

# The main job on the ellipse. Euler is off by 0.392 m and midpoint by 0.00067 m, from exact samples.
run(0 "ideal  Euler +0[.]392 .*ideal  Midpoint +0[.]00067.*noisy  Euler .*noisy  Midpoint" --preset course --output "${out}" --csv "${out}/table.csv")
file(STRINGS "${out}/imu.csv" imu)
list(LENGTH imu lines)
expect_equal(${lines} 4002)   # the header and both ends of 20 s at 200 Hz
file(STRINGS "${out}/groundtruth.csv" truth)
list(LENGTH truth lines)
expect_equal(${lines} 4002)
file(STRINGS "${out}/poses.tum" poses)
list(LENGTH poses lines)
expect_equal(${lines} 4001)
list(GET poses 4000 last)
if(NOT last MATCHES "^20[.]000000000 20([.]0*[0-9]?)? ")
  message(FATAL_ERROR "the ellipse ends at x = 20 m after 20 s, poses.tum says ${last}")
endif()
file(STRINGS "${out}/table.csv" table)
list(LENGTH table lines)
expect_equal(${lines} 5)

# The samples for NumPy, too: 56 bytes each behind a header that ends at a multiple of 64.
run(0 "wrote imu.csv, imu.npy, groundtruth.csv, poses.tum and imu.yaml to" --npy --duration 2 --output "${out}/npy")
file(SIZE "${out}/npy/imu.npy" bytes)
math(EXPR rest "(${bytes} - 401 * 56) % 64")
expect_equal(${rest} 0)
file(READ "${out}/npy/imu.npy" magic LIMIT 6 HEX)
expect_equal(${magic} 934e554d5059)

# The same seed gives the same bytes, another seed others.
file(SHA256 "${out}/imu.csv" first)
run(0 "seed 0" --preset course --output "${out}/a")
file(SHA256 "${out}/a/imu.csv" again)
expect_equal(${again} ${first})
run(0 "seed 1" --preset course --output "${out}/b" --seed 1)
file(SHA256 "${out}/b/imu.csv" other)
if(other STREQUAL first)
  message(FATAL_ERROR "another seed gave the same samples")
endif()

# Other motions; a body at rest integrates back exactly.
run(0 "rest: .*ideal  Euler +0 +0 +0 " --output "${out}/rest" --motion rest --duration 10)
run(0 "circle: .*801 samples" --output "${out}/circle" --motion circle --duration 4)
run(0 "coning: .*81 samples at 20 Hz" --output "${out}/coning" --motion coning --duration 4 --rate 20)

# What it writes it reads, in both formats, on either group, of any order.
foreach(file IN ITEMS groundtruth.csv poses.tum)
  foreach(group IN ITEMS split se3)
    foreach(order IN ITEMS 3 4 5 6)
      run(0 "801 poses over 4 s from 0 to 4000000000 ns, longest interval 0.005 s.*order ${order} on .*ideal  Midpoint +[0-9.e-]+" "${out}/circle/${file}"
        --output "${out}/again" --group ${group} --order ${order} --gravity 9.81)
    endforeach()
  endforeach()
endforeach()
# From the first pose to the last, through exact ones to much less than a micrometre.
run(0 "order 4 on .* 83 control points\nknots: uniform, 0.05 s apart\n.*\nposition .m. +[0-9.]+e-[01][0-9] +[0-9.]+e-[01][0-9] .*\nrotation .rad. +[0-9.]+e-[01][0-9] .*\n.omega. .rad/s. .*IMU: 801 samples"
  "${out}/circle/poses.tum" --output "${out}/again" --knot-interval 0.05)
file(STRINGS "${out}/again/poses.tum" poses)
list(GET poses 0 first_pose)
list(GET poses -1 last_pose)
if(NOT first_pose MATCHES "^0[.]000000000 " OR NOT last_pose MATCHES "^4[.]000000000 ")
  message(FATAL_ERROR "the curve should be from 0 to 4 s, is from\n${first_pose}\n${last_pose}")
endif()
# Poses that lie off, and half a second without any, are named.
file(STRINGS "${out}/circle/poses.tum" poses)
list(FILTER poses EXCLUDE REGEX "^2[.][0-4]")
list(TRANSFORM poses REPLACE "^(1[.]00[05]0* -?[0-9]+)[.]" "\\1.9")
list(JOIN poses "\n" damaged)
file(WRITE "${out}/damaged.tum" "${damaged}\n")
run(0 "701 poses over 4 s .*longest interval 0.505 s\n.*poses deviate by more than 6 standard deviations.*\n  [01][.][0-9]+ - 1[.][0-9]+ s .*\nholes: 1 span without poses.*\n  1.995 - 2.500 s\n.*IMU: 801 samples .*\nsamples in holes are left out of all files; --keep-holes keeps them:\n  1.995 - 2.500 s: 100 samples\nwrote imu.csv, imu.npy, groundtruth.csv, poses.tum and gaps.csv.*\nIntegrated back from the true initial state, and from the truth again after each hole:\n"
  "${out}/damaged.tum" --output "${out}/again" --preset ideal --npy)
# rows(<file> <count>): it has so many rows, none of them between 1.995 and 2.5 s unless there are 801.
function(rows file count)
  file(STRINGS "${out}/again/${file}" all REGEX "^[0-9]")
  list(LENGTH all size)
  expect_equal("${file}: ${size}" "${file}: ${count}")
  if(count EQUAL 701)
    list(FILTER all INCLUDE REGEX "^2([.][0-4]|[0-4][0-9][0-9][0-9][0-9][0-9][0-9][0-9][0-9],)")
    expect_equal("${all}" "")
  endif()
endfunction()
foreach(file IN ITEMS imu.csv groundtruth.csv poses.tum)
  rows(${file} 701)
endforeach()
file(STRINGS "${out}/again/gaps.csv" spans)
expect_equal("${spans}" "#start [ns],end [ns],length [s];1995000000,2500000000,0.505")
file(STRINGS "${out}/again/imu.csv" comments REGEX "^# ")
expect_equal("${comments}" "")
run(0 "samples in holes are invented; comments in imu.csv mark them:\n  1.995 - 2.500 s: 100 samples\n.*\nIntegrated back from the true initial state:\n" "${out}/damaged.tum" --output "${out}/again" --keep-holes)
foreach(file IN ITEMS imu.csv groundtruth.csv poses.tum)
  rows(${file} 801)
endforeach()
file(STRINGS "${out}/again/imu.csv" comments REGEX "^# ")
expect_equal("${comments}" "# hole from 1995000000 to 2500000000 ns: no poses, the readings in it are invented")
file(WRITE "${out}/dropped.yaml" "stamps: [dropped_samples: 0.999999999]\n")
run(2 "simulate_imu: none of 801 samples is left: 701 dropped, 100 in holes without poses" "${out}/damaged.tum" --output "${out}/none" --errors "${out}/dropped.yaml")
run(0 "wrote imu.csv" "${out}/circle/poses.tum" --output "${out}/again")
if(EXISTS "${out}/again/gaps.csv")
  message(FATAL_ERROR "gaps.csv of an earlier run is left")
endif()
# The options of the fit are those of fit_trajectory.
run(0 "knots: uniform, .*, the longest with residuals of at most 0.0001 m and 0.001 rad" "${out}/circle/poses.tum" --output "${out}/again" --goal-position 1e-4 --goal-rotation 1e-3)
run(0 "knots: non-uniform, " "${out}/circle/poses.tum" --output "${out}/again" --adaptive --goal-position 1e-4 --goal-rotation 1e-3)
run(0 "fit: through every pose" "${out}/circle/poses.tum" --output "${out}/again" --interpolate --group se3)
run(0 "cross-validation\n" "${out}/circle/poses.tum" --output "${out}/again" --cross-validate)
run(0 "fit: cauchy, smoothed as if the acceleration were white noise of 3 m and 3 rad .*as given: x y z 0.001 0.001 0.001 m, 0.002" "${out}/damaged.tum" --output "${out}/again"
  --loss cauchy --deviation-position 1e-3 --deviation-rotation 2e-3 --smooth-position 3 --smooth-rotation 3 --outlier-limit 5)
run(3 "NOT CONVERGED.*simulate_imu: the fit has not converged: 2 linear systems were not enough .--most-iterations.; nothing is written .--accept" "${out}/circle/poses.tum" --output "${out}/unfinished" --most-iterations 2)
if(EXISTS "${out}/unfinished")
  message(FATAL_ERROR "a fit that has not converged was written")
endif()
run(0 "NOT CONVERGED.*wrote imu.csv" "${out}/circle/poses.tum" --output "${out}/unfinished" --most-iterations 2 --accept)
# Sparse poses have knots further apart than close ones.
list(FILTER poses INCLUDE REGEX "^[0-9][.][0-9]0* ")
list(JOIN poses "\n" sparse)
file(WRITE "${out}/sparse.tum" "${sparse}\n")
run(0 "knots: uniform, 0.2[0-9]* s apart .chosen: longer intervals would miss motion above the noise of the poses." "${out}/sparse.tum" --output "${out}/again")

run(0 "Usage:.*--rate.*--gyro-noise.*--seed" --help)

# The errors of an IMU: known ones, from Kalibr's file, and a list of terms. What is the same makes the same samples.
run(0 "random walk: density 1.9393e-05 .*white noise: density 0.002 " --duration 2 --output "${out}/usual")
foreach(preset IN ITEMS course course-quiet mpu6050 adis16448 stim300 euroc ideal)
  run(0 "noisy  Midpoint +[0-9.e+-]+" --preset ${preset} --duration 2 --output "${out}/${preset}")
endforeach()
run(0 "gyro:\n  ideal\naccel:\n  ideal\n.*wrote imu.csv, groundtruth.csv and poses.tum to" --preset ideal --duration 2 --output "${out}/ideal")
function(expect_same_samples folder)
  file(SHA256 "${out}/${folder}/imu.csv" samples)
  expect_equal(${samples} ${first})
endfunction()
file(READ "${out}/imu.yaml" kalibr)
if(NOT kalibr MATCHES "rostopic: /imu0\nupdate_rate: 200.0 .*accelerometer_noise_density: 0.019 .*accelerometer_random_walk: 0.0005 .*gyroscope_noise_density: 0.015 .*gyroscope_random_walk: 5.0e-05 ")
  message(FATAL_ERROR "imu.yaml is\n${kalibr}")
endif()
run(0 "4001 samples at 200 Hz" --kalibr "${out}/imu.yaml" --output "${out}/kalibr")
expect_same_samples(kalibr)
run(0 "41 samples at 20 Hz" --kalibr "${out}/imu.yaml" --rate 20 --duration 2 --output "${out}/kalibr20")
# The same noise from the files of other estimators: VINS' are per sample, 0.0125 = 0.1/sqrt(64).
file(WRITE "${out}/orbslam3.yaml" "%YAML:1.0\n\nCamera.type: \"PinHole\"\nIMU.NoiseGyro: 0.015\nIMU.NoiseAcc: 0.019\nIMU.GyroWalk: 5.0e-05\nIMU.AccWalk: 5.0e-4\nIMU.Frequency: 200.0\n")
run(0 "4001 samples at 200 Hz" --imu-noise "${out}/orbslam3.yaml" --output "${out}/orbslam3")
expect_same_samples(orbslam3)
file(WRITE "${out}/vins.yaml" "%YAML:1.0\n\nimu: 1\nacc_n: 0.1\ngyr_n: 0.01\nacc_w: 0.001\ngyr_w: 0.0001\n")
run(0 "129 samples at 64 Hz.*gyro:\n  random walk: density 1.25e-05 .*white noise: density 0.00125 .*accel:\n  random walk: density 0.000125 .*white noise: density 0.0125 "
  --imu-noise "${out}/vins.yaml" --rate 64 --duration 2 --output "${out}/vins")
file(WRITE "${out}/course.yaml" "gyro: [random_walk: 5e-5, white_noise: 0.015]\naccel:\n  - random_walk: {density: [5e-4, 5e-4, 0.5e-3]}\n  - white_noise: {density: 0.019}\n")
run(0 "4001 samples at 200 Hz" --errors "${out}/course.yaml" --output "${out}/course_yaml")
expect_same_samples(course_yaml)
run(0 "white noise: density 0.015 rad" --preset course-quiet --gyro-noise 0.015 --gyro-walk 5e-5 --accel-noise 0.019 --accel-walk 5e-4
  --output "${out}/by_hand")
expect_same_samples(by_hand)

# All that Kalibr writes after a calibration.
file(WRITE "${out}/calibrated.yaml" "imu0:
  model: scale-misalignment
  T_i_b: [[1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]]
  time_offset: 0.0
  gyroscope_noise_density: 0.0001
  gyroscope_random_walk: 1.0e-05
  accelerometer_noise_density: 0.001
  accelerometer_random_walk: 0.0002
  update_rate: 100.0
  rostopic: /imu
  accelerometers:
    M:
    - [1.01, 0.0, 0.0]
    - [0.001, 1.0, 0.0]
    - [0.0, 0.002, 1.0]
  gyroscopes:
    A: [[0.001, 0, 0], [0, 0.002, 0], [0, 0, 0.003]]
    C_gyro_i: [[0, 1, 0], [-1, 0, 0], [0, 0, 1]]
    M: [[2, 0, 0], [0, 1, 0], [0, 0, 1]]
")
run(0 "201 samples at 100 Hz.*misalignment: matrix .0 2 0; -1 0 0; 0 0 1.\n  g-sensitivity: sensitivity .0 0.001 0; -0.002 0 0; 0 0 0.003. rad/s/.m/s.2.\n  random walk: density 1e-05 .*accel:\n  misalignment: matrix .1.01 0 0; 0.001 1 0; 0 0.002 1."
  --kalibr "${out}/calibrated.yaml" --duration 2 --output "${out}/calibrated")

# Every term that there is, the help says which, in the order of the file.
run(0 "white_noise: density.*dropped_samples: probability" --help-errors)
string(REGEX MATCHALL "  [a-z_]+:" terms "${printed}")
list(LENGTH terms count)
expect_equal(${count} 30)
file(WRITE "${out}/all.yaml" "# comments, and the units of data sheets
gyro:
  - second_order_bandwidth: {natural_frequency: 80, damping_ratio: 0.7}
  - first_order_bandwidth: 0.2 kHz
  - misalignment: {percent: [[0.1, 0.05, 0], [0, 0.1, 0], [0, 0, 0.1]]}
  - misalignment: {matrix: [[1, 0, 0], [0.001, 1, 0], [0, 0, 1]]}
  - scale_factor: [0.1 %, 500 ppm, 0]
  - scale_factor_asymmetry: 200 ppm
  - vibration_rectification: 1e-6
  - g_sensitivity: 0.015 deg/s/g
  - g_squared_sensitivity: [1e-6, 0, 0]
  - size_effect: [[0.001, 0, 0], [0, 0.001, 0], [0, 0, 0.002]]
  - temperature_scale: {coefficient: 40 ppm, initial_temperature: 20, final_temperature: 45, time_constant: 300}
  - temperature_bias: {coefficient: 0.005 deg/s, initial_temperature: 45, reference_temperature: 20}
  - constant_bias: [1 deg/s, 0, 0]
  - turn_on_bias: 0.5 deg/s
  - random_walk: 5e-5
  - gauss_markov: {standard_deviation: 1e-3, correlation_time: [100, 100, 0.1 h], initial_value: 0}
  - bias_instability: {floor: 14.5 deg/h, longest: 1 h}
  - bias_instability: 1e-4
  - rate_ramp: 1e-6
  - sinusoidal_vibration: {amplitude: 0.01, frequency: [30, 30, 60]}
  - random_vibration: {standard_deviation: 0.01, natural_frequency: 40, damping_ratio: 0.1}
  - white_noise: 0.66 deg/sqrt(h)
  - correlated_noise: {density: 1e-5, correlation: [[1, 0.5, 0], [0.5, 1, 0], [0, 0, 1]]}
  - quantization_noise: 1e-6
  - spikes: {probability: 0.1 %, standard_deviation: 0.1}
  - stuck_readings: {probability: 0.001, mean_length: 3}
  - quantization: 0.04 deg/s
  - saturation: 1000 deg/s
stamps:
  - clock_offset: 3 ms
  - clock_drift: 20 ppm
  - stamp_jitter: 0.2 ms
  - dropped_samples: 0.01
")
run(0 "second-order bandwidth: natural frequency 80 Hz, damping ratio 0.7\n  first-order bandwidth: cutoff frequency 200 Hz\n.*correlated noise: density 1e-05 .*stuck readings: probability 0.001, mean length 3 samples\n.*saturation: limit 17.45[0-9]* rad/s\naccel:\n  ideal\nstamps:\n  clock offset: offset 0.003 s\n.*\n[2-6][0-9] samples were dropped"
  --errors "${out}/all.yaml" --output "${out}/all")
file(STRINGS "${out}/all/imu.csv" imu)
file(STRINGS "${out}/all/groundtruth.csv" truth)
list(LENGTH imu samples)
list(LENGTH truth lines)
expect_equal(${samples} ${lines})
list(GET imu 1 imu)
list(GET truth 1 truth)
if(NOT imu MATCHES "^[234][0-9][0-9][0-9][0-9][0-9][0-9]," OR NOT truth MATCHES "^0,")
  message(FATAL_ERROR "the first stamp should be about 3 ms late:\n${imu}\n${truth}")
endif()

# Stamps that jitter by a fifth of the interval and by two keep their order in the file.
foreach(jitter IN ITEMS 1 10)
  file(WRITE "${out}/jitter.yaml" "stamps: [stamp_jitter: ${jitter} ms]\n")
  run(0 "12001 samples" --errors "${out}/jitter.yaml" --duration 60 --output "${out}/jitter")
endforeach()

# What it must refuse: one line that says what and where, exit code 2, and nothing written.
set(refused "${out}/refused")
set(refuse_begin "")

set(pose "0 0 0 0 0 0 1")
refuse("none.tum: .*[Nn]o such file" "${out}/none.tum")
refuse_file(": no rows, expected" empty.tum "")
refuse_file(":2: .*column" columns.tum "1.0 ${pose}\n1.1 0 0 0\n")
refuse_file(":2: .*nan" nan.tum "1.0 ${pose}\n1.1 nan 0 0 0 0 0 1\n")
refuse_file(":3: time 1.1 s follows 1.1 s in line 2, expected increasing" stamps.tum "1.0 ${pose}\n1.1 ${pose}\n1.1 ${pose}\n")
refuse_file(":2: quaternion .*norm 0" zero.tum "1.0 ${pose}\n1.1 0 0 0 0 0 0 0\n")
refuse_file(": 1 pose, expected at least 2" few.tum "1.0 ${pose}\n")
refuse("--rate: -5 Hz, expected a positive" --rate -5)
refuse("--rate: 0 Hz, expected a positive" --rate 0)
refuse("--rate: 3e.09 Hz, expected a positive number up to 1e9" --rate 3e9)
refuse("--rate: 1e.08 Hz for 20 s makes 2e.09 samples, expected less than 1e9" --rate 1e8)
refuse("--rate: 1 Hz for 1e.09 s makes 1e.09 samples, expected less than 1e9" --rate 1 --duration 1e9)
refuse("--duration: 1e.10, expected a positive number of seconds up to 9" --duration 1e10 --rate 1e-9)
refuse("--seed: -1, expected a whole number from 0 to 18446744073709551615" --seed -1)
refuse("--seed: 18446744073709551616, expected a whole number" --seed 18446744073709551616)
refuse("--seed: 1.5, expected a whole number" --seed 1.5)
refuse("--gravity: -9.81, expected a magnitude >= 0" --gravity -9.81)
refuse("--smooth-position.*requires.*--deviation|--smooth-position requires" "${out}/circle/poses.tum" --smooth-position 1)
refuse("--knot-interval and --interpolate: expected one way" "${out}/circle/poses.tum" --knot-interval 1 --interpolate)
foreach(option IN ITEMS "--loss cauchy" "--order 4" "--keep-holes" "--accept")
  string(REPLACE " " ";" option "${option}")
  refuse("requires trajectory" ${option})   # an analytic motion is exact
endforeach()
refuse("WhiteNoise: density is -1, expected" --gyro-noise -1)
refuse("RandomWalk: density is nan, expected" --accel-walk nan)
refuse("--duration: -1, expected a positive" --duration -1)
refuse("--knot-interval: 0, expected" "${out}/circle/poses.tum" --knot-interval 0)
refuse("--gravity: 2 numbers, expected 1 or 3" --gravity 0 9.81)
refuse("--order" "${out}/circle/poses.tum" --order 9)
refuse("--group" "${out}/circle/poses.tum" --group so4)
refuse("--motion" --motion spiral)
refuse("--rate" --rate fast)
run(0 "seed 18446744073709551615" --seed 18446744073709551615 --duration 1 --output "${out}/seed")
run(2 "poses.tum/sub: cannot create this folder" --output "${out}/poses.tum/sub")   # a file is in the way
run(2 "no/table.csv: .*No such file" --output "${refused}" --csv "${out}/no/table.csv")
file(GLOB left "${refused}/*")
if(left)
  message(FATAL_ERROR "a table that cannot be written left ${left}")
endif()

run(2 "imu.csv: is written twice, expected a path for each file" --duration 1 --output "${out}/same" --csv "${out}/same/imu.csv")

# A disk that is full: nothing of the old set is lost.
run(0 "wrote" --duration 1 --output "${out}/full")
file(SHA256 "${out}/full/imu.csv" before)
execute_process(COMMAND sh -c "ulimit -f 20; \"$@\"" sh "${PROGRAM}" --duration 5 --output "${out}/full"
  RESULT_VARIABLE result OUTPUT_QUIET ERROR_VARIABLE error)
file(SHA256 "${out}/full/imu.csv" after)
if(NOT (result EQUAL 1 AND error MATCHES "^simulate_imu: .*cannot write: File too large\n$" AND before STREQUAL after))
  message(FATAL_ERROR "a full disk: exit code ${result}, expected 1 and the old files, printed ${error}")
endif()

# Error files that are none.
function(refuse_errors pattern text)
  file(WRITE "${out}/errors.yaml" "${text}\n")
  refuse("errors.yaml${pattern}" --errors "${out}/errors.yaml")
endfunction()
refuse("none.yaml: cannot read this file" --errors "${out}/none.yaml")
refuse_errors(": expected a map" "")
refuse_errors(":1: unknown giro, expected accel, gyro, stamps" "giro: []")
refuse_errors(":[12]: not YAML: " "gyro: [")
refuse_errors(":2: unknown term white_nose, expected constant_bias, .*white_noise" "gyro:\n  - white_nose: 1")
refuse_errors(":1: WhiteNoise: density is -1, expected a finite number >= 0" "gyro: [white_noise: -1]")
refuse_errors(":1: .nan, expected a finite number" "gyro: [white_noise: .nan]")
refuse_errors(":1: 1 furlong: unknown unit furlong, expected none .SI. or one of .*deg/h" "gyro: [white_noise: 1 furlong]")
refuse_errors(":1: much is not a number" "gyro: [white_noise: much]")
refuse_errors(":1: 2 numbers, expected one, or one for each of 3 axes" "gyro: [white_noise: [1, 2]]")
refuse_errors(":1: no correlation_time, expected" "gyro: [gauss_markov: {standard_deviation: 1}]")
refuse_errors(":1: no correlation_time, expected a map" "gyro: [gauss_markov: 1]")
refuse_errors(":1: GaussMarkov: correlation time is 0, expected a finite number > 0" "gyro: [gauss_markov: {standard_deviation: 1, correlation_time: 0}]")
refuse_errors(":1: unknown densty, expected density" "gyro: [white_noise: {density: 1, densty: 2}]")
refuse_errors(":1: Misalignment: determinant of the matrix.* is 0, expected a matrix that can be inverted" "gyro: [misalignment: {matrix: 0}]")
refuse_errors(":3: Saturation: limit is 1, expected at least" "accel:\n  - quantization: 2\n  - saturation: 1")
refuse_errors(":1: unknown term white_noise, expected clock_offset" "stamps: [white_noise: 1]")
refuse_errors(":2: 2 keys, expected a list of terms" "gyro:\n  - {white_noise: 1, random_walk: 1}")
file(WRITE "${out}/kalibr_bad.yaml" "gyroscope_noise_density: 0.0001\ngyroscope_random_walk: 0\n")
refuse("kalibr_bad.yaml:2: gyroscope_random_walk is 0, expected a number > 0" --kalibr "${out}/kalibr_bad.yaml")
file(WRITE "${out}/kalibr_bad.yaml" "gyroscope_noise_density: 0.0001\n")
refuse("kalibr_bad.yaml:1: no gyroscope_random_walk, expected one" --kalibr "${out}/kalibr_bad.yaml")
file(READ "${out}/imu.yaml" kalibr)
file(WRITE "${out}/twice.yaml" "${kalibr}update_rate: 100.0\n")
refuse("twice.yaml:[0-9]+: update_rate is given twice, expected it once" --kalibr "${out}/twice.yaml")
file(WRITE "${out}/no_noise.yaml" "model: none\n")
refuse("no_noise.yaml:1: no IMU noise, expected the keys of Kalibr or OpenVINS .*, VINS .*, ORB-SLAM3 .*, GTSAM" --imu-noise "${out}/no_noise.yaml")
refuse("vins.yaml:[0-9]+: no update_rate, expected one or --rate" --imu-noise "${out}/vins.yaml")
refuse("--errors.*--imu-noise|--imu-noise.*--errors" --kalibr "${out}/imu.yaml" --errors "${out}/all.yaml")
refuse("--preset" --preset imaginary)
