#include "pool/steward.h"

#include <poll.h>

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>

#include "pool/area_layout.h"
#include "pool/messages.h"

namespace pstripack {
namespace {

/// Broadcast by rank 0: a call of TRMESH, or the end.
struct Order {
  std::int32_t real_bytes = 0;  ///< 4 or 8, the size of the nodes' reals; 0: the end
  std::int32_t n = 0;
  std::int64_t area = 0;        ///< number of the area that holds the arrays
  std::int32_t sends_area = 0;  ///< its descriptor follows on the sockets of connect_ranks()
};

/// Collective. True if every rank has mapped the area: then all read and write the arrays there, and none
/// are sent.
bool all_share(MpiCommunicator& ranks, const SharedArea& area, const Order& order) {
  std::int64_t seen = area.size() >= AreaLayout(order.n, order.real_bytes).size() ? 1 : 0;
  ranks.all_min(&seen, 1);
  return seen != 0;
}

/// Carries out one call, on any rank. `area`: null if this rank has not mapped it.
TrmeshResult carry_out_order(MpiCommunicator& ranks, Arrays arrays, const Order& order, void* area,
                             std::int32_t* lnew = nullptr, GroupCost* cost = nullptr) {
  TrmeshCall call;
  call.nodes = NodeArrays(static_cast<std::size_t>(order.real_bytes), nullptr, nullptr, nullptr);
  if (area != nullptr) call = AreaLayout(order.n, order.real_bytes).call(area, lnew);
  return collective_trmesh(ranks, arrays, call, cost);
}

/// Sockets between rank 0 and each other rank, to pass on descriptors of memory: on rank 0 one for each, on
/// the others one. None on any rank if a rank cannot reach rank 0, such as one on another machine.
/// Collective.
std::vector<Descriptor> connect_ranks(MpiCommunicator& ranks) {
  constexpr int kAtOnce = 64;  // fewer than any system lets wait for accept()
  std::string name;
  Descriptor listener;
  char text[64] = "";
  if (ranks.rank() == 0 && (listener = listen_under_new_name(&name))) std::strcpy(text, name.c_str());
  ranks.broadcast(text, sizeof text, 0);
  std::vector<Descriptor> sockets;
  for (int first = 1; first < ranks.size(); first += kAtOnce) {
    const int last = std::min(first + kAtOnce, ranks.size());
    if (first <= ranks.rank() && ranks.rank() < last) sockets.push_back(connect_to(text));
    std::int64_t reached = sockets.empty() || sockets.back() ? 1 : 0;
    ranks.all_min(&reached, 1);
    if (reached == 0) return {};
    for (int r = first; ranks.rank() == 0 && r < last; ++r) sockets.push_back(accept_from(listener));
  }
  return sockets;
}

}  // namespace

bool Steward::connect(const char* pool) {
  char nothing;
  supervisor_ = connect_to(pool);
  return supervisor_ && receive_packet(supervisor_, &nothing, 1, &listener_) && listener_;
}

void Steward::serve(MpiCommunicator& ranks) {
  sockets_ = connect_ranks(ranks);
  std::vector<pollfd> events;
  for (;;) {
    events = {{supervisor_.get(), POLLIN, 0}, {listener_.get(), POLLIN, 0}};
    for (const Client& client : clients_) events.push_back({client.socket.get(), POLLIN, 0});
    if (poll(events.data(), events.size(), -1) < 0) continue;
    if (events[0].revents != 0) break;
    for (std::size_t i = clients_.size(); i-- > 0;)
      if (events[i + 2].revents != 0 && !serve(clients_[i], ranks))
        clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
    if (events[1].revents != 0)
      if (Descriptor socket = accept_from(listener_)) clients_.push_back({std::move(socket), {}});
  }
  clients_.clear();
  Order end_of_pool;
  ranks.broadcast(&end_of_pool, sizeof end_of_pool, 0);
}

/// A rank that cannot get it finds the socket closed.
void Steward::send_to_workers(const Descriptor& file) {
  const char nothing = 0;
  for (Descriptor& socket : sockets_)
    if (!send_packet(socket, &nothing, 1, file.get())) socket.reset();
}

bool Steward::serve(Client& client, MpiCommunicator& ranks) {
  PoolRequest request;
  Descriptor new_area;
  if (!receive_packet(client.socket, &request, sizeof request, &new_area)) return false;
  if (new_area) {
    client.area = SharedArea();
    client.area = SharedArea::map(std::move(new_area));
    client.area_number = ++areas_;
  }
  PoolReply reply;
  if (request.format != PoolRequest::kFormat || (request.real_bytes != 4 && request.real_bytes != 8) ||
      request.n < 3 || client.area.size() < AreaLayout(request.n, request.real_bytes).size())
    return send_packet(client.socket, &reply, sizeof reply);

  Order order{request.real_bytes, request.n, client.area_number, client.area.file() ? 1 : 0};
  ranks.broadcast(&order, sizeof order, 0);
  if (order.sends_area != 0) send_to_workers(client.area.file());
  TrmeshResult result{0};
  try {
    const Arrays arrays = all_share(ranks, client.area, order) ? Arrays::shared : Arrays::on_one_rank;
    client.area.close_file();  // every rank that can map it has done so
    result = carry_out_order(ranks, arrays, order, client.area.data(), &reply.lnew,
                             request.wants_cost != 0 ? &reply.cost : nullptr);
  } catch (const AgreedFailure& failure) {
    result = {failure.code};
  }
  reply.done = 1;
  reply.ranks = ranks.size();
  reply.ier = result.ier;
  reply.node = result.node;
  reply.other = result.other;
  return send_packet(client.socket, &reply, sizeof reply);
}

void serve_as_worker(MpiCommunicator& ranks) {
  const std::vector<Descriptor> sockets = connect_ranks(ranks);
  SharedArea area;
  std::int64_t area_number = 0;
  for (;;) {
    Order order;
    ranks.broadcast(&order, sizeof order, 0);
    if (order.real_bytes == 0) return;
    if (order.area != area_number) area = SharedArea();
    area_number = order.area;
    if (Descriptor file; order.sends_area != 0 && !sockets.empty()) {
      char nothing = 0;
      receive_packet(sockets[0], &nothing, 1, &file);
      area = SharedArea::map(std::move(file));
      area.close_file();
    }
    try {
      const bool shared = all_share(ranks, area, order);
      carry_out_order(ranks, shared ? Arrays::shared : Arrays::on_one_rank, order,
                      shared ? area.data() : nullptr);
    } catch (const AgreedFailure&) {
      // Rank 0 tells the model; the next call may succeed.
    }
  }
}

}  // namespace pstripack
