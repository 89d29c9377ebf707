# point_sets: the named point sets of stripack-compare, the benchmark and the tests. It needs only the type Point. To
# add a family: a file in point_sets/families, and a line in families.h, point_sets.cpp and here.
include_guard(GLOBAL)

set(point_sets_dir ${CMAKE_CURRENT_LIST_DIR}/point_sets)
set(point_set_families random single fibonacci icosahedral latlon reduced_gaussian healpix cubed_sphere tripolar ring
                       variable clusters dense_cap antipodal cap box strip tee pairs hemisphere hemisphere_rim
                       small_circle two_curves crossing ellipse spiral comb falling_tee moment falling
                       ulp_groups axis_cap nest mirrored_nest rays lattice earth rounded rotated_pole refined
                       satellite swaths tracks rivers coast earthquakes)
list(TRANSFORM point_set_families PREPEND ${point_sets_dir}/families/)
list(TRANSFORM point_set_families APPEND .cpp)
add_library(point_sets STATIC
  ${point_sets_dir}/angles.cpp ${point_sets_dir}/distributions.cpp ${point_sets_dir}/point_sets.cpp ${point_sets_dir}/random_numbers.cpp
  ${point_sets_dir}/shapes.cpp ${point_sets_dir}/text_file.cpp ${point_set_families})
target_include_directories(point_sets
  PUBLIC ${point_sets_dir} $<TARGET_PROPERTY:pstripack_geometry,INTERFACE_INCLUDE_DIRECTORIES>)
target_link_libraries(point_sets PRIVATE pstripack_flags)
# Some fifty small files include the same headers: compiling fourteen at once takes as long as two.
set_target_properties(point_sets PROPERTIES UNITY_BUILD ON UNITY_BUILD_BATCH_SIZE 14)
