// Any bytes: read_fractint gives systems or throws an Error with a line. What it gives is written, and read again as
// the same.
#include "io/fractint.h"
#include "require.h"

using namespace ifsm::core;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::vector<FractintSystem> all;
  try {
    all = read_fractint({reinterpret_cast<const char*>(data), size});
  } catch (const Error& error) {
    require_line(error);
    return 0;
  }
  for (const FractintSystem& each : all) {
    const auto again = read_fractint(write_fractint(each.name, *each.system));
    require(again.size() == 1 && *again[0].system == *each.system);
  }
  return 0;
}
