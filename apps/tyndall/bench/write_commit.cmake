# cmake -DSOURCE=<folder> -DOUTPUT=<header> -P write_commit.cmake: the commit as a macro. Rewrites
# the header only if the commit has changed.
execute_process(
  COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE commit
  OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET
  RESULT_VARIABLE result)
if(NOT result EQUAL 0)
  set(commit unknown)
endif()
file(CONFIGURE OUTPUT ${OUTPUT} CONTENT "#define TYNDALL_COMMIT \"${commit}\"\n")
