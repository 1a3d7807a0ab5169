// A model being edited: a state over an immutable model, with a history.
//
// A state is told against the model, never against the edit before, so that order does not matter where edits do not
// meet, and nothing is lost by editing: undo, redo and named states give the same bits again.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deform/edit.h"
#include "deform/look.h"
#include "deform/pose.h"

namespace ifsm::core {

class Deformer {
 public:
  explicit Deformer(ModelPtr model, Manner manner = {});

  const Model& model() const { return *model_; }
  const Manner& manner() const { return manner_; }

  // Makes an edit, and forgets what was undone. An edit that is refused leaves everything as it was. Errors name the
  // argument: "level", "handles", "vectors", "radius", "first", "last", …
  void apply(const Edit& edit);

  // When the edits that follow take place; it changes nothing of the present state.
  void time_by(const Span& span);
  const Span& span() const { return span_; }
  // The curve at a time: a deformer of its own, whose state has of each edit of the log the share that its span says.
  // Moves to places, drags and pins go from where the earlier edits' shares have led. At the end of all spans: the
  // present state, bit for bit.
  Deformer at_time(double time) const;
  // From the first begin of the log's edits to the last end; nothing, without any.
  std::optional<Span> times() const;

  // A step back or forth in the history; range errors where there is none.
  void undo();
  void redo();
  Index undoable() const { return now_; }
  Index redoable() const { return static_cast<Index>(history_.size()) - 1 - now_; }

  // A state by a name, kept for later; going back to it is a step that can be undone.
  void keep_as(const std::string& name);
  void go_to(const std::string& name);
  bool knows(const std::string& name) const { return named_.contains(name); }

  // The edits that made the present state, the first one first; how many.
  std::vector<Timed> log() const;
  Index edits() const;
  // Makes edits one after the other, each a step, or, when one is refused, none: the error names it, "edits[3].level".
  void replay(const std::vector<Timed>& edits);
  // What a texture puts on a level, before its share: null where it does not reach.
  PointsPtr texture(const Texture& edit, int level) const;

  // Places of a level, in the samples' coordinates, or a numerical error when they have left the doubles' range: those
  // that the last step may have changed are changed(level).
  Points places(int level, Index first, Index count) const;
  void check_window(int level, Index first, Index number) const;  // what places() refuses: "level", "first", "number"
  // Points of the finest polyline. Open: parameters 0 … 1; closed: any, modulo 1.
  Points at(const std::vector<double>& parameters) const;
  Index count(int level) const;
  // The curve at the samples.
  Points samples() const;
  struct Window {
    Index first, count;
  };
  Window changed(int level) const;

  // The state as a model of its own.
  ModelPtr snapshot() const;

 private:
  // Of the nodes of a level: what a step touched. Level 0: all.
  struct Touched {
    int level = 0;
    Index first = 0, last = 0;
  };
  // A list from the last edit back, shared by states.
  struct Logged {
    Logged(Timed made, std::shared_ptr<Logged> after) : edit(std::move(made)), before(std::move(after)) {}
    Logged(const Logged&) = delete;
    Logged& operator=(const Logged&) = delete;
    ~Logged();  // one after the other: a long list would overflow the stack

    Timed edit;
    std::shared_ptr<Logged> before;
  };
  struct State {
    Pose pose;
    Look look;
    BasePtr base;
    std::shared_ptr<Logged> log;
    Touched touched;  // by the step that led here
  };
  using StatePtr = std::shared_ptr<const State>;

  const State& state() const { return *history_[static_cast<std::size_t>(now_)]; }
  Posed posed() const { return {*state().base, state().pose, manner_}; }
  void step_to(State next);

  // What of an edit a share of it is, in the present state.
  Move part(Move edit, double share) const;
  Pin part(const Pin& edit, double share) const;
  Drag part(Drag edit, double share) const;
  Restyle part(Restyle edit, double share) const;
  Texture part(Texture edit, double share) const;

  void make(State& next, const Move& edit) const;
  void make(State& next, const Pin& edit) const;
  void make(State& next, const Drag& edit) const;
  void make(State& next, const Restyle& edit) const;
  void make(State& next, const Texture& edit) const;
  void displace(State& next, int level, Index handle, const Vector& by, Reach reach, const SmallMatrix& frame) const;
  void check_drag(const Drag& edit) const;
  void lead(State& next, const Drag& edit, Index value, const Vector& by, const SmallMatrix& frame) const;
  void require_vectors(const Points& vectors, Index count, const char* argument) const;
  Points points_at(const Posed& posed, const std::vector<double>& parameters) const;
  static Points told(Points points);
  void require_finite(const Pose& pose) const;
  int checked_level(int level, int most) const;
  void check_levels(const Levels& levels) const;
  void check_texture(const Texture& edit) const;
  Index handle_count(int level) const;
  void check_handles(int level, const std::vector<Index>& handles) const;
  Vector way_to(const Vector& place, const Points& now) const;
  Touched nodes_of(int level, const std::vector<Index>& handles) const;

  ModelPtr model_;
  Manner manner_;
  std::vector<StatePtr> history_;
  Index now_ = 0;
  Touched touched_;
  Span span_;
  std::map<std::string, StatePtr> named_;
};

}  // namespace ifsm::core
