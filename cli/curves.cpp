#include "curves.h"

#include <algorithm>
#include <cmath>

#include "csv.h"
#include "failure.h"
#include "files.h"
#include "geojson.h"
#include "report.h"
#include "rings.h"

namespace cli {
namespace {

constexpr std::size_t most_dimensions = 4;
constexpr const char* gap_advice = "cut the curve there with --gaps split, go straight across with --gaps bridge";

void check_shape(const Table& table, const std::string& source) {
  if (table.columns > most_dimensions)
    throw Failure(Exit::Input, source + " has " + std::to_string(table.columns) +
                                   " columns; a curve has 1 to 4: choose them with --columns, by name or number.");
  if (table.rows() < 2) throw Failure(Exit::Input, source + " holds one point; a curve needs at least 2.");
}

bool ends_meet(const Samples& samples) {
  const auto d = static_cast<std::ptrdiff_t>(samples.dimension);
  return std::equal(samples.points.begin(), samples.points.begin() + d, samples.points.end() - d);
}

// An altitude of GeoJSON is in metres, and goes with kilometres.
constexpr double kilometres_in_a_metre = 1e-3;
// By how much east-west lengths may be wrong on a plane: told from the first on, refused beyond the second.
constexpr double told_stretch = 1.1, most_stretch = 2;

// From one curve as it was read to one or more as they are fitted.
class Preparation {
 public:
  Preparation(std::string source, const Reading& reading) : source_(std::move(source)), reading_(reading) {}

  void take(Samples samples) {
    place_ = source_ + (samples.place.empty() ? "" : ", " + samples.place);
    if (reading_.project) unwrap_degrees(samples);
    drop_repeated_point(samples);
    if (reading_.gaps == Gaps::Split) return take_pieces(samples);
    if (reading_.gaps == Gaps::Bridged) bridge(samples);
    keep(std::move(samples));
  }

  Curves curves() && {
    place_ = source_;
    if (stretched_ > 0)
      say(counted(stretched_, "curve") + " with east-west lengths wrong by up to " +
          rounded((worst_stretch_ - 1) * 100, 2) + " % at the ends of the plane");
    return std::move(curves_);
  }

 private:
  void say(const std::string& what) { curves_.notes.push_back(place_ + ": " + what + "."); }

  [[noreturn]] void refuse(const std::string& what) const { throw Failure(Exit::Input, place_ + ": " + what + "."); }

  void unwrap_degrees(Samples& samples) const {
    const auto d = static_cast<std::size_t>(samples.dimension);
    if (d < 2)
      throw Failure(Exit::Usage, "--project needs two columns, longitude and latitude; " + place_ + " has one.");
    if (const auto k = first_off_the_earth(samples.points, d))
      refuse("point " + std::to_string(*k + 1) + " is " + shortest(samples.points[*k * d]) + ", " +
             shortest(samples.points[*k * d + 1]) +
             "; --project takes longitude and latitude in degrees, latitudes up to 90: give the columns in that order "
             "(--columns), or leave --project out when the coordinates are lengths");
    unwrap(samples.points, d);
    if (samples.closed && runs_round_a_pole(samples.points, d))
      refuse(
          "the ring runs round a pole, which no local plane holds; project it with another tool, and leave "
          "--project out");
  }

  void drop_repeated_point(Samples& samples) {
    const auto d = static_cast<std::size_t>(samples.dimension);
    if (!ends_meet(samples)) return;
    if (!samples.closed) {
      say("the last point repeats the first; if this is a ring, add --closed");
    } else if (samples.points.size() > 2 * d) {
      samples.points.resize(samples.points.size() - d);
      say("the last point repeats the first and was dropped, as --closed closes the ring");
    }
  }

  void bridge(Samples& samples) {
    const auto d = static_cast<std::size_t>(samples.dimension);
    auto bridge = bridge_gaps(std::move(samples.points), d, samples.closed);
    if (bridge.points.size() / d < bridge.filled + 2)
      refuse("fewer than two points are known; a curve needs at least 2");
    if (bridge.filled > 0)
      say(counted(bridge.gaps, "gap") + " bridged with " + counted(bridge.filled, "point") + " on straight lines");
    if (bridge.cut_off > 0) say(counted(bridge.cut_off, "point") + " of gaps at the ends cut off");
    samples.points = std::move(bridge.points);
  }

  void take_pieces(const Samples& samples) {
    auto split = split_at_gaps(samples.points, static_cast<std::size_t>(samples.dimension), samples.closed);
    if (split.pieces.empty()) refuse("no two points follow each other without a gap; --gaps bridge goes across");
    if (split.gaps > 0) say(counted(split.gaps, "gap") + ", " + counted(split.pieces.size(), "piece"));
    if (samples.closed && split.gaps > 0) say("the ring is cut at its gaps: its pieces are open");
    if (split.singles > 0)
      say(counted(split.singles, "point") + " alone between gaps left out, as a curve needs at least 2");
    for (auto& piece : split.pieces)
      keep({std::move(piece), samples.dimension, split.closed, samples.name, samples.place});
  }

  void keep(Samples samples) {
    if (reading_.project) to_plane(samples);
    curves_.all.push_back(std::move(samples));
  }

  void to_plane(Samples& samples) {
    const auto d = static_cast<std::size_t>(samples.dimension);
    const auto middle = reading_.project->middle.value_or(middle_of(samples.points, d));
    const double wrong = stretch(samples.points, d, middle);
    if (wrong > most_stretch)
      refuse("on a plane about latitude " + rounded(middle.latitude) +
             " its east-west lengths would be wrong by more than a factor of two; give it a middle of its own, or "
             "project it with another tool and leave --project out");
    if (wrong > told_stretch) ++stretched_;
    worst_stretch_ = std::max(worst_stretch_, wrong);
    project(samples.points, d, middle);
    samples.middle = middle;
  }

  std::string source_;
  std::string place_;  // of the curve that is prepared
  const Reading& reading_;
  Curves curves_;
  std::size_t stretched_ = 0;
  double worst_stretch_ = 1;
};

double square(double value) { return value * value; }

// Numbers are divided by this power of two before they are squared: of 1e200 and 1e-200 there is no square. It changes
// no bit of what has one.
int exponent_of(double largest) { return largest > 0 && std::isfinite(largest) ? std::ilogb(largest) : 0; }

Samples samples_of(GeoCurve curve, const Reading& reading) {
  if (reading.project && curve.dimension == 3)
    for (std::size_t i = 2; i < curve.points.size(); i += 3) curve.points[i] *= kilometres_in_a_metre;
  return {std::move(curve.points), curve.dimension, curve.ring || reading.closed, std::move(curve.name),
          std::move(curve.place)};
}

Curves curves_of_geojson(std::string_view text, const std::string& source, const Reading& reading) {
  if (!reading.columns.empty())
    throw Failure(Exit::Usage, "--columns: " + source + " is GeoJSON, which has no columns; leave it out.");
  auto read = parse_geojson(text, source, reading.flat);
  const auto faults = notes_on_rings(read.all, source, reading.project.has_value());
  Preparation preparation(source, reading);
  for (auto& curve : read.all) preparation.take(samples_of(std::move(curve), reading));
  auto curves = std::move(preparation).curves();
  curves.notes.insert(curves.notes.begin(), faults.begin(), faults.end());
  curves.notes.insert(curves.notes.begin(), read.notes.begin(), read.notes.end());
  return curves;
}

Curves curves_of_table(std::string_view text, const std::string& source, const Reading& reading) {
  if (reading.columns.size() > most_dimensions)
    throw Failure(Exit::Usage,
                  "--columns names " + std::to_string(reading.columns.size()) + " columns; a curve has 1 to 4.");
  auto table = parse_csv(text, source, {reading.columns, reading.gaps != Gaps::Refused, gap_advice});
  check_shape(table, source);
  Preparation preparation(source, reading);
  preparation.take({std::move(table.values), static_cast<int>(table.columns), reading.closed});
  return std::move(preparation).curves();
}

}  // namespace

Curves parse_curves(std::string_view text, const std::string& source, const Reading& reading) {
  return looks_like_json(text) ? curves_of_geojson(text, source, reading) : curves_of_table(text, source, reading);
}

Curves read_curves(const std::string& path, const Reading& reading) {
  return parse_curves(read_file(path), input_name(path), reading);
}

double root_of_squares(const std::vector<double>& values, double count) {
  double largest = 0;
  for (const double value : values) largest = std::max(largest, std::abs(value));
  const int exponent = exponent_of(largest);
  double sum = 0;
  for (const double value : values) sum += square(std::scalbn(value, -exponent));
  return std::scalbn(std::sqrt(sum / count), exponent);
}

Distance distance(const std::vector<double>& a, const std::vector<double>& b, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  double apart = 0;
  for (std::size_t i = 0; i < a.size(); ++i) apart = std::max(apart, std::abs(a[i] - b[i]));
  const int exponent = exponent_of(apart);
  double sum = 0, largest = 0;
  for (std::size_t k = 0; k < a.size(); k += d) {
    double squares = 0;
    for (std::size_t i = k; i < k + d; ++i) squares += square(std::scalbn(a[i] - b[i], -exponent));
    sum += squares;
    largest = std::max(largest, squares);
  }
  return {std::scalbn(std::sqrt(sum * dimension / static_cast<double>(a.size())), exponent),
          std::scalbn(std::sqrt(largest), exponent)};
}

std::vector<std::string> coordinate_names(int dimension) {
  const std::vector<std::string> names{"x", "y", "z", "w"};
  return {names.begin(), names.begin() + dimension};
}

}  // namespace cli
