// Writes the seeds of read_model_fuzz:  write_model_seeds tests/fuzz/seeds/read_model
#include <cmath>
#include <cstdio>
#include <fstream>
#include <string>

#include "curve/keep.h"
#include "curve/named.h"
#include "io/model_writer.h"

using namespace ifsm::core;

namespace {

Points spiral(Index dimension, Index count) {
  Points points(dimension, count);
  for (Index axis = 0; axis < dimension; ++axis)
    for (Index k = 0; k < count; ++k) {
      const auto t = static_cast<double>(k);
      points.plane(axis)[static_cast<std::size_t>(k)] = t * std::cos(t + 1.5 * static_cast<double>(axis));
    }
  return points;
}

void save(const std::string& path, const Model& model) {
  for (const Format format : {Format::json, Format::cbor}) {
    const Bytes bytes = write_model(model, format);
    std::ofstream file(path + (format == Format::json ? ".json" : ".cbor"), std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: write_model_seeds <folder>\n"), 2;
  const std::string folder = std::string(argv[1]) + "/";
  const FilterPtr joined = named_filter("casteljau", Topology::joined, 2, 2);
  const FilterPtr cubic = named_filter("casteljau", Topology::joined, 4, 3);
  const FilterPtr square = named_filter("haar", Topology::square, 0, 0);
  const FilterPtr koch = named_filter("koch", Topology::square, 0, 0);
  save(folder + "dense", *analyze(joined, spiral(2, 9), false));
  save(folder + "closed", *analyze(joined, spiral(3, 8), true));
  const ModelPtr model = analyze(joined, spiral(2, 65), false);
  save(folder + "sparse", *keep(*model, most_significant(*model, 4)));
  save(folder + "cubic", *from_polygon(cubic, spiral(1, 4), false, 3));
  save(folder + "haar", *analyze(square, spiral(1, 8), true));
  save(folder + "koch", *analyze(koch, spiral(2, 12), false));
}
