#pragma once
// Local sockets between processes of one user on one machine. Packets keep their borders and can carry file
// descriptors. The names are in Linux's abstract name space: nothing is left behind in any folder.

#include <cstddef>
#include <string>

#include "base/descriptor.h"

namespace pstripack {

/// A socket that listens under a new name, close-on-exec like every descriptor of this file. None on failure,
/// with errno.
Descriptor listen_under_new_name(std::string* name);

/// Connects to a name; waits where the listener has not accepted yet. None on failure, or if the listener is
/// another user's.
Descriptor connect_to(const char* name);

/// The next connection; none if it is another user's.
Descriptor accept_from(const Descriptor& listener);

/// One packet, and up to kMostDescriptors descriptors with it (-1: none in this place). False if the other
/// side is gone. No signal is raised.
constexpr int kMostDescriptors = 4;
bool send_packet(const Descriptor& to, const void* bytes, std::size_t size, const int* descriptors = nullptr,
                 int count = 0);

/// Waits for one packet of exactly `size` bytes. False if the other side is gone or sent something else.
/// descriptors: `count` places; those that carry nothing become none.
bool receive_packet(const Descriptor& from, void* bytes, std::size_t size, Descriptor* descriptors = nullptr,
                    int count = 0);

}  // namespace pstripack
