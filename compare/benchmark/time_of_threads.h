#pragma once
// What threads cost and gain where the user sets nothing.

#include <string>
#include <vector>

#include "library.h"

namespace benchmark {

/// Writes a table: TRMESH by default and on one thread, other nodes in each call, 20 ms between the calls, as
/// in a model.
void run_time_of_threads(const std::string& self, int repeats);

/// Writes a table: the same where other ranks or programs need the processors, without a pause.
void run_time_of_threads_on_busy_machine(const std::string& self, int repeats);

/// Writes a table: the first call of a process, which the system has to give memory, and later ones; for up
/// to a million nodes those of the original, too, if it is given.
void run_time_of_first_calls(const std::string& self, const std::vector<int>& sizes,
                             const legacy_stripack::Library* original, int repeats);

/// Writes a table: triad of STREAM, TRMESH, TRLIST, CRLIST and centroidal meshes on 1, 2, 4, ... and all
/// processors.
void run_scaling_of_threads(const std::string& self, int repeats);

}  // namespace benchmark
