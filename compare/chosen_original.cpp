#include "chosen_original.h"

#include <fmt/format.h>

#include <stdexcept>

#include "probe.h"

namespace comparison {

void add_original_options(CLI::App& app, OriginalChoice& choice) {
  app.add_option("--original", choice.file, "shared library of your own STRIPACK instead of the one found");
  app.add_option("--original-abi", choice.abi, "its ABI: r8 (12-argument TRMESH), r4, 8arg [r8]")
      ->check(CLI::IsMember({"r8", "r4", "8arg"}).description(""));
}

ChosenOriginal open_original(const OriginalChoice& choice) {
  if (choice.file.empty()) {
    const auto where = legacy_stripack::configured_original();
    if (!where)
      throw std::runtime_error("no original to compare with: this build found none; give --original LIBRARY");
    return {legacy_stripack::Original(*where), where->name};
  }
  ChosenOriginal chosen{{choice.file, legacy_stripack::abi_named(choice.abi)},
                        fmt::format("{} ({})", choice.file, choice.abi)};
  legacy_stripack::refuse_other_abi(chosen.original.library());
  return chosen;
}

}  // namespace comparison
