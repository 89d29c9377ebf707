#include "scvt/halo.h"

#include <algorithm>

namespace pstripack::scvt {

void Halo::make_directory(const Neighbourhood& here) {
  const auto size = static_cast<std::size_t>(ranks_.size());
  const Parcels parcels = exchange_in_agreement(ranks_, [&] {
    std::vector<std::vector<std::int64_t>> numbers(size);
    for (std::size_t i = 0; i < here.stars.count; ++i)
      numbers[directory_of(here.numbers[i])].push_back(here.numbers[i]);
    return packed(numbers);
  });
  in_agreement(ranks_, [&] {
    directory_.emplace(Items<std::int64_t>(parcels).size());
    for (std::size_t r = 0; r < size; ++r)
      for (const std::int64_t number : Items<std::int64_t>(parcels, r))
        directory_->insert(number, static_cast<std::int32_t>(r));
  });
}

std::vector<std::int32_t> Halo::owners_of(const std::vector<std::int64_t>& numbers) {
  const auto size = static_cast<std::size_t>(ranks_.size());
  const Parcels questions = exchange_in_agreement(ranks_, [&] {
    std::vector<std::vector<std::int64_t>> asked(size);
    for (const std::int64_t number : numbers) asked[directory_of(number)].push_back(number);
    return packed(asked);
  });
  const Parcels answers = exchange_in_agreement(ranks_, [&] {
    std::vector<std::vector<std::int32_t>> owners(size);
    for (std::size_t r = 0; r < size; ++r)
      for (const std::int64_t number : Items<std::int64_t>(questions, r))
        owners[r].push_back(directory_->at(number));
    return packed(owners);
  });
  std::vector<std::int32_t> owners;
  in_agreement(ranks_, [&] {
    std::vector<const std::int32_t*> next;
    for (std::size_t r = 0; r < size; ++r) next.push_back(Items<std::int32_t>(answers, r).begin());
    for (const std::int64_t number : numbers) owners.push_back(*next[directory_of(number)]++);
  });
  return owners;
}

void Halo::connect(const Neighbourhood& here) {
  const NeighbourLists& stars = here.stars;
  size_ = stars.count;
  if (ranks_.size() == 1) return;
  if (!directory_) make_directory(here);
  std::vector<std::size_t> places;
  std::vector<std::int64_t> numbers;
  in_agreement(ranks_, [&] {
    const std::size_t slots = stars.count == 0 ? 0 : stars.end_of(stars.count - 1);
    for (std::size_t s = 0; s < slots; ++s) {
      const auto place = static_cast<std::size_t>(stars.neighbour[s]) - 1;
      if (place >= stars.count) places.push_back(place);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    for (const std::size_t place : places) numbers.push_back(here.numbers[place]);
    if (!places.empty()) size_ = places.back() + 1;
  });
  const std::vector<std::int32_t> owners = owners_of(numbers);
  in_agreement(ranks_, [&] {
    to_.assign(static_cast<std::size_t>(ranks_.size()), {});
    from_ = to_;
    std::vector<std::size_t> owner(size_ - stars.count);
    for (std::size_t k = 0; k < places.size(); ++k) {
      owner[places[k] - stars.count] = static_cast<std::size_t>(owners[k]);
      from_[static_cast<std::size_t>(owners[k])].push_back(places[k]);
    }
    for (std::size_t i = 0; i < stars.count; ++i)
      for (std::size_t s = stars.begin_of(i); s < stars.end_of(i); ++s) {
        const auto place = static_cast<std::size_t>(stars.neighbour[s]) - 1;
        if (place < stars.count) continue;
        std::vector<std::size_t>& to = to_[owner[place - stars.count]];
        if (to.empty() || to.back() != i) to.push_back(i);
      }
    const auto by_number = [&](std::size_t a, std::size_t b) { return here.numbers[a] < here.numbers[b]; };
    for (auto* lists : {&to_, &from_})
      for (std::vector<std::size_t>& list : *lists) std::sort(list.begin(), list.end(), by_number);
  });
}

}  // namespace pstripack::scvt
