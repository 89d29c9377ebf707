#pragma once
// The options that say how a file of nodes is read, for pstripack and stripack-compare.

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "files/nodes.h"

namespace program {

/// "'word' is none of A, B; did you mean A?"
std::string is_none_of(const std::string& word, const std::vector<std::string>& words);

/// Accepts one of these words and converts it to an enumerator.
template <class Enum>
void add_choice(CLI::App& app, const char* name, Enum& value, const std::map<std::string, Enum>& choices,
                const char* text) {
  const auto number_of = [choices](std::string& word) -> std::string {
    if (const auto found = choices.find(word); found != choices.end()) {
      word = std::to_string(static_cast<int>(found->second));
      return "";
    }
    std::vector<std::string> words;
    for (const auto& [choice, number] : choices) words.push_back(choice);
    return is_none_of(word, words);
  };
  app.add_option(name, value, text)->type_name("WORD")->transform(CLI::Validator(number_of, ""));
}

/// --from, --columns, --coordinates, --units.
void add_reading(CLI::App& app, files::ReadOptions& read);

}  // namespace program
