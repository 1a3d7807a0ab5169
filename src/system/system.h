// Iterated function systems (IFS): some affine maps of the plane or of space, and how often each is taken. The
// attractor is the one compact set A with A = ∪ w_i(A) over the active maps, those of a probability above 0; the
// measure μ on it is the one with μ = Σ p_i μ∘w_i^-1 (math.md section 1).
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "system/enclosure.h"

namespace ifsm::core {

class System {
 public:
  static constexpr int most_maps = 256;

  // Weights: one a map, not negative; divided by their sum they are the probabilities. None: |det M_i|, but at least a
  // 25th of the maps' mean |det|, so that flat maps are taken too (all flat: all alike). Maps of the plane have zeros
  // in their third rows and columns.
  System(int dimension, std::vector<Affine> maps, std::vector<double> weights = {});

  int dimension() const { return dimension_; }
  const std::vector<Affine>& maps() const { return maps_; }
  const std::vector<double>& probabilities() const { return probabilities_; }
  // As they were given; empty when they were not.
  const std::vector<double>& weights() const { return weights_; }

  // Numbers of the maps of a probability above 0.
  const std::vector<int>& active() const { return active_; }
  // These maps themselves.
  std::vector<Affine> active_maps() const;

  // A point of the attractor, if there is one: what the first active map leaves where it is.
  Vector3 point() const { return fixed_point(maps_[static_cast<std::size_t>(active_[0])]); }

  // `word` in numbers of all maps.
  const Contraction& contraction() const { return contraction_; }

  // Holds the attractor. Refuted contractivity is a range error with the word's radius, an undecided one numerical.
  const Ellipsoid& enclosure() const;

  friend bool operator==(const System& a, const System& b) {
    return a.dimension_ == b.dimension_ && a.maps_ == b.maps_ && a.weights_ == b.weights_;
  }

 private:
  int dimension_;
  std::vector<Affine> maps_;
  std::vector<double> weights_;
  std::vector<double> probabilities_;
  std::vector<int> active_;
  Contraction contraction_;
};

using SystemPtr = std::shared_ptr<const System>;

}  // namespace ifsm::core
