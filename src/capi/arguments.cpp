#include "capi/arguments.h"

#include <string>

namespace ifsm::core {
namespace {

constexpr std::uint32_t smallest_struct = 8;    // struct_size and one more field
constexpr std::uint32_t largest_struct = 4096;  // far beyond any header, and safe to look at

}  // namespace

void refuse_null(const char* argument) {
  throw Error(Status::null, argument, std::string(argument) + " is NULL; pass a pointer to it.");
}

void refuse_capacity(const char* argument, std::int64_t capacity, std::int64_t needed) {
  throw Error(Status::capacity, argument,
              std::string(argument) + " has room for " + std::to_string(capacity) + " values and " +
                  std::to_string(needed) + " are needed; pass an array of that size.")
      .with(static_cast<double>(capacity))
      .needs(needed);
}

void require_count(std::int64_t count, std::int64_t needed, const char* argument) {
  if (count == needed) return;
  throw Error(Status::shape, argument,
              std::string(argument) + " is " + std::to_string(count) + " and must be " + std::to_string(needed) +
                  "; pass an array of that size.")
      .with(static_cast<double>(count))
      .needs(needed);
}

std::uint32_t checked_struct_size(std::uint32_t size, const char* argument) {
  if (size >= smallest_struct && size <= largest_struct && size % alignof(std::uint32_t) == 0) return size;
  throw Error(Status::options, argument,
              std::string(argument) + " tells a struct of " + std::to_string(size) +
                  " bytes, which no header has; set struct_size to the sizeof of the struct.")
      .with(size);
}

void require_zero_tail(const void* given, std::uint32_t given_size, std::size_t known_size, const char* argument) {
  const auto* bytes = static_cast<const unsigned char*>(given);
  for (std::size_t i = known_size; i < given_size; ++i)
    if (bytes[i] != 0)
      throw Error(Status::options, argument,
                  std::string(argument) + " sets a field at byte " + std::to_string(i) +
                      " that this library is too old to know; leave it zero or use a newer library.")
          .at(static_cast<std::int64_t>(i))
          .with(bytes[i]);
}

}  // namespace ifsm::core
