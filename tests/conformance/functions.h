// Every function that a language's binding has, as data: its parameters as the file tells them, and a way to call it.
#pragma once

#include <ifsm.h>

#include <string>
#include <vector>

namespace conformance {

class Call;

// kind: int32, int64, uint32, uint64, real, text, handle, doubles, int32s, int64s, uint32s, bytess, curve, curves,
// known, callback, output; made and told are results. low, high, null: as in tests/abi/functions.csv.
struct Parameter {
  std::string name, kind, low, high, null;
};

struct Function {
  std::string name;
  std::vector<Parameter> parameters;
  ifsm_status (*call)(Call&);
};

const std::vector<Function>& functions();
const Function& function(const std::string& name);

}  // namespace conformance
