// How a curve is posed: where its control points and the handles of finer levels went. The curve that a pose makes of a
// base model is told node by node:
//
//   x' = L_θ x + S(D_θ)   below a node θ that no deeper move touches,
//
// x the base's curve below θ, L_θ the turn that θ's details take, S the synthesis without details and D_θ = P'_θ - L_θ
// P_θ, P' and P the node's polygons in the pose and in the base. It is synthesis of P'_θ and details L_θ δ, since
// synthesis is linear and acts on each coordinate alone (paper 002, section 5); but x is synthesised once, and D_θ
// needs no details.
//
// The turn of a node that holds a moved handle is that of its polygon, base to pose; other nodes take their parent's,
// and the root turns by its control points. So nothing changes outside the nodes that hold what was moved: it keeps its
// bits.
#pragma once

#include <Eigen/Core>
#include <map>
#include <vector>

#include "deform/base.h"
#include "linalg/turn.h"

namespace ifsm::core {

using Vector = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 4, 1>;

// What details do when their polygon moves: turn by the turn of their node as told above; or of their own node's
// polygon each, all the way down (node-frame details); or stay as they are (absolute details).
enum class Follow : std::int32_t { moved = 0, each = 1, none = 2 };

struct Manner {
  Turning turning = Turning::similarity;
  Follow follow = Follow::moved;
};

// Of one level; keys are handles (handles.h). Displacements are told in the frame of the node that holds
// the handle, at the time of the base: they turn with what is above them.
struct Moves {
  std::map<Index, Vector> own;    // only the nodes that hold them change (ours)
  std::map<Index, Vector> field;  // the details below take the turn of the curve as a whole (paper 002, Local)
  std::map<Index, Vector> pins;   // places from the centre, whatever happens above
  // Added to details of this level, told as those of the base are; keys count the level's details. No turn follows.
  std::map<Index, Vector> details;

  bool moves_handles() const { return !own.empty() || !field.empty() || !pins.empty(); }
};

struct Pose {
  Points polygon;            // the control points, from the centre
  std::vector<Moves> moves;  // [level], the finest included; level 0's handles are the control points
};

// A base in a pose. Both are borrowed, and must not change. Not for two threads at once.
class Posed {
 public:
  Posed(const Base& base, const Pose& pose, Manner manner);

  // Places first … first + count - 1 of a level, from the centre, as points(model, level) has them.
  Points places(int level, Index first, Index count) const;

  // The matrix that turns displacements of a handle, told in its frame, to where they are seen.
  SmallMatrix frame(int level, Index handle) const;

  // The same for fields; and for the details of a node.
  SmallMatrix whole() const;
  SmallMatrix turn_at(int level, Index node) const;

  // A model that has this curve: details below the deepest moves are the base's, turned; above them, what analysis of
  // the moved handles finds.
  ModelPtr snapshot() const;

 private:
  using Polygon = Eigen::MatrixXd;  // n × d

  struct Node {
    int level;
    Index node;
    SmallMatrix turn;
    Polygon polygon;  // P'
    // D: handed down from where something moved, not told anew, so that it has the same bits however far the walk goes.
    Polygon off;
  };

  const Shape& shape() const { return base_.shape(); }
  Index dimension() const { return pose_.polygon.dimension(); }
  PolygonView base_polygon(int level, Index node) const;
  bool is_still(const Node& node) const;
  // By moves of handles of levels not below `deepest`, and of details above it.
  bool is_moved_below(int level, Index node, int deepest) const;

  Node root() const;
  void find_off(Node& node) const;
  Points off_of_children(const Node& node) const;
  // The children of a node, their own level's moves not yet made.
  std::vector<Node> children(const Node& node, int begin, int end) const;  // of all, numbers begin … end - 1
  // Makes the moves of the node's own level. `path` holds the turns of the nodes above it, the root's first.
  void move(Node& node, const std::vector<SmallMatrix>& path) const;
  SmallMatrix own_turn(const Node& node, const SmallMatrix& handed) const;
  SmallMatrix whole_turn(int level, const SmallMatrix& handed) const;
  void find_whole_turns();

  // Calls visit(node) for the nodes, level by level at most `level`, below which the one formula tells the curve, as
  // far as they hold values of the line of `level` within [first, end).
  template <class Visit>
  void walk(int level, Index first, Index end, const Visit& visit) const;
  template <class Visit>
  void walk_below(Node node, std::vector<SmallMatrix>& path, int level, Index first, Index end,
                  const Visit& visit) const;

  Points line(int level, Index first, Index end) const;
  void write(const Node& node, int level, Index first, Points& out) const;

  const Base& base_;
  const Pose& pose_;
  Manner manner_;
  int deepest_ = 0;                       // level whose polygons are moved otherwise than by what is above
  std::vector<SmallMatrix> whole_turns_;  // [level]: of the curve as a whole, fields of this level and above counted
};

}  // namespace ifsm::core
