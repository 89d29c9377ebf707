// Every point file of tests/data, in the given and in other orders. Every bug found becomes a file there:
// hexadecimal floats, and a comment on what went wrong.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "point_sets.h"
#include "support/data_file.h"
#include "support/expect.h"
#include "support/names.h"

namespace {

std::vector<std::string> files() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(TEST_DATA_DIR))
    if (entry.path().extension() == ".txt") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

class PointFile : public ::testing::TestWithParam<std::string> {};

TEST_P(PointFile, IsAsPromisedInAnyOrder) {
  expect_as_promised_in_any_order(nodes_in(TEST_DATA_DIR "/" + GetParam() + ".txt"), GetParam(), 50);
}

INSTANTIATE_TEST_SUITE_P(Of, PointFile, ::testing::ValuesIn(files()), name_of_case);

TEST(PointFiles, AreThere) { EXPECT_GE(files().size(), 5u); }

}  // namespace
