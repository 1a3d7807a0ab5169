// The canonical complement U of a given T.
#pragma once

#include "curve/filter.h"

namespace ifsm::core {

// R = (maps over U). Square: U spans the orthogonal complement of T's rows and U U^T = s² I, s the geometric mean of
// T's extreme singular values, so that cond(R) = cond(T) and analysis is least squares. Joined: the same for the
// interior columns of the interior rows. The basis is that of a column-pivoted QR of the projector, with positive
// diagonal: a choice that depends on nothing but T. A singular error when T's rows are dependent.
RowMatrix with_complement(const Shape& shape, const RowMatrix& maps);

}  // namespace ifsm::core
