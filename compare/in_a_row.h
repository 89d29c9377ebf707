#pragma once

/// Measures a kind of call that alternates with another kind: call(false) once, not measured, then call(true)
/// three times. On a virtual machine, processors that slept during the other calls are slow to return, and
/// the first call of a process uses new pages.
template <class Call>
void in_a_row(const Call& call) {
  for (const bool counts : {false, true, true, true}) call(counts);
}
