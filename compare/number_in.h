#pragma once

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <string>

/// Accepts the numbers from `low` to `high`. CLI::Range lets nan pass.
inline CLI::Validator number_in(double low, double high) {
  return CLI::Validator(
      [low, high](const std::string& text) {
        double value;
        const bool is_in = CLI::detail::lexical_cast(text, value) && low <= value && value <= high;
        return is_in ? "" : fmt::format("{} is not from {:g} to {:g}", text, low, high);
      },
      "");
}
