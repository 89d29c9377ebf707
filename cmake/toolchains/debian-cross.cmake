# Debian's cross compilers, and qemu-user to run what they make. Included by the toolchain files beside this one, which
# set `processor`, and `gnu`, the processor's name in names of compilers.
set(CMAKE_SYSTEM_NAME Linux)
set(CMAKE_SYSTEM_PROCESSOR ${processor})
set(CMAKE_C_COMPILER ${gnu}-linux-gnu-gcc)
set(CMAKE_CXX_COMPILER ${gnu}-linux-gnu-g++)
set(CMAKE_Fortran_COMPILER ${gnu}-linux-gnu-gfortran)
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)  # notes that GCC 10 passes other arguments than GCC 9
set(CMAKE_CROSSCOMPILING_EMULATOR qemu-${processor}-static -L /usr/${gnu}-linux-gnu)
# CMake finds libraries of this processor only, since it knows their folders; headers and programs are those of all.
set(CMAKE_FIND_ROOT_PATH /usr/${gnu}-linux-gnu)
set(CMAKE_FIND_ROOT_PATH_MODE_PROGRAM NEVER)
