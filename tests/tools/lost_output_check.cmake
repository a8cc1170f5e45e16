# Runs every program and script with a standard output that is full, closed, or a pipe without a reader. Lost output is
# an error: exit code 1 and one line that says so. PROGRAMS: the paths of all. PYTHON runs those that end in .py.
cmake_minimum_required(VERSION 3.22)
if(NOT EXISTS /dev/full)
  message("skipped: there is no /dev/full")
  return()
endif()
file(REMOVE_RECURSE "${WORK_DIR}")
file(MAKE_DIRECTORY "${WORK_DIR}")

set(reason "standard output cannot be written")   # what is left of it where more than a buffer was printed
function(command_of program)   # in <command>, and the name that messages begin with in <name>
  cmake_path(GET program FILENAME name)
  set(command "${program}")
  if(program MATCHES "[.]py$")
    set(command "${PYTHON}" "${program}")
  endif()
  set(name "${name}" PARENT_SCOPE)
  set(command "${command}" PARENT_SCOPE)
endfunction()

# expect_lost(<how> <message> <program> <shell> <arguments...>): the shell runs its arguments in "$@".
function(expect_lost how message program shell)
  command_of("${program}")
  execute_process(COMMAND sh -c "${shell}" sh ${command} ${ARGN} WORKING_DIRECTORY "${WORK_DIR}"
    RESULT_VARIABLE result OUTPUT_VARIABLE printed ERROR_VARIABLE error)
  if(NOT (result EQUAL 1 AND error MATCHES "${message}" AND printed STREQUAL ""))
    message(SEND_ERROR "${name} ${ARGN}, standard output ${how}: exit code ${result}, expected 1 and ${message}, printed ${error}${printed}")
  endif()
endfunction()
function(expect_full program)
  command_of("${program}")
  expect_lost("full" "^${name}: (${reason}|(standard output: )?No space left on device)\n$" "${program}" "\"$@\" > /dev/full" ${ARGN})
endfunction()

foreach(program IN LISTS PROGRAMS)
  expect_full("${program}" --help)   # a program without options does its work
  command_of("${program}")
  expect_lost("closed" "^${name}: (${reason}|(standard output: )?Bad file descriptor)\n$" "${program}" "\"$@\" >&-" --help)
  # The reader leaves before the program starts. Scripts say nothing to whom has left.
  set(left "${name}: (${reason}|Broken pipe)\n")
  if(program MATCHES "[.]py$")
    set(left "")
  endif()
  expect_lost("a pipe without a reader" "^${left}$" "${program}"
    "rm -f gone code; mkfifo gone; { read _ < gone; \"$@\"; echo $? > code; } | { exec <&-; echo > gone; }; exit $(cat code)" --help)
endforeach()

# Results, where a run is short.
function(expect_results name)
  foreach(program IN LISTS PROGRAMS)
    cmake_path(GET program FILENAME found)
    if(found STREQUAL name)
      expect_full("${program}" ${ARGN})
      return()
    endif()
  endforeach()
endfunction()
string(REPEAT "1\n2\n3\n" 20 numbers)
file(WRITE "${WORK_DIR}/numbers.txt" "${numbers}")
expect_results(allan deviation numbers.txt)
expect_results(simulate_imu --duration 2 --output .)   # the files are there all the same
if(EXISTS "${WORK_DIR}/poses.tum")
  expect_results(allan imu.csv --no-plot --output .)
  expect_results(compare_trajectories poses.tum poses.tum)
  expect_results(dead_reckon imu.csv poses.tum --windows 1)
  expect_results(fit_trajectory poses.tum --no-plot --output .)
  expect_results(simulate_imu poses.tum --output again)
endif()
