# What the scripts that run dead_reckon share. <out>: the folder that they write to.

# figures(<line>): a line of the table of the last run, as window, runs, skipped, gaps, position_median, position_90,
# position_max, attitude_median, attitude_90, attitude_max.
macro(figures line)
  file(STRINGS "${out}/table.csv" table)
  list(GET table ${line} row)
  string(REPLACE "," ";" row "${row}")
  foreach(name IN ITEMS window runs skipped gaps position_median position_90 position_max attitude_median attitude_90 attitude_max)
    list(POP_FRONT row ${name})
  endforeach()
endmacro()
function(expect)   # a condition
  if(NOT (${ARGN}))
    list(JOIN ARGN " " text)
    list(JOIN table "\n" table)
    message(FATAL_ERROR "dead_reckon: expected ${text} in line ${line} of\n${table}")
  endif()
endfunction()
macro(reckon pattern)
  run(0 "${pattern}" ${ARGN} --csv "${out}/table.csv")
  figures(1)
endmacro()
