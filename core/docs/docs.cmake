# Makes the documentation of the public headers with Doxygen. A warning is an error.
#   cmake -DCORE=… -DHEADERS="…" -DOUT=… -DVERSION=… -P docs.cmake
find_program(DOXYGEN doxygen)
if(NOT DOXYGEN)
  message(FATAL_ERROR "doxygen was not found; install the Debian package doxygen, or put the program into PATH")
endif()
file(MAKE_DIRECTORY ${OUT})
file(WRITE ${OUT}/Doxyfile "@INCLUDE = ${CORE}/docs/Doxyfile\nINPUT = docs/main_page.md ${HEADERS}\nOUTPUT_DIRECTORY = ${OUT}\nPROJECT_NUMBER = ${VERSION}\n")
execute_process(COMMAND ${DOXYGEN} ${OUT}/Doxyfile WORKING_DIRECTORY ${CORE} RESULT_VARIABLE result
  OUTPUT_QUIET ERROR_VARIABLE warnings)
if(NOT result EQUAL 0 OR NOT warnings STREQUAL "")
  message(FATAL_ERROR "doxygen found faults in the public headers:\n${warnings}")
endif()
message(STATUS "${OUT}/html/index.html")
