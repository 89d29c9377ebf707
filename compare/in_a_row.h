#pragma once

/// Where two kinds of calls are measured in turn: some of one kind in a row. call(false) does not count, then
/// call(true) does, three times. On a virtual machine processors that have slept through the other kind's
/// calls are slow to come back; and the first call of all has pages that are new to it.
template <class Call>
void in_a_row(const Call& call) {
  for (const bool counts : {false, true, true, true}) call(counts);
}
