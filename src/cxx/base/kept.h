#pragma once
// What an owner keeps from one call to the next and can do without: given up where memory is out.

#include <memory>
#include <new>
#include <utility>

namespace pstripack {

struct KeptThing {
  virtual ~KeptThing() = default;
};

/// Puts the thing into one of a few places, which is its owner's until the owner takes it out; -1, and it is
/// destroyed, if all are taken. Safe from any thread, as the others below; nobody waits.
int put_into_a_place(std::unique_ptr<KeptThing> thing) noexcept;
/// Null if it was given up.
std::unique_ptr<KeptThing> take_out_of(int place) noexcept;
/// Destroys the things in all places; false if there were none.
bool give_up_kept_things() noexcept;

/// A T that its owner keeps. It is gone after give_up_kept_things().
template <class T>
class Kept {
 public:
  Kept() = default;
  Kept(Kept&& other) noexcept : place_(std::exchange(other.place_, -1)) {}
  Kept& operator=(Kept&& other) noexcept {
    std::swap(place_, other.place_);
    return *this;
  }
  ~Kept() { take(); }

  /// Or destroys it, if there is no place or no memory.
  void put(std::unique_ptr<T> value) noexcept {
    take();
    try {
      place_ = put_into_a_place(std::make_unique<Thing>(std::move(value)));
    } catch (const std::bad_alloc&) {
    }
  }
  /// Null if there is none any more.
  std::unique_ptr<T> take() noexcept {
    if (place_ < 0) return nullptr;
    const std::unique_ptr<KeptThing> thing = take_out_of(std::exchange(place_, -1));
    return thing == nullptr ? nullptr : std::move(static_cast<Thing&>(*thing).value);
  }

 private:
  struct Thing : KeptThing {
    explicit Thing(std::unique_ptr<T> v) : value(std::move(v)) {}
    std::unique_ptr<T> value;
  };
  int place_ = -1;
};

}  // namespace pstripack
