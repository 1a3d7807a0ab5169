#include "system/address.h"

#include <cmath>
#include <string>

#include "base/error.h"

namespace ifsm::core {
namespace {

const Affine& letter(const System& system, std::span<const std::int64_t> word, std::size_t place) {
  const auto count = static_cast<std::int64_t>(system.maps().size());
  if (word[place] >= 0 && word[place] < count) return system.maps()[static_cast<std::size_t>(word[place])];
  throw Error(Status::range, "symbols",
              "symbols[" + std::to_string(place) + "] is " + std::to_string(word[place]) +
                  "; the system's maps are 0 to " + std::to_string(count - 1) + ".")
      .at(static_cast<std::int64_t>(place))
      .with(static_cast<double>(word[place]));
}

// Depth first: a word of the wanted length is one as soon as one of its pieces is small and near.
class Search {
 public:
  Search(const System& system, const Vector3& point, std::int64_t length, double tolerance, std::int64_t most)
      : system_(system), point_(point), length_(length), tolerance_(tolerance), most_(most) {}

  std::vector<std::vector<std::int64_t>> words() {
    extend(Affine::identity(system_.dimension()));
    return std::move(found_);
  }

 private:
  // Is one of the piece's points within the tolerance? None is when all are beyond twice of it.
  bool extend(const Affine& prefix) {
    const Ellipsoid piece = prefix * system_.enclosure();
    const double size = piece.axes.norm(), distance = (point_ - piece.centre).norm();
    if (distance > size + tolerance_) return false;
    const bool counted = static_cast<std::int64_t>(word_.size()) >= length_;
    if (counted && size <= tolerance_ / 2) return true;  // all of it is within twice the tolerance
    constexpr std::int64_t most_pieces = 1 << 24;
    constexpr std::size_t longest = 1 << 13;  // what the stack holds
    if (++pieces_ > most_pieces || word_.size() > longest || static_cast<std::int64_t>(found_.size()) > most_)
      throw Error(Status::limit, "length",
                  "The point has more addresses of that length, or takes more pieces, than are looked at; ask for a "
                  "smaller length or give a larger tolerance.")
          .with(static_cast<double>(length_));
    for (const int i : system_.active()) {
      word_.push_back(i);
      const bool near = extend(prefix * system_.maps()[static_cast<std::size_t>(i)]);
      if (near && static_cast<std::int64_t>(word_.size()) == length_) found_.push_back(word_);
      word_.pop_back();
      if (near && counted) return true;
    }
    return false;
  }

  const System& system_;
  Vector3 point_;
  std::int64_t length_;
  double tolerance_;
  std::int64_t most_;
  std::int64_t pieces_ = 0;
  std::vector<std::int64_t> word_;
  std::vector<std::vector<std::int64_t>> found_;
};

}  // namespace

Affine word_map(const System& system, std::span<const std::int64_t> word) {
  Affine map = Affine::identity(system.dimension());
  for (std::size_t k = 0; k < word.size(); ++k) map = map * letter(system, word, k);
  return map;
}

Vector3 point_of(const System& system, std::span<const std::int64_t> word, std::int64_t period) {
  static_cast<void>(system.enclosure());  // refuses what has no attractor
  in_range(period, 1, static_cast<std::int64_t>(word.size()), "period");
  for (std::size_t k = 0; k < word.size(); ++k) {
    static_cast<void>(letter(system, word, k));
    if (system.probabilities()[static_cast<std::size_t>(word[k])] > 0) continue;
    throw Error(Status::range, "symbols",
                "symbols[" + std::to_string(k) + "] is " + std::to_string(word[k]) +
                    ", a map of probability 0, which the attractor has no piece of; give an active one.")
        .at(static_cast<std::int64_t>(k))
        .with(static_cast<double>(word[k]));
  }
  const std::size_t head = word.size() - static_cast<std::size_t>(period);
  Vector3 point = fixed_point(word_map(system, word.subspan(head)));
  for (std::size_t k = head; k-- > 0;) point = letter(system, word, k)(point);
  return point;
}

std::vector<std::vector<std::int64_t>> addresses_of(const System& system, const Vector3& point, std::int64_t length,
                                                    double tolerance, std::int64_t most) {
  constexpr std::int64_t longest = 1 << 10;
  in_range(length, 1, longest, "length");
  constexpr double least = 0x1p-44;  // of the attractor's size: what rounding leaves of it
  const double size = system.enclosure().axes.norm();
  const bool kept = tolerance > least * size || (size == 0 && tolerance == 0);  // the origin alone: nothing is rounded
  if (!kept || !std::isfinite(tolerance))
    throw Error(Status::range, "tolerance",
                "tolerance is " + text_of(tolerance) + "; give a finite one above " + text_of(least * size) +
                    ", 2^-44 of the attractor's size.")
        .with(tolerance);
  return Search(system, point, length, tolerance, most).words();
}

}  // namespace ifsm::core
