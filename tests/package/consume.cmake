# Configures, builds and runs the program in consumer/ against the library, taken by <WAY>, and reads its output.
file(REMOVE_RECURSE "${WORK_DIR}")
if(WAY STREQUAL "find_package")
  execute_process(COMMAND ${CMAKE_COMMAND} --install "${BINARY_DIR}" --prefix "${WORK_DIR}/installed"
    OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
  set(library "-Dsplinertia_ROOT=${WORK_DIR}/installed")
else()
  set(library "-DSPLINERTIA_SOURCE_DIR=${SOURCE_DIR}")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} -S "${CMAKE_CURRENT_LIST_DIR}/consumer" -B "${WORK_DIR}/build" -G "${GENERATOR}"
  "-DCMAKE_CXX_COMPILER=${COMPILER}" "-DCMAKE_CXX_FLAGS=${FLAGS}" ${library} ${DEPENDENCIES} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build "${WORK_DIR}/build" COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND "${WORK_DIR}/build/consumer" OUTPUT_VARIABLE output COMMAND_ERROR_IS_FATAL ANY)
if(NOT output STREQUAL "splinertia works: log(identity) = 0 0 0 0 0 0\n201 states, at rest\n")
  message(FATAL_ERROR "The consumer printed: ${output}")
endif()
