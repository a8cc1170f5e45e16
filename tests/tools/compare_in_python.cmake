# What compares compare_trajectories with other programs.
find_program(PYTHON NAMES python3 python)
find_program(EVO_APE evo_ape)
function(compare_in_python script)
  execute_process(COMMAND "${PYTHON}" "${CMAKE_CURRENT_LIST_DIR}/${script}" "${PROGRAM}" ${ARGN}
    RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${text}")
  endif()
  message("${text}")
endfunction()
