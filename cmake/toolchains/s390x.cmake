set(processor s390x)
set(gnu s390x)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
