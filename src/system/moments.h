// Moments of the invariant measure: exact, from linear systems degree by degree.
#pragma once

#include <array>
#include <vector>

#include "system/system.h"

namespace ifsm::core {

constexpr int most_moment_degree = 8;

// Powers of x, y, z (z: 0 in the plane). Of degree 0, then 1, …; within a degree those of x fall, then those of y.
using Powers = std::array<int, 3>;
std::vector<Powers> monomials(int dimension, int degree);

// ∫ (x - about)^a dμ for the monomials above. Degree 1 … 8 (range).
std::vector<double> moments(const System& system, int degree, const Vector3& about);

}  // namespace ifsm::core
