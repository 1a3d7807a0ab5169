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

constexpr Index exactly = std::numeric_limits<Index>::max();
constexpr Index roughly = 8, closely = 32;

// How sketches of a count of details are made.
struct Way {
  Resolve how;
  Distance by;

  friend bool operator==(const Way&, const Way&) = default;
};

// Looks for the smallest count whose sketch is within the bound; a larger count is taken to be nearer.
class Search {
 public:
  Search(const Model& model, double bound, Distance distance, const Watch& watch)
      : model_(model), bound_(bound), distance_(distance), watch_(watch), enough_(model.details_total()) {}

  // `watch` hears how far the search is.
  void double_up(Way way, Watch watch) {
    for (Index count = 0; count < enough_; count = count == 0 ? 1 : 2 * count) {
      watch.report(std::log2(1.0 + static_cast<double>(count)) / std::log2(1.0 + static_cast<double>(enough_)),
                   "search");
      if (try_count(count, way)) return;
    }
  }

  // Until the count is known to one in `part`, or exactly.
  void halve(Way way, Index part, Watch watch) {
    const double first = width();
    while (!is_known_to(part)) {
      watch.report(1 - width() / first, "search");
      try_count(too_few_ + (enough_ - too_few_) / 2, way);
    }
  }

  // The same where a try is dear: distances fall about as one over the count.
  void aim(Way way, Index part, Index first, Watch watch) {
    const double wide = width();
    for (Index next = first; !is_known_to(part);) {
      watch.report(1 - width() / wide, "search");
      const Index count = std::clamp(next, too_few_ + 1, enough_ - 1);
      try_count(count, way);
      next = static_cast<Index>(std::ceil(static_cast<double>(count) * std::pow(last_ / bound_, 0.8)));
      if (next == count || next <= too_few_ || next >= enough_) next = too_few_ + (enough_ - too_few_) / 2;
    }
  }

  // Where a larger count need not be nearer: does half of what is known to be enough do, or three quarters?
  bool is_doubtful(Way way) {
    for (const Index part : {enough_ / 2, enough_ * 3 / 4})
      if (part < too_few_ && try_count(part, way)) return true;
    return false;
  }

  void forget_too_few() { too_few_ = -1; }
  Index enough() const { return enough_; }

  // Found in another way than the one that is asked for, a sketch is made in that way as well, and the nearer one
  // taken.
  ModelPtr found(Way asked) {
    if (!found_) return std::make_shared<Model>(model_.parts());  // all details are needed
    if (found_way_ == asked) return found_;
    const ModelPtr other = made(enough_, asked);
    return distance(*other, model_, distance_, watch_) <= distance(*found_, model_, distance_, watch_) ? other : found_;
  }

 private:
  // Of what the count may be; above zero as long as it is not known.
  double width() const { return std::log(static_cast<double>(enough_ - too_few_)); }

  bool is_known_to(Index part) const { return enough_ - too_few_ <= std::max<Index>(1, enough_ / part); }

  ModelPtr made(Index count, Way way) const {
    return resolved(model_, most_significant(model_, count), way.how, way.by, watch_);
  }

  bool try_count(Index count, Way way) {
    ModelPtr sketch = made(count, way);
    last_ = distance(*sketch, model_, distance_, watch_);
    if (last_ <= bound_) {
      enough_ = count;
      found_ = std::move(sketch);
      found_way_ = way;
      return true;
    }
    too_few_ = count;
    return false;
  }

  const Model& model_;
  double bound_;
  Distance distance_;
  const Watch& watch_;
  Index too_few_ = -1;  // the largest count known to be
  Index enough_;        // the smallest
  double last_ = 0;
  ModelPtr found_;
  Way found_way_{};
};

bool is_squares(const Model& model, Distance distance) { return distance == Distance::rms || !model.shape().joined(); }

ModelPtr found_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch) {
  Search search(model, bound, distance, watch);
  const Way asked{how, distance}, as_they_are{Resolve::none, distance};
  // Values as they are, which cost nothing to try, bound the count from above.
  search.double_up(as_they_are, watch.part(0, 0.03));
  search.halve(as_they_are, exactly, watch.part(0.03, 0.06));
  if (how == Resolve::none) return search.found(asked);
  search.forget_too_few();
  if (how == Resolve::values || is_squares(model, distance)) {
    search.double_up(asked, watch.part(0.06, 0.5));
    search.halve(asked, exactly, watch.part(0.5, 1));
    return search.found(asked);
  }
  // And so does what is chosen for the mean square, which is fast.
  const Way squares{how, Distance::rms};
  search.double_up(squares, watch.part(0.06, 0.15));
  search.halve(squares, roughly, watch.part(0.15, 0.3));
  search.forget_too_few();
  search.aim(asked, closely, search.enough() / 2, watch.part(0.3, 0.7));
  while (search.is_doubtful(asked)) {
    search.forget_too_few();
    search.aim(asked, closely, search.enough() / 2, watch.part(0.7, 1));
  }
  return search.found(asked);
}

}  // namespace

void require_bound(double bound, double diagonal, const char* argument) {
  require_finite(bound, argument);
  const double least = 1e-12 * diagonal;
  if (bound >= least || !std::isfinite(least)) return;  // analysis refuses such curves
  throw Error(Status::range, argument,
              std::string(argument) + " is " + text_of(bound) + "; models promise their samples within " +
                  text_of(least) + " (1e-12 of the diagonal): give at least that.")
      .with(bound);
}

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
  require_bound(bound, model.parts().diagonal, "threshold");
  if (const int exponent = exponent_to_remove(model.parts().diagonal)) {
    const ModelPtr near = scaled(model, -exponent);
    return scaled(*found_within(*near, std::scalbn(bound, -exponent), how, distance, watch), exponent);
  }
  return found_within(model, bound, how, distance, watch);
}

ModelPtr keep_levels_within(const Model& model, double bound, Resolve how, Distance distance, Watch& watch) {
  require_bound(bound, model.parts().diagonal, "threshold");
  for (int levels = 0; levels < model.levels(); ++levels) {
    watch.report(static_cast<double>(levels) / model.levels(), "search");
    ModelPtr sketch = resolved(model, first_levels(model, levels), how, distance, watch);
    if (core::distance(*sketch, model, distance, watch) <= bound) return sketch;
  }
  return std::make_shared<Model>(model.parts());
}

}  // namespace ifsm::core
