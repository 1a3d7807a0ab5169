// Any bytes: read_system gives a system or throws an Error. One that it gives is written, and read again as the same.
#include "io/system_file.h"
#include "require.h"

using namespace ifsm::core;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  SystemPtr system;
  try {
    system = read_system({data, size});
  } catch (const Error& error) {
    require(error.status() != Status::internal && error.status() != Status::range);
    return 0;
  }
  const Bytes cbor = write_system(*system, Format::cbor), json = write_system(*system, Format::json);
  require(write_system(*read_system(json), Format::cbor) == cbor);
  require(write_system(*read_system(cbor), Format::json) == json);
  return 0;
}
