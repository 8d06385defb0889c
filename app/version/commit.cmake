# Writes the commit of SOURCE to HEADER, if it differs from what the header says: cmake -DSOURCE=… -DHEADER=… -P commit.cmake
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty=-changed --abbrev=12 --exclude=*
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(commit "unknown commit")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define CHAINMAIL_COMMIT \"${commit}\"\n" @ONLY)
