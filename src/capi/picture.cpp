#include <ifsm.h>

#include <algorithm>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "capi/arguments.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "capi/options.h"
#include "raster/chaos.h"
#include "raster/distance.h"
#include "raster/points.h"
#include "raster/portrait.h"
#include "raster/set.h"
#include "raster/tone.h"
#include "raster/view.h"
#include "system/reach.h"

using namespace ifsm::core;

namespace ifsm::core {

// For deliver(): four bytes a pixel.
inline void copy_out(const Picture& picture, std::int64_t, std::uint8_t* to) {
  for (const Rgba& each : picture)
    *to++ = each.colour.red, *to++ = each.colour.green, *to++ = each.colour.blue, *to++ = each.alpha;
}

inline void copy_out(const std::vector<Meets>& pixels, std::int64_t, std::uint8_t* to) {
  for (const Meets each : pixels) *to++ = static_cast<std::uint8_t>(each);
}

// A histogram to be: it is counted where it goes, when that is known to have room.
struct Counting {
  SystemPtr system;
  Window window;
  std::uint64_t seed;
  std::int64_t points;
  Watch* watch;
  ifsm_picture_report* told;
};

inline void copy_out(const Counting& game, std::int64_t count, std::uint32_t* to) {
  const std::span<std::uint32_t> counts(to, static_cast<std::size_t>(count));
  game.told->inside = count_in_place(*game.system, game.window, game.seed, game.points, counts, *game.watch);
  game.told->met = std::count_if(counts.begin(), counts.end(), [](std::uint32_t c) { return c > 0; });
}

// A sample to be, likewise.
struct Sampling {
  const System* system;
  std::uint64_t seed;
  std::int64_t points, length;
  Watch* watch;
};

inline void copy_out(const Sampling& s, std::int64_t, double* to) {
  tell_points(*s.system, s.seed, s.points, to, 0, nullptr, *s.watch);
}
inline void copy_out(const Sampling& s, std::int64_t, std::int32_t* to) {
  tell_points(*s.system, s.seed, s.points, nullptr, s.length, to, *s.watch);
}

}  // namespace ifsm::core

namespace {

enum class Shows : int32_t { tone = 0, symbol = 1, address = 2, set = 3, distance = 4 };

constexpr int32_t most_pixels = 32768, usual_pixels = 1024;
constexpr Direction usual_direction{.azimuth = .6, .elevation = .45, .field = .5};

void require_window_fields(const ifsm_picture_options& read) {
  require_finite(read.left, "left");
  require_finite(read.bottom, "bottom");
  require_finite(read.right, "right");
  require_finite(read.top, "top");
}

bool has_window(const ifsm_picture_options& read) {
  return read.left != 0 || read.bottom != 0 || read.right != 0 || read.top != 0;
}

std::vector<Rgb> colours_of(const uint8_t* stops, int64_t count) {
  constexpr int64_t bytes_a_colour = 3, most_colours = 256;
  in_range(count, 0, bytes_a_colour * most_colours, "stop_count");
  const auto given = input(stops, count, "stops", "stop_count");
  if (count % bytes_a_colour != 0)
    throw Error(Status::range, "stop_count",
                "stop_count is " + std::to_string(count) + "; give three bytes a colour, of 1 to 256 colours.")
        .with(static_cast<double>(count));
  std::vector<Rgb> colours;
  for (int64_t k = 0; k < count; k += bytes_a_colour)
    colours.push_back({given.data[k], given.data[k + 1], given.data[k + 2]});
  return colours;
}

// The options as they are meant, defaults told; all of them are checked, whoever asks.
class Request {
 public:
  explicit Request(const ifsm_picture_options* given) : read_(read_options(given)) {
    width_ = count_or(read_.width, most_pixels, usual_pixels, "width");
    height_ = count_or(read_.height, most_pixels, width_, "height");
    threads_ = threads_of(read_.threads);
    require_window_fields(read_);
    in_range(read_.points, 0, int64_t{1} << 50, "points");
    in_between(read_.tolerance, 0, 1, "tolerance");
    shows_ = choice(read_.colour, Shows::distance, "colour");
    const PaletteName name = choice(read_.palette, PaletteName::ink, "palette");
    stops_ = colours_of(read_.stops, read_.stop_count);
    if (!stops_.empty()) own_.emplace(stops_);
    palette_ = own_ ? &*own_ : &palette(name);
    in_range(read_.symbols, 0, 16, "symbols");
    in_range(read_.oversample, 0, std::min(8, most_pixels / std::max(width_, height_)), "oversample");
    in_range(read_.reserved, 0, 0, "reserved");
    require_finite(read_.azimuth, "azimuth");
    require_finite(read_.elevation, "elevation");
    constexpr double widest = 3;
    in_between(read_.field, 0, widest, "field");
    token_ = borrow_if_any(read_.cancel, "cancel");
  }
  Request(const Request&) = delete;
  Request& operator=(const Request&) = delete;

  int64_t width() const { return width_; }
  int64_t height() const { return height_; }
  int64_t pixels() const { return int64_t{width_} * height_; }
  int threads() const { return threads_; }
  uint64_t seed() const { return read_.seed; }
  Shows shows() const { return shows_; }
  const Palette& colours() const { return *palette_; }
  bool has_own_window() const { return has_window(read_); }
  Direction direction() const {
    const bool told = read_.azimuth != 0 || read_.elevation != 0 || read_.field != 0;
    return told ? Direction{read_.azimuth, read_.elevation, read_.field} : usual_direction;
  }
  Watch watch() const { return Watch(token_.get(), progress_of(read_)); }
  int64_t points(int64_t otherwise) const { return read_.points == 0 ? otherwise : read_.points; }
  double tolerance(double otherwise) const { return read_.tolerance == 0 ? otherwise : read_.tolerance; }

  Look look() const { return {static_cast<Colouring>(shows_), read_.symbols, palette_, stops_}; }

  Rgba background() const {
    const auto byte = [&](int shift) { return static_cast<uint8_t>(read_.background >> shift); };
    return {{byte(24), byte(16), byte(8)}, byte(0)};
  }

  int64_t oversample() const {
    constexpr int64_t large = 4096;
    if (read_.oversample != 0) return read_.oversample;
    return shows_ == Shows::distance || std::max(width_, height_) > large ? 1 : 2;
  }

  // As it was given, or around a box.
  template <class BoxOf>
  Window window(const BoxOf& box) const {
    if (!has_window(read_)) return window_around(box(), width_, height_);
    const Window given{read_.left, read_.bottom, read_.right, read_.top, width_, height_};
    if (!(given.right > given.left)) refuse_side("right", given.right, given.left);
    if (!(given.top > given.bottom)) refuse_side("top", given.top, given.bottom);
    require_window(given);
    return given;
  }
  Window plane_window(const System& system) const {
    require_plane(system);
    return window([&] { return bounding_box(system, box_tolerance(system)); });
  }

  static double box_tolerance(const System& system) {
    constexpr double share = 1e-6;
    return share * system.enclosure().axes.norm();
  }

 private:
  [[noreturn]] static void refuse_side(const char* argument, double value, double before) {
    throw Error(Status::range, argument,
                std::string(argument) + " is " + text_of(value) + ", not above the other side's " + text_of(before) +
                    "; give a window of some size, or all four sides 0 for one around the attractor.")
        .with(value);
  }

  ifsm_picture_options read_;
  int32_t width_, height_;
  int threads_;
  Shows shows_;
  std::vector<Rgb> stops_;
  std::optional<Palette> own_;
  const Palette* palette_;
  std::shared_ptr<CancelToken> token_;
};

ifsm_picture_report report_of(const Window& window) {
  ifsm_picture_report told{};
  told.width = static_cast<int32_t>(window.width);
  told.height = static_cast<int32_t>(window.height);
  told.left = window.left, told.bottom = window.bottom, told.right = window.right, told.top = window.top;
  return told;
}

void tell(const std::vector<Meets>& pixels, ifsm_picture_report& told) {
  told.met = std::count(pixels.begin(), pixels.end(), Meets::yes);
  told.undecided = std::count(pixels.begin(), pixels.end(), Meets::undecided);
}

double pixel_of(const Window& window) { return (window.right - window.left) / static_cast<double>(window.width); }

constexpr double usual_set_tolerance = 1. / 64, usual_distance_tolerance = 1. / 8;
constexpr int64_t points_a_pixel = 16, points_a_pixel_of_space = 32;

// What all four drawings have in common: the window, how many values it takes, and where report and values go. `draw`
// makes them, and fills in the rest of the report.
template <class T, class Draw>
void draw_into(const Request& request, const Window& window, int64_t values_a_pixel, ifsm_picture_report* report,
               const Output<T>& to, int64_t* count, const Draw& draw) {
  const Report where(report, "report");
  const int64_t needed = request.pixels() * values_a_pixel;
  int64_t& told_count = required(count, "count");
  const Threads threads(request.threads());
  ifsm_picture_report told = report_of(window);
  Watch watch = request.watch();
  deliver(needed, to, told_count, [&] { return draw(watch, told); });
  where.write(told);
}

// What is drawn of a system of the plane, a value a pixel.
struct Plane {
  SystemPtr system;
  const Request& request;
  Window window;
  Watch& watch;
  ifsm_picture_report& told;
};

template <class T, class Draw>
void draw_plane(ifsm_system handle, const ifsm_picture_options* options, ifsm_picture_report* report,
                const Output<T>& to, int64_t* count, const Draw& draw) {
  const auto system = borrow(handle);
  const Request request(options);
  const Window window = request.plane_window(*system);
  draw_into(request, window, 1, report, to, count, [&](Watch& watch, ifsm_picture_report& told) {
    return draw(Plane{system, request, window, watch, told});
  });
}

Window finer(Window window, int64_t times) {
  window.width *= times;
  window.height *= times;
  return window;
}

int64_t points_of(const System& system, const Request& request, bool of_space, const Window& window, Watch& watch) {
  if (of_space) return request.points(window.pixels() * points_a_pixel_of_space);
  if (request.points(0) != 0 || !request.has_own_window()) return request.points(window.pixels() * points_a_pixel);
  return points_for(system, window, request.seed(), points_a_pixel, watch);
}

Picture drawn(const System& system, const Request& request, const std::optional<View>& view, const Window& window,
              Watch& watch, ifsm_picture_report& told) {
  if (request.shows() == Shows::set) {
    const auto pixels = set_pixels(system, window, request.tolerance(usual_set_tolerance), watch);
    tell(pixels, told);
    return set_picture(pixels, request.colours());
  }
  if (request.shows() == Shows::distance) {
    const auto found = distances(system, window, request.tolerance(usual_distance_tolerance), watch);
    return distance_picture(found, pixel_of(window), request.colours());
  }
  told.points = points_of(system, request, view.has_value(), window, watch);
  Portrait portrait = view ? space_portrait(system, *view, window, request.look(), request.seed(), told.points, watch)
                           : plane_portrait(system, window, request.look(), request.seed(), told.points, watch);
  told.inside = portrait.inside;
  told.met = portrait.met;
  return std::move(portrait.pixels);
}

// Points, or the letters of their addresses, into what is known to have room.
template <class T>
void sample_into(const System& system, const Request& request, int64_t values_a_point, int64_t length,
                 const Output<T>& to, int64_t* count) {
  constexpr int64_t usual_sample = 65536;
  static_cast<void>(system.enclosure());  // contractive, also when only the count is wanted
  const int64_t points = request.points(usual_sample);
  const Threads threads(request.threads());
  Watch watch = request.watch();
  deliver(checked_product(points, values_a_point, "points"), to, required(count, "count"), [&] {
    return Sampling{&system, request.seed(), points, length, &watch};
  });
}

// Around the attractor's box: a ball that holds it, and whose middle is where one looks.
View view_of(const System& system, const Direction& direction) {
  const double tolerance = Request::box_tolerance(system);
  const Box box = bounding_box(system, tolerance);
  const Vector3 middle = (box.low + box.high) / 2;
  return {direction, {middle, farthest(system, middle, tolerance)}};
}

}  // namespace

ifsm_status ifsm_picture_options_init(ifsm_picture_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_system_histogram(ifsm_system handle, const ifsm_picture_options* options, ifsm_picture_report* report,
                                  uint32_t* counts, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    draw_plane(handle, options, report, output(counts, capacity, "counts"), count, [](const Plane& asked) {
      const auto& [system, request, window, watch, told] = asked;
      told.points = points_of(*system, request, false, window, watch);
      return Counting{system, window, request.seed(), told.points, &watch, &told};
    });
  });
}

ifsm_status ifsm_system_set(ifsm_system handle, const ifsm_picture_options* options, ifsm_picture_report* report,
                            uint8_t* pixels, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    draw_plane(handle, options, report, output(pixels, capacity, "pixels"), count, [](const Plane& asked) {
      auto found = set_pixels(*asked.system, asked.window, asked.request.tolerance(usual_set_tolerance), asked.watch);
      tell(found, asked.told);
      return found;
    });
  });
}

ifsm_status ifsm_system_distances(ifsm_system handle, const ifsm_picture_options* options, ifsm_picture_report* report,
                                  double* values, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    draw_plane(handle, options, report, output(values, capacity, "distances"), count, [](const Plane& asked) {
      return distances(*asked.system, asked.window, asked.request.tolerance(usual_distance_tolerance), asked.watch);
    });
  });
}

ifsm_status ifsm_system_render(ifsm_system handle, const ifsm_picture_options* options, ifsm_picture_report* report,
                               uint8_t* rgba, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const Request request(options);
    const bool of_space = system->dimension() == 3;
    if (of_space && (request.shows() == Shows::set || request.shows() == Shows::distance)) require_plane(*system);
    std::optional<View> view;
    if (of_space) view = view_of(*system, request.direction());
    const Window window = !view ? request.plane_window(*system) : request.window([&] {
      const Vector3 corner(view->reach(), view->reach(), 0);
      return Box{-corner, corner};
    });
    const int64_t times = request.oversample();
    draw_into(request, window, 4, report, output(rgba, capacity, "rgba"), count,
              [&](Watch& watch, ifsm_picture_report& told) {
                const Window computed = finer(window, times);
                Picture picture = shrunk(drawn(*system, request, view, computed, watch, told), computed.width,
                                         computed.height, times);
                lay_over(picture, request.background());
                return picture;
              });
  });
}

ifsm_status ifsm_tone_map(const uint32_t* counts, int64_t number, const ifsm_picture_options* options, uint8_t* rgba,
                          int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto given = input(counts, number, "counts", "number");
    const Request request(options);
    deliver(checked_product(given.count, 4, "number"), output(rgba, capacity, "rgba"), required(count, "count"), [&] {
      Picture picture = density_picture({given.data, static_cast<std::size_t>(given.count)}, request.colours());
      lay_over(picture, request.background());
      return picture;
    });
  });
}

ifsm_status ifsm_system_sample(ifsm_system handle, const ifsm_picture_options* options, double* points,
                               int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    sample_into(*system, Request(options), system->dimension(), 0, output(points, capacity, "points"), count);
  });
}

ifsm_status ifsm_system_sample_addresses(ifsm_system handle, const ifsm_picture_options* options, int32_t length,
                                         int32_t* symbols, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    constexpr int32_t longest = 1024;
    in_range(length, 1, longest, "length");
    sample_into(*system, Request(options), length, length, output(symbols, capacity, "symbols"), count);
  });
}
