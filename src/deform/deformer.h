// A model being edited: a state over it, with a history, and a log of the edits that led there, told in time.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "deform/edit.h"
#include "deform/state.h"

namespace ifsm::core {

class Deformer {
 public:
  explicit Deformer(ModelPtr model, Manner manner = {});

  const Model& model() const { return *now().model; }
  const Manner& manner() const { return now().manner; }

  // The present state: places, samples, a snapshot, … Until the next step.
  const State& now() const { return step().state; }
  // The places of a level that the last step, an undone one too, may have changed.
  Window changed(int level) const;

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
  Index undoable() const { return at_; }
  Index redoable() const { return static_cast<Index>(history_.size()) - 1 - at_; }

  // A state by a name, kept for later; going back to it is a step that can be undone.
  void keep_as(const std::string& name);
  void go_to(const std::string& name);
  bool knows(const std::string& name) const { return named_.contains(name); }

  // The edits that made the present state, the first one first; how many.
  std::vector<Timed> log() const;
  Index edits() const;
  // Makes edits one after the other, each a step, or, when one is refused, none: the error names it, "edits[3].level".
  void replay(const std::vector<Timed>& edits);

 private:
  // A list from the last edit back, shared by steps.
  struct Logged {
    Logged(Timed made, std::shared_ptr<Logged> after) : edit(std::move(made)), before(std::move(after)) {}
    Logged(const Logged&) = delete;
    Logged& operator=(const Logged&) = delete;
    ~Logged();  // one after the other: a long list would overflow the stack

    Timed edit;
    std::shared_ptr<Logged> before;
  };
  struct Step {
    State state;
    std::shared_ptr<Logged> log = nullptr;
    Touched touched = {};  // on the way here
  };
  using StepPtr = std::shared_ptr<const Step>;

  const Step& step() const { return *history_[static_cast<std::size_t>(at_)]; }
  void step_to(Step next);

  std::vector<StepPtr> history_;
  Index at_ = 0;
  Touched touched_;  // by the last step
  Span span_;
  std::map<std::string, StepPtr> named_;
};

}  // namespace ifsm::core
