// ifsm systems: what systems there are by name.
#include <memory>

#include "commands/command.h"

namespace cli {
namespace {

void run(bool json) {
  Json all = Json::array();
  std::vector<std::vector<std::string>> rows;
  for (const auto& entry : ifsm::system_catalog()) {
    all.push_back({{"name", entry.name}, {"dimension", entry.dimension}, {"source", entry.source}});
    rows.push_back({entry.name, std::to_string(entry.dimension), entry.source});
  }
  if (json) return print(all);
  print(aligned({"name", "dimension", "source"}, rows, 3) +
        "\nShort names: fern, gasket, dragon, koch, levy, snowflake, sponge; - and _ are the same.\n");
}

}  // namespace

void add_systems(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("systems", "List the systems that have names");
  auto json = std::make_shared<bool>(false);
  command->add_flag("--json", *json, "As JSON");
  command->callback([json] { run(*json); });
}

}  // namespace cli
