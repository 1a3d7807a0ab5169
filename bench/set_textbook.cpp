#include "set_textbook.h"

#include <algorithm>
#include <cmath>

namespace {

struct Recursion {
  const std::vector<PixelMap>& maps;
  double radius;
  std::int64_t width, height;
  std::uint8_t* marks;
  std::int64_t words = 0;

  static double stretch(const PixelMap& p) {
    const double squares = p.a * p.a + p.b * p.b + p.c * p.c + p.d * p.d, area = p.a * p.d - p.b * p.c;
    return std::sqrt((squares + std::sqrt(std::max(0.0, squares * squares - 4 * area * area))) / 2);
  }

  void follow(const PixelMap& p) {
    ++words;
    const double around = radius * stretch(p);
    if (p.e + around < 0 || p.e - around >= static_cast<double>(width) || p.f + around < 0 ||
        p.f - around >= static_cast<double>(height))
      return;
    constexpr double half_a_pixel = .5;
    if (around > half_a_pixel) {
      for (const PixelMap& q : maps)
        follow({p.a * q.a + p.b * q.c, p.a * q.b + p.b * q.d, p.c * q.a + p.d * q.c, p.c * q.b + p.d * q.d,
                p.a * q.e + p.b * q.f + p.e, p.c * q.e + p.d * q.f + p.f});
      return;
    }
    const auto column = static_cast<std::int64_t>(std::floor(p.e)), row = static_cast<std::int64_t>(std::floor(p.f));
    if (column >= 0 && column < width && row >= 0 && row < height) marks[row * width + column] = 1;
  }
};

}  // namespace

std::int64_t textbook_set(const std::vector<PixelMap>& maps, const PixelMap& whole, double radius, std::int64_t width,
                          std::int64_t height, std::uint8_t* marks) {
  Recursion recursion{maps, radius, width, height, marks};
  recursion.follow(whole);
  return recursion.words;
}
