// On which side of a line a point lies: decided exactly.
#pragma once

namespace ifsm::core {

// (b - a) x (c - a) in the plane: positive when c lies to the left of the way from a to b, zero when and only when the
// three are collinear. The sign is exact, whatever the rounding, for coordinates that are 0 or 2^-450 … 2^450 in
// magnitude; where floating point leaves the sign in doubt, the determinant is summed as an expansion.
// Source: J. R. Shewchuk, Adaptive precision floating-point arithmetic and fast robust geometric predicates, 1997.
double orientation(const double* a, const double* b, const double* c);

// The same, rounded from the exact value: the sign and all digits.
double exact_orientation(const double* a, const double* b, const double* c);

}  // namespace ifsm::core
