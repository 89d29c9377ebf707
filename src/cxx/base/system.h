#pragma once
// What systems do in different ways, besides the pool, which exists on Linux only (PSTRIPACK_WITH_POOL).
// Where PSTRIPACK_LINUX is not defined, POSIX must do; the build with PSTRIPACK_ONLY_POSIX tests that on
// Linux.

#include <sys/socket.h>
#include <sys/types.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>

#if defined(__linux__) && !defined(PSTRIPACK_ONLY_POSIX)
#define PSTRIPACK_LINUX
#endif

namespace pstripack {

/// The variables of this process, as `environ` lists them. macOS hides `environ` from shared libraries.
char** all_environment_variables();

/// Path of the program that this process runs; empty if it is unknown.
std::string path_of_this_program();

/// As socketpair() for a stream, but close-on-exec; where the system needs two steps for that, a program
/// started by another thread between them inherits the descriptors. False on failure, with errno set.
bool open_stream(int (&ends)[2]);
/// As sendmsg(), for a socket of open_stream. Raises no SIGPIPE.
ssize_t send_without_signal(int socket, const msghdr& message);

/// As write(). Fails if the bytes cannot be read, also where AddressSanitizer would report them.
ssize_t write_unchecked(int file, const void* bytes, std::size_t size);

/// A bit for each processor that this process may use. Where the system does not tell: the first ones, as
/// many as it has.
using ProcessorSet = std::array<std::uint64_t, 16>;
ProcessorSet usable_processors();

/// Bytes of memory that this process may use at most: of the machine, or of a control group that it is in
/// (Slurm, containers), if one has less. SIZE_MAX if that is unknown; so is the next.
std::size_t memory_limit();
/// Bytes that it may still take without swapping: an upper bound, since others of its control group take
/// theirs.
std::size_t available_memory();

}  // namespace pstripack
