// The chaos game beside libflam3's, which renders flames: the same file read by both, the same square of 1024 x 1024
// pixels, as many points, one thread each. libflam3 follows a colour as well and makes a picture of what it counted;
// what that costs at any number of points is left out, since times are differences of two numbers of points. The
// issue's bound: 30 times as many points a second.
extern "C" {  // its header does not say so
#include <flam3.h>
}

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>

#include "base/error.h"
#include "base/parallel.h"
#include "io/flame.h"
#include "raster/chaos.h"
#include "system/named.h"
#include "system/reach.h"

using namespace ifsm::core;

namespace {

constexpr int side = 1024, turns = 7;
constexpr int few = 8, many = 40;  // points a pixel

double median(std::vector<double> values) {
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
  return values[values.size() / 2];
}

// Of the process, all of its threads: flam3 starts one for each rendering.
template <class Call>
double seconds(const Call& call) {
  const std::clock_t start = std::clock();
  call();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

Window square_around(const System& system) {
  const Box box = bounding_box(system, 1e-6 * system.enclosure().axes.norm());
  const double half = .51 * (box.high - box.low).maxCoeff();
  const Vector3 middle = .5 * (box.low + box.high);
  return {middle(0) - half, middle(1) - half, middle(0) + half, middle(1) + half, side, side};
}

// The least that its picture can be made of: one pass, no oversampling, no density estimation, the narrowest filter.
std::string file_of(const System& system, const Window& window) {
  const auto text = [](double value) { return text_of(value); };
  std::string file = "<flame name=\"bench\" time=\"0\" size=\"1024 1024\" center=\"" +
                     text(.5 * (window.left + window.right)) + " " + text(.5 * (window.bottom + window.top)) +
                     "\" scale=\"" + text(side / (window.right - window.left)) +
                     "\" supersample=\"1\" filter=\"0.1\" quality=\"1\" passes=\"1\" temporal_samples=\"1\""
                     " estimator_radius=\"0\" brightness=\"4\" gamma=\"4\" background=\"0 0 0\">\n"
                     "<color index=\"0\" rgb=\"255 255 255\"/><color index=\"255\" rgb=\"255 255 255\"/>\n";
  for (std::size_t i = 0; i < system.maps().size(); ++i) {
    const Affine& m = system.maps()[i];
    file += "<xform weight=\"" + text(system.probabilities()[i]) + "\" color=\"0\" linear=\"1\" coefs=\"";
    for (const double c : {m.linear(0, 0), m.linear(1, 0), m.linear(0, 1), m.linear(1, 1), m.shift(0)})
      file += text(c) + " ";
    file += text(m.shift(1)) + "\"/>\n";
  }
  return file + "</flame>\n";
}

class Flam3 {
 public:
  Flam3(std::string file, int bits) : picture_(std::size_t{side} * side * channels) {
    int count = 0;
    static char name[] = "bench";
    genomes_ = flam3_parse_xml2(file.data(), name, flam3_defaults_on, &count);
    if (genomes_ == nullptr || count != 1) std::exit((std::fputs("flam3 does not read the file\n", stderr), 1));
    frame_.genomes = genomes_;
    frame_.ngenomes = 1;
    frame_.pixel_aspect_ratio = 1;
    frame_.bits = bits;
    frame_.bytes_per_channel = 1;
    frame_.nthreads = 1;
    frame_.sub_batch_size = 10000;  // its program's
    flam3_init_frame(&frame_);
  }

  double render(int points_per_pixel) {
    genomes_->sample_density = points_per_pixel;
    return seconds([&] {
      stat_struct stats;
      if (flam3_render(&frame_, picture_.data(), flam3_field_both, channels, 1, &stats) != 0) std::exit(1);
    });
  }

  // Row by row from below: flam3 draws y downwards.
  bool lit(std::int64_t pixel) const {
    const unsigned char* colours = picture_.data() + channels * pixel;
    return colours[0] > 0 || colours[3] > 0;
  }

 private:
  static constexpr int channels = 4;
  flam3_frame frame_{};
  flam3_genome* genomes_ = nullptr;
  std::vector<unsigned char> picture_;
};

// Of the pixels that either met, the share that both did: that they play the same game.
double agreement(const Flam3& flam3, const Counts& counts) {
  std::int64_t both = 0, either = 0;
  for (std::int64_t row = 0; row < side; ++row)
    for (std::int64_t column = 0; column < side; ++column) {
      const bool ours = counts.pixels[static_cast<std::size_t>(row * side + column)] > 0;
      const bool theirs = flam3.lit((side - 1 - row) * side + column);
      both += ours && theirs ? 1 : 0;
      either += ours || theirs ? 1 : 0;
    }
  return static_cast<double>(both) / static_cast<double>(either);
}

// bits: how flam3 counts. 33: floats, as its program does unless told otherwise. 64: doubles, larger and faster.
void compare(const char* name, int bits) {
  const Window window = square_around(*named_system(name));
  const std::string file = file_of(*named_system(name), window);
  const SystemPtr system = read_flame(file)[0].system;
  Flam3 flam3(file, bits);
  Counts counts;
  const Threads one(1);
  const auto ours = [&](int points_per_pixel) {
    Watch watch;
    return seconds([&] { counts = chaos_counts(*system, window, 1, points_per_pixel * window.pixels(), watch); });
  };
  std::vector<double> peer, mine, ratio, fixed, whole;
  for (int turn = 0; turn < turns; ++turn) {
    const double peer_few = flam3.render(few), mine_few = ours(few);
    const double peer_many = flam3.render(many), mine_many = ours(many);
    peer.push_back(peer_many - peer_few);
    mine.push_back(mine_many - mine_few);
    fixed.push_back(peer_few - few * peer.back() / (many - few));
    ratio.push_back(peer.back() / mine.back());
    whole.push_back(peer_many / mine_many);
  }
  const auto rate = [&](const std::vector<double>& times) {
    return 1e-6 * (many - few) * static_cast<double>(window.pixels()) / median(times);
  };
  std::printf(
      "%-8s flam3 with %d bits %5.1f million/s and %3.0f ms a picture   ours %4.0f million/s   ratio %4.1f   "
      "with all costs, %d points a pixel %4.1f   pixels alike %.4f\n",
      name, bits, rate(peer), 1e3 * median(fixed), rate(mine), median(ratio), many, median(whole),
      agreement(flam3, counts));
}

}  // namespace

int main() {
  for (const char* name : {"fern", "gasket"})
    for (const int bits : {33, 64}) compare(name, bits);
}
