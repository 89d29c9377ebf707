# Python for scripts of tests and documents, and its modules.

# python_has(result python module...): sets result to TRUE if this Python has these modules.
function(python_has result python)
  execute_process(COMMAND ${python} -c "import importlib.util as u, sys; sys.exit(not all(map(u.find_spec, sys.argv[1:])))" ${ARGN}
                  RESULT_VARIABLE lacks_modules OUTPUT_QUIET ERROR_QUIET)
  set(${result} FALSE PARENT_SCOPE)
  if(lacks_modules EQUAL 0)
    set(${result} TRUE PARENT_SCOPE)
  endif()
endfunction()

if(PSTRIPACK_TESTS OR PROJECT_IS_TOP_LEVEL)
  # Debian's modules need Debian's Python, which may not be the first one in PATH.
  if(NOT DEFINED Python3_EXECUTABLE AND EXISTS /usr/bin/python3)
    set(Python3_EXECUTABLE /usr/bin/python3)
  endif()
  find_package(Python3 COMPONENTS Interpreter)
endif()
