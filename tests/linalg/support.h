// Seeded numbers and matrices for all tests that do arithmetic, and a way to look at refusals.
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <random>

#include "base/error.h"

namespace ifsm::core::testing {

constexpr double epsilon = 2.220446049250313e-16;
using Random = std::mt19937_64;
using Matrix = Eigen::MatrixXd;

double normal(Random& random);
Eigen::Index uniform(Random& random, Eigen::Index low, Eigen::Index high);
Matrix random_matrix(Random& random, Eigen::Index rows, Eigen::Index columns);

// A square matrix with orthonormal columns, the first of which span what the given ones do.
Matrix orthonormal(const Matrix& columns);

// d × d, of determinant 1; nothing else of its distribution is promised.
Matrix random_rotation(Random& random, Eigen::Index d);

// The least x, a column for each of b's, that minimises |a x - b|: Eigen's complete orthogonal decomposition.
Matrix least_squares(const Matrix& a, const Matrix& b);
Eigen::Index rank(const Matrix& a);

// Fails unless `call` throws an Error; gives it for a look.
template <class Call>
Error refusal(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << "nothing was refused";
  return {Status::ok, "", ""};
}

}  // namespace ifsm::core::testing
