#include "io/system_file.h"

#include <ifsm.h>

#include <optional>
#include <string>

#include "capi/arguments.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "io/fractint.h"
#include "io/system_files.h"

using namespace ifsm::core;

namespace {

Bytes file_of(const System& system, int32_t format, const char* name) {
  in_range(format, IFSM_FORMAT_JSON, IFSM_FORMAT_FRACTINT, "format");
  if (format != IFSM_FORMAT_FRACTINT) return write_system(system, static_cast<Format>(format));
  const std::string text = write_fractint(name == nullptr ? "system" : name, system);
  return {text.begin(), text.end()};
}

std::span<const uint8_t> file_in(const uint8_t* bytes, int64_t count, const char* count_argument) {
  const auto file = input(bytes, count, "bytes", count_argument);
  return {file.begin(), file.end()};
}

}  // namespace

ifsm_status ifsm_system_save(ifsm_system handle, int32_t format, const char* name, uint8_t* bytes, int64_t capacity,
                             int64_t* count) {
  return guarded(__func__, [&] {
    const auto system = borrow(handle);
    const Bytes file = file_of(*system, format, name);
    deliver(
        static_cast<int64_t>(file.size()), output(bytes, capacity, "bytes"),
        required(count, "count"), [&]() -> const auto& { return file; });
  });
}

ifsm_status ifsm_system_load(const uint8_t* bytes, int64_t count, const char* name, ifsm_system* system) {
  return guarded(__func__, [&] {
    const auto file = file_in(bytes, count, "count");
    required(system, "system");
    issue(read_system_named(file, name == nullptr ? std::nullopt : std::optional<std::string_view>(name)), *system);
  });
}

ifsm_status ifsm_system_file_names(const uint8_t* bytes, int64_t byte_count, uint8_t* names, int64_t capacity,
                                   int64_t* count) {
  return guarded(__func__, [&] {
    const auto file = file_in(bytes, byte_count, "byte_count");
    const auto to = output(names, capacity, "names");
    required(count, "count");
    std::string lines;
    for (const auto& each : read_systems(file)) lines += each.name + '\n';
    deliver(
        static_cast<int64_t>(lines.size()), to, *count, [&]() -> const auto& { return lines; });
  });
}
