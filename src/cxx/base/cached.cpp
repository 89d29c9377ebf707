#include "base/cached.h"

#include <atomic>

namespace pstripack {
namespace {

struct Place {
  std::atomic<bool> is_taken{false};  // stays true when the thing is given up, until the owner asks for it
  std::atomic<CachedThing*> thing{nullptr};
};
constexpr int places = kSharedPlaces + 32;
Place place[places];

}  // namespace

bool put_into(int i, std::unique_ptr<CachedThing>& thing) noexcept {
  CachedThing* none = nullptr;
  if (!place[i].thing.compare_exchange_strong(none, thing.get())) return false;
  thing.release();
  return true;
}

std::unique_ptr<CachedThing> take_out_of(int i) noexcept {
  return std::unique_ptr<CachedThing>(place[i].thing.exchange(nullptr));
}

int take_place() noexcept {
  for (int i = kSharedPlaces; i < places; ++i)
    if (!place[i].is_taken.exchange(true)) return i;
  return -1;
}

void return_place(int i) noexcept { place[i].is_taken = false; }

bool free_cached_things() noexcept {
  bool any = false;
  for (int i = 0; i < places; ++i) any = take_out_of(i) != nullptr || any;
  return any;
}

}  // namespace pstripack
