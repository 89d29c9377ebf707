#pragma once
// The options that say how a file of nodes is read, for pstripack and stripack-compare.

#include <CLI/CLI.hpp>
#include <map>
#include <string>
#include <vector>

#include "files/nodes.h"

namespace program {

/// Adds an option by "--name TYPE", or an argument by its name.
template <class T>
CLI::Option* option(CLI::App& app, const std::string& name, T& value, const std::string& text) {
  const std::size_t blank = name.find(' ');
  return app.add_option(name.substr(0, blank), value, text)
      ->type_name(blank == name.npos ? "" : name.substr(blank + 1));
}

/// Accepts one of these words.
CLI::Validator one_of(std::vector<std::string> words);

/// Adds an option that is one of these words, each of which stands for an enumerator.
template <class Enum>
void add_choice(CLI::App& app, const char* name, Enum& value, const std::map<std::string, Enum>& choices,
                const char* text) {
  std::vector<std::string> words;
  for (const auto& [word, choice] : choices) words.push_back(word);
  app.add_option_function<std::string>(
         name, [&value, choices](const std::string& word) { value = choices.at(word); }, text)
      ->type_name("WORD")
      ->check(one_of(words));
}

/// --from, --columns, --coordinates, --units.
void add_reading(CLI::App& app, files::ReadOptions& read);

}  // namespace program
