#include "chaos_textbook.h"

#include <bit>

namespace {

// xoroshiro128+ of Blackman and Vigna, 2018: about the cheapest that is good enough.
struct Generator {
  std::uint64_t s[2] = {0x9E3779B97F4A7C15, 0xBF58476D1CE4E5B9};

  double next() {
    const std::uint64_t a = s[0], b = s[1] ^ s[0], word = s[0] + s[1];
    s[0] = std::rotl(a, 24) ^ b ^ (b << 16);
    s[1] = std::rotl(b, 37);
    return static_cast<double>(word >> 11) * 0x1p-53;
  }
};

}  // namespace

void textbook_chaos(const std::vector<TextbookMap>& maps, const TextbookWindow& w, std::int64_t points,
                    std::uint32_t* counts) {
  Generator random;
  double x = 0, y = 0;
  constexpr int forgotten = 100;
  for (std::int64_t k = -forgotten; k < points; ++k) {
    const double u = random.next();
    const TextbookMap* m = maps.data();
    while (u >= m->until) ++m;
    const double next = m->a * x + m->b * y + m->e;
    y = m->c * x + m->d * y + m->f;
    x = next;
    const double column = (x - w.left) * w.columns_per_unit, row = (w.top - y) * w.rows_per_unit;
    if (k >= 0 && column >= 0 && column < static_cast<double>(w.width) && row >= 0 &&
        row < static_cast<double>(w.height))
      ++counts[static_cast<std::int64_t>(row) * w.width + static_cast<std::int64_t>(column)];
  }
}
