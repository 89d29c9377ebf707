#include "pool/channel.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/random.h>
#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cstdint>
#include <utility>

namespace pstripack {
namespace {

struct Address {
  sockaddr_un bytes{};
  socklen_t size = 0;

  explicit Address(const char* name) {
    bytes.sun_family = AF_UNIX;
    const std::size_t length = strlen(name);
    if (length + 1 > sizeof bytes.sun_path) return;
    memcpy(bytes.sun_path + 1, name, length);  // a leading zero: abstract
    size = static_cast<socklen_t>(offsetof(sockaddr_un, sun_path) + 1 + length);
  }
  const sockaddr* get() const { return reinterpret_cast<const sockaddr*>(&bytes); }
};

bool is_ours(const Descriptor& socket) {
  ucred peer{};
  socklen_t size = sizeof peer;
  return getsockopt(socket.get(), SOL_SOCKET, SO_PEERCRED, &peer, &size) == 0 && peer.uid == geteuid();
}

/// Room for the descriptors of a packet. Only those that exist are sent; the first byte of the packet is a
/// bit map of their places.
struct Ancillary {
  alignas(cmsghdr) char bytes[CMSG_SPACE(kMostDescriptors * sizeof(int))];
};

}  // namespace

Descriptor listen_under_new_name(std::string* name) {
  Descriptor listener(socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (!listener) return {};
  std::uint64_t random = 0;
  if (getrandom(&random, sizeof random, 0) != sizeof random) return {};
  char text[64];
  snprintf(text, sizeof text, "pstripack-%ld-%016llx", static_cast<long>(getpid()),
           static_cast<unsigned long long>(random));
  *name = text;
  const Address address(text);
  if (bind(listener.get(), address.get(), address.size) != 0 || listen(listener.get(), SOMAXCONN) != 0)
    return {};
  return listener;
}

Descriptor connect_to(const char* name) {
  const Address address(name);
  Descriptor socket(::socket(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0));
  if (!socket || address.size == 0) return {};
  while (connect(socket.get(), address.get(), address.size) != 0)
    if (errno != EINTR) return {};
  return is_ours(socket) ? std::move(socket) : Descriptor();
}

Descriptor accept_from(const Descriptor& listener) {
  Descriptor socket(accept4(listener.get(), nullptr, nullptr, SOCK_CLOEXEC));
  return socket && is_ours(socket) ? std::move(socket) : Descriptor();
}

bool send_packet(const Descriptor& to, const void* bytes, std::size_t size, const int* descriptors,
                 int count) {
  unsigned char places = 0;
  int fds[kMostDescriptors];
  int used = 0;
  for (int i = 0; i < count; ++i)
    if (descriptors[i] >= 0) {
      places = static_cast<unsigned char>(places | 1 << i);
      fds[used++] = descriptors[i];
    }
  iovec parts[] = {{&places, 1}, {const_cast<void*>(bytes), size}};
  Ancillary ancillary{};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  if (used > 0) {
    message.msg_control = ancillary.bytes;
    message.msg_controllen = CMSG_SPACE(static_cast<std::size_t>(used) * sizeof(int));
    cmsghdr* const header = CMSG_FIRSTHDR(&message);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(static_cast<std::size_t>(used) * sizeof(int));
    memcpy(CMSG_DATA(header), fds, static_cast<std::size_t>(used) * sizeof(int));
  }
  for (;;) {
    const ssize_t sent = sendmsg(to.get(), &message, MSG_NOSIGNAL);
    if (sent >= 0) return true;
    if (errno != EINTR) return false;
  }
}

bool receive_packet(const Descriptor& from, void* bytes, std::size_t size, Descriptor* descriptors,
                    int count) {
  unsigned char places = 0;
  iovec parts[] = {{&places, 1}, {bytes, size}};
  Ancillary ancillary{};
  msghdr message{};
  message.msg_iov = parts;
  message.msg_iovlen = 2;
  message.msg_control = ancillary.bytes;
  message.msg_controllen = sizeof ancillary.bytes;
  ssize_t received = -1;
  do received = recvmsg(from.get(), &message, MSG_CMSG_CLOEXEC);
  while (received < 0 && errno == EINTR);

  int fds[kMostDescriptors];
  int used = 0;
  if (received >= 0)
    if (const cmsghdr* const header = CMSG_FIRSTHDR(&message);
        header != nullptr && header->cmsg_level == SOL_SOCKET && header->cmsg_type == SCM_RIGHTS) {
      used = static_cast<int>((header->cmsg_len - CMSG_LEN(0)) / sizeof(int));
      memcpy(fds, CMSG_DATA(header), static_cast<std::size_t>(used) * sizeof(int));
    }
  for (int i = 0, next = 0; i < kMostDescriptors; ++i) {
    const bool carried = (places >> i & 1) != 0 && next < used;
    Descriptor descriptor(carried ? fds[next++] : -1);
    if (i < count) descriptors[i] = std::move(descriptor);
  }
  return received == static_cast<ssize_t>(size) + 1;
}

}  // namespace pstripack
