#include "linalg/contractivity.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "linalg/spectrum.h"

namespace ifsm::core {
namespace {

struct Product {
  std::vector<int> word;
  Eigen::MatrixXd matrix;
  double size;
};

std::vector<Product> longer(const std::vector<Product>& words, const std::vector<Eigen::MatrixXd>& maps) {
  std::vector<Product> all;
  for (const Product& prefix : words)
    for (std::size_t i = 0; i < maps.size(); ++i) {
      Product& next = all.emplace_back(prefix);
      next.word.push_back(static_cast<int>(i));
      next.matrix = prefix.matrix.lazyProduct(maps[i]);
      next.size = next.matrix.norm();
    }
  return all;
}

}  // namespace

Eigen::MatrixXd balancing(const std::vector<Eigen::MatrixXd>& maps) {
  const Eigen::Index size = maps[0].rows();
  Eigen::MatrixXd h = Eigen::MatrixXd::Identity(size, size);
  for (int step = 0; step < 60; ++step) {
    Eigen::MatrixXd next = Eigen::MatrixXd::Identity(size, size);
    for (const auto& a : maps) next += a.transpose() * h * a;
    h = next / next.norm();
    h += 1e-9 * Eigen::MatrixXd::Identity(size, size);
  }
  Eigen::MatrixXd upper = h.allFinite() ? cholesky(h) : Eigen::MatrixXd();
  return upper.size() != 0 ? upper : Eigen::MatrixXd(Eigen::MatrixXd::Identity(size, size));
}

std::optional<Growth> growing_word(const std::vector<Eigen::MatrixXd>& maps, int longest) {
  constexpr std::size_t most = 256;
  const Eigen::Index size = maps[0].rows();
  std::vector<Product> words{{{}, Eigen::MatrixXd::Identity(size, size), 1}};
  for (int length = 1; length <= longest; ++length) {
    words = longer(words, maps);
    if (words.size() > most) {
      std::partial_sort(words.begin(), words.begin() + most, words.end(),
                        [](const Product& a, const Product& b) { return a.size > b.size; });
      words.resize(most);
    }
    for (Product& each : words) {
      const double radius =
          each.matrix.allFinite() ? spectral_radius(each.matrix) : std::numeric_limits<double>::infinity();
      if (!(radius < 1)) return Growth{std::move(each.word), radius};
    }
  }
  return std::nullopt;
}

}  // namespace ifsm::core
