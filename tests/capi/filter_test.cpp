// Filters through the C ABI.
#include <cmath>
#include <limits>
#include <vector>

#include "support.h"

namespace {

ifsm_filter_info describe(ifsm_filter filter) {
  ifsm_filter_info info{};
  info.struct_size = sizeof info;
  EXPECT_EQ(ifsm_filter_describe(filter, &info), IFSM_OK);
  return info;
}

std::vector<double> matrix_of(ifsm_filter filter) {
  int64_t count = 0;
  EXPECT_EQ(ifsm_filter_matrix(filter, nullptr, 0, &count), IFSM_OK);
  std::vector<double> matrix(static_cast<std::size_t>(count));
  EXPECT_EQ(ifsm_filter_matrix(filter, matrix.data(), count, &count), IFSM_OK);
  return matrix;
}

class Filter : public testing::Test {
 protected:
  void SetUp() override { WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 4, 2, &filter)); }
  void TearDown() override { WORKS(ifsm_filter_destroy(filter)); }
  ifsm_filter filter{};
  ifsm_filter made{};
};

TEST_F(Filter, ThatIsNamedHasTheShapeAskedFor) {
  const ifsm_filter_info info = describe(filter);
  EXPECT_EQ(info.topology, IFSM_TOPOLOGY_JOINED);
  EXPECT_EQ(info.control_points, 4);
  EXPECT_EQ(info.maps, 2);
  EXPECT_EQ(info.stride, 3);
  EXPECT_EQ(info.rows, 7);
  EXPECT_EQ(info.details_per_node, 3);
  EXPECT_EQ(info.contractive, 1);
  EXPECT_GE(info.condition, 1);
}

TEST_F(Filter, ComesBackFromItsMatrixBitForBit) {
  const auto matrix = matrix_of(filter);
  ASSERT_EQ(matrix.size(), 49u);
  WORKS(ifsm_filter_from_matrix(IFSM_TOPOLOGY_JOINED, 4, 2, 0, matrix.data(), 49, &made));
  EXPECT_EQ(matrix_of(made), matrix);
  WORKS(ifsm_filter_destroy(made));
}

TEST_F(Filter, ComesBackFromItsMapsWithTheSameComplement) {
  const auto matrix = matrix_of(filter);
  WORKS(ifsm_filter_from_maps(IFSM_TOPOLOGY_JOINED, 4, 2, 0, matrix.data(), 4 * 7, &made));
  EXPECT_EQ(matrix_of(made), matrix);
  WORKS(ifsm_filter_destroy(made));
}

TEST_F(Filter, LeavesAnArrayThatIsTooSmallAlone) {
  std::vector<double> room(48, 7.0);
  int64_t count = -5;
  FAILS(ifsm_filter_matrix(filter, room.data(), 48, &count), IFSM_ERROR_CAPACITY, "matrix");
  EXPECT_EQ(last_error().required, 49);
  EXPECT_EQ(room, std::vector<double>(48, 7.0));
  EXPECT_EQ(count, -5);
}

TEST_F(Filter, RefusesNamesThatItDoesNotHaveAndListsThoseItHas) {
  FAILS(ifsm_filter_named("casteljou", 0, 0, 0, &made), IFSM_ERROR_RANGE, "name");
  EXPECT_NE(std::string(last_error().message).find("casteljau, coast, haar"), std::string::npos)
      << last_error().message;
  FAILS(ifsm_filter_named(nullptr, 0, 0, 0, &made), IFSM_ERROR_NULL, "name");
  FAILS(ifsm_filter_named("casteljau", 0, 0, 0, nullptr), IFSM_ERROR_NULL, "filter");
  EXPECT_EQ(made.id, 0u);
}

TEST_F(Filter, RefusesShapesOutsideTheRange) {
  const double matrix[1] = {1};
  FAILS(ifsm_filter_from_matrix(2, 4, 2, 0, matrix, 1, &made), IFSM_ERROR_RANGE, "topology");
  FAILS(ifsm_filter_from_matrix(0, 17, 2, 0, matrix, 1, &made), IFSM_ERROR_RANGE, "control_points");
  FAILS(ifsm_filter_from_matrix(0, 4, 9, 0, matrix, 1, &made), IFSM_ERROR_RANGE, "maps");
  FAILS(ifsm_filter_from_matrix(0, 4, 2, 2, matrix, 1, &made), IFSM_ERROR_RANGE, "stride");
  FAILS(ifsm_filter_from_matrix(0, 4, 2, 0, matrix, 1, &made), IFSM_ERROR_SHAPE, "count");
  EXPECT_EQ(last_error().required, 49);
  FAILS(ifsm_filter_from_matrix(0, 4, 2, 0, nullptr, 49, &made), IFSM_ERROR_NULL, "matrix");
  EXPECT_EQ(made.id, 0u);
}

TEST_F(Filter, RefusesMatricesThatAreNotFiniteOrNotAFilter) {
  auto matrix = matrix_of(filter);
  matrix[17] = std::numeric_limits<double>::quiet_NaN();
  FAILS(ifsm_filter_from_matrix(0, 4, 2, 0, matrix.data(), 49, &made), IFSM_ERROR_NOT_FINITE, "matrix");
  EXPECT_EQ(last_error().index, 17);
  FAILS(ifsm_filter_from_maps(0, 4, 2, 0, matrix.data(), 28, &made), IFSM_ERROR_NOT_FINITE, "matrix");
  matrix[17] = 100;
  FAILS(ifsm_filter_from_matrix(0, 4, 2, 0, matrix.data(), 49, &made), IFSM_ERROR_SINGULAR, "matrix");
  EXPECT_EQ(made.id, 0u);
}

TEST_F(Filter, WantsAResultStructWithItsSize) {
  ifsm_filter_info info{};
  FAILS(ifsm_filter_describe(filter, &info), IFSM_ERROR_OPTIONS, "info");
  FAILS(ifsm_filter_describe(filter, nullptr), IFSM_ERROR_NULL, "info");
}

TEST_F(Filter, IsOfItsOwnKind) {
  FAILS(ifsm_model_destroy(ifsm_model{filter.id}), IFSM_ERROR_INVALID_HANDLE, "model");
  FAILS(ifsm_fit_destroy(ifsm_fit{filter.id}), IFSM_ERROR_INVALID_HANDLE, "fit");
  EXPECT_EQ(describe(filter).control_points, 4);
}

}  // namespace
