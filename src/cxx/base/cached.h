#pragma once
// A cache from one call to the next. Its contents are destroyed if an allocation fails.

#include <memory>
#include <new>
#include <utility>

namespace pstripack {

struct CachedThing {
  virtual ~CachedThing() = default;
};

/// Stores `thing` in one of 32 places of the process and returns the number of the place, which is the
/// caller's until it calls take_out_of. Destroys `thing` and returns -1 if all places are taken. This
/// function and the two below may be called from any thread and never wait.
int put_into_a_place(std::unique_ptr<CachedThing> thing) noexcept;
/// Frees the place and returns what it held; null if that has been given up.
std::unique_ptr<CachedThing> take_out_of(int place) noexcept;
/// Destroys what all places hold. False if they were empty.
bool free_cached_things() noexcept;

/// Holds a T until free_cached_things() destroys it.
template <class T>
class Cached {
 public:
  Cached() = default;
  Cached(Cached&& other) noexcept : place_(std::exchange(other.place_, -1)) {}
  Cached& operator=(Cached&& other) noexcept {
    std::swap(place_, other.place_);
    return *this;
  }
  ~Cached() { take(); }

  /// Stores `value`, or destroys it if there is no free place or no memory.
  void put(std::unique_ptr<T> value) noexcept {
    take();
    try {
      place_ = put_into_a_place(std::make_unique<Thing>(std::move(value)));
    } catch (const std::bad_alloc&) {
    }
  }
  /// The stored value; null if it has been destroyed.
  std::unique_ptr<T> take() noexcept {
    if (place_ < 0) return nullptr;
    const std::unique_ptr<CachedThing> thing = take_out_of(std::exchange(place_, -1));
    return thing == nullptr ? nullptr : std::move(static_cast<Thing&>(*thing).value);
  }

 private:
  struct Thing : CachedThing {
    explicit Thing(std::unique_ptr<T> v) : value(std::move(v)) {}
    std::unique_ptr<T> value;
  };
  int place_ = -1;
};

}  // namespace pstripack
