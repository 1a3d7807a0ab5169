#include <algorithm>

#include "curve/evaluate.h"
#include "support.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

using Word = std::vector<std::int32_t>;

ModelPtr model_of(int maps, int levels, bool closed = false) {
  const Shape shape(Topology::joined, 3, maps);
  return from_polygon(casteljau(shape), Points(2, 3), closed, levels);
}

Word word_of(Index node, int maps, int length) {
  Word word(static_cast<std::size_t>(length));
  for (auto symbol = word.rbegin(); symbol != word.rend(); ++symbol, node /= maps)
    *symbol = static_cast<std::int32_t>(node % maps);
  return word;
}

TEST(Address, OfEveryIntervalsStartIsItsWord) {
  for (int maps = 2; maps <= 8; ++maps)
    for (int levels = 0; levels <= 3; ++levels)
      for (int length = 1; length <= 5; ++length) {
        const ModelPtr model = model_of(maps, levels);
        const Index nodes = model->shape().nodes(length);
        for (Index node = 0; node < nodes; node += 1 + nodes / 500) {
          const Word word = word_of(node, maps, length);
          ASSERT_EQ(address(*model, interval(*model, word).first, length), word)
              << maps << " maps, levels " << levels << ", node " << node << " of " << nodes;
        }
      }
}

TEST(Address, OfAJointIsTheOneThatStartsThereHoweverTheParameterWasMade) {
  for (int maps = 2; maps <= 8; ++maps)
    for (int levels = 0; levels <= 4; ++levels)
      for (int depth = 1; depth <= 6; ++depth) {
        const ModelPtr model = model_of(maps, levels);
        const auto nodes = static_cast<double>(model->shape().nodes(depth));
        for (Index k = 0; k < model->shape().nodes(depth); k += 1 + model->shape().nodes(depth) / 300) {
          const double quotient = static_cast<double>(k) / nodes, product = static_cast<double>(k) * (1 / nodes);
          ASSERT_EQ(address(*model, quotient, depth), word_of(k, maps, depth)) << maps << " " << levels << " " << depth;
          ASSERT_EQ(address(*model, product, depth), word_of(k, maps, depth)) << maps << " " << levels << " " << depth;
        }
      }
}

TEST(Address, OfAThirdWithThreeMapsStartsWithOne) {
  for (int levels = 0; levels <= 8; ++levels)
    EXPECT_EQ(address(*model_of(3, levels), 1.0 / 3, 10), (Word{1, 0, 0, 0, 0, 0, 0, 0, 0, 0})) << levels;
}

TEST(Address, OfAThirdWithTwoMapsAlternates) {
  for (int levels = 0; levels <= 8; ++levels)
    EXPECT_EQ(address(*model_of(2, levels), 1.0 / 3, 8), (Word{0, 1, 0, 1, 0, 1, 0, 1})) << levels;
}

TEST(Address, OfTheEndIsTheLastSymbolForEver) {
  for (int maps = 2; maps <= 8; ++maps)
    for (int levels = 0; levels <= 3; ++levels) {
      EXPECT_EQ(address(*model_of(maps, levels), 1.0, 1024), Word(1024, maps - 1));
      EXPECT_EQ(address(*model_of(maps, levels), 0.0, 1024), Word(1024, 0));
      EXPECT_EQ(address(*model_of(maps, levels, true), 1.0, 20), Word(20, 0));  // a ring begins where it ends
      EXPECT_EQ(address(*model_of(maps, levels, true), -1.0, 20), Word(20, 0));
    }
}

TEST(Address, LiesInItsOwnInterval) {
  Random random(1);
  for (int maps = 2; maps <= 8; ++maps)
    for (int trial = 0; trial < 300; ++trial) {
      const ModelPtr model = model_of(maps, trial % 6);
      const double t = std::uniform_real_distribution<double>(0, 1)(random);
      const int length = 1 + trial % 12;
      const Interval covered = interval(*model, address(*model, t, length));
      EXPECT_LE(covered.first, t + 4 * epsilon);
      EXPECT_GE(covered.last, t - 4 * epsilon);
      EXPECT_NEAR(covered.last - covered.first, std::pow(maps, -length), 4 * epsilon);
    }
}

TEST(Address, OfALongLengthContinuesTheShortOne) {
  Random random(2);
  for (int trial = 0; trial < 100; ++trial) {
    const ModelPtr model = model_of(2 + trial % 7, trial % 5);
    const double t = std::uniform_real_distribution<double>(0, 1)(random);
    const Word far = address(*model, t, 1024);
    for (const int length : {1, 2, 5, 40})
      EXPECT_EQ(address(*model, t, length), Word(far.begin(), far.begin() + length));
    for (const auto symbol : far) EXPECT_TRUE(symbol >= 0 && symbol < model->shape().maps());
  }
}

TEST(Address, WithTwoMapsIsTheBinaryExpansionToTheLastBit) {
  const ModelPtr model = model_of(2, 3);
  const double t = 0x1.23456789abcdep-1;
  const Word word = address(*model, t, 60);
  double sum = 0;
  for (std::size_t i = 0; i < word.size(); ++i) sum += std::ldexp(word[i], -1 - static_cast<int>(i));
  EXPECT_EQ(sum, t);
}

TEST(Address, IsRefusedForWhatIsNoParameterOrLength) {
  const ModelPtr model = model_of(2, 2);
  EXPECT_EQ(refusal([&] { address(*model, 1.5, 3); }).status(), Status::range);
  EXPECT_EQ(refusal([&] { address(*model, std::nan(""), 3); }).status(), Status::not_finite);
  EXPECT_EQ(refusal([&] { address(*model, 0.5, 0); }).argument(), "length");
  EXPECT_EQ(refusal([&] { address(*model, 0.5, 1025); }).argument(), "length");
}

TEST(Interval, OfNothingIsTheWholeCurve) {
  const Interval all = interval(*model_of(3, 2), {});
  EXPECT_EQ(all.first, 0.0);
  EXPECT_EQ(all.last, 1.0);
}

TEST(Interval, EndsWhereTheNextBeginsBitForBit) {
  for (int maps = 2; maps <= 8; ++maps)
    for (int length = 1; length <= 7; ++length) {
      const ModelPtr model = model_of(maps, 1);
      const Index nodes = model->shape().nodes(length);
      for (Index node = 0; node + 1 < nodes; node += 1 + nodes / 400)
        ASSERT_EQ(interval(*model, word_of(node, maps, length)).last,
                  interval(*model, word_of(node + 1, maps, length)).first)
            << maps << " " << length << " " << node;
      EXPECT_EQ(interval(*model, word_of(nodes - 1, maps, length)).last, 1.0);
    }
}

TEST(Interval, IsTheNearestDoubleToItsFraction) {
  for (int maps = 2; maps <= 8; ++maps)
    for (int length = 1; length <= 7; ++length) {
      const ModelPtr model = model_of(maps, 1);
      const Index nodes = model->shape().nodes(length);
      for (Index node = 0; node < nodes; node += 1 + nodes / 400)
        ASSERT_NEAR(interval(*model, word_of(node, maps, length)).first,
                    static_cast<double>(node) / static_cast<double>(nodes), 2 * epsilon);
    }
}

TEST(Interval, RefusesSymbolsThatAreNoMaps) {
  for (const std::int32_t bad : {-1, 3}) {
    const Word word = {0, 2, bad};
    const Error error = refusal([&] { interval(*model_of(3, 1), word); });
    EXPECT_EQ(error.status(), Status::range);
    EXPECT_EQ(error.argument(), "symbols");
    EXPECT_EQ(error.index(), 2);
    EXPECT_EQ(error.value(), bad);
  }
}

}  // namespace
