# Makes libstripack_original.so from the objects of libngmath.a that STRIPACK also has, with names without CS.
# In libngmath CSTRANS and CSSCOORD are single precision; the double versions are CSTRANSD and CSSCOORDD.
# CSCRLIST has other arguments: crlist_ comes from ngmath_crlist.c.

set(routines addnod areas bdyadd bnodes circum covsph delarc delnb delnod edge getnp insert inside intadd
             intrsc jrand left lstptr nbcnt nearnd optim store swap swptst trfind trlist trlprt trmesh trprnt)

set(objects cscrlist.o cstransd.o csscoordd.o)
set(renamed "cscrlist_ ngmath_crlist_\ncstransd_ trans_\ncsscoordd_ scoord_\n")
set(exported "trans_; scoord_; crlist_;")
foreach(routine IN LISTS routines)
  list(APPEND objects cs${routine}.o)
  string(APPEND renamed "cs${routine}_ ${routine}_\n")
  string(APPEND exported " ${routine}_;")
endforeach()

set(dir ${CMAKE_CURRENT_BINARY_DIR}/ngmath)
file(WRITE ${dir}/renamed.txt "${renamed}")
file(WRITE ${dir}/exported.map "{ global: ${exported} local: *; };\n")

add_custom_command(
  OUTPUT ${dir}/original.o
  COMMAND ${CMAKE_AR} x ${STRIPACK_NGMATH} ${objects}
  # CSCRLIST with another SCOORD (ngmath_crlist.c).
  COMMAND ${CMAKE_OBJCOPY} --redefine-sym csscoordd_=ngmath_keep_centre_ cscrlist.o
  COMMAND ${CMAKE_LINKER} -r -o original.o ${objects}
  COMMAND ${CMAKE_OBJCOPY} --redefine-syms=renamed.txt original.o
  WORKING_DIRECTORY ${dir}
  DEPENDS ${STRIPACK_NGMATH} ${dir}/renamed.txt
  COMMENT "Renaming the routines of ${STRIPACK_NGMATH}"
  VERBATIM)

add_library(stripack_original SHARED ngmath_crlist.c ${dir}/original.o)
set_source_files_properties(${dir}/original.o PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
# -Bsymbolic: routines of the original call each other even if the program defines the same names.
target_link_options(stripack_original PRIVATE
  -Wl,-Bsymbolic -Wl,--version-script=${dir}/exported.map -Wl,--no-undefined)
set_target_properties(stripack_original PROPERTIES LINK_DEPENDS ${dir}/exported.map)
target_link_libraries(stripack_original PRIVATE pstripack_flags gfortran m)
