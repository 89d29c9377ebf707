set(processor aarch64)
set(gnu aarch64)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
