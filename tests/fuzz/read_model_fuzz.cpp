// Any bytes: read_model gives a model or throws an Error. A model that it gives is written, and read again as the same.
#include "io/model_reader.h"
#include "io/model_writer.h"
#include "require.h"

using namespace ifsm::core;

namespace {

constexpr Index most_doubles = 1 << 16;  // deeper trees are sound as well, and slow

void check_round_trip(const Model& model) {
  if (tree_doubles(model.shape(), model.dimension(), model.levels()) > most_doubles) return;
  const Bytes cbor = write_model(model, Format::cbor), json = write_model(model, Format::json);
  require(write_model(*read_model(json), Format::cbor) == cbor);
  require(write_model(*read_model(cbor), Format::json) == json);
  require(points(model, model.levels()).dimension() == model.dimension());  // synthesis stays inside its arrays
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  ModelPtr model;
  try {
    model = read_model({data, size});
  } catch (const Error& error) {
    require(error.status() != Status::internal && error.status() != Status::range);
    return 0;
  }
  check_round_trip(*model);
  return 0;
}
