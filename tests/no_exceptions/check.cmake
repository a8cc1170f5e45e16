# Compiles CASE without exceptions, and looks whether its object asks for the heap, streams or exceptions.
separate_arguments(FLAGS UNIX_COMMAND "${FLAGS}")
execute_process(COMMAND "${COMPILER}" -std=c++20 -O2 -DNDEBUG -fno-exceptions ${FLAGS} ${INCLUDE_FOLDERS} -c "${CASE}" -o "${OBJECT}"
  RESULT_VARIABLE code ERROR_VARIABLE text)
if(NOT code EQUAL 0)
  message(FATAL_ERROR "it does not compile:\n${text}")
endif()
execute_process(COMMAND "${NM}" -C "${OBJECT}" OUTPUT_VARIABLE symbols COMMAND_ERROR_IS_FATAL ANY)
string(REGEX MATCHALL "[^\n]*(operator new|stringstream|basic_ostream|ios_base|__cxa_throw)[^\n]*" found "${symbols}")
if(found)
  list(JOIN found "\n" found)
  message(FATAL_ERROR "its object has\n${found}")
endif()
