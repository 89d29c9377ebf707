set(processor riscv64)
set(gnu riscv64)
include(${CMAKE_CURRENT_LIST_DIR}/debian-cross.cmake)
