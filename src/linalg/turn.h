// The turn of a polygon P → P': the similarity of positive orientation that maps one onto the other best.
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace ifsm::core {

using SmallMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, 4, 4>;
inline SmallMatrix identity(Eigen::Index dimension) { return SmallMatrix::Identity(dimension, dimension); }
using PolygonView = Eigen::Ref<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>;  // a point a row

// Root mean square distance of a polygon's points from their mean; 0 when they differ by rounding alone.
double polygon_size(const PolygonView& polygon);

// d × d rotation Q that minimises sum |Q p_j - p'_j|² over centred points; where the points leave it undetermined, the
// one that turns least. P' = P gives the identity, bit for bit.
SmallMatrix least_rotation(const PolygonView& from, const PolygonView& to);

// size(P') / size(P) · least_rotation; a polygon that is one point counts as of the other's size.
SmallMatrix turn(const PolygonView& from, const PolygonView& to);

// What may be asked of a turn. Linear (paper 002): the matrix, any, that maps P onto P' best, by P's pseudo-inverse; in
// directions that P does not span, the similarity. The identity, bit for bit, for P' = P.
enum class Turning : std::int32_t { similarity = 0, rotation = 1, linear = 2 };
SmallMatrix turn(const PolygonView& from, const PolygonView& to, Turning how);

// Does the matrix take one polygon to the other, up to a translation and so much rounding? A part that moved as a whole
// keeps its parent's turn, which is better known than that of a small polygon.
bool maps_onto(const SmallMatrix& matrix, const PolygonView& from, const PolygonView& to, double rounding);

}  // namespace ifsm::core
