# Run by cpack between installing and packing (packages.cmake). Adds what Debian's policy requires beside the installed
# files: copyright, changelog, compressed man pages, archives without debugging symbols.

# Remove cpack's own lists of installed files: the target `uninstall` would delete the files that they name.
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  file(REMOVE ${CPACK_PSTRIPACK_BINARY_DIR}/install_manifest_${component}.txt)
endforeach()

if(NOT CPACK_GENERATOR STREQUAL "DEB")
  return()
endif()
find_program(GZIP gzip REQUIRED)
find_program(STRIP strip REQUIRED)
set(source ${CPACK_PSTRIPACK_SOURCE_DIR})

# The licence as a paragraph of Debian's format: indented, with dots for empty lines; its title and copyright line are
# fields.
file(READ ${source}/LICENSE licence)
string(REGEX MATCH "Copyright \\(c\\) ([^\n]+)\n+(.*)" _ "${licence}")
set(holder ${CMAKE_MATCH_1})
string(STRIP "${CMAKE_MATCH_2}" licence)
string(REPLACE "\n\n" "\n.\n" licence "${licence}")
string(REPLACE "\n" "\n " licence "${licence}")
set(copyright "Format: https://www.debian.org/doc/packaging-manuals/copyright-format/1.0/
Upstream-Name: PSTRIPACK

Files: *
Copyright: ${holder}
License: BSD-3-Clause
 ${licence}
")

# The licences of these libraries, which are compiled into the packages, require a notice.
function(add_copyrights component)
  set(all "${copyright}")
  foreach(library IN LISTS ARGN)
    if(EXISTS /usr/share/doc/${library}/copyright)
      file(READ /usr/share/doc/${library}/copyright text)
      string(APPEND all "\n---- of ${library}, parts of which are compiled in:\n\n${text}")
    endif()
  endforeach()
  set(copyright_of_${component} "${all}" PARENT_SCOPE)
endfunction()
add_copyrights(tools libcli11-dev nlohmann-json3-dev)
add_copyrights(mpi_tools libcli11-dev nlohmann-json3-dev)  # pstripack-mpi
add_copyrights(python pybind11-dev)

# For the libraries: false reports of lintian.
set(overrides_of_libraries
  "# They call libpstripack, libgfortran and nothing else.\n"
  "library-not-linked-against-libc\n"
  "# cpack writes these scripts. The package has the trigger as well.\n"
  "maintscript-calls-ldconfig\n")

string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  set(root ${CPACK_TEMPORARY_DIRECTORY}/${component})
  string(TOUPPER ${component} COMPONENT)
  set(package ${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  set(documents ${root}/usr/share/doc/${package})

  if(copyright_of_${component})
    file(WRITE ${documents}/copyright "${copyright_of_${component}}")
  else()
    file(WRITE ${documents}/copyright "${copyright}")
  endif()
  if(component MATCHES "^(runtime|mpi)$")
    file(WRITE ${root}/usr/share/lintian/overrides/${package} ${overrides_of_libraries})
  endif()
  file(WRITE ${documents}/changelog.Debian
    "pstripack (${CPACK_PACKAGE_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE}) bookworm; urgency=medium\n\n"
    "  * Built by cpack; what is new is in the file changelog.\n\n -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
  configure_file(${source}/CHANGELOG.md ${documents}/changelog COPYONLY)

  file(GLOB_RECURSE pages ${root}/usr/share/man/*)
  execute_process(COMMAND ${GZIP} -9n ${pages} ${documents}/changelog.Debian ${documents}/changelog
                  COMMAND_ERROR_IS_FATAL ANY)
  file(GLOB_RECURSE archives ${root}/*.a)
  if(archives)
    execute_process(COMMAND ${STRIP} --strip-debug --enable-deterministic-archives ${archives}
                    COMMAND_ERROR_IS_FATAL ANY)
  endif()
endforeach()
