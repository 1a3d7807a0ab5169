// Systems in Fractint's text files, `.ifs`: any number of a file, of the plane (rows a b c d e f p) or of space (three
// rows of M, then t, then p). Of Fractint 20.4's documentation.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "system/system.h"

namespace ifsm::core {

struct FractintSystem {
  std::string name;
  SystemPtr system;
};

// All systems of a file, in its order; comments, and blocks that are called so, are left out. What is wrong is a format
// error, or the system's own, which names the line, counted from 1, in its text and as its index.
std::vector<FractintSystem> read_fractint(std::string_view text);

// One system as such a file has it: doubles come back bit for bit, probabilities that were not given are. A name is a
// word; characters that the format gives a meaning become "_".
std::string write_fractint(std::string_view name, const System& system);

}  // namespace ifsm::core
