// Any bytes: read_flame gives systems of the plane or throws an Error with a line. What it gives is written as a
// Fractint file, and read again as the same.
#include "io/flame.h"
#include "io/fractint.h"
#include "require.h"

using namespace ifsm::core;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<FlameSystem> all;
  try {
    all = read_flame({reinterpret_cast<const char*>(data), size});
  } catch (const Error& error) {
    require_line(error);
    return 0;
  }
  for (const FlameSystem& each : all) {
    require((each.system == nullptr) == each.refused.has_value());
    if (each.refused) {
      require_line(*each.refused);
      continue;
    }
    require(each.system->dimension() == 2);
    const auto again = read_fractint(write_fractint(each.name, *each.system));
    require(again.size() == 1 && *again[0].system == *each.system);
  }
  return 0;
}
