# Runs dead_reckon on what simulate_imu, which lies beside it, has written, and on everything
# that it must refuse.
cmake_minimum_required(VERSION 3.22)
set(out "${WORK_DIR}/out")
file(REMOVE_RECURSE "${out}")
file(MAKE_DIRECTORY "${out}")

include("${CMAKE_CURRENT_LIST_DIR}/run.cmake")

cmake_path(GET PROGRAM PARENT_PATH programs)
find_program(SIMULATE_IMU simulate_imu PATHS "${programs}" NO_DEFAULT_PATH REQUIRED)
function(simulate folder)
  execute_process(COMMAND "${SIMULATE_IMU}" --output "${out}/${folder}" ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "simulate_imu ${ARGN}: exit code ${result}\n${text}")
  endif()
endfunction()

include("${CMAKE_CURRENT_LIST_DIR}/dead_reckon_steps.cmake")

# An ideal IMU on the ellipse, 20 s at 200 Hz: what is left is the scheme's.
simulate(ideal --preset ideal)
set(ideal "${out}/ideal/imu.csv" "${out}/ideal/groundtruth.csv")
reckon("imu.csv: 4001 samples over 20 s\n.*groundtruth.csv: 4001 states over 20 s\nmidpoint, velocities from the trajectory file, biases from the trajectory file removed\n" ${ideal})
foreach(line RANGE 1 3)
  figures(${line})
  expect(skipped EQUAL 0 AND gaps EQUAL 0)
  expect(position_median LESS 1e-3 AND position_max LESS 1e-3 AND attitude_max LESS 1e-4)
  expect(position_median LESS_EQUAL position_90 AND position_90 LESS_EQUAL position_max)
  expect(attitude_median LESS_EQUAL attitude_90 AND attitude_90 LESS_EQUAL attitude_max)
endforeach()
# One after the other: 20 s hold six windows of 3 s, and two of 7 s. Windows that no sample ends are not made longer.
reckon("\n +3 +6 .*\n +7 +2 .*\n +20 +1 .*\n +0.005 +4000 " ${ideal} --windows 3 7 20 0.005)
run(2 "no window of 21 s in which both files have data: .*imu.csv covers 0 to 20000000000 ns, .*groundtruth.csv covers 0 to 20000000000 ns" ${ideal} --windows 1 21)
run(2 "no window of 0.004 s in" ${ideal} --windows 0.004)
run(2 "no window of 0.0125 s in" ${ideal} --windows 0.0125)

# Each scheme has its order.
foreach(scheme_and_bounds IN ITEMS "euler 1e-2 2e-2" "zero-order-hold 1e-2 2e-2" "midpoint 6e-5 7e-5" "trapezoid 3e-5 7e-5" "rk4 3e-5 7e-5"
    "rk4-double-step 0 1e-7" "magnus4 2e-9 4e-9")
  string(REPLACE " " ";" scheme_and_bounds "${scheme_and_bounds}")
  list(GET scheme_and_bounds 0 scheme)
  list(GET scheme_and_bounds 1 least)
  list(GET scheme_and_bounds 2 most)
  reckon("\n${scheme}, velocities" ${ideal} --scheme ${scheme} --windows 1)
  expect(runs EQUAL 20 AND position_median GREATER least AND position_max LESS most)
endforeach()

# Poses alone are truth, too: their velocities are as good as they are dense, and the two at the ends have none.
reckon("poses.tum: 3999 poses with a velocity from their neighbours over 19.99 s\nmidpoint, velocities from its poses, biases not removed\n" "${out}/ideal/imu.csv" "${out}/ideal/poses.tum" --windows 1)
expect(runs EQUAL 19 AND skipped EQUAL 1 AND position_max LESS 2e-4)
# Every seventh state, 35 ms apart: the truth in between is interpolated, the velocity linearly, to about 4 mm/s.
file(STRINGS "${out}/ideal/groundtruth.csv" truth)
set(sparse "")
set(poses "")
string(REPEAT ",[^,]*" 7 seven)
set(i 0)
foreach(row IN LISTS truth)
  math(EXPR kept "${i} % 7")
  if(kept EQUAL 1)
    string(APPEND sparse "${row}\n")
    string(REGEX REPLACE "^([^,]*${seven}).*" "\\1" row "${row}")
    string(APPEND poses "${row}\n")
  endif()
  math(EXPR i "${i} + 1")
endforeach()
file(WRITE "${out}/sparse.csv" "${sparse}")
file(WRITE "${out}/poses.csv" "#t [ns],x,y,z,qw,qx,qy,qz\n${poses}")
reckon("572 states" "${out}/ideal/imu.csv" "${out}/sparse.csv" --windows 1)
expect(runs EQUAL 19 AND position_max LESS 5e-3)
reckon("570 poses with a velocity from their neighbours .*velocities from its poses" "${out}/ideal/imu.csv" "${out}/poses.csv" --windows 1)
expect(runs EQUAL 19 AND position_max LESS 1.2e-2)
run(2 "poses.csv: expected three consecutive poses at most 0.02 s apart, to compute a velocity" "${out}/ideal/imu.csv" "${out}/poses.csv" --longest-gap 0.02)

# Biases are removed unless they are to be kept: 0.1 m/s^2 makes 0.05 m in a second, 0.01 rad/s on each axis
# a degree.
file(WRITE "${out}/biased.yaml" "gyro: [constant_bias: 0.01]\naccel: [constant_bias: [0.1, 0, 0]]\n")
simulate(biased --errors "${out}/biased.yaml")
set(biased "${out}/biased/imu.csv" "${out}/biased/groundtruth.csv")
reckon("biases from the trajectory file removed" ${biased} --windows 1)
expect(position_max LESS 1e-3 AND attitude_max LESS 1e-4)
reckon("biases not removed" ${biased} --windows 1 --keep-biases)
expect(position_median GREATER 0.04 AND position_median LESS 0.2 AND attitude_median GREATER 0.98 AND attitude_median LESS 1.0)

# Biases that are given instead, each for itself.
set(poses "${out}/biased/imu.csv" "${out}/biased/poses.tum")
reckon("velocities from its poses, biases not removed\n" ${poses} --windows 1)
expect(position_median GREATER 0.04 AND attitude_median GREATER 0.98)
reckon("velocities from its poses, gyro bias .0.01 0.01 0.01. rad/s from --gyro-bias removed, accel bias .0.1 0 0. m/s.2 from --accel-bias removed\n"
  ${poses} --windows 1 --gyro-bias 0.01 0.01 0.01 --accel-bias 0.1 0 0)
expect(position_max LESS 1e-3 AND attitude_max LESS 1e-4)
reckon("gyro bias .0.01 0.01 0.01. rad/s from --gyro-bias removed, accel bias not removed\n" ${poses} --windows 1 --gyro-bias 0.01 0.01 0.01)
expect(position_median GREATER 0.04 AND position_median LESS 0.06 AND attitude_max LESS 1e-4)
reckon("gyro bias from the trajectory file removed, accel bias .0 0 0. m/s.2 from --accel-bias removed\n" ${biased} --windows 1 --accel-bias 0 0 0)
expect(position_median GREATER 0.04 AND position_median LESS 0.06 AND attitude_max LESS 1e-4)
run(2 "--gyro-bias excludes --keep-biases" ${biased} --keep-biases --gyro-bias 0 0 0)

# A calibration file says all of it; options come before it, and it before the trajectory file.
set(calibration "gyro_bias: [0.01, 0.01, 0.01]
gyro_bias_standard_deviation: [0, 0, 0]
accel_bias: [0.1, 0, 0]
accel_bias_standard_deviation: [.inf, 0, 0]
gravity: [0, 0, -9.80665]
gravity_direction_standard_deviation: [0, 0]
lever_arm: [0.3, -0.2, 0.1]
lever_arm_standard_deviation: [0, 0, 0]
rotation: {w: 0.2, x: 0.4, y: 0.4, z: 0.8}
time_offset: 12.5 ms
time_offset_standard_deviation: 0
")
file(WRITE "${out}/calibration.yaml" "${calibration}")
find_program(PYTHON NAMES python3 python)
if(PYTHON)
  execute_process(COMMAND "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/move_truth.py" ${biased} "${out}/body.csv" "${out}/body.tum" RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "move_truth.py: exit code ${result}")
  endif()
  set(used "gyro bias .* from .*calibration.yaml removed, accel bias .* from .*calibration.yaml removed\ngravity .0 0 -9.80665. m/s.2 from .*calibration.yaml\nlever arm .0.3 -0.2 0.1. m from .*calibration.yaml. true states are moved to the IMU.*\nrotation vector of the IMU's axes .* deg\ntime offset 0.0125 s added to the IMU's times\n")
  foreach(truth IN ITEMS body.csv body.tum)
    set(moved "${out}/biased/imu.csv" "${out}/${truth}" --windows 1)
    set(body ${moved} --calibration "${out}/calibration.yaml")
    reckon("${used}" ${body})
    expect(position_max LESS 1e-3 AND attitude_max LESS 1e-2)
    # Without the lever arm, the time offset, gravity or the biases it is not as good.
    reckon("lever arm .0 0 0. m from --lever-arm" ${body} --lever-arm 0 0 0)
    expect(position_median GREATER 3e-3)
    reckon("gravity .0 0 -9.8. m/s.2 from --gravity" ${body} --gravity 9.8)
    expect(position_median GREATER 3e-3)
    reckon("gyro bias .0 0 0. rad/s from --gyro-bias removed, accel bias .* from .*calibration.yaml removed" ${body} --gyro-bias 0 0 0)
    expect(attitude_median GREATER 0.98)
    reckon("biases not removed\ngravity" ${body} --keep-biases)
    expect(attitude_median GREATER 0.98 AND position_median GREATER 0.04)
    string(REPLACE "12.5 ms" "0" other "${calibration}")
    file(WRITE "${out}/other.yaml" "${other}")
    reckon("lever arm" ${moved} --calibration "${out}/other.yaml")
    expect(position_median GREATER 3e-3)
  endforeach()
else()
  message("skipped: truth of a body, because Python is not installed")
endif()

# Another world: gravity as an amount along -z, or as a vector.
simulate(moon --preset ideal --gravity 0 0 -1.62)
foreach(gravity IN ITEMS "1.62" "0;0;-1.62")
  reckon("midpoint" "${out}/moon/imu.csv" "${out}/moon/groundtruth.csv" --windows 1 --gravity ${gravity})
  expect(position_max LESS 1e-3)
endforeach()
reckon("midpoint" "${out}/moon/imu.csv" "${out}/moon/groundtruth.csv" --windows 1)
expect(position_median GREATER 4 AND position_median LESS 4.2)   # (9.80665 - 1.62)/2

# without(<file> <pattern> <new file>): leaves out the lines that match.
function(without file pattern new)
  file(STRINGS "${file}" rows)
  list(FILTER rows EXCLUDE REGEX "${pattern}")
  list(JOIN rows "\n" rows)
  file(WRITE "${new}" "${rows}\n")
endfunction()

string(REPEAT "[0-9]" 8 ns8)
# No samples from 5.2 s to 5.5 s: refused, or integrated across and counted once for each length of windows.
without("${out}/ideal/imu.csv" "^5[234]${ns8}," "${out}/gap.csv")
run(2 "gap.csv: in the window of 1 s that begins at 5000000000: integrate: sample 40 at 5500000000 comes 0.305 s after the one before, expected at most 0.1 s" "${out}/gap.csv" "${out}/ideal/groundtruth.csv")
foreach(windows IN ITEMS "1" "1;5;10")
  reckon("\n1 s: gaps longer than 0.1 s that were bridged: 1\n" "${out}/gap.csv" "${out}/ideal/groundtruth.csv" --bridge-gaps --windows ${windows})
  expect(runs EQUAL 20 AND gaps EQUAL 1 AND skipped EQUAL 0 AND position_median LESS 1e-4 AND position_max GREATER 1e-3)
endforeach()
figures(3)
expect(gaps EQUAL 1)
reckon("midpoint" "${out}/gap.csv" "${out}/ideal/groundtruth.csv" --longest-gap 0.4 --windows 1)
expect(runs EQUAL 20 AND gaps EQUAL 0)
# A window that would end in the gap is not made longer or shorter.
without("${out}/ideal/imu.csv" "^(5[89]|6[01])${ns8}," "${out}/gap_at_end.csv")
reckon("windows skipped without a sample or a true state at their end: 1\n" "${out}/gap_at_end.csv" "${out}/ideal/groundtruth.csv" --bridge-gaps --windows 1)
expect(skipped EQUAL 1 AND runs EQUAL 18)

# No truth from 4 s to 5.5 s: windows neither begin nor end there.
without("${out}/ideal/groundtruth.csv" "^(4[0-9]|5[0-4])${ns8}," "${out}/hole.csv")
reckon("3701 states" "${out}/ideal/imu.csv" "${out}/hole.csv" --windows 1)
expect(skipped EQUAL 1 AND runs EQUAL 17 AND position_max LESS 1e-4)

# What it must refuse: one line that says what and where, exit code 2, and no table.
set(refuse_option --csv)
set(refuse_begin "")
set(refused "${out}/none.csv")
run(0 "Usage:.*imu.*trajectory.*--scheme.*euler.*magnus4.*--windows.*--longest-gap.*--bridge-gaps" --help)
refuse("imu" )
refuse("trajectory" "${out}/ideal/imu.csv")
refuse("none.csv: .*[Nn]o such file" "${out}/none.csv" "${out}/ideal/groundtruth.csv")
refuse("none.tum: .*[Nn]o such file" "${out}/ideal/imu.csv" "${out}/none.tum")
refuse("--scheme: heun not in" ${ideal} --scheme heun)
refuse("--windows: 0, expected positive" ${ideal} --windows 1 0)
refuse("--windows: -1, expected positive" ${ideal} --windows -1)
refuse("--windows: nan, expected positive" ${ideal} --windows nan)
refuse("--windows: inf, expected positive" ${ideal} --windows inf)
refuse("--windows" ${ideal} --windows long)
refuse("--longest-gap: 0, expected a positive" ${ideal} --longest-gap 0)
refuse("--longest-gap: nan, expected a positive" ${ideal} --longest-gap nan)
refuse("--gravity: 2 numbers, expected 1 or 3" ${ideal} --gravity 0 9.81)
refuse("--gravity: nan, expected finite" ${ideal} --gravity nan)
refuse("--gravity: -9.81, expected a magnitude >= 0, which acts along -z, or a vector x y z" ${ideal} --gravity -9.81)
foreach(option IN ITEMS gyro-bias accel-bias lever-arm)
  refuse("--${option}: 0 nan 1, expected finite numbers" ${ideal} --${option} 0 nan 1)
  refuse("--${option}" ${ideal} --${option} 0 1)
  refuse("--${option}" ${ideal} --${option} 0 1 x)
endforeach()
refuse("none.yaml: cannot read this file" ${ideal} --calibration "${out}/none.yaml")
string(REPLACE "[0.3, -0.2, 0.1]" "[0.3, -0.2]" other "${calibration}")
file(WRITE "${out}/other.yaml" "${other}")
refuse("other.yaml:7: lever_arm: 2 numbers, expected 3" ${ideal} --calibration "${out}/other.yaml")
reckon("\n +0.005 +4000 " ${ideal} --scheme magnus4 --windows 0.005)   # two samples each: the line in place of the cubic
set(sample "0 0 0 0 0 9.8")
file(WRITE "${out}/bad.txt" "1000000000 ${sample}\n1005000000 ${sample}\n1005000000 ${sample}\n")
refuse("bad.txt:3: time 1005000000 follows 1005000000, expected increasing" "${out}/bad.txt" "${out}/ideal/poses.tum")
file(WRITE "${out}/bad.txt" "1000000000 ${sample}\n1005000000 0 0 nan 0 0 9.8\n")
refuse("bad.txt:2: \"nan\" is not a finite number" "${out}/bad.txt" "${out}/ideal/poses.tum")
file(WRITE "${out}/bad.txt" "# nothing\n")
refuse("bad.txt:1: no rows" "${out}/bad.txt" "${out}/ideal/poses.tum")
file(WRITE "${out}/one.txt" "1000000000 ${sample}\n")
refuse("no window of 1 s in which both files have data" "${out}/one.txt" "${out}/ideal/poses.tum")
file(WRITE "${out}/late.txt" "100000000000 ${sample}\n100100000000 ${sample}\n")
refuse("no window of 1 s in which both files have data: .*late.txt covers 100000000000 to 100100000000 ns, .*poses.tum covers 5000000 to 19995000000 ns" "${out}/late.txt" "${out}/ideal/poses.tum")
file(WRITE "${out}/one.tum" "1.0 0 0 0 0 0 0 1\n")
refuse("one.tum: expected three consecutive poses" "${out}/ideal/imu.csv" "${out}/one.tum")
without("${out}/ideal/groundtruth.csv" "^4" "${out}/broken.csv")
file(APPEND "${out}/broken.csv" "30000000000,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,x\n")
refuse("broken.csv:[0-9]+: \"x\" is .*baz in column 17" "${out}/ideal/imu.csv" "${out}/broken.csv")
run(2 "no/table.csv: .*No such file" ${ideal} --csv "${out}/no/table.csv")
