#pragma once
// The options that say how a file of nodes is read, for pstripack and stripack-compare.

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "files/nodes.h"

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace program {

/// Accepts one of these words.
CLI::Validator one_of(std::vector<std::string> words);

/// Adds an option that is one of these words; set(word) takes it.
void add_words(CLI::App& app, const char* name, std::vector<std::string> words, const char* text,
               const std::function<void(const std::string&)>& set);

/// Adds an option that is one of these words, each of which stands for an enumerator.
template <class Enum>
void add_choice(CLI::App& app, const char* name, Enum& value, const std::map<std::string, Enum>& choices,
                const char* text) {
  std::vector<std::string> words;
  for (const auto& [word, choice] : choices) words.push_back(word);
  add_words(app, name, words, text, [&value, choices](const std::string& word) { value = choices.at(word); });
}

/// --from, --columns, --coordinates, --units.
void add_reading(CLI::App& app, files::ReadOptions& read);

}  // namespace program
