// Any bytes: read_flame gives systems of the plane or throws an Error with a line. What it gives is written as a
// Fractint file, and read again as the same.
#include <cstdlib>

#include "base/error.h"
#include "io/flame.h"
#include "io/fractint.h"

using namespace ifsm::core;

namespace {

void require(bool holds) {
  if (!holds) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<FlameSystem> all;
  try {
    all = read_flame({reinterpret_cast<const char*>(data), size});
  } catch (const Error& error) {
    require(error.status() != Status::internal && error.index() >= 1);
    return 0;
  }
  for (const FlameSystem& each : all) {
    require((each.system == nullptr) == each.refused.has_value());
    if (each.refused) {
      require(each.refused->status() != Status::internal && each.refused->index() >= 1);
      continue;
    }
    require(each.system->dimension() == 2);
    const auto again = read_fractint(write_fractint(each.name, *each.system));
    require(again.size() == 1 && *again[0].system == *each.system);
  }
  return 0;
}
