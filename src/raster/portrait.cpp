#include "raster/portrait.h"

#include <hwy/cache_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/error.h"
#include "base/parallel.h"
#include "raster/parts.h"
#include "raster/relief.h"
#include "raster/walk.h"

namespace ifsm::core {
namespace {

constexpr double full_light = 65535;
using Light = std::array<std::uint32_t, 3>;  // in parts of full_light: integers, so that sums need no order

Light whole(Rgb colour) {
  const std::array<double, 3> light = light_of(colour);
  Light result{};
  for (std::size_t k = 0; k < 3; ++k) result[k] = static_cast<std::uint32_t>(std::lround(light[k] * full_light));
  return result;
}

// Colours by number, and which number an orbit has. An address is kept as the share of the measure that lies in pieces
// of smaller addresses: for i_1 i_2 … that is P_i1 + p_i1 (P_i2 + p_i2 (…)), P_i the sum of the probabilities before i.
// So each shade of a palette is seen as often as any other.
class Colours {
 public:
  static constexpr std::size_t most_letters = 16, shades = 1024;
  // Of the last so many letters; or of all, in the first place.
  using Shares = std::array<double, most_letters>;

  Colours(const System& system, const Look& look) : look_(look), probabilities_(system.probabilities()) {
    in_range(look.letters, 0, most_letters, "letters");
    double sum = 0;
    for (const double p : probabilities_) before_.push_back(sum), sum += p;
    if (look.colouring == Colouring::letter)
      for (std::size_t i = 0; i < system.maps().size(); ++i) table_.push_back(whole(colour_of_letter(i)));
    else
      for (std::size_t k = 0; k < shades; ++k)
        table_.push_back(whole(look.palette->at(static_cast<double>(k) / (shades - 1))));
  }

  void extend(Shares& shares, int letter) const {
    const auto i = static_cast<std::size_t>(letter);
    if (look_.letters == 0) {
      shares[0] = before_[i] + probabilities_[i] * shares[0];
      return;
    }
    for (auto k = static_cast<std::size_t>(look_.letters); k-- > 1;)
      shares[k] = before_[i] + probabilities_[i] * shares[k - 1];
    shares[0] = before_[i] + probabilities_[i] / 2;  // the middle of the piece
  }

  std::uint32_t number(const Shares& shares, int letter) const {
    if (look_.colouring == Colouring::letter) return static_cast<std::uint32_t>(letter);
    const double share = shares[look_.letters == 0 ? 0 : static_cast<std::size_t>(look_.letters) - 1];
    return static_cast<std::uint32_t>(std::lround(std::min(share, 1.0) * (shades - 1)));
  }

  const Light& light(std::uint32_t number) const { return table_[number]; }
  Rgb colour(std::uint32_t number) const {
    const Light& l = table_[number];
    return colour_of({l[0] / full_light, l[1] / full_light, l[2] / full_light});
  }

 private:
  Rgb colour_of_letter(std::size_t i) const {
    if (look_.letter_colours.empty()) return letter_colour(static_cast<int>(i));
    return look_.letter_colours[i % look_.letter_colours.size()];
  }

  Look look_;
  std::vector<double> probabilities_, before_;
  std::vector<Light> table_;
};

// Bytes between what different threads write to, so that no line of a cache is both's.
constexpr std::size_t apart = 128;

// What was seen waits until what its pixel holds has come from memory, far away as pixels are: asked for when it is
// seen, taken when all have been asked for.
template <class Seen>
class Waiting {
 public:
  // Whether it is time to take all.
  bool add(const void* wanted, const Seen& seen) {
    hwy::Prefetch(static_cast<const std::uint8_t*>(wanted));
    all_[count_++] = seen;
    return count_ == all_.size();
  }

  template <class Take>
  void take(const Take& take) {
    for (std::size_t k = 0; k < count_; ++k) take(all_[k]);
    count_ = 0;
  }

 private:
  std::array<Seen, orbit_count> all_;
  std::size_t count_ = 0;
};

// So many of one value. The first touch of memory is what takes long.
template <class Value>
std::vector<Value> filled(std::size_t count, const Value& value, const Watch& watch) {
  std::vector<Value> all;
  all.reserve(count);
  for_parts(count, watch, [&](std::size_t, std::size_t end) { all.resize(end, value); });
  return all;
}

// Plays all chunks, each into one of some canvases, as many as there are threads; the first one holds all in the end.
// Canvas: see(number of a colour, x), settle() what waits, add(other, watch).
template <std::size_t d, class Make>
auto paint(const System& system, const Colours& colours, const Make& make_canvas, std::uint64_t seed,
           std::int64_t points, Watch& watch) {
  using Canvas = decltype(make_canvas());
  const WalkMaps<d> maps(system);
  const Start start(system);
  const std::int64_t chunks = (points + points_per_chunk - 1) / points_per_chunk;
  std::vector<Canvas> canvases;
  std::generate_n(std::back_inserter(canvases), std::clamp<std::int64_t>(chunks, 1, threads_at_once()), make_canvas);
  const auto groups = static_cast<std::int64_t>(canvases.size());
  for (std::int64_t done = 0; done < chunks; done += groups) {
    parallel_for(std::min(groups, chunks - done), 0, [&](std::int64_t group) {
      Canvas& canvas = canvases[static_cast<std::size_t>(group)];
      const std::int64_t chunk = done + group, left = points - chunk * points_per_chunk;
      const std::int64_t wanted = std::min(left, points_per_chunk);
      constexpr auto orbits = static_cast<std::int64_t>(orbit_count);
      std::array<Colours::Shares, orbit_count> addresses{};
      walk<d>(maps, start, seed, chunk, (wanted + orbits - 1) / orbits, watch,
              [&](std::int64_t step, std::size_t orbit, const auto& x, int letter) {
                colours.extend(addresses[orbit], letter);
                const std::int64_t place = (step - start.steps) * orbits + static_cast<std::int64_t>(orbit);
                if (place >= 0 && place < wanted) canvas.see(colours.number(addresses[orbit], letter), x);
              });
    });
    watch.report(static_cast<double>(std::min(done + groups, chunks)) / static_cast<double>(chunks), "points");
  }
  for (Canvas& canvas : canvases) canvas.settle();
  for (std::size_t k = 1; k < canvases.size(); ++k) canvases[0].add(canvases[k], watch);
  watch.finish();
  return std::move(canvases[0]);
}

// The light of all points of a pixel, added up.
class alignas(apart) LightSums {
 public:
  LightSums(const Window& window, const Colours& colours, const Watch& watch)
      : grid_(window), colours_(&colours), sums_(filled(static_cast<std::size_t>(window.pixels()) + 1, Sum{}, watch)) {}

  void see(std::uint32_t number, const std::array<double, 2>& x) {
    const auto pixel = static_cast<std::size_t>(grid_.pixel(x[0], x[1]));
    if (waiting_.add(&sums_[pixel], {pixel, number})) settle();
  }

  void settle() {
    waiting_.take([&](const Seen& seen) {
      Sum& sum = sums_[seen.pixel];
      const Light& light = colours_->light(seen.number);
      ++sum.count;
      for (std::size_t k = 0; k < 3; ++k) sum.light[k] += light[k];
    });
  }

  void add(const LightSums& other, const Watch& watch) {
    for_parts(sums_.size(), watch, [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p) {
        sums_[p].count += other.sums_[p].count;
        for (std::size_t k = 0; k < 3; ++k) sums_[p].light[k] += other.sums_[p].light[k];
      }
    });
  }

  // Mean colours; where points are few, nearer to white.
  Portrait portrait(const Watch& watch) const {
    Portrait made;
    const std::size_t pixels = sums_.size() - 1;
    std::vector<std::uint32_t> counts(pixels);
    for_parts(pixels, watch, [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p) {
        counts[p] = static_cast<std::uint32_t>(
            std::min<std::uint64_t>(sums_[p].count, std::numeric_limits<std::uint32_t>::max()));
        made.inside += static_cast<std::int64_t>(sums_[p].count);
        made.met += sums_[p].count > 0 ? 1 : 0;
      }
    });
    const Density density(counts);
    made.pixels.resize(pixels);
    for_parts(pixels, watch, [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p)
        if (counts[p] != 0) made.pixels[p] = {colour_of(light_of(sums_[p], density(counts[p]))), 255};
    });
    return made;
  }

 private:
  struct Sum {
    std::uint64_t count = 0;
    std::array<std::uint64_t, 3> light{};
  };
  static std::array<double, 3> light_of(const Sum& sum, double density) {
    constexpr double faintest = .6;
    const double solid = faintest + (1 - faintest) * density;
    std::array<double, 3> light{};
    for (std::size_t k = 0; k < 3; ++k)
      light[k] = 1 - solid * (1 - static_cast<double>(sum.light[k]) / static_cast<double>(sum.count) / full_light);
    return light;
  }
  struct Seen {
    std::size_t pixel;
    std::uint32_t number;
  };

  Grid grid_;
  const Colours* colours_;
  std::vector<Sum> sums_;  // one more for what lies outside
  Waiting<Seen> waiting_;
};

// The nearest point of each pixel: farness above its colour's number, so that the smallest is kept, whatever the order.
// In 32 bits, since the pixels of a picture should stay near: 22 of farness, 10 of the number.
class alignas(apart) Nearest {
 public:
  Nearest(const Window& window, const View& view, const Watch& watch)
      : grid_(window), view_(view), seen_(filled(static_cast<std::size_t>(window.pixels()) + 1, nothing, watch)) {}

  void see(std::uint32_t number, const std::array<double, 3>& x) {
    const View::Seen seen = view_(x[0], x[1], x[2]);
    if (!seen.visible) return;
    const std::int64_t pixel = grid_.pixel(seen.x, seen.y);
    inside_ += pixel < static_cast<std::int64_t>(seen_.size()) - 1 ? 1 : 0;
    const double farness = std::clamp(1 - seen.nearness, 0.0, 1.0) * farthest;
    const std::uint32_t key = static_cast<std::uint32_t>(static_cast<std::int32_t>(farness)) << number_bits | number;
    const auto place = static_cast<std::size_t>(pixel);
    if (waiting_.add(&seen_[place], {place, key})) settle();
  }

  void settle() {
    waiting_.take([&](const Seen& seen) { seen_[seen.pixel] = std::min(seen_[seen.pixel], seen.key); });
  }

  void add(const Nearest& other, const Watch& watch) {
    inside_ += other.inside_;
    for_parts(seen_.size(), watch, [&](std::size_t first, std::size_t end) {
      for (std::size_t p = first; p < end; ++p) seen_[p] = std::min(seen_[p], other.seen_[p]);
    });
  }

  Portrait portrait(const Colours& colours, const Look& look) const {
    Portrait made;
    made.inside = inside_;
    std::vector<float> nearness(seen_.size() - 1, 0);
    made.pixels.resize(nearness.size());
    for (std::size_t p = 0; p < nearness.size(); ++p) {
      if (seen_[p] == nothing) continue;
      ++made.met;
      nearness[p] = static_cast<float>(1 - static_cast<double>(seen_[p] >> number_bits) / farthest);
      const std::uint32_t number = seen_[p] % (1U << number_bits);
      made.pixels[p] = {look.colouring == Colouring::tone ? look.palette->at(1 - nearness[p]) : colours.colour(number),
                        255};
    }
    shade(made.pixels, nearness, grid_.width, grid_.height, look.colouring != Colouring::tone);
    return made;
  }

 private:
  struct Seen {
    std::size_t pixel;
    std::uint32_t key;
  };
  static constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();
  static constexpr int number_bits = 10;
  static_assert(Colours::shades <= 1 << number_bits && System::most_maps <= 1 << number_bits);
  static constexpr double farthest = 0x1p22 - 2;

  Grid grid_;
  View view_;
  std::int64_t inside_ = 0;
  std::vector<std::uint32_t> seen_;  // one more for what lies outside
  Waiting<Seen> waiting_;
};

void require_points(std::int64_t points) { in_range(points, 1, std::int64_t{1} << 50, "points"); }

}  // namespace

std::int64_t points_for(const System& system, const Window& window, std::uint64_t seed, std::int64_t a_pixel,
                        Watch& watch) {
  constexpr std::int64_t asked = 1 << 20, most_times = 64;
  Window whole = window;
  whole.width = whole.height = 1;
  Watch part = watch.part(0, 0);
  const std::int64_t inside = std::max<std::int64_t>(chaos_counts(system, whole, seed, asked, part).inside, 1);
  const std::int64_t all = window.pixels() * a_pixel;  // if all fell there; windows have 2^30 pixels at most
  return std::min(all * asked / inside, all * most_times);
}

Portrait plane_portrait(const System& system, const Window& window, const Look& look, std::uint64_t seed,
                        std::int64_t points, Watch& watch) {
  require_plane(system);
  require_window(window);
  if (look.colouring == Colouring::tone) {
    const Counts counts = chaos_counts(system, window, seed, points, watch);
    const auto met = std::count_if(counts.pixels.begin(), counts.pixels.end(), [](std::uint32_t c) { return c > 0; });
    return {density_picture(counts.pixels, *look.palette), counts.inside, met};
  }
  static_cast<void>(system.enclosure());  // refuses what has no attractor
  require_points(points);
  const Colours colours(system, look);
  const auto canvas = [&] { return LightSums(window, colours, watch); };
  return paint<2>(system, colours, canvas, seed, points, watch).portrait(watch);
}

Portrait space_portrait(const System& system, const View& view, const Window& window, const Look& look,
                        std::uint64_t seed, std::int64_t points, Watch& watch) {
  require_window(window);
  if (system.dimension() != 3)
    throw Error(Status::shape, "system", "The system lies in the plane, which has no points of view; draw it as one.")
        .with(system.dimension());
  static_cast<void>(system.enclosure());
  require_points(points);
  const Colours colours(system, look);
  const auto canvas = [&] { return Nearest(window, view, watch); };
  return paint<3>(system, colours, canvas, seed, points, watch).portrait(colours, look);
}

}  // namespace ifsm::core
