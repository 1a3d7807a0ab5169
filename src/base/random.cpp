#include "base/random.h"

#include <cmath>

namespace ifsm::core {
namespace {

using Word = std::uint32_t;

// Upper and lower half of a product.
std::array<Word, 2> multiply(Word a, Word b) {
  const std::uint64_t product = std::uint64_t{a} * b;
  return {static_cast<Word>(product >> 32), static_cast<Word>(product)};
}

// -1 … 1, 53 bits.
double symmetric(Word high, Word low) {
  const std::uint64_t bits = (std::uint64_t{high} << 32 | low) >> 11;
  return static_cast<double>(bits) * 0x1p-52 - 1;
}

// The natural logarithm, to a few roundings: libraries differ in the last bit of theirs.
double logarithm(double value) {
  int exponent = 0;
  double mantissa = std::frexp(value, &exponent);  // 0.5 … 1
  if (mantissa < 0.70710678118654752) mantissa *= 2, --exponent;
  // log m = 2 artanh s; s² < 0.03, so what follows the term s^23 / 23 is below 2^-57.
  const double s = (mantissa - 1) / (mantissa + 1), square = s * s;
  constexpr double terms[] = {1. / 23, 1. / 21, 1. / 19, 1. / 17, 1. / 15, 1. / 13,
                              1. / 11, 1. / 9,  1. / 7,  1. / 5,  1. / 3,  1};
  double sum = 0;
  for (const double term : terms) sum = sum * square + term;
  return exponent * 0.69314718055994531 + 2 * s * sum;
}

}  // namespace

std::array<Word, 4> philox(std::array<Word, 4> counter, std::array<Word, 2> key) {
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    const auto first = multiply(0xD2511F53, counter[0]), second = multiply(0xCD9E8D57, counter[2]);
    counter = {second[0] ^ counter[1] ^ key[0], second[1], first[0] ^ counter[3] ^ key[1], first[1]};
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
  return counter;
}

std::array<double, 2> normal_pair(std::uint64_t seed, std::uint32_t stream, std::uint64_t index) {
  const std::array<Word, 2> key{static_cast<Word>(seed), static_cast<Word>(seed >> 32)};
  // Three tries in four fall into the circle; 2^8 of them never fail all.
  for (Word attempt = 0;; ++attempt) {
    const auto words = philox({static_cast<Word>(index), static_cast<Word>(index >> 32), stream, attempt}, key);
    const double x = symmetric(words[0], words[1]), y = symmetric(words[2], words[3]);
    const double square = x * x + y * y;
    if (square >= 1 || square == 0) continue;
    const double radius = std::sqrt(-2 * logarithm(square) / square);
    return {x * radius, y * radius};
  }
}

}  // namespace ifsm::core
