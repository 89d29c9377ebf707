# The names of a version. PROJECT_VERSION is that of the release which PSTRIPACK_CANDIDATE (-rc1, or empty) leads to.
#   PSTRIPACK_VERSION       as programs and documents say it: 1.0.0-rc1
#   PSTRIPACK_PYTHON_PACKAGE_VERSION, PSTRIPACK_DEBIAN_VERSION   the same as pip and dpkg write it: 1.0.0rc1, 1.0.0~rc1
#   PSTRIPACK_SOVERSION     number in the sonames
#   PSTRIPACK_FILE_VERSION  number in the files' names: libpstripack.so.FILE_VERSION
# The rule of sonames: a library's soname is .so.MAJOR of its release. A candidate is no release and has the soname of the
# major version before, so programs linked with a candidate are linked again for the release.
set(PSTRIPACK_VERSION ${PROJECT_VERSION}${PSTRIPACK_CANDIDATE})
string(REPLACE "-" "" PSTRIPACK_PYTHON_PACKAGE_VERSION ${PSTRIPACK_VERSION})
string(REPLACE "-" "~" PSTRIPACK_DEBIAN_VERSION ${PSTRIPACK_VERSION})
set(PSTRIPACK_SOVERSION ${PROJECT_VERSION_MAJOR})
set(PSTRIPACK_FILE_VERSION ${PROJECT_VERSION})
if(PSTRIPACK_CANDIDATE)
  string(REGEX REPLACE "[^0-9]" "" candidate ${PSTRIPACK_CANDIDATE})
  math(EXPR PSTRIPACK_SOVERSION "${PROJECT_VERSION_MAJOR} - 1")
  set(PSTRIPACK_FILE_VERSION ${PSTRIPACK_SOVERSION}.99.${candidate})
endif()
