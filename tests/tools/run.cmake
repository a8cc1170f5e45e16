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

# refuse(<pattern> <options...>): bad input. The exit code is 2, one line is printed, which matches the pattern, and
# nothing is left in the path <refused>, a folder or a file that <refuse_option> names. CLI11's hint at --help may follow.
# With an empty <refuse_begin>, lines on how the input was read may stand before.
set(refuse_option --output)
set(refuse_begin "^")
function(refuse pattern)
  run(2 "${refuse_begin}[^\n]*${pattern}[^\n]*\n(Run with --help[^\n]*\n)?$" ${ARGN} ${refuse_option} "${refused}")
  file(GLOB left "${refused}/*")
  if(left OR (EXISTS "${refused}" AND NOT IS_DIRECTORY "${refused}"))
    message(FATAL_ERROR "${program_name} ${ARGN} left ${refused} ${left}")
  endif()
endfunction()
# refuse_file(<pattern> <name> <text> <options...>): the same for a file of this name with this text.
function(refuse_file pattern name text)
  file(WRITE "${out}/${name}" "${text}")
  refuse("${name}${pattern}" "${out}/${name}" ${ARGN})
endfunction()
