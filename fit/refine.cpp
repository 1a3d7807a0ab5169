#include "fit/refine.h"

namespace ifsm::core {

Lanes refined(const Shape& shape, const RowMatrix& matrix, const Lanes& coarse, int from, int to) {
  const Eigen::MatrixXd maps = matrix.topRows(shape.control_points()).transpose();
  Lanes line = coarse;
  for (int level = from; level < to; ++level) {
    Lanes fine(shape.line_length(level + 1), line.cols());
    for (Index node = 0; node < shape.nodes(level); ++node)
      fine.middleRows(node * shape.children_step(), shape.rows()).noalias() =
          maps * line.middleRows(node * shape.polygon_step(), shape.control_points());
    line.swap(fine);
  }
  return line;
}

}  // namespace ifsm::core
