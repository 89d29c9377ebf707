# point_sets: the named point sets of stripack-compare, the benchmark and the tests. It needs only the type Point.
include_guard(GLOBAL)

set(point_sets_dir ${CMAKE_CURRENT_LIST_DIR}/point_sets)
set(point_set_sources angles.cpp distributions.cpp families/close.cpp families/curves.cpp families/even.cpp
                      families/instruments.cpp families/lattices.cpp families/uneven.cpp numbers.cpp point_sets.cpp
                      shapes.cpp)
list(TRANSFORM point_set_sources PREPEND ${point_sets_dir}/)
add_library(point_sets STATIC ${point_set_sources})
target_include_directories(point_sets
  PUBLIC ${point_sets_dir} $<TARGET_PROPERTY:pstripack_geometry,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(point_sets PRIVATE pstripack_flags)
