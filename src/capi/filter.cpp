#include "curve/filter.h"

#include <ifsm.h>

#include "capi/arguments.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "curve/complement.h"
#include "curve/named.h"

using namespace ifsm::core;

namespace {

Topology topology_of(int32_t topology) { return choice(topology, Topology::square, "topology"); }

// A copy of the caller's row-major matrix.
RowMatrix matrix_of(const double* matrix, int64_t count, int rows, int columns) {
  required(matrix, "matrix");
  require_count(count, int64_t{rows} * columns, "count");
  require_finite(matrix, count, "matrix");
  return Eigen::Map<const RowMatrix>(matrix, rows, columns);
}

}  // namespace

ifsm_status ifsm_filter_named(const char* name, int32_t topology, int32_t control_points, int32_t maps,
                              ifsm_filter* filter) {
  return guarded(__func__, [&] {
    required(name, "name");
    required(filter, "filter");
    issue(named_filter(name, topology_of(topology), control_points, maps), *filter);
  });
}

ifsm_status ifsm_filter_from_matrix(int32_t topology, int32_t control_points, int32_t maps, int32_t stride,
                                    const double* matrix, int64_t count, ifsm_filter* filter) {
  return guarded(__func__, [&] {
    required(filter, "filter");
    const Shape shape(topology_of(topology), control_points, maps, stride);
    issue(std::make_shared<Filter>(shape, matrix_of(matrix, count, shape.rows(), shape.rows())), *filter);
  });
}

ifsm_status ifsm_filter_from_maps(int32_t topology, int32_t control_points, int32_t maps, int32_t stride,
                                  const double* matrix, int64_t count, ifsm_filter* filter) {
  return guarded(__func__, [&] {
    required(filter, "filter");
    const Shape shape(topology_of(topology), control_points, maps, stride);
    const RowMatrix t = matrix_of(matrix, count, shape.control_points(), shape.rows());
    issue(std::make_shared<Filter>(shape, with_complement(shape, t)), *filter);
  });
}

ifsm_status ifsm_filter_describe(ifsm_filter handle, ifsm_filter_info* info) {
  return guarded(__func__, [&] {
    const auto filter = borrow(handle);
    const Shape& shape = filter->shape();
    ifsm_filter_info told{};
    told.topology = static_cast<int32_t>(shape.topology());
    told.control_points = shape.control_points();
    told.maps = shape.maps();
    told.stride = shape.stride();
    told.rows = shape.rows();
    told.details_per_node = shape.details_per_node();
    told.contractive = static_cast<int32_t>(filter->contractivity());
    told.condition = filter->condition();
    Report(info, "info").write(told);
  });
}

ifsm_status ifsm_filter_matrix(ifsm_filter handle, double* matrix, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto filter = borrow(handle);
    deliver(filter->matrix().size(), output(matrix, capacity, "matrix"), required(count, "count"),
            [&]() -> const RowMatrix& { return filter->matrix(); });
  });
}

ifsm_status ifsm_filter_destroy(ifsm_filter filter) {
  return guarded(__func__, [&] { destroy(filter); });
}
