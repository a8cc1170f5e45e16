# Says how long a workflow took. Included, it notes when configuring began; run as a script (cmake -D STAMP=… -P) at
# the end it prints the time since then. The note is used once: a later plain build prints nothing.
if(CMAKE_SCRIPT_MODE_FILE)
  if(EXISTS "${STAMP}")
    file(READ "${STAMP}" began)
    file(REMOVE "${STAMP}")
    string(TIMESTAMP now %s)
    math(EXPR seconds "${now} - ${began}")
    message(STATUS "splinertia: ${DONE} in ${seconds} s")
  endif()
  return()
endif()

set(splinertia_stamp "${CMAKE_CURRENT_BINARY_DIR}/configure_began")
string(TIMESTAMP splinertia_now %s)
file(WRITE "${splinertia_stamp}" "${splinertia_now}")
# splinertia_stopwatch(<result> <what was done>): the command that prints the time
function(splinertia_stopwatch result done)
  set(${result} "${CMAKE_COMMAND}" -D "STAMP=${splinertia_stamp}" -D "DONE=${done}"
    -P "${CMAKE_CURRENT_FUNCTION_LIST_FILE}" PARENT_SCOPE)
endfunction()

# Every program of <directory> and below
function(splinertia_programs_in directory result)
  get_property(targets DIRECTORY "${directory}" PROPERTY BUILDSYSTEM_TARGETS)
  get_property(below DIRECTORY "${directory}" PROPERTY SUBDIRECTORIES)
  set(programs "")
  foreach(target IN LISTS targets)
    get_target_property(type ${target} TYPE)
    if(type MATCHES "EXECUTABLE|OBJECT_LIBRARY")
      list(APPEND programs ${target})
    endif()
  endforeach()
  foreach(folder IN LISTS below)
    splinertia_programs_in("${folder}" more)
    list(APPEND programs ${more})
  endforeach()
  set(${result} "${programs}" PARENT_SCOPE)
endfunction()

function(splinertia_report_time)
  splinertia_programs_in("${PROJECT_SOURCE_DIR}" programs)
  splinertia_stopwatch(stopwatch "configured and built")
  add_custom_target(splinertia_time ALL COMMAND ${stopwatch}
    COMMENT "All built" VERBATIM)
  if(programs)
    add_dependencies(splinertia_time ${programs})
  endif()
endfunction()
