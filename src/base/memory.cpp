#include "base/memory.h"

#include <unistd.h>

#include <string>

#include "base/error.h"

namespace ifsm::core {

std::int64_t physical_memory() {
  const std::int64_t pages = sysconf(_SC_PHYS_PAGES), size = sysconf(_SC_PAGESIZE);
  return pages > 0 && size > 0 ? checked_product(pages, size, "pages") : INT64_MAX;
}

void require_memory(std::int64_t doubles, const char* argument) {
  const std::int64_t bytes = checked_product(doubles, sizeof(double), argument), memory = physical_memory();
  if (bytes <= memory) return;
  const auto gigabytes = [](std::int64_t count) { return std::to_string((count >> 30) + 1) + " GiB"; };
  throw Error(Status::memory, argument,
              std::string(argument) + " asks for " + gigabytes(bytes) + " at least and this machine has " +
                  gigabytes(memory) + "; give a smaller one.")
      .with(static_cast<double>(bytes))
      .needs(bytes);
}

}  // namespace ifsm::core
