#include "deform/reach.h"

#include <Eigen/Core>
#include <vector>

#include "deform/handles.h"

namespace ifsm::core {
namespace {

// A point as weights on the polygon of a node; upwards they are multiplied by the maps, P_child = P T_i (eq. (6)).
class Climb {
 public:
  Climb(const Model& model, const Seat& seat)
      : model_(model),
        level_(model.levels()),
        node_(seat.node),
        weights_(Eigen::VectorXd::Unit(model.shape().control_points(), seat.point)) {}

  void to(int level) {
    for (; level_ > level; --level_, node_ /= model_.shape().maps()) weights_ = columns().topRows(points()) * weights_;
  }
  // Of a node's own details, from its child.
  Eigen::VectorXd of_details() const { return columns().bottomRows(model_.shape().details_per_node()) * weights_; }

  Index node() const { return node_; }
  const Eigen::VectorXd& weights() const { return weights_; }

 private:
  int points() const { return model_.shape().control_points(); }
  // Of R, those that make this node's polygon.
  RowMatrix columns() const {
    const Index child = node_ % model_.shape().maps();
    return model_.filter().matrix().middleCols(child * model_.shape().polygon_step(), points());
  }

  const Model& model_;
  int level_;
  Index node_;
  Eigen::VectorXd weights_;
};

// add(seat, share) for what tells a point of the finest polyline: the two places that it lies between, each the mean of
// its seats. Joined, all seats of a place are alike: one tells it.
template <class Add>
void at_seats(const Model& model, double parameter, const Add& add) {
  const Handles finest(model.shape(), model.closed(), model.levels());
  const auto at_place = [&](Index place, double share) {
    std::vector<Seat> seats = finest.seats(place);
    if (model.shape().joined()) seats.resize(1);
    for (const Seat& seat : seats) add(seat, share / static_cast<double>(seats.size()));
  };
  const auto [place, next, part] = model.placement().between(parameter);
  at_place(place, 1 - part);
  if (part > 0) at_place(next, part);
}

}  // namespace

Shares handle_shares(const Model& model, int level, double parameter) {
  const Handles handles(model.shape(), model.closed(), level);
  Shares shares;
  at_seats(model, parameter, [&](const Seat& seat, double share) {
    Climb climb(model, seat);
    climb.to(level);
    for (int c = 0; c < model.shape().control_points(); ++c)
      if (climb.weights()(c) != 0) shares[handles.handle({climb.node(), c})] += share * climb.weights()(c);
  });
  return shares;
}

Shares detail_shares(const Model& model, int level, double parameter) {
  const int d = model.shape().details_per_node();
  Shares shares;
  at_seats(model, parameter, [&](const Seat& seat, double share) {
    Climb climb(model, seat);
    climb.to(level + 1);
    const Eigen::VectorXd own = climb.of_details();
    for (int j = 0; j < d; ++j)
      if (own(j) != 0) shares[climb.node() / model.shape().maps() * d + j] += share * own(j);
  });
  return shares;
}

}  // namespace ifsm::core
