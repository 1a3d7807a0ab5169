#include "raster/orbits.h"

#include <algorithm>

#include "base/random.h"

namespace ifsm::core {

RandomWords::RandomWords(std::uint64_t seed, std::uint64_t chunk) {
  const auto low = [](std::uint64_t word) { return static_cast<std::uint32_t>(word); };
  for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) {
    const auto words =
        philox({low(chunk), low(chunk >> 32), static_cast<std::uint32_t>(orbit), 0}, {low(seed), low(seed >> 32)});
    a[orbit] = words[0], b[orbit] = words[1], c[orbit] = words[2];
    counter[orbit] = 1;
  }
}

template <class Real>
Coefficients<Real>::Coefficients(const System& system) : choice(system.probabilities()) {
  const std::size_t size = std::max(choice.slots(), system.maps().size());
  for (std::vector<Real>* each : {&a, &b, &c, &d, &e, &f}) each->resize(size);
  for (std::size_t i = 0; i < system.maps().size(); ++i) {
    const Affine& map = system.maps()[i];
    a[i] = static_cast<Real>(map.linear(0, 0)), b[i] = static_cast<Real>(map.linear(0, 1));
    c[i] = static_cast<Real>(map.linear(1, 0)), d[i] = static_cast<Real>(map.linear(1, 1));
    e[i] = static_cast<Real>(map.shift(0)), f[i] = static_cast<Real>(map.shift(1));
  }
}
template struct Coefficients<float>;
template struct Coefficients<double>;

Start::Start(const System& system) : letter(system.active()[0]), point(system.point()), steps(0) {
  const Choice choice(system.probabilities());
  constexpr int rounds = 4;
  constexpr double forgotten = 0x1p-32;
  for (int round = 0; round < rounds; ++round) {
    RandomWords random(0, static_cast<std::uint64_t>(round));
    for (std::size_t orbit = 0; orbit < orbit_count; ++orbit) {
      Matrix3 product = Affine::identity(system.dimension()).linear;
      std::int64_t taken = 0;
      for (; taken < most_steps && product.norm() > forgotten; ++taken)
        product = product * system.maps()[static_cast<std::size_t>(choice(random.next(orbit)))].linear;
      steps = std::max(steps, taken);
    }
  }
}

}  // namespace ifsm::core
