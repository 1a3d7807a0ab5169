#include "io/fingerprint.h"

#include <bit>
#include <cstdint>
#include <span>

namespace ifsm::core {
namespace {

class Hash {
 public:
  // Byte by byte from the lowest, on every machine.
  void add(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) hash_ = (hash_ ^ (value >> shift & 0xff)) * 0x100000001b3;
  }
  void add(std::span<const double> values) {
    for (const double value : values) add(std::bit_cast<std::uint64_t>(value));
  }
  void add(const Points& points) {
    for (Index axis = 0; axis < points.dimension(); ++axis) add(points.plane(axis));
  }

  std::string digits() const {
    std::string text;
    for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[hash_ >> shift & 0xf];
    return text;
  }

 private:
  std::uint64_t hash_ = 0xcbf29ce484222325;
};

}  // namespace

std::string fingerprint(const Model& model) {
  const Shape& shape = model.shape();
  const RowMatrix& matrix = model.filter().matrix();
  Hash hash;
  for (const Index number :
       {Index{shape.joined()}, Index{shape.control_points()}, Index{shape.maps()}, Index{shape.stride()},
        model.dimension(), Index{model.closed()}, model.parts().samples, Index{model.levels()}})
    hash.add(static_cast<std::uint64_t>(number));
  hash.add({matrix.data(), static_cast<std::size_t>(matrix.size())});
  hash.add(model.parts().center);
  hash.add(model.parts().polygon);
  for (int level = 0; level < model.levels(); ++level) hash.add(model.details(level));
  return hash.digits();
}

}  // namespace ifsm::core
