#pragma once

/// For measuring two kinds of calls alternately: some of one kind in a row. call(false) is not measured;
/// call(true) is, three times. On a virtual machine processors that slept during the other kind's calls are
/// slow to return; and the very first call uses new pages.
template <class Call>
void in_a_row(const Call& call) {
  for (const bool counts : {false, true, true, true}) call(counts);
}
