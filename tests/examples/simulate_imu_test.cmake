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

# The main job on the ellipse. Euler is off by 0.392 m and midpoint by 0.00074 m, from exact samples.
run(0 "ideal  Euler +0[.]392 .*ideal  Midpoint +0[.]00074.*noisy  Euler .*noisy  Midpoint" --output "${out}" --csv "${out}/table.csv")
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

# The same seed gives the same bytes, another seed others.
file(SHA256 "${out}/imu.csv" first)
run(0 "seed 0" --output "${out}/a")
file(SHA256 "${out}/a/imu.csv" again)
expect_equal(${again} ${first})
run(0 "seed 1" --output "${out}/b" --seed 1)
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
      run(0 "801 poses over 4 s, longest gap 0.005 s.*order ${order} on .*ideal  Midpoint +[0-9.e-]+" "${out}/circle/${file}"
        --output "${out}/again" --group ${group} --order ${order} --gravity 9.81)
    endforeach()
  endforeach()
endforeach()

run(0 "Usage:.*--rate.*--gyro-noise.*--seed" --help)

# What it must refuse: one line that says what and where, exit code 2, and nothing written.
set(refused "${out}/refused")
function(refuse pattern)
  run(2 "${pattern}" ${ARGN} --output "${refused}")
  file(GLOB left "${refused}/*")
  if(left)
    message(FATAL_ERROR "simulate_imu ${ARGN} left ${left}")
  endif()
endfunction()
function(refuse_file pattern name text)
  file(WRITE "${out}/${name}" "${text}")
  refuse("${name}${pattern}" "${out}/${name}" ${ARGN})
endfunction()

set(pose "0 0 0 0 0 0 1")
refuse("none.tum: .*[Nn]o such file" "${out}/none.tum")
refuse_file(": no rows, expected" empty.tum "")
refuse_file(":2: .*column" columns.tum "1.0 ${pose}\n1.1 0 0 0\n")
refuse_file(":2: .*nan" nan.tum "1.0 ${pose}\n1.1 nan 0 0 0 0 0 1\n")
refuse_file(":3: time 1.1 follows 1.1, expected increasing" stamps.tum "1.0 ${pose}\n1.1 ${pose}\n1.1 ${pose}\n")
refuse_file(":2: quaternion .*norm 0" zero.tum "1.0 ${pose}\n1.1 0 0 0 0 0 0 0\n")
refuse_file(": 3 poses, expected at least 4" few.tum "1.0 ${pose}\n1.1 ${pose}\n1.2 ${pose}\n")
refuse_file(": the poses span 0.2 s, which gives 3 control points 0.1 s apart, expected at least 4" short.tum "1.0 ${pose}\n1.1 ${pose}\n1.15 ${pose}\n1.2 ${pose}\n"
  --knot-interval 0.1)
refuse("rate is -5 Hz, expected a positive" --rate -5)
refuse("rate is 0 Hz, expected a positive" --rate 0)
refuse("WhiteNoise: density is -1, expected" --gyro-noise -1)
refuse("RandomWalk: density is nan, expected" --accel-walk nan)
refuse("--duration: -1, expected a positive" --duration -1)
refuse("--knot-interval: 0, expected" "${out}/circle/poses.tum" --knot-interval 0)
refuse("--gravity: 2 numbers, expected 1 or 3" --gravity 0 9.81)
refuse("--order" "${out}/circle/poses.tum" --order 9)
refuse("--group" "${out}/circle/poses.tum" --group so4)
refuse("--motion" --motion spiral)
refuse("--rate" --rate fast)
run(2 "poses.tum/sub: cannot create this folder" --output "${out}/poses.tum/sub")   # a file is in the way
run(2 "no/table.csv: .*No such file" --output "${refused}" --csv "${out}/no/table.csv")
file(GLOB left "${refused}/*")
if(left)
  message(FATAL_ERROR "a table that cannot be written left ${left}")
endif()

# Real trajectories.
if(EXISTS "${SHARED_DATA_DIR}")
  run(0 "16702 poses over 83.505 s.*ideal  Midpoint" "${SHARED_DATA_DIR}/euroc_V1_02_medium_gt.csv" --output "${out}/V1_02")
  run(0 "3000 poses over 30.0896 s, longest gap 0.1101 s.*ideal  Midpoint" "${SHARED_DATA_DIR}/tum_freiburg1_xyz_gt.txt"
    --output "${out}/freiburg1_xyz" --group se3)
else()
  message("skipped: real trajectories, because there is no folder ${SHARED_DATA_DIR}")
endif()
