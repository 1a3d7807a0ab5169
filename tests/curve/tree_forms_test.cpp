#include "curve/tree_forms.h"

#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

constexpr int levels = 8;

TreeForms factored(const Shape& shape, const Eigen::VectorXd& weight, const Kept& kept) {
  TreeForms forms(shape, levels, false, weight);
  forms.factor(named_filter("casteljau", Topology::joined, shape.control_points(), shape.maps())->matrix(), kept, {});
  return forms;
}

TEST(TreeForms, HoldOneFormALevelWhereAllPlacesAreSamples) {
  const Shape shape(Topology::joined, 5, 2);
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(shape.line_length(levels));
  const TreeForms forms(shape, levels, false, weight);
  EXPECT_EQ(forms.root_kind(), levels - 1);
}

// Places k ρ rounded: m neighbouring ones show m + 1 patterns at most.
TEST(TreeForms, HoldFewFormsWhereSamplesLeaveGaps) {
  const Shape shape(Topology::joined, 5, 2);
  const Points points(1, 11'000);
  const FilterPtr filter = named_filter("casteljau", Topology::joined, 5, 2);
  const ModelPtr model = analyze(filter, points, false);
  const int deep = model->levels();
  const TreeForms forms(shape, deep, false, sample_weights(*model));
  Index most = 0;
  for (int level = 0; level < deep; ++level)
    most += std::min(shape.nodes(level), (shape.line_length(deep) - 1) / shape.nodes(level) + 1);
  EXPECT_LE(forms.root_kind() + 1, most);
  EXPECT_LT(most, shape.first_node(deep) / 8);
}

TEST(TreeForms, BranchOnlyTowardsWhatIsKept) {
  const Shape shape(Topology::joined, 4, 3);
  const Index d = shape.details_per_node();
  Kept kept(static_cast<std::size_t>(shape.first_node(levels) * d), char{0});
  const Index node = 1234;
  ASSERT_LT(node, shape.nodes(levels - 1));
  kept[static_cast<std::size_t>((shape.first_node(levels - 1) + node) * d + 2)] = 1;
  kept[static_cast<std::size_t>((shape.first_node(1) + 2) * d)] = 1;
  const TreeForms forms = factored(shape, Eigen::VectorXd::Ones(shape.line_length(levels)), kept);
  EXPECT_EQ(forms.kept_count(), 2);
  EXPECT_EQ(forms.branches(0).size(), 1U);
  Index values = 0;
  for (int level = 0; level < levels; ++level)
    for (const Branch& branch : forms.branches(level)) {
      EXPECT_EQ(branch.level, level);
      EXPECT_EQ(branch.first_value, values);
      values += static_cast<Index>(branch.kept.size());
      for (int c = 0; c < shape.maps(); ++c)
        if (const int child = branch.children[static_cast<std::size_t>(c)]; child >= 0) {
          EXPECT_EQ(forms.branch(child).node, branch.node * shape.maps() + c);
        }
    }
  ASSERT_EQ(forms.branches(levels - 1).size(), 1U);
  EXPECT_EQ(forms.branches(levels - 1)[0].node, node);
  EXPECT_EQ(forms.branches(levels - 1)[0].kept, std::vector<int>{2});
}

TEST(TreeForms, ForgetWhatWasKeptBefore) {
  const Shape shape(Topology::joined, 3, 2);
  const Eigen::VectorXd weight = Eigen::VectorXd::Ones(shape.line_length(levels));
  const auto filter = named_filter("casteljau", Topology::joined, 3, 2)->matrix();
  const auto details = static_cast<std::size_t>(shape.first_node(levels) * shape.details_per_node());
  TreeForms forms = factored(shape, weight, Kept(details, char{1}));
  forms.factor(filter, Kept(details, char{0}), {});
  EXPECT_EQ(forms.root_branch(), -1);
  EXPECT_EQ(forms.root_inverse(), factored(shape, weight, Kept(details, char{0})).root_inverse());
}

}  // namespace
