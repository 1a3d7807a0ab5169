#include "deform/deformer.h"

#include <algorithm>
#include <utility>

#include "deform/dragging.h"
#include "deform/dressing.h"
#include "deform/moving.h"

namespace ifsm::core {

Deformer::Deformer(ModelPtr model, Manner manner) {
  history_.push_back(std::make_shared<const Step>(Step{State(std::move(model), manner)}));
}

Deformer::Logged::~Logged() {
  for (auto last = std::move(before); last && last.use_count() == 1;) last = std::exchange(last->before, nullptr);
}

void Deformer::step_to(Step next) {
  auto made = std::make_shared<const Step>(std::move(next));
  const auto needed = static_cast<std::size_t>(at_) + 2;
  if (history_.capacity() < needed) history_.reserve(2 * needed);  // before what was undone is forgotten: it may fail
  history_.resize(static_cast<std::size_t>(at_) + 1);
  history_.push_back(std::move(made));
  ++at_;
  touched_ = step().touched;
}

void Deformer::apply(const Edit& edit) {
  Edited next = std::visit([&](const auto& one) { return after(now(), one); }, edit);
  require_finite(next.state.pose);
  step_to({std::move(next.state), std::make_shared<Logged>(Timed{edit, span_}, step().log), next.touched});
}

Window Deformer::changed(int level) const {
  in_range(level, 0, model().levels(), "level");
  return touched_.places(model(), level);
}

void Deformer::undo() {
  if (at_ == 0) throw Error(Status::range, "deformer", "There is no step to undo; ask how many there are first.");
  touched_ = step().touched;
  --at_;
}

void Deformer::redo() {
  if (redoable() == 0)
    throw Error(Status::range, "deformer", "There is no undone step to make again; an edit forgets them.");
  ++at_;
  touched_ = step().touched;
}

void Deformer::keep_as(const std::string& name) { named_[name] = history_[static_cast<std::size_t>(at_)]; }

void Deformer::go_to(const std::string& name) {
  const auto found = named_.find(name);
  if (found == named_.end())
    throw Error(Status::range, "name", "No state is kept as \"" + name + "\"; keep one by that name first.");
  step_to({found->second->state, found->second->log});
}

void Deformer::time_by(const Span& span) {
  require_span(span);
  span_ = span;
}

std::optional<Span> Deformer::times() const {
  std::optional<Span> all;
  for (auto entry = step().log; entry; entry = entry->before) {
    const Span& span = entry->edit.span;
    if (!all) all = span;
    all = {std::min(all->begin, span.begin), std::max(all->end, span.end), Easing::linear};
  }
  return all;
}

Deformer Deformer::at_time(double time) const {
  require_finite(time, "time");
  Deformer frame = *this;  // steps are shared
  frame.history_.resize(1);
  frame.at_ = 0;
  frame.touched_ = {};
  frame.named_.clear();
  for (const Timed& made : log()) {
    const double share = made.span.share(time);
    frame.span_ = made.span;
    if (share == 1) frame.apply(made.edit);
    if (share > 0 && share < 1)
      frame.apply(std::visit([&](const auto& edit) -> Edit { return part(frame.now(), edit, share); }, made.edit));
  }
  frame.span_ = span_;
  return frame;
}

void Deformer::replay(const std::vector<Timed>& edits) {
  Deformer all = *this;  // steps are shared
  for (std::size_t i = 0; i < edits.size(); ++i) {
    const std::string entry = "edits[" + std::to_string(i) + "]";
    all.span_ = edits[i].span;
    try {
      require_span(edits[i].span);
      all.apply(edits[i].edit);
    } catch (const Error& error) {
      throw Error(error.status(), entry + "." + error.argument(), entry + ": " + error.what())
          .at(error.index())
          .with(error.value())
          .needs(error.required());
    }
  }
  all.span_ = span_;
  *this = std::move(all);
}

std::vector<Timed> Deformer::log() const {
  std::vector<Timed> edits;
  for (auto entry = step().log; entry; entry = entry->before) edits.push_back(entry->edit);
  std::ranges::reverse(edits);
  return edits;
}

Index Deformer::edits() const {
  Index count = 0;
  for (auto entry = step().log; entry; entry = entry->before) ++count;
  return count;
}

}  // namespace ifsm::core
