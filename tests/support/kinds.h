#pragma once
// The kinds of reals and integers of the four libraries, for typed tests of templates.

#include <gtest/gtest.h>

#include <cstdint>

template <class RealKind, class IntKind>
struct Kinds {
  using Real = RealKind;
  using Int = IntKind;
};

using AllKinds =
    ::testing::Types<Kinds<float, std::int32_t>, Kinds<double, std::int32_t>, Kinds<double, std::int64_t>>;
