#include "chosen_original.h"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "probe.h"

namespace comparison {
namespace {
constexpr double kLongestProbe = 2;  // limit in seconds of each call of TRMESH for six nodes
}

ChosenOriginal open_original(const OriginalChoice& choice, double timeout, int real_bytes) {
  using legacy_stripack::Abi;
  auto where = legacy_stripack::configured_original();
  if (!choice.file.empty()) where = {choice.file, choice.file, Abi{real_bytes, 4, 12}};
  if (!where)
    throw std::runtime_error("no original to compare with: this build found none; give --original LIBRARY");
  if (!choice.abi.empty()) where->abi = legacy_stripack::abi_named(choice.abi);

  const auto probe = probe_abi(legacy_stripack::Library(where->file), where->abi.real_bytes,
                               std::min(timeout, kLongestProbe));
  const auto text_of = [](const Abi& abi) { return fmt::format("{}: {}", name_of(abi), describe(abi)); };
  if (!probe.abi)
    fmt::print(
        stderr,
        "stripack-compare: {}: its ABI cannot be detected, since TRMESH does not triangulate six nodes: {}. "
        "It is called as {}{}\n",
        where->name, probe.why_not, text_of(where->abi),
        choice.abi.empty() ? ", which --original-abi, or abi= in PSTRIPACK_CHECK, overrides" : "");
  else if (!choice.abi.empty() && !(where->abi == *probe.abi))
    throw std::runtime_error(fmt::format("{}: its TRMESH answers to ABI {}, not to {}", where->name,
                                         text_of(*probe.abi), text_of(where->abi)));
  else
    where->abi = *probe.abi;
  return {legacy_stripack::Original(*where), fmt::format("{} ({})", where->name, text_of(where->abi))};
}

}  // namespace comparison
