# Compares compare_trajectories with evo (pip install evo), and with definitions, on a recorded trajectory.
# Real data: euroc_V1_02_medium_gt.csv
cmake_minimum_required(VERSION 3.22)
set(out "${WORK_DIR}/out")
file(REMOVE_RECURSE "${out}")
file(MAKE_DIRECTORY "${out}")
include("${CMAKE_CURRENT_LIST_DIR}/compare_in_python.cmake")
if(NOT EVO_APE OR NOT PYTHON)
  message("skipped: evo_ape is not installed")
  return()
endif()

set(recorded "${TEST_DATA}/euroc_V1_02_medium_gt.csv")
compare_in_python(compare_with_evo.py "${EVO_APE}" "${out}" "${recorded}" perturb)
compare_in_python(compare_by_definition.py "${out}" "${recorded}" "${out}/perturbed.tum" 5 20 50)
