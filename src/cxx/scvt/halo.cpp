#include "scvt/halo.h"

#include <algorithm>

namespace pstripack::scvt {

void Halo::make_directory(const Neighbourhood& here) {
  const auto size = static_cast<std::size_t>(ranks_.size());
  const Parcels parcels = exchange_in_agreement(ranks_, [&] {
    std::vector<std::vector<std::int64_t>> numbers(size);
    for (std::size_t i = 0; i < here.stars.count; ++i)
      numbers[meeting_rank(GlobalNumber{here.numbers[i]}, size)].push_back(here.numbers[i]);
    return packed(numbers);
  });
  in_agreement(ranks_, [&] {
    directory_.emplace(Items<std::int64_t>(parcels).size());
    for (std::size_t r = 0; r < size; ++r)
      for (const std::int64_t number : Items<std::int64_t>(parcels, r))
        directory_->insert(GlobalNumber{number}, static_cast<std::int32_t>(r));
  });
}

void Halo::connect(const Neighbourhood& here) {
  const NeighbourLists& stars = here.stars;
  size_ = stars.count;
  if (ranks_.size() == 1) return;
  if (!directory_) make_directory(here);
  const auto size = static_cast<std::size_t>(ranks_.size());
  std::vector<std::size_t> places;  // of the halo
  const Parcels questions = exchange_in_agreement(ranks_, [&] {
    const std::size_t slots = stars.count == 0 ? 0 : stars.end_of(stars.count - 1);
    for (std::size_t s = 0; s < slots; ++s) {
      const auto place = static_cast<std::size_t>(stars.neighbour[s]) - 1;
      if (place >= stars.count) places.push_back(place);
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<std::vector<std::int64_t>> asked(size);
    for (const std::size_t place : places)
      asked[meeting_rank(GlobalNumber{here.numbers[place]}, size)].push_back(here.numbers[place]);
    return packed(asked);
  });
  const Parcels answers = exchange_in_agreement(ranks_, [&] {
    std::vector<std::vector<std::size_t>> owners(size);
    for (std::size_t r = 0; r < size; ++r)
      for (const std::int64_t number : Items<std::int64_t>(questions, r))
        owners[r].push_back(static_cast<std::size_t>(directory_->at(GlobalNumber{number})));
    return packed(owners);
  });
  in_agreement(ranks_, [&] {
    to_.assign(size, {});
    from_.assign(size, {});
    if (!places.empty()) size_ = places.back() + 1;
    std::vector<const std::size_t*> answer;
    for (std::size_t r = 0; r < size; ++r) answer.push_back(Items<std::size_t>(answers, r).begin());
    std::vector<std::size_t> owner(size_ - stars.count);
    for (const std::size_t place : places) {
      owner[place - stars.count] = *answer[meeting_rank(GlobalNumber{here.numbers[place]}, size)]++;
      from_[owner[place - stars.count]].push_back(place);
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
