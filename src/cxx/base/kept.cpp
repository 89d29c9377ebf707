#include "base/kept.h"

#include <atomic>

namespace pstripack {
namespace {

struct Place {
  std::atomic<bool> is_taken{false};  // stays true when the thing is given up, until the owner asks for it
  std::atomic<KeptThing*> thing{nullptr};
};
#ifndef PSTRIPACK_KEPT_PLACES  // more where many ranks are one process: compare/many_ranks
#define PSTRIPACK_KEPT_PLACES 32
#endif
constexpr int places = PSTRIPACK_KEPT_PLACES;
Place place[places];

}  // namespace

int put_into_a_place(std::unique_ptr<KeptThing> thing) noexcept {
  for (int i = 0; i < places; ++i)
    if (!place[i].is_taken.exchange(true)) {
      place[i].thing = thing.release();
      return i;
    }
  return -1;
}

std::unique_ptr<KeptThing> take_out_of(int i) noexcept {
  std::unique_ptr<KeptThing> thing(place[i].thing.exchange(nullptr));
  place[i].is_taken = false;
  return thing;
}

bool give_up_kept_things() noexcept {
  bool any = false;
  for (Place& p : place) {
    const std::unique_ptr<KeptThing> thing(p.thing.exchange(nullptr));
    any = any || thing != nullptr;
  }
  return any;
}

}  // namespace pstripack
