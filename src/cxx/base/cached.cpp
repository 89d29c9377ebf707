#include "base/cached.h"

#include <atomic>

namespace pstripack {
namespace {

struct Place {
  std::atomic<bool> is_taken{false};  // stays true when the thing is given up, until the owner asks for it
  std::atomic<CachedThing*> thing{nullptr};
};
constexpr int places = 32;
Place place[places];

}  // namespace

int put_into_a_place(std::unique_ptr<CachedThing> thing) noexcept {
  for (int i = 0; i < places; ++i)
    if (!place[i].is_taken.exchange(true)) {
      place[i].thing = thing.release();
      return i;
    }
  return -1;
}

std::unique_ptr<CachedThing> take_out_of(int i) noexcept {
  std::unique_ptr<CachedThing> thing(place[i].thing.exchange(nullptr));
  place[i].is_taken = false;
  return thing;
}

bool free_cached_things() noexcept {
  bool any = false;
  for (Place& p : place) {
    const std::unique_ptr<CachedThing> thing(p.thing.exchange(nullptr));
    any = any || thing != nullptr;
  }
  return any;
}

}  // namespace pstripack
