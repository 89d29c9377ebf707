set(processor ppc64le)
set(gnu powerpc64le)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
