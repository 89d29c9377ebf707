#pragma once
// A cache from one call to the next. Its contents are destroyed if an allocation fails.

#include <cstddef>
#include <memory>
#include <utility>

namespace pstripack {

struct CachedThing {
  virtual ~CachedThing() = default;
};

/// A process has places for things. Those from 0 to here belong to nobody: any thread may look into them.
constexpr int kSharedPlaces = 4;
// These functions may be called from any thread and never wait.
/// Stores `thing`, if the place is empty. False if it is not.
bool put_into(int place, std::unique_ptr<CachedThing>& thing) noexcept;
/// What the place held; null if it was empty, or if that has been given up.
std::unique_ptr<CachedThing> take_out_of(int place) noexcept;
/// A place that is the caller's until it is returned; -1 if all are taken.
int take_place() noexcept;
void return_place(int place) noexcept;
/// Destroys what all places hold. False if they were empty.
bool free_cached_things() noexcept;

/// Bytes that may stay in memory from one call to the next, from construction to destruction. With the blocks
/// of base/workspace.h, which the system can take back, they have an upper bound.
class CacheReservation {
 public:
  /// Throws std::bad_alloc if they may not stay.
  explicit CacheReservation(std::size_t bytes);
  ~CacheReservation();
  CacheReservation(const CacheReservation&) = delete;
  CacheReservation& operator=(const CacheReservation&) = delete;

 private:
  const std::size_t bytes_;
};

/// Holds a T, a CachedThing, until free_cached_things() destroys it.
template <class T>
class Cached {
 public:
  Cached() = default;
  Cached(const Cached&) = delete;
  ~Cached() { take(); }

  /// Stores `value`, or destroys it if there is no free place.
  void put(std::unique_ptr<T> value) noexcept {
    take();
    place_ = take_place();
    std::unique_ptr<CachedThing> thing = std::move(value);
    if (place_ >= 0) put_into(place_, thing);
  }
  /// The stored value; null if it has been destroyed.
  std::unique_ptr<T> take() noexcept {
    if (place_ < 0) return nullptr;
    std::unique_ptr<CachedThing> thing = take_out_of(place_);
    return_place(std::exchange(place_, -1));
    return std::unique_ptr<T>(static_cast<T*>(thing.release()));
  }

 private:
  int place_ = -1;
};

}  // namespace pstripack
