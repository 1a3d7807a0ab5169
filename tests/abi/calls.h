// Every function of the ABI as data: what its parameters are, and a way to call it with any arguments.
// The tables behind it are functions.csv and structs.csv.
#pragma once

#include <ifsm.h>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <type_traits>
#include <vector>

namespace misuse {

// One argument; which member counts is the parameter's type's affair.
struct Argument {
  std::uint64_t id = 0;
  void* pointer = nullptr;
  std::int64_t integer = 0;
  double real = 0;
};
using Arguments = std::vector<Argument>;

template <class T>
T as(const Argument& argument) {
  if constexpr (std::is_pointer_v<T> && std::is_function_v<std::remove_pointer_t<T>>)
    return reinterpret_cast<T>(argument.pointer);
  else if constexpr (std::is_pointer_v<T>)
    return static_cast<T>(argument.pointer);
  else if constexpr (std::is_same_v<T, double>)
    return argument.real;
  else if constexpr (std::is_integral_v<T>)
    return static_cast<T>(argument.integer);
  else
    return T{argument.id};
}

struct Parameter {
  std::string name, type, kind, ownership, null, low, high, good;
  std::size_t size;  // of what a pointer points to (of one element)
};

struct Function {
  std::string name;
  bool can_fail;
  std::vector<Parameter> parameters;
  ifsm_status (*call)(const Arguments&);
};

struct Field {
  std::string name, type, kind, low, high;
  std::size_t offset, size;
};

const std::vector<Function>& functions();
const std::vector<Field>& fields(const std::string& type);  // of a struct that is handed in

}  // namespace misuse
