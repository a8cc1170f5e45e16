# What the scripts of this folder share: running PROGRAM and looking at what it says.
cmake_path(GET PROGRAM STEM program_name)

# run(<exit code> <pattern> <options...>): checks both, the pattern against everything that is printed, which is left
# in <printed>.
function(run code pattern)
  execute_process(COMMAND "${PROGRAM}" ${ARGN} RESULT_VARIABLE result OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT result STREQUAL code)
    message(FATAL_ERROR "${program_name} ${ARGN}: exit code ${result}, expected ${code}\n${text}")
  endif()
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "${program_name} ${ARGN}: expected to match ${pattern}, printed\n${text}")
  endif()
  set(printed "${text}" PARENT_SCOPE)
endfunction()
