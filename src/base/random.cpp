#include "base/random.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace ifsm::core {
namespace {

using Word = std::uint32_t;

// Counters side by side: what a round does to one does not wait for the others.
template <std::size_t lanes>
using Counters = std::array<std::array<Word, lanes>, 4>;

template <std::size_t lanes>
void encipher(Counters<lanes>& c, std::array<Word, 2> key) {
  constexpr int rounds = 10;
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < lanes; ++i) {
      const std::uint64_t first = std::uint64_t{0xD2511F53} * c[0][i], second = std::uint64_t{0xCD9E8D57} * c[2][i];
      c[0][i] = static_cast<Word>(second >> 32) ^ c[1][i] ^ key[0];
      c[1][i] = static_cast<Word>(second);
      c[2][i] = static_cast<Word>(first >> 32) ^ c[3][i] ^ key[1];
      c[3][i] = static_cast<Word>(first);
    }
    key[0] += 0x9E3779B9;
    key[1] += 0xBB67AE85;
  }
}

std::array<Word, 2> key_of(std::uint64_t seed) { return {static_cast<Word>(seed), static_cast<Word>(seed >> 32)}; }

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

// A point of the square -1 … 1, all alike likely; taken when it lies in the unit disc and is not its centre.
struct Drawn {
  double x, y;

  double square() const { return x * x + y * y; }
  bool is_taken() const { return square() < 1 && square() > 0; }
};

template <std::size_t lanes>
Drawn drawn(const Counters<lanes>& words, std::size_t lane) {
  return {symmetric(words[0][lane], words[1][lane]), symmetric(words[2][lane], words[3][lane])};
}

Drawn drawn(std::uint64_t seed, std::uint32_t stream, std::uint64_t index, Word attempt) {
  // Three tries in four are taken; 2^8 of them never fail all.
  for (;; ++attempt) {
    Counters<1> words{{{static_cast<Word>(index)}, {static_cast<Word>(index >> 32)}, {stream}, {attempt}}};
    encipher(words, key_of(seed));
    if (const Drawn point = drawn(words, 0); point.is_taken()) return point;
  }
}

std::array<double, 2> normal(const Drawn& point) {
  const double square = point.square(), radius = std::sqrt(-2 * logarithm(square) / square);
  return {point.x * radius, point.y * radius};
}

}  // namespace

std::array<Word, 4> philox(std::array<Word, 4> counter, std::array<Word, 2> key) {
  Counters<1> words{{{counter[0]}, {counter[1]}, {counter[2]}, {counter[3]}}};
  encipher(words, key);
  return {words[0][0], words[1][0], words[2][0], words[3][0]};
}

std::array<double, 2> normal_pair(std::uint64_t seed, std::uint32_t stream, std::uint64_t index) {
  return normal(drawn(seed, stream, index, 0));
}

void normal_numbers(std::uint64_t seed, std::uint32_t stream, std::span<double> numbers) {
  constexpr std::size_t block = 32;  // pairs
  for (std::size_t from = 0; from < numbers.size(); from += 2 * block) {
    Counters<block> words;
    for (std::size_t k = 0; k < block; ++k) {
      const std::uint64_t index = from / 2 + k;
      words[0][k] = static_cast<Word>(index), words[1][k] = static_cast<Word>(index >> 32);
      words[2][k] = stream, words[3][k] = 0;
    }
    encipher(words, key_of(seed));
    // The points first, which branch, then their numbers, which do not.
    std::array<Drawn, block> points;
    for (std::size_t k = 0; k < block; ++k) {
      points[k] = drawn(words, k);
      if (!points[k].is_taken()) points[k] = drawn(seed, stream, from / 2 + k, 1);
    }
    const std::span<double> these = numbers.subspan(from, std::min(2 * block, numbers.size() - from));
    for (std::size_t k = 0; k < these.size(); k += 2) {
      const auto [first, second] = normal(points[k / 2]);
      these[k] = first;
      if (k + 1 < these.size()) these[k + 1] = second;
    }
  }
}

}  // namespace ifsm::core
