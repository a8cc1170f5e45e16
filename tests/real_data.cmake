# Tests on recorded data, which is not in the repository: each is a ctest entry of its own, skipped where a file that it
# names is absent. Included by CMakeLists.txt; run as a script by the tests, with COMMAND and the paths DATA.
if(CMAKE_SCRIPT_MODE_FILE)
  foreach(path IN LISTS DATA)
    if(NOT EXISTS "${path}")
      message("skipped: there is no ${path}")
      return()
    endif()
  endforeach()
  execute_process(COMMAND ${COMMAND} RESULT_VARIABLE result)
  if(NOT result STREQUAL "0")
    message(FATAL_ERROR "exit code ${result}")
  endif()
  return()
endif()

set(SPLINERTIA_TEST_DATA "${PROJECT_SOURCE_DIR}/../shared/data" CACHE PATH
  "Folder of recorded data; tests of files that are not there are skipped")

# splinertia_real_data_test(<name> <source> <command...>): what the source needs is said by its line "Real data: PATH...".
function(splinertia_real_data_test name source)
  file(STRINGS "${source}" line LIMIT_COUNT 1 REGEX "^(//|#) Real data: ")
  if(NOT line)
    message(FATAL_ERROR "${source}: expected a line \"Real data: PATH...\"")
  endif()
  string(REGEX REPLACE "^(//|#) Real data: " "" data "${line}")
  separate_arguments(data)
  list(TRANSFORM data PREPEND "${SPLINERTIA_TEST_DATA}/")
  add_test(NAME ${name} COMMAND ${CMAKE_COMMAND} -D "DATA=${data}" -D "COMMAND=${ARGN}"
    -P "${PROJECT_SOURCE_DIR}/tests/real_data.cmake")
  set_tests_properties(${name} PROPERTIES SKIP_REGULAR_EXPRESSION "^skipped: ")
endfunction()
