// ifsm.hpp — the C++ face of ifsm.h: the same library, with owners, exceptions and vectors. Header only, C++17.
//
//     #include <ifsm.hpp>
//
//     int main() {
//       std::vector<double> samples;                             // x0 y0 x1 y1 …
//       for (int k = 0; k < 257; ++k) samples.insert(samples.end(), {1.0 * k, 1.0 * (k * k % 101)});
//
//       const ifsm::Fit fit = ifsm::fit_sparse({{samples, 2}});  // finds a filter under which few details say much
//       const ifsm::Model model = fit.model(0);                  // the exact model of the samples under it
//       const ifsm::Model sketch = model.keep(ifsm::most_significant(32).resolved());
//       const std::vector<double> points = sketch.samples();     // interleaved again
//       return points.size() == samples.size() ? 0 : 1;
//     }
//
// How it maps to C
//   Filter, Model and Fit own one handle each: they move, and do not copy (std::shared_ptr<Model> shares one). What
//   they name is immutable, so every member is const, returns a new value, and may be called from any thread. A
//   moved-from or default-constructed one holds the null handle; using it is an Error, destroying it is fine. Errors
//   are thrown as ifsm::Error, which carries the whole of ifsm_error by value; cancelling as ifsm::Cancelled. Arrays
//   come in as std::vector and go out as std::vector; what their numbers mean, their shapes, units and errors are told
//   in ifsm.h beside the function of the same name. Callbacks are std::function. What one throws stops the call and
//   comes out of it, unchanged: nothing unwinds through the library. Everything is inline over the C ABI, so a program
//   built today runs with every later library of the same soname, whatever compiler or standard library built either.
#ifndef IFSM_HPP
#define IFSM_HPP

#include <ifsm.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace ifsm {

// ------------------------------------------------------------------------------------------------------------------
// Errors

// What ifsm_last_error() tells, kept for as long as one likes. what() is the full sentence.
class Error : public std::runtime_error {
 public:
  explicit Error(const ifsm_error& told)
      : std::runtime_error(told.message),
        status(told.status),
        function(told.function),
        argument(told.argument),
        index(told.index),
        value(told.value),
        required(told.required) {}

  ifsm_status status;     // IFSM_ERROR_…
  std::string function;   // e.g. "ifsm_model_create"
  std::string argument;   // the parameter or field to blame, or ""
  std::int64_t index;     // the position in it, or -1
  double value;           // the offending value, or NaN
  std::int64_t required;  // what a count must be, or -1
};

// A callback or a token said stop.
class Cancelled : public Error {
 public:
  using Error::Error;
};

namespace detail {

[[noreturn]] inline void throw_last_error() {
  ifsm_error told{};
  told.struct_size = sizeof told;
  if (ifsm_last_error(&told) != IFSM_OK) throw std::logic_error("ifsm_last_error refused its own header's struct.");
  if (told.status == IFSM_ERROR_CANCELLED) throw Cancelled(told);
  throw Error(told);
}

inline void check(ifsm_status status) {
  if (status != IFSM_OK) throw_last_error();
}

inline std::int64_t size_of(std::size_t size) { return static_cast<std::int64_t>(size); }

// The two-step call of every output array: how many, then which. call(array, capacity, count).
template <class T, class Call>
std::vector<T> fetch(const Call& call) {
  std::int64_t count = 0;
  check(call(nullptr, 0, &count));
  std::vector<T> values(static_cast<std::size_t>(count));
  if (count > 0) check(call(values.data(), count, &count));
  return values;
}

// A result struct, its size set.
template <class T, class Call>
T describe(const Call& call) {
  T told{};
  told.struct_size = sizeof told;
  check(call(&told));
  return told;
}

// One handle, destroyed at the end.
template <class Handle, ifsm_status (*Destroy)(Handle)>
class Owner {
 public:
  Owner() noexcept = default;
  explicit Owner(Handle handle) noexcept : handle_(handle) {}
  Owner(Owner&& other) noexcept : handle_(other.release()) {}
  Owner& operator=(Owner&& other) noexcept {
    Owner(std::move(other)).swap(*this);
    return *this;
  }
  Owner(const Owner&) = delete;
  Owner& operator=(const Owner&) = delete;
  ~Owner() { static_cast<void>(Destroy(handle_) == IFSM_OK); }

  Handle get() const noexcept { return handle_; }
  Handle release() noexcept { return std::exchange(handle_, Handle{}); }
  void swap(Owner& other) noexcept { std::swap(handle_, other.handle_); }

 private:
  Handle handle_{};
};

}  // namespace detail

// ------------------------------------------------------------------------------------------------------------------
// The library

inline std::string version() { return ifsm_version_text(); }

// How many threads calls use: 0 is one a core. Never changes results.
inline void set_threads(int threads) { detail::check(ifsm_set_threads(threads)); }
inline int threads() {
  std::int32_t count = 0;
  detail::check(ifsm_threads(&count));
  return count;
}

// ------------------------------------------------------------------------------------------------------------------
// Cancel tokens: what one thread passes to a long call, so that another may stop it

class Cancel {
 public:
  Cancel() {
    ifsm_cancel made{};
    detail::check(ifsm_cancel_create(&made));
    handle_ = Owner(made);
  }

  // Calls that hold the token throw Cancelled within 100 ms. Final. Any thread.
  void request() const { detail::check(ifsm_cancel_request(handle_.get())); }

  bool requested() const {
    std::int32_t requested = 0;
    detail::check(ifsm_cancel_requested(handle_.get(), &requested));
    return requested != 0;
  }

  ifsm_cancel handle() const noexcept { return handle_.get(); }

 private:
  using Owner = detail::Owner<ifsm_cancel, ifsm_cancel_destroy>;
  Owner handle_;
};

// ------------------------------------------------------------------------------------------------------------------
// Curves: ordered points, interleaved

// Refers to the caller's points: keep them while the Curve is in use.
class Curve {
 public:
  // `points` holds count × dimension doubles.
  Curve(const std::vector<double>& points, int dimension, bool closed = false)
      : Curve(points.data(), dimension > 0 ? detail::size_of(points.size()) / dimension : 0, dimension, closed) {
    if (dimension > 0 && points.size() % static_cast<std::size_t>(dimension) != 0)
      throw std::invalid_argument("ifsm::Curve: " + std::to_string(points.size()) +
                                  " doubles are not points of dimension " + std::to_string(dimension) +
                                  "; pass a multiple of it.");
  }
  Curve(std::vector<double>&&, int, bool = false) = delete;  // would refer to points that are gone
  Curve(const double* points, std::int64_t count, int dimension, bool closed = false)
      : curve_{points, count, dimension, closed ? 1 : 0} {}

  const ifsm_curve& get() const noexcept { return curve_; }

 private:
  ifsm_curve curve_;
};

enum class Topology : std::int32_t { joined = IFSM_TOPOLOGY_JOINED, square = IFSM_TOPOLOGY_SQUARE };
enum class Frame : std::int32_t { absolute = IFSM_FRAME_ABSOLUTE, node = IFSM_FRAME_NODE };
enum class Follow : std::int32_t { polyline = IFSM_CURVE_POLYLINE, limit = IFSM_CURVE_LIMIT };
enum class Resolve : std::int32_t {
  none = IFSM_RESOLVE_NONE,
  values = IFSM_RESOLVE_VALUES,
  choice = IFSM_RESOLVE_CHOICE
};
enum class Distance : std::int32_t {
  rms = IFSM_DISTANCE_RMS,
  largest = IFSM_DISTANCE_LARGEST,
  hausdorff = IFSM_DISTANCE_HAUSDORFF
};
enum class Format : std::int32_t {
  json = IFSM_FORMAT_JSON,
  cbor = IFSM_FORMAT_CBOR,
  fractint = IFSM_FORMAT_FRACTINT  // systems alone
};
enum class Colour : std::int32_t {
  tone = IFSM_COLOUR_TONE,
  symbol = IFSM_COLOUR_SYMBOL,
  address = IFSM_COLOUR_ADDRESS,
  set = IFSM_COLOUR_SET,
  distance = IFSM_COLOUR_DISTANCE
};
enum class Palette : std::int32_t {
  dusk = IFSM_PALETTE_DUSK,
  sea = IFSM_PALETTE_SEA,
  fern = IFSM_PALETTE_FERN,
  ember = IFSM_PALETTE_EMBER,
  ink = IFSM_PALETTE_INK
};

// ------------------------------------------------------------------------------------------------------------------
// Filters

class Filter {
 public:
  Filter() = default;                                              // the null handle
  explicit Filter(ifsm_filter owned) noexcept : handle_(owned) {}  // takes ownership

  // By name, e.g. "casteljau"; 0 chooses the name's own numbers.
  static Filter named(const std::string& name, Topology topology = Topology::joined, int control_points = 0,
                      int maps = 0) {
    return make([&](ifsm_filter* made) {
      return ifsm_filter_named(name.c_str(), static_cast<std::int32_t>(topology), control_points, maps, made);
    });
  }

  // From all of R, row-major.
  static Filter from_matrix(Topology topology, int control_points, int maps, const std::vector<double>& matrix,
                            int stride = 0) {
    return make([&](ifsm_filter* made) {
      return ifsm_filter_from_matrix(static_cast<std::int32_t>(topology), control_points, maps, stride, matrix.data(),
                                     detail::size_of(matrix.size()), made);
    });
  }

  // From T alone, row-major, with the canonical complement.
  static Filter from_maps(Topology topology, int control_points, int maps, const std::vector<double>& matrix,
                          int stride = 0) {
    return make([&](ifsm_filter* made) {
      return ifsm_filter_from_maps(static_cast<std::int32_t>(topology), control_points, maps, stride, matrix.data(),
                                   detail::size_of(matrix.size()), made);
    });
  }

  ifsm_filter_info describe() const {
    return detail::describe<ifsm_filter_info>([&](auto* told) { return ifsm_filter_describe(handle(), told); });
  }

  // R: rows × rows, row-major.
  std::vector<double> matrix() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_filter_matrix(handle(), to...); });
  }

  ifsm_filter handle() const noexcept { return handle_.get(); }
  ifsm_filter release() noexcept { return handle_.release(); }  // the caller destroys it

 private:
  template <class Call>
  static Filter make(const Call& call) {
    ifsm_filter made{};
    detail::check(call(&made));
    return Filter(made);
  }

  detail::Owner<ifsm_filter, ifsm_filter_destroy> handle_;
};

namespace detail {

// Stands between the library and a std::function: an exception waits here until the library has returned.
struct Trampoline {
  const std::function<bool(double, const std::string&)>* progress;
  std::exception_ptr thrown{};

  static std::int32_t call(void* user, double fraction, const char* stage) noexcept {
    auto& self = *static_cast<Trampoline*>(user);
    try {
      return (*self.progress)(fraction, stage) ? 1 : 0;
    } catch (...) {
      self.thrown = std::current_exception();
      return 1;
    }
  }
};

}  // namespace detail

// ------------------------------------------------------------------------------------------------------------------
// Which details a sketch keeps: all of the first levels, so many, those above a threshold, or as few as bring it within
// a bound

class Keep {
 public:
  explicit Keep(std::int32_t rule) {
    detail::check(ifsm_keep_options_init(&options_, sizeof options_));
    options_.rule = rule;
  }
  Keep& count(std::int64_t count) {
    options_.count = count;
    return *this;
  }
  Keep& threshold(double threshold) {
    options_.threshold = threshold;
    return *this;
  }
  // What is kept is solved anew, by least squares against the model's samples; or even chosen anew.
  Keep& resolved(Resolve resolve = Resolve::values) {
    options_.resolve = static_cast<std::int32_t>(resolve);
    return *this;
  }
  // What a bound is measured by, and what solving makes small.
  Keep& by(Distance distance) {
    options_.distance = static_cast<std::int32_t>(distance);
    return *this;
  }
  // As in FitOptions: returning true cancels.
  Keep& telling(std::function<bool(double fraction, const std::string& stage)> progress) {
    progress_ = std::move(progress);
    return *this;
  }
  // The token must live until the call ends.
  Keep& cancelled_by(const Cancel& token) {
    options_.cancel = token.handle();
    return *this;
  }
  const ifsm_keep_options& get() const noexcept { return options_; }
  const std::function<bool(double fraction, const std::string& stage)>& progress() const noexcept { return progress_; }

 private:
  ifsm_keep_options options_{};
  std::function<bool(double fraction, const std::string& stage)> progress_;
};

inline Keep first_levels(std::int64_t levels) { return Keep(IFSM_KEEP_LEVELS).count(levels); }
inline Keep most_significant(std::int64_t details) { return Keep(IFSM_KEEP_COUNT).count(details); }
inline Keep within(double bound, Distance distance = Distance::rms) {
  return Keep(IFSM_KEEP_WITHIN).threshold(bound).by(distance);
}
inline Keep levels_within(double bound, Distance distance = Distance::rms) {
  return Keep(IFSM_KEEP_LEVELS_WITHIN).threshold(bound).by(distance);
}
inline Keep above(double threshold) { return Keep(IFSM_KEEP_THRESHOLD).threshold(threshold); }

// ------------------------------------------------------------------------------------------------------------------
// Answers to questions about a curve

// The point of the curve that is nearest to a query.
struct Nearest {
  double parameter;
  double distance;
  std::vector<double> point;
};

// Two parameters at one point; along a piece that is gone twice, from the first ones to the last.
struct Crossing {
  double first_p, first_q, last_p, last_q;
  double x, y;  // of the first ones
};

namespace detail {
inline std::vector<Crossing> crossings(const std::vector<double>& rows) {
  std::vector<Crossing> found;
  for (auto row = rows.begin(); row != rows.end(); row += 6)
    found.push_back({row[0], row[1], row[2], row[3], row[4], row[5]});
  return found;
}
}  // namespace detail

enum class Count : std::int32_t { boxes = IFSM_DIMENSION_BOXES, divider = IFSM_DIMENSION_DIVIDER };

struct Dimension {
  ifsm_dimension_report report;
  std::vector<double> scales, counts;
};

struct Spectrum {
  ifsm_spectrum_report report;
  std::vector<double> scales, rms;  // a level each
};

// What a refinement may be told; zero means the default everywhere, as in ifsm_refine_options.
struct RefineOptions {
  int levels = 0;
  std::uint64_t seed = 0;
  int learned = 0;
  double roughness = 0;  // -1: none
};

// ------------------------------------------------------------------------------------------------------------------
// Models

class Model {
 public:
  Model() = default;                                             // the null handle
  explicit Model(ifsm_model owned) noexcept : handle_(owned) {}  // takes ownership

  // The exact model of samples; 0 levels: as few as have a place for each.
  Model(const Filter& filter, const Curve& samples, int levels = 0) {
    ifsm_model_options options{};
    detail::check(ifsm_model_options_init(&options, sizeof options));
    options.levels = levels;
    *this = make([&](ifsm_model* made) { return ifsm_model_create(filter.handle(), &samples.get(), &options, made); });
  }

  // A control polygon without details.
  static Model from_polygon(const Filter& filter, const Curve& polygon, int levels) {
    return make(
        [&](ifsm_model* made) { return ifsm_model_from_polygon(filter.handle(), &polygon.get(), levels, made); });
  }

  // From a file's bytes, of either format.
  static Model load(const std::vector<std::uint8_t>& bytes) {
    return make([&](ifsm_model* made) { return ifsm_model_load(bytes.data(), detail::size_of(bytes.size()), made); });
  }
  std::vector<std::uint8_t> save(Format format) const {
    return fetch<std::uint8_t>([&](auto... to) { return ifsm_model_save(handle(), number(format), to...); });
  }

  ifsm_model_info describe() const {
    return detail::describe<ifsm_model_info>([&](auto* told) { return ifsm_model_describe(handle(), told); });
  }
  Filter filter() const {
    ifsm_filter made{};
    detail::check(ifsm_model_filter(handle(), &made));
    return Filter(made);
  }

  // The curve: at its samples, as polygons of a level joined, at parameters.
  std::vector<double> samples() const {
    return fetch<double>([&](auto... to) { return ifsm_model_samples(handle(), to...); });
  }
  std::vector<double> points(int level) const {
    return fetch<double>([&](auto... to) { return ifsm_model_points(handle(), level, to...); });
  }
  std::vector<double> evaluate(const std::vector<double>& parameters, Follow follow = Follow::polyline) const {
    return fetch<double>([&](auto... to) {
      return ifsm_model_evaluate(handle(), number(follow), parameters.data(), detail::size_of(parameters.size()),
                                 to...);
    });
  }

  // Parameters of the samples; parameters and addresses.
  std::vector<double> parameters() const {
    return fetch<double>([&](auto... to) { return ifsm_model_parameters(handle(), to...); });
  }
  std::vector<std::int32_t> address(double parameter, int length) const {
    return fetch<std::int32_t>([&](auto... to) { return ifsm_model_address(handle(), parameter, length, to...); });
  }
  std::pair<double, double> interval(const std::vector<std::int32_t>& symbols) const {
    std::pair<double, double> covered;
    detail::check(ifsm_model_interval(handle(), symbols.data(), detail::size_of(symbols.size()), &covered.first,
                                      &covered.second));
    return covered;
  }

  // What the model consists of.
  std::vector<double> control_points() const {
    return fetch<double>([&](auto... to) { return ifsm_model_control_points(handle(), to...); });
  }
  std::vector<double> details(int level, Frame frame = Frame::absolute) const {
    return fetch<double>([&](auto... to) { return ifsm_model_details(handle(), level, number(frame), to...); });
  }
  std::vector<double> significance(int level) const {
    return fetch<double>([&](auto... to) { return ifsm_model_significance(handle(), level, to...); });
  }

  // Other models.
  Model with_control_points(const std::vector<double>& points, Frame frame = Frame::node) const {
    return make([&](ifsm_model* made) {
      return ifsm_model_with_control_points(handle(), number(frame), points.data(), detail::size_of(points.size()),
                                            made);
    });
  }
  Model with_details(int level, const std::vector<double>& vectors, Frame frame = Frame::absolute) const {
    return make([&](ifsm_model* made) {
      return ifsm_model_with_details(handle(), level, number(frame), vectors.data(), detail::size_of(vectors.size()),
                                     made);
    });
  }
  Model with_filter(const Filter& filter) const {
    return make([&](ifsm_model* made) { return ifsm_model_with_filter(handle(), filter.handle(), made); });
  }
  Model keep(const Keep& rule) const {
    ifsm_keep_options options = rule.get();
    detail::Trampoline trampoline{&rule.progress()};
    if (rule.progress()) options.progress = detail::Trampoline::call, options.user = &trampoline;
    ifsm_model made{};
    const ifsm_status status = ifsm_model_keep(handle(), &options, &made);
    Model sketch(made);
    if (trampoline.thrown) std::rethrow_exception(trampoline.thrown);
    detail::check(status);
    return sketch;
  }

  // Questions.
  double length(double from = 0, double to = 1) const {
    double length = 0;
    detail::check(ifsm_model_length(handle(), from, to, &length));
    return length;
  }
  // Parameters of so many points, equally far apart along the curve; or of points that far apart.
  std::vector<double> spaced(std::int64_t points) const {
    return fetch<double>([&](auto... to) { return ifsm_model_spaced(handle(), points, 0, to...); });
  }
  std::vector<double> spaced_by(double spacing) const {
    return fetch<double>([&](auto... to) { return ifsm_model_spaced(handle(), 0, spacing, to...); });
  }
  std::vector<Nearest> nearest(const std::vector<double>& queries) const {
    const std::vector<double> rows = fetch<double>([&](auto... to) {
      return ifsm_model_nearest(handle(), queries.data(), detail::size_of(queries.size()), to...);
    });
    std::vector<Nearest> found;
    const std::ptrdiff_t width = 2 + describe().dimension;
    for (auto row = rows.begin(); row != rows.end(); row += width)
      found.push_back({row[0], row[1], std::vector<double>(row + 2, row + width)});
    return found;
  }
  ifsm_distances distance(const Model& other) const {
    return detail::describe<ifsm_distances>(
        [&](auto* told) { return ifsm_model_distance(handle(), other.handle(), told); });
  }
  std::vector<double> curvature(const std::vector<double>& parameters, double scale) const {
    return fetch<double>([&](auto... to) {
      return ifsm_model_curvature(handle(), scale, parameters.data(), detail::size_of(parameters.size()), to...);
    });
  }
  std::vector<Crossing> crossings() const {
    return detail::crossings(fetch<double>([&](auto... to) { return ifsm_model_crossings(handle(), to...); }));
  }
  // 0: the default number of scales, smallest and largest scale.
  Dimension dimension(Count method = Count::boxes, int scales = 0, double smallest = 0, double largest = 0) const {
    ifsm_dimension_options options{};
    detail::check(ifsm_dimension_options_init(&options, sizeof options));
    options.method = number(method);
    options.scales = scales;
    options.smallest = smallest;
    options.largest = largest;
    Dimension told{};
    told.report.struct_size = sizeof told.report;
    columns(fetch<double>([&](auto... to) { return ifsm_model_dimension(handle(), &options, &told.report, to...); }),
            told.scales, told.counts);
    return told;
  }
  Spectrum spectrum() const {
    Spectrum told{};
    told.report.struct_size = sizeof told.report;
    columns(fetch<double>([&](auto... to) { return ifsm_model_spectrum(handle(), &told.report, to...); }), told.scales,
            told.rms);
    return told;
  }
  Model refine(const RefineOptions& wanted = {}) const {
    ifsm_refine_options options{};
    detail::check(ifsm_refine_options_init(&options, sizeof options));
    options.levels = wanted.levels;
    options.seed = wanted.seed;
    options.learned = wanted.learned;
    options.roughness = wanted.roughness;
    return make([&](ifsm_model* made) { return ifsm_model_refine(handle(), &options, made); });
  }

  ifsm_model handle() const noexcept { return handle_.get(); }
  ifsm_model release() noexcept { return handle_.release(); }  // the caller destroys it

 private:
  template <class Enum>
  static std::int32_t number(Enum value) {
    return static_cast<std::int32_t>(value);
  }
  template <class T, class Call>
  static std::vector<T> fetch(const Call& call) {
    return detail::fetch<T>(call);
  }
  // Rows of two.
  static void columns(const std::vector<double>& rows, std::vector<double>& left, std::vector<double>& right) {
    for (std::size_t i = 0; i + 1 < rows.size(); i += 2) left.push_back(rows[i]), right.push_back(rows[i + 1]);
  }
  template <class Call>
  static Model make(const Call& call) {
    ifsm_model made{};
    detail::check(call(&made));
    return Model(made);
  }

  detail::Owner<ifsm_model, ifsm_model_destroy> handle_;
};

// ------------------------------------------------------------------------------------------------------------------
// Deformers: models being edited. The one mutable class: one thread at a time, or Error with IFSM_ERROR_BUSY

enum class Turning : std::int32_t {
  similarity = IFSM_TURNING_SIMILARITY,
  rotation = IFSM_TURNING_ROTATION,
  linear = IFSM_TURNING_LINEAR
};
enum class Following : std::int32_t { moved = IFSM_FOLLOW_MOVED, each = IFSM_FOLLOW_EACH, none = IFSM_FOLLOW_NONE };
enum class Reach : std::int32_t { nodes = IFSM_REACH_NODES, curve = IFSM_REACH_CURVE };
enum class Falloff : std::int32_t {
  none = IFSM_FALLOFF_NONE,
  linear = IFSM_FALLOFF_LINEAR,
  smooth = IFSM_FALLOFF_SMOOTH
};
enum class Ruler : std::int32_t { handles = IFSM_RULER_HANDLES, length = IFSM_RULER_LENGTH };
enum class Lead : std::int32_t { handles = IFSM_LEAD_HANDLES, details = IFSM_LEAD_DETAILS };
enum class Easing : std::int32_t {
  smooth = IFSM_EASING_SMOOTH,
  linear = IFSM_EASING_LINEAR,
  in = IFSM_EASING_IN,
  out = IFSM_EASING_OUT
};

// How handles move, as in ifsm_move_options.
struct MoveOptions {
  bool places = false;  // vectors are where handles go to
  Reach reach = Reach::nodes;
  Falloff falloff = Falloff::none;
  Ruler ruler = Ruler::handles;
  double radius = 0;
};

// How details of levels change, as in ifsm_restyle_options.
struct RestyleOptions {
  int fade = 0;
  int mirror = 0;  // the number of an axis, from 1
  double angle = 0;
};

// Where other details come from, as in ifsm_texture_options.
struct TextureOptions {
  int fade = 0;
  const Model* from = nullptr;  // none: random ones
  double roughness = 0;
  double size = 0;
  std::uint64_t seed = 0;
};

class Deformer {
 public:
  struct Window {
    std::int64_t first, number;
  };

  Deformer() = default;                                                // the null handle
  explicit Deformer(ifsm_deformer owned) noexcept : handle_(owned) {}  // takes ownership
  explicit Deformer(const Model& model, Turning turning = Turning::similarity, Following follow = Following::moved) {
    ifsm_deformer_options options{};
    detail::check(ifsm_deformer_options_init(&options, sizeof options));
    options.turning = static_cast<std::int32_t>(turning);
    options.follow = static_cast<std::int32_t>(follow);
    ifsm_deformer made{};
    detail::check(ifsm_deformer_create(model.handle(), &options, &made));
    handle_ = Owner(made);
  }

  ifsm_deformer_info describe() const {
    return detail::describe<ifsm_deformer_info>([&](auto* told) { return ifsm_deformer_describe(handle(), told); });
  }

  // Vectors are interleaved, one a handle.
  Deformer& move(int level, const std::vector<std::int64_t>& handles, const std::vector<double>& vectors,
                 const MoveOptions& wanted = {}) {
    ifsm_move_options options{};
    detail::check(ifsm_move_options_init(&options, sizeof options));
    options.places = wanted.places ? 1 : 0;
    options.reach = static_cast<std::int32_t>(wanted.reach);
    options.falloff = static_cast<std::int32_t>(wanted.falloff);
    options.ruler = static_cast<std::int32_t>(wanted.ruler);
    options.radius = wanted.radius;
    return done(ifsm_deformer_move(handle(), level, handles.data(), detail::size_of(handles.size()), vectors.data(),
                                   detail::size_of(vectors.size()), &options));
  }
  Deformer& pin(int level, const std::vector<std::int64_t>& handles, bool hold = true) {
    return done(ifsm_deformer_pin(handle(), level, handles.data(), detail::size_of(handles.size()), hold ? 1 : 0));
  }
  Deformer& drag(int level, const std::vector<double>& parameters, const std::vector<double>& places,
                 Lead lead = Lead::handles) {
    return done(ifsm_deformer_drag(handle(), level, static_cast<std::int32_t>(lead), parameters.data(),
                                   detail::size_of(parameters.size()), places.data(), detail::size_of(places.size())));
  }
  Deformer& restyle(int first, int last, double scale, const RestyleOptions& wanted = {}) {
    ifsm_restyle_options options{};
    detail::check(ifsm_restyle_options_init(&options, sizeof options));
    options.fade = wanted.fade;
    options.mirror = wanted.mirror;
    options.angle = wanted.angle;
    return done(ifsm_deformer_restyle(handle(), first, last, scale, &options));
  }
  Deformer& texture(int first, int last, const TextureOptions& wanted = {}) {
    ifsm_texture_options options{};
    detail::check(ifsm_texture_options_init(&options, sizeof options));
    options.fade = wanted.fade;
    if (wanted.from) options.from = wanted.from->handle();
    options.roughness = wanted.roughness;
    options.size = wanted.size;
    options.seed = wanted.seed;
    return done(ifsm_deformer_texture(handle(), first, last, &options));
  }
  Deformer& undo() { return done(ifsm_deformer_undo(handle())); }
  Deformer& redo() { return done(ifsm_deformer_redo(handle())); }
  Deformer& keep_as(const std::string& name) { return done(ifsm_deformer_keep_as(handle(), name.c_str())); }
  Deformer& go_to(const std::string& name) { return done(ifsm_deformer_go_to(handle(), name.c_str())); }

  // When the edits that follow take place; the curve at a time.
  Deformer& time(double begin, double end, Easing easing = Easing::smooth) {
    return done(ifsm_deformer_time(handle(), begin, end, static_cast<std::int32_t>(easing)));
  }
  Deformer at_time(double time) const {
    ifsm_deformer made{};
    detail::check(ifsm_deformer_at_time(handle(), time, &made));
    return Deformer(made);
  }

  // The edits, to be kept and made again.
  std::vector<std::uint8_t> save(Format format) const {
    return detail::fetch<std::uint8_t>(
        [&](auto... to) { return ifsm_deformer_save(handle(), static_cast<std::int32_t>(format), to...); });
  }
  Deformer& replay(const std::vector<std::uint8_t>& bytes) {
    return done(ifsm_deformer_replay(handle(), bytes.data(), detail::size_of(bytes.size())));
  }

  // Meetings of the curve with itself that the edits caused.
  std::vector<Crossing> crossings() const {
    return detail::crossings(
        detail::fetch<double>([&](auto... to) { return ifsm_deformer_crossings(handle(), to...); }));
  }

  std::vector<double> points(int level, std::int64_t first, std::int64_t number) const {
    return detail::fetch<double>(
        [&](auto... to) { return ifsm_deformer_points(handle(), level, first, number, to...); });
  }
  std::vector<double> samples() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_deformer_samples(handle(), to...); });
  }
  std::vector<double> evaluate(const std::vector<double>& parameters) const {
    return detail::fetch<double>([&](auto... to) {
      return ifsm_deformer_evaluate(handle(), parameters.data(), detail::size_of(parameters.size()), to...);
    });
  }
  Window changed(int level) const {
    Window told{};
    detail::check(ifsm_deformer_changed(handle(), level, &told.first, &told.number));
    return told;
  }
  Model snapshot() const {
    ifsm_model made{};
    detail::check(ifsm_deformer_snapshot(handle(), &made));
    return Model(made);
  }

  ifsm_deformer handle() const noexcept { return handle_.get(); }
  ifsm_deformer release() noexcept { return handle_.release(); }  // the caller destroys it

 private:
  using Owner = detail::Owner<ifsm_deformer, ifsm_deformer_destroy>;

  Deformer& done(ifsm_status status) {
    detail::check(status);
    return *this;
  }

  Owner handle_;
};

// ------------------------------------------------------------------------------------------------------------------
// Fits

// What a fit may be told; zero means the default everywhere, as in ifsm_fit_options.
struct FitOptions {
  int threads = 0;
  const Filter* start = nullptr;      // where to start
  int control_points = 0;             // -1: chosen
  int maps = 0;                       // -1: chosen
  std::vector<std::int64_t> budgets;  // of vectors, control points and details together
  int iterations = 0;
  int rounds = 0;     // -1: none
  int polish = 0;     // -1: none
  double within = 0;  // instead of budgets: a bound that sketches keep, by `distance`
  Distance distance = Distance::rms;
  const Cancel* cancel = nullptr;
  // Returns true to cancel. Runs on the calling thread; what it throws comes out of fit_sparse.
  std::function<bool(double fraction, const std::string& stage)> progress;
};

// What is known about one curve's samples, as in ifsm_fit_samples. Values stay here while the fit runs.
struct FitSamples {
  std::vector<double> parameters;   // with Parameters::given
  std::vector<double> weights;      // one a sample
  std::vector<double> covariances;  // dimension × dimension a sample
  bool fixed_ends = false;

  // The curve passes through a point at a parameter; its first (0) or last (1) leg lies along a direction.
  FitSamples& through(double parameter, const std::vector<double>& point) {
    return add(IFSM_CONSTRAINT_POINT, parameter, point);
  }
  FitSamples& along(double parameter, const std::vector<double>& direction) {
    return add(IFSM_CONSTRAINT_TANGENT, parameter, direction);
  }

  // Borrows this object.
  ifsm_fit_samples get() const {
    ifsm_fit_samples told{};
    told.parameters = parameters.data(), told.parameter_count = detail::size_of(parameters.size());
    told.weights = weights.data(), told.weight_count = detail::size_of(weights.size());
    told.covariances = covariances.data(), told.covariance_count = detail::size_of(covariances.size());
    told.constraint_kinds = kinds_.data();
    told.constraint_parameters = at_.data();
    told.constraint_values = values_.data();
    told.constraint_count = detail::size_of(kinds_.size());
    told.fixed_ends = fixed_ends ? 1 : 0;
    return told;
  }

 private:
  FitSamples& add(std::int32_t kind, double parameter, const std::vector<double>& value) {
    kinds_.push_back(kind);
    at_.push_back(parameter);
    values_.insert(values_.end(), value.begin(), value.end());
    return *this;
  }

  std::vector<std::int32_t> kinds_;
  std::vector<double> at_, values_;
};

enum class Parameters : std::int32_t {
  index = IFSM_PARAMETERS_INDEX,
  chord = IFSM_PARAMETERS_CHORD,
  centripetal = IFSM_PARAMETERS_CENTRIPETAL,
  given = IFSM_PARAMETERS_GIVEN
};
enum class Loss : std::int32_t {
  squares = IFSM_LOSS_SQUARES,
  huber = IFSM_LOSS_HUBER,
  cauchy = IFSM_LOSS_CAUCHY,
  tukey = IFSM_LOSS_TUKEY
};

// What stage curve may be told; zero means the default everywhere, as in ifsm_fit_curve_options.
struct FitCurveOptions {
  int threads = 0;
  const Filter* start = nullptr;  // where to start
  int control_points = 0;
  int maps = 0;
  bool fixed_filter = false;  // control points alone
  Parameters parameters = Parameters::index;
  int reparameterise = 0;  // rounds
  Loss loss = Loss::squares;
  double loss_scale = 0;
  int levels = 0;
  int starts = 0;
  int iterations = 0;
  double tolerance = 0;
  std::vector<FitSamples> samples;  // one a curve, or none
  const Cancel* cancel = nullptr;
  std::function<bool(double fraction, const std::string& stage)> progress;  // as in FitOptions
};

// What stage filter may be told, as in ifsm_fit_filter_options.
struct FitFilterOptions {
  int threads = 0;
  const Filter* start = nullptr;  // whose T stays
  int control_points = 0;
  int maps = 0;
  int kept_levels = 0;  // -1: none
  int iterations = 0;
  double tolerance = 0;
  const Cancel* cancel = nullptr;
  std::function<bool(double fraction, const std::string& stage)> progress;  // as in FitOptions
};

class Fit {
 public:
  Fit() = default;                                           // the null handle
  explicit Fit(ifsm_fit owned) noexcept : handle_(owned) {}  // takes ownership

  // The exact model of a curve under the fitted filter.
  Model model(std::int64_t curve) const {
    ifsm_model made{};
    detail::check(ifsm_fit_model(handle(), curve, &made));
    return Model(made);
  }
  // The best sketch of a curve that was found for a budget.
  Model sketch(std::int64_t curve, std::int64_t budget) const {
    ifsm_model made{};
    detail::check(ifsm_fit_sketch(handle(), curve, budget, &made));
    return Model(made);
  }
  ifsm_fit_report describe() const {
    return detail::describe<ifsm_fit_report>([&](auto* told) { return ifsm_fit_describe(handle(), told); });
  }
  ifsm_fit_budget describe_budget(std::int64_t curve, std::int64_t budget) const {
    return detail::describe<ifsm_fit_budget>(
        [&](auto* told) { return ifsm_fit_describe_budget(handle(), curve, budget, told); });
  }

  // Where the fit saw a curve's samples.
  std::vector<double> parameters(std::int64_t curve) const {
    return detail::fetch<double>([&](auto... to) { return ifsm_fit_parameters(handle(), curve, to...); });
  }
  // Covariances, row by row: of a curve's control points, of the fitted part of the filter, of the curve's points.
  std::vector<double> covariance(std::int64_t curve) const {
    return detail::fetch<double>([&](auto... to) { return ifsm_fit_covariance(handle(), curve, to...); });
  }
  std::vector<double> filter_covariance() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_fit_filter_covariance(handle(), to...); });
  }
  std::vector<double> curve_covariance(std::int64_t curve, const std::vector<double>& parameters) const {
    return detail::fetch<double>([&](auto... to) {
      return ifsm_fit_curve_covariance(handle(), curve, parameters.data(), detail::size_of(parameters.size()), to...);
    });
  }

  ifsm_fit handle() const noexcept { return handle_.get(); }
  ifsm_fit release() noexcept { return handle_.release(); }  // the caller destroys it

 private:
  detail::Owner<ifsm_fit, ifsm_fit_destroy> handle_;
};

namespace detail {

inline std::vector<ifsm_curve> curves_of(const std::vector<Curve>& curves) {
  std::vector<ifsm_curve> given;
  given.reserve(curves.size());
  for (const Curve& curve : curves) given.push_back(curve.get());
  return given;
}

// The options that all stages have, and the call itself: call(curves, count, options, fit).
template <class Told, class Options, class Call>
Fit run_fit(const std::vector<Curve>& curves, const Options& options, Told& told, const Call& call) {
  const std::vector<ifsm_curve> given = curves_of(curves);
  Trampoline trampoline{&options.progress};
  told.threads = options.threads;
  if (options.start != nullptr) told.start = options.start->handle();
  told.control_points = options.control_points;
  told.maps = options.maps;
  told.iterations = options.iterations;
  if (options.cancel != nullptr) told.cancel = options.cancel->handle();
  if (options.progress) told.progress = Trampoline::call, told.user = &trampoline;

  ifsm_fit made{};
  const ifsm_status status = call(given.data(), size_of(given.size()), &told, &made);
  Fit fit(made);
  if (trampoline.thrown) std::rethrow_exception(trampoline.thrown);
  check(status);
  return fit;
}

}  // namespace detail

// Stage sparse: one filter for all curves, under which few details tell them.
inline Fit fit_sparse(const std::vector<Curve>& curves, const FitOptions& options = {}) {
  ifsm_fit_options told{};
  detail::check(ifsm_fit_options_init(&told, sizeof told));
  told.budgets = options.budgets.empty() ? nullptr : options.budgets.data();
  told.budget_count = detail::size_of(options.budgets.size());
  told.rounds = options.rounds;
  told.polish = options.polish;
  told.within = options.within;
  told.distance = static_cast<std::int32_t>(options.distance);
  return detail::run_fit(curves, options, told, ifsm_fit_sparse);
}

// Stage curve: control points and T whose curve without details comes nearest to the samples.
inline Fit fit_curve(const std::vector<Curve>& curves, const FitCurveOptions& options = {}) {
  ifsm_fit_curve_options told{};
  detail::check(ifsm_fit_curve_options_init(&told, sizeof told));
  told.fixed_filter = options.fixed_filter ? 1 : 0;
  told.parameters = static_cast<std::int32_t>(options.parameters);
  told.reparameterise = options.reparameterise;
  told.loss = static_cast<std::int32_t>(options.loss);
  told.loss_scale = options.loss_scale;
  told.levels = options.levels;
  told.starts = options.starts;
  told.tolerance = options.tolerance;
  std::vector<ifsm_fit_samples> samples;
  samples.reserve(options.samples.size());
  for (const FitSamples& known : options.samples) samples.push_back(known.get());
  told.samples = samples.data();
  told.sample_count = detail::size_of(samples.size());
  return detail::run_fit(curves, options, told, ifsm_fit_curve);
}

// Stage filter: with T as it is, the U under which the first levels of details tell the samples best.
inline Fit fit_filter(const std::vector<Curve>& curves, const FitFilterOptions& options = {}) {
  ifsm_fit_filter_options told{};
  detail::check(ifsm_fit_filter_options_init(&told, sizeof told));
  told.kept_levels = options.kept_levels;
  told.tolerance = options.tolerance;
  return detail::run_fit(curves, options, told, ifsm_fit_filter);
}

struct TrainOptions {
  int threads = 0;
  const Filter* start = nullptr;  // where to start
  int control_points = 0;
  int maps = 0;
  std::vector<std::int64_t> budgets;  // of vectors, control points and details together
  int hold_out = 0;                   // every so-manyth curve is judged, not trained on
  int rounds = 0;
  int iterations = 0;
  double condition = 0;
  double reach = 0;
  const Cancel* cancel = nullptr;
  // Returns true to cancel. Runs on the calling thread; what it throws comes out of train.
  std::function<bool(double fraction, const std::string& stage)> progress;
};

struct Trained {
  Filter filter;
  ifsm_train_report report;
};

// One filter for a family of curves.
inline Trained train(const std::vector<Curve>& curves, const TrainOptions& options = {}) {
  const std::vector<ifsm_curve> given = detail::curves_of(curves);
  detail::Trampoline trampoline{&options.progress};
  ifsm_train_options told{};
  detail::check(ifsm_train_options_init(&told, sizeof told));
  told.threads = options.threads;
  if (options.start != nullptr) told.start = options.start->handle();
  told.control_points = options.control_points;
  told.maps = options.maps;
  told.budgets = options.budgets.empty() ? nullptr : options.budgets.data();
  told.budget_count = detail::size_of(options.budgets.size());
  told.hold_out = options.hold_out;
  told.rounds = options.rounds;
  told.iterations = options.iterations;
  told.condition = options.condition;
  told.reach = options.reach;
  if (options.cancel != nullptr) told.cancel = options.cancel->handle();
  if (options.progress) told.progress = detail::Trampoline::call, told.user = &trampoline;

  ifsm_filter made{};
  ifsm_train_report report{};
  report.struct_size = sizeof report;
  const ifsm_status status = ifsm_train(given.data(), detail::size_of(given.size()), &told, &made, &report);
  Filter filter(made);
  if (trampoline.thrown) std::rethrow_exception(trampoline.thrown);
  detail::check(status);
  return {std::move(filter), report};
}

// ------------------------------------------------------------------------------------------------------------------
// Systems: iterated function systems

// What ifsm_picture_options says; zero means the default everywhere, as there.
struct PictureOptions {
  int width = 0, height = 0;
  int threads = 0;
  double left = 0, bottom = 0, right = 0, top = 0;  // all zero: around the attractor
  std::uint64_t seed = 0;
  std::int64_t points = 0;
  double tolerance = 0;
  Colour colour = Colour::tone;
  Palette palette = Palette::dusk;
  std::vector<std::uint8_t> stops;  // red, green, blue of each colour, instead of the palette
  int symbols = 0;
  int oversample = 0;
  std::uint32_t background = 0;
  double azimuth = 0, elevation = 0, field = 0;
  const Cancel* cancel = nullptr;
  std::function<bool(double fraction, const std::string& stage)> progress;  // true cancels
};

// What was drawn: the report tells the window, and how much of it was met.
template <class Value>
struct Drawn {
  ifsm_picture_report report;
  std::vector<Value> values;  // row by row, row 0 on top
};

namespace detail {

// What call(options) returns, with PictureOptions in C's terms; what its progress throws is thrown again.
template <class Call>
auto with_picture_options(const PictureOptions& options, const Call& call) {
  ifsm_picture_options told{};
  check(ifsm_picture_options_init(&told, sizeof told));
  told.width = options.width, told.height = options.height, told.threads = options.threads;
  told.left = options.left, told.bottom = options.bottom, told.right = options.right, told.top = options.top;
  told.seed = options.seed, told.points = options.points, told.tolerance = options.tolerance;
  told.colour = static_cast<std::int32_t>(options.colour);
  told.palette = static_cast<std::int32_t>(options.palette);
  told.stops = options.stops.data(), told.stop_count = size_of(options.stops.size());
  told.symbols = options.symbols, told.oversample = options.oversample, told.background = options.background;
  told.azimuth = options.azimuth, told.elevation = options.elevation, told.field = options.field;
  if (options.cancel != nullptr) told.cancel = options.cancel->handle();
  Trampoline trampoline{&options.progress};
  if (options.progress) told.progress = Trampoline::call, told.user = &trampoline;
  try {
    return call(static_cast<const ifsm_picture_options*>(&told));
  } catch (const Cancelled&) {
    if (trampoline.thrown) std::rethrow_exception(trampoline.thrown);
    throw;
  }
}

}  // namespace detail

class System {
 public:
  System() = default;                                              // the null handle
  explicit System(ifsm_system owned) noexcept : handle_(owned) {}  // takes ownership

  // Maps of d × (d + 1) numbers each, row by row (M | t); probabilities: one a map, or none.
  System(int dimension, const std::vector<double>& maps, const std::vector<double>& probabilities = {})
      : System(make([&](ifsm_system* made) {
          return ifsm_system_create(dimension, maps.data(), detail::size_of(maps.size()), probabilities.data(),
                                    detail::size_of(probabilities.size()), made);
        })) {}

  static System from_parameters(int dimension, const std::vector<double>& parameters,
                                const std::vector<double>& probabilities = {}) {
    return make([&](ifsm_system* made) {
      return ifsm_system_from_parameters(dimension, parameters.data(), detail::size_of(parameters.size()),
                                         probabilities.data(), detail::size_of(probabilities.size()), made);
    });
  }
  static System named(const std::string& name) {
    return make([&](ifsm_system* made) { return ifsm_system_named(name.c_str(), made); });
  }
  static System from_model(const Model& model) {
    return make([&](ifsm_system* made) { return ifsm_system_from_model(model.handle(), made); });
  }

  // From a file's bytes, of any format; of several systems the one of that name.
  static System load(const std::vector<std::uint8_t>& bytes) { return loaded(bytes, nullptr); }
  static System load(const std::vector<std::uint8_t>& bytes, const std::string& name) {
    return loaded(bytes, name.c_str());
  }
  std::vector<std::uint8_t> save(Format format, const std::string& name = "system") const {
    return detail::fetch<std::uint8_t>(
        [&](auto... to) { return ifsm_system_save(handle(), static_cast<std::int32_t>(format), name.c_str(), to...); });
  }

  // A model without details, in the library's own polygon.
  Model model(Topology topology, int levels) const {
    ifsm_model made{};
    detail::check(ifsm_model_from_system(handle(), static_cast<std::int32_t>(topology), nullptr, levels, &made));
    return Model(made);
  }
  Model model(Topology topology, const Curve& polygon, int levels) const {
    ifsm_model made{};
    detail::check(ifsm_model_from_system(handle(), static_cast<std::int32_t>(topology), &polygon.get(), levels, &made));
    return Model(made);
  }

  ifsm_system_info describe() const {
    return detail::describe<ifsm_system_info>([&](auto* told) { return ifsm_system_describe(handle(), told); });
  }
  std::vector<double> maps() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_system_maps(handle(), to...); });
  }
  std::vector<double> parameters() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_system_parameters(handle(), to...); });
  }
  std::vector<double> probabilities() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_system_probabilities(handle(), to...); });
  }
  std::vector<double> fixed_points() const {
    return detail::fetch<double>([&](auto... to) { return ifsm_system_fixed_points(handle(), to...); });
  }
  std::vector<std::int32_t> witness() const {
    return detail::fetch<std::int32_t>([&](auto... to) { return ifsm_system_witness(handle(), to...); });
  }

  // Words, points, addresses (row by row, `length` symbols each).
  std::vector<double> word(const std::vector<std::int32_t>& symbols) const {
    return detail::fetch<double>(
        [&](auto... to) { return ifsm_system_word(handle(), symbols.data(), detail::size_of(symbols.size()), to...); });
  }
  std::vector<double> point(const std::vector<std::int32_t>& symbols, std::int64_t period = 1) const {
    return detail::fetch<double>([&](auto... to) {
      return ifsm_system_point(handle(), symbols.data(), detail::size_of(symbols.size()), period, to...);
    });
  }
  std::vector<std::int32_t> addresses(const std::vector<double>& point, int length, double tolerance = 0) const {
    return detail::fetch<std::int32_t>([&](auto... to) {
      return ifsm_system_addresses(handle(), point.data(), detail::size_of(point.size()), length, tolerance, to...);
    });
  }

  // The attractor and its measure; a tolerance of 0 is a billionth of its size.
  std::vector<double> box(double tolerance = 0) const {
    return detail::fetch<double>([&](auto... to) { return ifsm_system_box(handle(), tolerance, to...); });
  }
  std::vector<double> ball(double tolerance = 0) const {
    return detail::fetch<double>([&](auto... to) { return ifsm_system_ball(handle(), tolerance, to...); });
  }
  double diameter(double tolerance = 0) const {
    double told = 0;
    detail::check(ifsm_system_diameter(handle(), tolerance, &told));
    return told;
  }
  std::vector<double> moments(int degree, const std::vector<double>& about = {}) const {
    return detail::fetch<double>([&](auto... to) {
      return ifsm_system_moments(handle(), degree, about.data(), detail::size_of(about.size()), to...);
    });
  }
  double similarity_dimension() const {
    double told = 0;
    detail::check(ifsm_system_similarity_dimension(handle(), &told));
    return told;
  }
  Dimension box_dimension(int finest = 0) const {
    Dimension found{};
    found.report.struct_size = sizeof found.report;
    const auto rows = detail::fetch<double>(
        [&](auto... to) { return ifsm_system_box_dimension(handle(), finest, &found.report, to...); });
    for (auto row = rows.begin(); row != rows.end(); row += 2)
      found.scales.push_back(row[0]), found.counts.push_back(row[1]);
    return found;
  }

  // Pictures and points.
  Drawn<std::uint32_t> histogram(const PictureOptions& options = {}) const {
    return draw<std::uint32_t>(ifsm_system_histogram, options);
  }
  Drawn<std::uint8_t> set(const PictureOptions& options = {}) const {
    return draw<std::uint8_t>(ifsm_system_set, options);
  }
  Drawn<double> distances(const PictureOptions& options = {}) const {
    return draw<double>(ifsm_system_distances, options);
  }
  Drawn<std::uint8_t> render(const PictureOptions& options = {}) const {
    return draw<std::uint8_t>(ifsm_system_render, options);
  }
  std::vector<double> sample(const PictureOptions& options = {}) const {
    return detail::with_picture_options(options, [&](const auto* told) {
      return detail::fetch<double>([&](auto... to) { return ifsm_system_sample(handle(), told, to...); });
    });
  }
  std::vector<std::int32_t> sample_addresses(int length, const PictureOptions& options = {}) const {
    return detail::with_picture_options(options, [&](const auto* told) {
      return detail::fetch<std::int32_t>(
          [&](auto... to) { return ifsm_system_sample_addresses(handle(), told, length, to...); });
    });
  }

  ifsm_system handle() const noexcept { return handle_.get(); }
  ifsm_system release() noexcept { return handle_.release(); }  // the caller destroys it

 private:
  template <class Call>
  static System make(const Call& call) {
    ifsm_system made{};
    detail::check(call(&made));
    return System(made);
  }

  static System loaded(const std::vector<std::uint8_t>& bytes, const char* name) {
    return make(
        [&](ifsm_system* made) { return ifsm_system_load(bytes.data(), detail::size_of(bytes.size()), name, made); });
  }

  template <class Value, class Function>
  Drawn<Value> draw(const Function& function, const PictureOptions& options) const {
    Drawn<Value> drawn{};
    drawn.report.struct_size = sizeof drawn.report;
    drawn.values = detail::with_picture_options(options, [&](const auto* told) {
      return detail::fetch<Value>([&](auto... to) { return function(handle(), told, &drawn.report, to...); });
    });
    return drawn;
  }

  detail::Owner<ifsm_system, ifsm_system_destroy> handle_;
};

// The names of a file's systems; of formats without names a single empty one.
inline std::vector<std::string> system_names(const std::vector<std::uint8_t>& bytes) {
  const auto lines = detail::fetch<std::uint8_t>(
      [&](auto... to) { return ifsm_system_file_names(bytes.data(), detail::size_of(bytes.size()), to...); });
  std::vector<std::string> names(1);
  for (const std::uint8_t byte : lines)
    byte == '\n' ? static_cast<void>(names.emplace_back()) : names.back().push_back(static_cast<char>(byte));
  names.pop_back();  // every line has an end
  return names;
}

// All systems that have names.
inline std::vector<ifsm_system_entry> system_catalog() {
  std::vector<ifsm_system_entry> entries;
  ifsm_system_entry entry{};
  entry.struct_size = sizeof entry;
  while (ifsm_system_catalog(detail::size_of(entries.size()), &entry) == IFSM_OK) entries.push_back(entry);
  return entries;
}

// Red, green, blue, alpha for each count.
inline std::vector<std::uint8_t> tone_map(const std::vector<std::uint32_t>& counts,
                                          const PictureOptions& options = {}) {
  return detail::with_picture_options(options, [&](const auto* told) {
    return detail::fetch<std::uint8_t>(
        [&](auto... to) { return ifsm_tone_map(counts.data(), detail::size_of(counts.size()), told, to...); });
  });
}

}  // namespace ifsm

#endif  // IFSM_HPP
