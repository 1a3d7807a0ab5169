// Maps of the plane in six numbers, for innermost loops.
#pragma once

#include "linalg/affine.h"

namespace ifsm::core {

// x → M x + t. Affine's without what is zero in the plane: a third of the products.
struct Piece {
  double a, b, c, d, e, f;

  double x(double u, double v) const { return a * u + b * v + e; }
  double y(double u, double v) const { return c * u + d * v + f; }

  friend Piece operator*(const Piece& p, const Piece& q) {
    return {p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d,       p.c * q.a + p.d * q.c,
            p.c * q.b + p.d * q.d, p.a * q.e + p.b * q.f + p.e, p.c * q.e + p.d * q.f + p.f};
  }
};

}  // namespace ifsm::core
