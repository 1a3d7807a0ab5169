// What exported bodies do with what C hands them: pointers, arrays, structs with a size.
#pragma once

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <type_traits>

#include "base/error.h"

namespace ifsm::core {

[[noreturn]] void refuse_null(const char* argument);
[[noreturn]] void refuse_capacity(const char* argument, std::int64_t capacity, std::int64_t needed);

// *pointer, or a null error.
template <class T>
T& required(T* pointer, const char* argument) {
  if (pointer == nullptr) refuse_null(argument);
  return *pointer;
}

// An input array; NULL only when it is empty.
template <class T>
struct Input {
  const T* data;
  std::int64_t count;
  const T* begin() const { return data; }
  const T* end() const { return data + count; }
};

template <class T>
Input<T> input(const T* data, std::int64_t count, const char* argument, const char* count_argument) {
  in_range(count, 0, std::int64_t{1} << 48, count_argument);
  if (count > 0) required(data, argument);
  return {data, count};
}

// A number of the C header's as the enumeration that it stands for, whose values run from 0 to `last`.
template <class Enum>
Enum choice(std::int32_t value, Enum last, const char* argument) {
  return static_cast<Enum>(in_range(value, 0, static_cast<std::int32_t>(last), argument));
}

// A shape error when a count is not the one that follows from other arguments.
void require_count(std::int64_t count, std::int64_t needed, const char* argument);

// The caller's array: where an answer goes, if it fits.
template <class T>
struct Output {
  T* data;  // NULL: only the count is wanted
  std::int64_t capacity;
  const char* argument;
};

template <class T>
Output<T> output(T* data, std::int64_t capacity, const char* argument) {
  in_range(capacity, 0, INT64_MAX, "capacity");
  if (capacity > 0) required(data, argument);
  return {data, capacity, argument};
}

// How values reach the caller's array: contiguous ones here, other types beside their C functions. Cannot fail, but for
// what the header says is made in the array itself.
template <class Range, class T>
void copy_out(const Range& values, std::int64_t count, T* to) {
  std::copy_n(values.data(), count, to);
}

// Writes the `needed` values that make() returns, and their count. make() is called when they are wanted and fit;
// nothing is written before everything that can fail is over.
template <class T, class Make>
void deliver(std::int64_t needed, const Output<T>& to, std::int64_t& count, const Make& make) {
  if (to.data != nullptr) {
    if (to.capacity < needed) refuse_capacity(to.argument, to.capacity, needed);
    copy_out(make(), needed, to.data);
  }
  count = needed;
}

// Structs that start with uint32_t struct_size. Every published header has at least one field beside it; sizes of no
// header (uninitialised memory, most of the time) are refused.
std::uint32_t checked_struct_size(std::uint32_t size, const char* argument);
void require_zero_tail(const void* given, std::uint32_t given_size, std::size_t known_size, const char* argument);

// The caller's options as this library knows them: absent fields are zero, which is their default.
template <class T>
T read_options(const T* given, const char* argument = "options") {
  static_assert(std::is_trivially_copyable_v<T>);
  T read{};
  if (given != nullptr) {
    const std::uint32_t size = checked_struct_size(given->struct_size, argument);
    require_zero_tail(given, size, sizeof(T), argument);
    std::memcpy(&read, given, std::min<std::size_t>(size, sizeof(T)));
  }
  read.struct_size = sizeof(T);
  return read;
}

// What …_options_init does. `size` is the size in the caller's header.
template <class T>
void init_options(T* options, std::uint32_t size) {
  void* const start = &required(options, "options");
  std::memset(start, 0, checked_struct_size(size, "size"));
  std::memcpy(start, &size, sizeof size);
}

// Where a result struct goes: as much of it as the caller's header knows. A field that is newer than this library is
// left alone.
template <class T>
class Report {
 public:
  Report(T* target, const char* argument)
      : target_(&required(target, argument)), size_(checked_struct_size(target->struct_size, argument)) {}

  void write(T told) const {
    static_assert(std::is_trivially_copyable_v<T>);
    told.struct_size = size_;
    std::memcpy(static_cast<void*>(target_), &told, std::min<std::size_t>(size_, sizeof(T)));
  }

 private:
  T* target_;
  std::uint32_t size_;
};

}  // namespace ifsm::core
