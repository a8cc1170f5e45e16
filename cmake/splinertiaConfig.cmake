include("${CMAKE_CURRENT_LIST_DIR}/SplinertiaFindDependencies.cmake")
if(NOT splinertia_missing)
  include("${CMAKE_CURRENT_LIST_DIR}/splinertiaTargets.cmake")
endif()
