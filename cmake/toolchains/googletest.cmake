# For the cross compilers of this folder: find_package(GTest) compiles the source of Debian's package.
include(FetchContent)
FetchContent_Declare(GTest SOURCE_DIR /usr/src/googletest OVERRIDE_FIND_PACKAGE)
