#pragma once
// Local sockets between processes of one user on one machine. They preserve packet boundaries, and a packet
// can carry a file descriptor. Their names are in Linux's abstract name space, so no files are left behind.

#include <cstddef>
#include <string>

#include "base/descriptor.h"

namespace pstripack {

/// A socket that listens under a new name, which is stored in *name. It is close-on-exec, like every
/// descriptor of this file. None on failure, with errno set.
Descriptor listen_under_new_name(std::string* name);

/// Connects to a name, waiting until the listener accepts. None on failure, or if the listener belongs to
/// another user.
Descriptor connect_to(const char* name);

/// Accepts the next connection. None on failure, or if the other side belongs to another user.
Descriptor accept_from(const Descriptor& listener);

/// Sends one packet, with a descriptor unless that is -1. False if the other side is gone. Raises no signal.
bool send_packet(const Descriptor& to, const void* bytes, std::size_t size, int descriptor = -1);

/// Waits for one packet of exactly `size` bytes. False if the other side is gone or sent something else.
/// *descriptor becomes the descriptor received; none if there is none.
bool receive_packet(const Descriptor& from, void* bytes, std::size_t size, Descriptor* descriptor = nullptr);

}  // namespace pstripack
