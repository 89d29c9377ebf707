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

/// A message of these bytes, with room for one descriptor.
struct Message {
  iovec part;
  alignas(cmsghdr) char descriptor[CMSG_SPACE(sizeof(int))]{};
  msghdr header{};

  Message(void* bytes, std::size_t size) : part{bytes, size} {
    header.msg_iov = &part;
    header.msg_iovlen = 1;
    header.msg_control = descriptor;
    header.msg_controllen = sizeof descriptor;
  }
  Message(const Message&) = delete;
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

bool send_packet(const Descriptor& to, const void* bytes, std::size_t size, int descriptor) {
  Message message(const_cast<void*>(bytes), size);
  if (descriptor >= 0) {
    cmsghdr* const header = CMSG_FIRSTHDR(&message.header);
    header->cmsg_level = SOL_SOCKET;
    header->cmsg_type = SCM_RIGHTS;
    header->cmsg_len = CMSG_LEN(sizeof descriptor);
    memcpy(CMSG_DATA(header), &descriptor, sizeof descriptor);
  } else {
    message.header.msg_controllen = 0;
  }
  ssize_t sent = -1;
  do sent = sendmsg(to.get(), &message.header, MSG_NOSIGNAL);
  while (sent < 0 && errno == EINTR);
  return sent >= 0;
}

bool receive_packet(const Descriptor& from, void* bytes, std::size_t size, Descriptor* descriptor) {
  Message message(bytes, size);
  ssize_t received = -1;
  do received = recvmsg(from.get(), &message.header, MSG_CMSG_CLOEXEC | MSG_TRUNC);
  while (received < 0 && errno == EINTR);
  Descriptor carried;
  if (const cmsghdr* const header = CMSG_FIRSTHDR(&message.header);
      received >= 0 && header != nullptr && header->cmsg_type == SCM_RIGHTS) {
    int file;
    memcpy(&file, CMSG_DATA(header), sizeof file);
    carried.reset(file);
  }
  if (descriptor != nullptr) *descriptor = std::move(carried);
  return received == static_cast<ssize_t>(size);
}

}  // namespace pstripack
