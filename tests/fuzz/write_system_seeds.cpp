// Writes the seeds of read_system_fuzz and of read_fractint_fuzz:  write_system_seeds tests/fuzz/seeds
// Those of read_flame_fuzz are written by hand.
#include <cstdio>
#include <fstream>
#include <string>

#include "io/fractint.h"
#include "io/system_file.h"
#include "system/named.h"

using namespace ifsm::core;

namespace {

template <class Text>
void save(const std::string& path, const Text& text) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(text.data()), static_cast<std::streamsize>(text.size()));
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return std::fprintf(stderr, "usage: write_system_seeds <folder>\n"), 2;
  const std::string folder = argv[1];
  std::string fractint = "comment { of the plane and of space }\n";
  for (const char* name : {"fern", "gasket", "fern_3d"}) {
    const SystemPtr system = named_system(name);
    save(folder + "/read_system/" + name + ".json", write_system(*system, Format::json));
    save(folder + "/read_system/" + name + ".cbor", write_system(*system, Format::cbor));
    fractint += write_fractint(name, *system) + "; and\n";
  }
  save(folder + "/read_fractint/three.ifs", fractint);
}
