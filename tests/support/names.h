#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <string>

/// A text as GoogleTest takes it for the name of a case: with underscores for all but letters and digits.
inline std::string case_name(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
  return text;
}
inline std::string name_of_case(const ::testing::TestParamInfo<std::string>& info) {
  return case_name(info.param);
}
