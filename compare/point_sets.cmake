# point_sets: the named point sets of the harness, the benchmark and the tests. Needs only the Point type.
include_guard(GLOBAL)

add_library(point_sets STATIC ${CMAKE_CURRENT_LIST_DIR}/point_sets.cpp)
target_include_directories(point_sets PUBLIC
  ${CMAKE_CURRENT_LIST_DIR}
  $<TARGET_PROPERTY:pstripack_geometry,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(point_sets PRIVATE pstripack_flags)
