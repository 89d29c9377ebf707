#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace comparison {

enum ExitCode { kExplained = 0, kAgainstUs = 1, kUsage = 2 };

/// The command chosen on the command line; returns the exit code.
using Command = std::function<int()>;

/// `stripack-compare lists A B`
void add_lists(CLI::App& app, Command& chosen);
/// `stripack-compare record -- PROGRAM ARGUMENTS`
void add_record(CLI::App& app, Command& chosen);
/// `stripack-compare replay FILE`
void add_replay(CLI::App& app, Command& chosen);

}  // namespace comparison
