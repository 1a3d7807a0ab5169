#include "base/random.h"

#include <algorithm>
#include <bit>
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

// The natural logarithm of a normal number that is positive, to a few roundings: libraries differ in the last bit of
// theirs.
double logarithm(double value) {
  // value = mantissa 2^exponent, mantissa in 0.7 … 1.4. The constant is sqrt(1/2) as bits.
  constexpr std::uint64_t root = 0x3FE6A09E667F3BCD, exponents = 0xFFF0000000000000;
  const std::uint64_t bits = std::bit_cast<std::uint64_t>(value), scale = (bits - root) & exponents;
  const auto exponent = static_cast<double>(static_cast<std::int64_t>(scale) >> 52);
  const double mantissa = std::bit_cast<double>(bits - scale);
  // log m = 2 artanh s = 2 (s + s³/3 + s⁵/5 …); s² < 0.03, so what follows s^23 / 23 is below 2^-57. Every other term,
  // then the others: neither chain waits for the other.
  const double s = (mantissa - 1) / (mantissa + 1), square = s * s, fourth = square * square;
  double even = 1. / 21, odd = 1. / 23;
  for (const double term : {1. / 17, 1. / 13, 1. / 9, 1. / 5, 1.}) even = even * fourth + term;
  for (const double term : {1. / 19, 1. / 15, 1. / 11, 1. / 7, 1. / 3}) odd = odd * fourth + term;
  return exponent * 0.69314718055994531 + 2 * s * (even + square * odd);
}

// A point of the unit disc, all alike likely, and the square of its distance to the centre, which is not 0.
struct InDisc {
  double x, y, square;
};

InDisc drawn_in_disc(std::uint64_t seed, std::uint32_t stream, std::uint64_t index) {
  const std::array<Word, 2> key{static_cast<Word>(seed), static_cast<Word>(seed >> 32)};
  // Three tries in four fall into the disc; 2^8 of them never fail all.
  for (Word attempt = 0;; ++attempt) {
    const auto words = philox({static_cast<Word>(index), static_cast<Word>(index >> 32), stream, attempt}, key);
    const double x = symmetric(words[0], words[1]), y = symmetric(words[2], words[3]);
    const double square = x * x + y * y;
    if (square < 1 && square > 0) return {x, y, square};
  }
}

std::array<double, 2> normal(const InDisc& point) {
  const double radius = std::sqrt(-2 * logarithm(point.square) / point.square);
  return {point.x * radius, point.y * radius};
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
  return normal(drawn_in_disc(seed, stream, index));
}

void normal_numbers(std::uint64_t seed, std::uint32_t stream, std::span<double> numbers) {
  // Points of a block first, which branch, then their numbers, which do not: a processor works on several at once.
  constexpr std::size_t block = 32;
  std::array<InDisc, block> points;
  for (std::size_t from = 0; from < numbers.size(); from += 2 * block) {
    const std::span<double> these = numbers.subspan(from, std::min(2 * block, numbers.size() - from));
    const std::size_t pairs = (these.size() + 1) / 2;
    for (std::size_t k = 0; k < pairs; ++k) points[k] = drawn_in_disc(seed, stream, from / 2 + k);
    for (std::size_t k = 0; k < pairs; ++k) {
      const auto [first, second] = normal(points[k]);
      these[2 * k] = first;
      if (2 * k + 1 < these.size()) these[2 * k + 1] = second;
    }
  }
}

}  // namespace ifsm::core
