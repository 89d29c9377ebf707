# The release: `cmake --build build --target dist` writes pstripack-VERSION.tar.gz, of the last commit, and its checksum.
# `dist-trial` does so while no publisher stands in project-address.cmake.
# Usage: cmake -DSOURCE_DIR=... -DOUTPUT_DIR=... -DVERSION=... [-DTRIAL=ON] -P dist.cmake
include(${CMAKE_CURRENT_LIST_DIR}/project-address.cmake)
if(NOT TRIAL AND "${PSTRIPACK_PUBLISHER} ${PSTRIPACK_SECURITY_ADDRESS} ${PSTRIPACK_HOMEPAGE}" MATCHES "no-address[.]invalid")
  message(FATAL_ERROR "who publishes this? Write it into cmake/project-address.cmake, or make the target dist-trial")
endif()
file(READ ${SOURCE_DIR}/SECURITY.md security)
string(FIND "${security}" "${PSTRIPACK_SECURITY_ADDRESS}" found)
if(found EQUAL -1)
  message(FATAL_ERROR "SECURITY.md does not name ${PSTRIPACK_SECURITY_ADDRESS}, as cmake/project-address.cmake does")
endif()
find_program(GIT git REQUIRED)
set(name pstripack-${VERSION})
execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} status --porcelain OUTPUT_VARIABLE changes COMMAND_ERROR_IS_FATAL ANY)
if(changes)
  message(WARNING "not in ${name}.tar.gz, because not committed:\n${changes}")
endif()
file(MAKE_DIRECTORY ${OUTPUT_DIR})
execute_process(COMMAND ${GIT} -C ${SOURCE_DIR} archive --format=tar.gz --prefix=${name}/ -o ${OUTPUT_DIR}/${name}.tar.gz HEAD
                COMMAND_ERROR_IS_FATAL ANY)
file(SHA256 ${OUTPUT_DIR}/${name}.tar.gz sum)
file(WRITE ${OUTPUT_DIR}/${name}.tar.gz.sha256 "${sum}  ${name}.tar.gz\n")
message(STATUS "${OUTPUT_DIR}/${name}.tar.gz ${sum}")
