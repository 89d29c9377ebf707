# How tests and measuring programs start ranks, with any MPI:
#   mpiexec             command and options, which allow more ranks than processors and bind no rank
#   mpiexec_words       the same as words for a shell
#   mpi_environment     for tests: lets Open MPI run as root, and lets its waiting ranks leave their processors to others
#   mpi_is_open_mpi     false for Hydra, the launcher of MPICH and Intel MPI, which needs no options
#   mpi_patience        factor of the tests' time limits: waiting ranks of MPICH keep processors busy
#   add_mpi_test, starts_ranks: see below
set(mpi_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_mpi_yield_when_idle=1)

# quick_without_ranks(): at the end of a folder's CMakeLists.txt, gives its tests that start no ranks the label quick.
function(quick_without_ranks)
  get_property(tests DIRECTORY PROPERTY TESTS)
  foreach(test IN LISTS tests)
    get_property(labels TEST ${test} PROPERTY LABELS)
    if(NOT mpi IN_LIST labels)
      set_property(TEST ${test} APPEND PROPERTY LABELS quick)
    endif()
  endforeach()
endfunction()

if(NOT PSTRIPACK_WITH_MPI)
  return()
endif()
execute_process(COMMAND ${MPIEXEC_EXECUTABLE} --version OUTPUT_VARIABLE mpiexec_version ERROR_QUIET)
set(mpiexec ${MPIEXEC_EXECUTABLE})
set(mpi_is_open_mpi FALSE)
set(mpi_patience 10)
if(mpiexec_version MATCHES "Open MPI|OpenRTE")
  set(mpi_is_open_mpi TRUE)
  set(mpi_patience 1)
  list(APPEND mpiexec --oversubscribe --bind-to none)
  # A rank starts in two thirds of the processor time without what no test uses: lists of PCI and other devices, PMIx's
  # tables in shared memory, messages by other networks than those of ob1.
  list(APPEND mpi_environment HWLOC_COMPONENTS=-pci,-linuxio PMIX_MCA_gds=hash OMPI_MCA_pml=ob1)
endif()
list(JOIN mpiexec " " mpiexec_words)
if(mpi_is_open_mpi AND PSTRIPACK_TESTS AND NOT CMAKE_C_FLAGS MATCHES "-fsanitize")  # sanitizers must be loaded first
  add_library(naps MODULE ${PROJECT_SOURCE_DIR}/tests/support/naps.c)
  list(APPEND mpi_environment LD_PRELOAD=$<TARGET_FILE:naps>)
endif()

# starts_ranks(test [LIMIT seconds] [PROCESSORS n] [LABELS label...] [ENVIRONMENT variable=value...]): sets properties of
# a test whose command starts ranks. PROCESSORS: 1 unless all ranks compute most of the time: tests that wait for
# launchers and deadlines may run beside each other. ctest starts tests with the longest limits first.
function(starts_ranks test)
  cmake_parse_arguments(arg "" "LIMIT;PROCESSORS" "LABELS;ENVIRONMENT" ${ARGN})
  if(NOT arg_LIMIT)
    set(arg_LIMIT 60)
  endif()
  if(NOT arg_PROCESSORS)
    set(arg_PROCESSORS 1)
  endif()
  math(EXPR limit "3 * ${arg_LIMIT} * ${mpi_patience}")  # beside other programs ranks take several times as long
  set(labels mpi ${arg_LABELS})
  set(environment ${mpi_environment} ${arg_ENVIRONMENT})
  set_tests_properties(${test} PROPERTIES TIMEOUT ${limit} COST ${arg_LIMIT} PROCESSORS ${arg_PROCESSORS} LABELS "${labels}"
                                          ENVIRONMENT "${environment}")
endfunction()

# add_mpi_test(test RANKS n [THREADS n] [LONG] [FOLDER path] [LIMIT, LABELS, ENVIRONMENT as above] COMMAND target argument...)
# LONG: only `ctest -C long` runs it.
function(add_mpi_test test)
  cmake_parse_arguments(arg "LONG" "RANKS;THREADS;LIMIT;FOLDER" "LABELS;ENVIRONMENT;COMMAND" ${ARGN})
  list(POP_FRONT arg_COMMAND program)
  set(options)
  if(arg_LONG)
    list(APPEND options CONFIGURATIONS long)
    list(APPEND arg_LABELS long)
  endif()
  if(arg_FOLDER)
    list(APPEND options WORKING_DIRECTORY ${arg_FOLDER})
  endif()
  if(NOT arg_THREADS)
    set(arg_THREADS 1)
  endif()
  set(processors 1)
  if(arg_RANKS GREATER 4)
    set(processors 2)
  endif()
  add_test(NAME ${test} ${options} COMMAND ${mpiexec} -n ${arg_RANKS} $<TARGET_FILE:${program}> ${arg_COMMAND})
  starts_ranks(${test} LIMIT "${arg_LIMIT}" PROCESSORS ${processors} LABELS ${arg_LABELS}
               ENVIRONMENT OMP_NUM_THREADS=${arg_THREADS} ${arg_ENVIRONMENT})
endfunction()
