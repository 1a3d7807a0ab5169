// A map as it is composed: shear, then scale, then turn, then move. By paper 000 these give the best level of control.
#pragma once

#include "linalg/affine.h"

namespace ifsm::core {

// M = rotation · diag(scale) · [[1, h_xy, h_xz], [0, 1, h_yz], [0, 0, 1]]. Every map is one.
struct Parameters {
  Vector3 rotation = Vector3::Zero();  // axis times angle in radians; in the plane (0, 0, angle), against the clock
  Vector3 scale = Vector3::Ones();     // negative: a reflection; z is not looked at in the plane
  Vector3 shear = Vector3::Zero();     // h_xy, h_xz, h_yz; in the plane h_xy alone
  Vector3 shift = Vector3::Zero();
};

Affine map_of(const Parameters& parameters, int dimension);

// The same map's parameters: of an angle in (-π, π], of scales not negative but for the last, which has det's
// sign. Shears of what is scaled to nothing are 0.
Parameters parameters_of(const Affine& map, int dimension);

}  // namespace ifsm::core
