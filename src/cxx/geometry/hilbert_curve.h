#pragma once
// Hilbert's curve on a square, five levels at a time.

#include <array>
#include <cstdint>

namespace pstripack::hilbert {

constexpr int kLevels = 5;  ///< levels of the curve per step ("block")
constexpr std::uint32_t kSide = 1 << kLevels;

/// In a state the axes are swapped (bit 0), and the curve runs backwards (bit 1).
constexpr std::uint16_t kSwap = 1, kInvert = 2;

struct Step {
  std::uint16_t position, state;
};

constexpr std::array<std::array<Step, kSide * kSide>, 4> make_steps() {
  // For each state: position along the curve of the quadrant (i,j), and the change of state there.
  constexpr std::uint16_t position_of[4][4] = {{0, 1, 3, 2}, {0, 3, 1, 2}, {2, 3, 1, 0}, {2, 1, 3, 0}};
  constexpr std::uint16_t change[4] = {kSwap, 0, 0, kInvert | kSwap};
  std::array<std::array<Step, kSide * kSide>, 4> steps{};
  for (std::uint16_t start = 0; start < 4; ++start)
    for (std::uint32_t cell = 0; cell < kSide * kSide; ++cell) {
      std::uint16_t state = start, position = 0;
      for (int level = kLevels - 1; level >= 0; --level) {
        const std::uint32_t i = (cell >> (kLevels + level)) & 1, j = (cell >> level) & 1;
        const std::uint16_t quadrant = position_of[state][i << 1 | j];
        position = static_cast<std::uint16_t>(position << 2 | quadrant);
        state = static_cast<std::uint16_t>(state ^ change[quadrant]);
      }
      steps[start][cell] = {position, state};
    }
  return steps;
}

/// steps[state][i<<5|j]: the position of cell (i,j) of 32 x 32 along the curve, and the state in that cell.
inline constexpr auto steps = make_steps();

/// Position of the cell (i,j) of kSide^blocks x kSide^blocks along the curve: 2 kLevels bits per block. Other
/// bits of i and j do not matter.
inline std::uint64_t along_curve(std::uint32_t i, std::uint32_t j, int blocks, std::uint16_t state = 0) {
  std::uint64_t key = 0;
  for (int b = kLevels * (blocks - 1); b >= 0; b -= kLevels) {
    const Step s = steps[state][((i >> b) & (kSide - 1)) << kLevels | ((j >> b) & (kSide - 1))];
    key = key << (2 * kLevels) | s.position;
    state = s.state;
  }
  return key;
}

}  // namespace pstripack::hilbert
