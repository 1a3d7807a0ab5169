// The turn of a polygon P → P': the similarity of positive orientation that maps one onto the other best.
#pragma once

#include <Eigen/Core>

namespace ifsm::core {

using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;
using PolygonView = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;  // a point a row

// Root mean square distance of a polygon's points from their mean; 0 when they differ by rounding alone.
double polygon_size(const PolygonView& polygon);

// d × d rotation Q that minimises sum |Q p_j - p'_j|² over centred points; where the points leave it undetermined, the
// one that turns least. P' = P gives the identity, bit for bit.
SmallMatrix least_rotation(const PolygonView& from, const PolygonView& to);

// size(P') / size(P) · least_rotation; a polygon that is one point counts as of the other's size.
SmallMatrix turn(const PolygonView& from, const PolygonView& to);

}  // namespace ifsm::core
