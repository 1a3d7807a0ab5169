// Do all long products of some matrices shrink? What proofs and refutations of that need. Words are read from the left:
// the word (i, j) stands for maps[i] * maps[j].
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

namespace ifsm::core {

// Proven: all long products shrink. Refuted: some do not. Undecided at the length tried.
enum class Contractivity : std::int32_t { refuted = -1, undecided = 0, proven = 1 };

// Upper triangular U: in the coordinates U x the matrices look nearly as contractive as they are together. The root of
// the limit of H ← I + c Σ A_i^T H A_i, c < 1/N slowed so that it converges for every contractive set. The identity
// where numbers fail.
Eigen::MatrixXd balancing(const std::vector<Eigen::MatrixXd>& maps);

// A word of a spectral radius that is not below 1.
struct Growth {
  std::vector<int> word;
  double radius;
};

// One of the shortest, up to `longest` letters; of each length the 256 words of the largest norms are looked at.
std::optional<Growth> growing_word(const std::vector<Eigen::MatrixXd>& maps, int longest);

}  // namespace ifsm::core
