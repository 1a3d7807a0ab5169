#include "fit/within.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "curve/resolve.h"
#include "curve/scale.h"
#include "fit/approach.h"

namespace ifsm::core {
namespace {

// Models come back to their samples within 1e-12 of the diagonal: a bound below asks for rounding errors.
void require_bound(const Model& model, double bound) {
  require_finite(&bound, 1, "threshold");
  const double least = 1e-12 * model.parts().diagonal;
  if (bound >= least) return;
  throw Error(Status::range, "threshold",
              "threshold is " + text_of(bound) + "; models promise their samples within " + text_of(least) +
                  " (1e-12 of the diagonal): give at least that.")
      .with(bound);
}

constexpr Index exactly = std::numeric_limits<Index>::max();
constexpr Index roughly = 8, closely = 32;

// Looks for the smallest count whose sketch is within the bound; a larger count is taken to be nearer.
class Search {
 public:
  Search(const Model& model, double bound, Distance distance)
      : model_(model), bound_(bound), distance_(distance), enough_(model.details_total()) {}

  // sketch(count) makes one; `watch` hears how far the search is.
  template <class Sketch>
  void double_up(const Sketch& sketch, Watch watch) {
    for (Index count = 0; count < enough_; count = count == 0 ? 1 : 2 * count) {
      watch.report(std::log2(1.0 + static_cast<double>(count)) / std::log2(1.0 + static_cast<double>(enough_)),
                   "search");
      if (try_count(count, sketch)) return;
    }
  }

  // Until the count is known to one in `part`, or exactly.
  template <class Sketch>
  void halve(const Sketch& sketch, Index part, Watch watch) {
    const double first = std::log(static_cast<double>(enough_ - too_few_));
    while (!is_known_to(part)) {
      const double left = std::log(static_cast<double>(enough_ - too_few_));
      watch.report(first > 0 ? 1 - left / first : 1, "search");
      try_count(too_few_ + (enough_ - too_few_) / 2, sketch);
    }
  }

  // The same where a try is dear: distances fall about as one over the count.
  template <class Sketch>
  void aim(const Sketch& sketch, Index part, Index first, Watch watch) {
    const double wide = std::log(static_cast<double>(enough_ - too_few_));
    for (Index next = first; !is_known_to(part);) {
      const double left = std::log(static_cast<double>(enough_ - too_few_));
      watch.report(wide > 0 ? 1 - left / wide : 1, "search");
      const Index count = std::clamp(next, too_few_ + 1, enough_ - 1);
      try_count(count, sketch);
      next = static_cast<Index>(std::ceil(static_cast<double>(count) * std::pow(last_ / bound_, 0.8)));
      if (next == count || next <= too_few_ || next >= enough_) next = too_few_ + (enough_ - too_few_) / 2;
    }
  }

  void forget_too_few() { too_few_ = -1; }
  Index enough() const { return enough_; }
  const ModelPtr& found() const { return found_; }  // none: all details are needed

 private:
  bool is_known_to(Index part) const { return enough_ - too_few_ <= std::max<Index>(1, enough_ / part); }

  template <class Sketch>
  bool try_count(Index count, const Sketch& sketch) {
    ModelPtr made = sketch(count);
    last_ = distance(*made, model_, distance_);
    if (last_ <= bound_) {
      enough_ = count;
      found_ = std::move(made);
      return true;
    }
    too_few_ = count;
    return false;
  }

  const Model& model_;
  double bound_;
  Distance distance_;
  Index too_few_ = -1;  // the largest count known to be
  Index enough_;        // the smallest
  double last_ = 0;
  ModelPtr found_;
};

bool is_squares(const Model& model, Distance distance) { return distance == Distance::rms || !model.shape().joined(); }

ModelPtr found_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch) {
  Search search(model, bound, distance);
  const auto sketch = [&](Index count) {
    return resolved(model, most_significant(model, count), how, distance, watch);
  };
  const auto whole = [&] { return std::make_shared<Model>(model.parts()); };
  if (how != Resolve::choice || is_squares(model, distance)) {
    search.double_up(sketch, watch.part(0, 0.4));
    search.halve(sketch, exactly, watch.part(0.4, 1));
    return search.found() ? search.found() : whole();
  }
  // What is chosen for the mean square is made fast, and needs more details.
  const auto by_squares = [&](Index count) {
    return resolved(model, most_significant(model, count), how, Distance::rms, watch);
  };
  search.double_up(by_squares, watch.part(0, 0.15));
  search.halve(by_squares, roughly, watch.part(0.15, 0.3));
  search.forget_too_few();
  search.aim(sketch, closely, search.enough() / 2, watch.part(0.3, 1));
  return search.found() ? search.found() : whole();
}

}  // namespace

ModelPtr resolved(const Model& model, const Kept& kept, Resolve how, Distance distance, const Watch& watch) {
  if (how == Resolve::none) return keep(model, kept);
  if (is_squares(model, distance))
    return how == Resolve::values ? resolve(model, kept, watch) : resolve_choice(model, kept, watch);
  if (const int exponent = exponent_to_remove(model.parts().diagonal))
    return scaled(*resolved(*scaled(model, -exponent), kept, how, distance, watch), exponent);
  return how == Resolve::values ? approach(model, kept, distance, watch)
                                : approach_choice(model, kept, distance, watch);
}

ModelPtr keep_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch) {
  require_bound(model, bound);
  if (const int exponent = exponent_to_remove(model.parts().diagonal)) {
    const ModelPtr near = scaled(model, -exponent);
    return scaled(*found_within(*near, std::scalbn(bound, -exponent), how, distance, watch), exponent);
  }
  return found_within(model, bound, how, distance, watch);
}

ModelPtr keep_levels_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch) {
  require_bound(model, bound);
  for (int levels = 0; levels < model.levels(); ++levels) {
    watch.report(static_cast<double>(levels) / model.levels(), "search");
    ModelPtr sketch = resolved(model, first_levels(model, levels), how, distance, watch);
    if (core::distance(*sketch, model, distance) <= bound) return sketch;
  }
  return std::make_shared<Model>(model.parts());
}

}  // namespace ifsm::core
