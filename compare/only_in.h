#pragma once

#include <algorithm>
#include <iterator>
#include <vector>

/// The items of the first of two sorted vectors that the second does not have.
template <class Item>
std::vector<Item> only_in(const std::vector<Item>& first, const std::vector<Item>& second) {
  std::vector<Item> rest;
  std::set_difference(first.begin(), first.end(), second.begin(), second.end(), std::back_inserter(rest));
  return rest;
}
