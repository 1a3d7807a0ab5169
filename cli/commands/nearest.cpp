// ifsm nearest: the points of a curve that are nearest to given ones.
#include <memory>

#include "commands/command.h"
#include "commands/values.h"
#include "curves.h"
#include "failure.h"
#include "files.h"
#include "models.h"

namespace cli {
namespace {

struct NearestArguments {
  std::string model;
  std::string queries;
  std::vector<std::string> columns;
  PointsOutput output;
};

void run(const NearestArguments& arguments) {
  if (arguments.model == "-" && arguments.queries == "-")
    throw Failure(Exit::Usage, "the model and the points cannot both come from standard input.");
  check_writable(arguments.output.path);
  check_not_read(arguments.output.path, {arguments.model, arguments.queries});
  const auto model = load_model(arguments.model);
  const auto source = input_name(arguments.queries);
  const auto queries = parse_csv(read_file(arguments.queries), source, {arguments.columns});
  const int dimension = model.describe().dimension;
  if (queries.columns != static_cast<std::size_t>(dimension))
    throw Failure(Exit::Input, source + " has " + std::to_string(queries.columns) +
                                   " columns, and the curve dimension " + std::to_string(dimension) +
                                   "; choose as many with --columns, by name or number.");
  Table table{coordinate_names(dimension), queries.columns + 2, {}};
  table.names.insert(table.names.begin(), {"t", "distance"});
  for (const auto& found : model.nearest(queries.values)) {
    table.values.insert(table.values.end(), {found.parameter, found.distance});
    table.values.insert(table.values.end(), found.point.begin(), found.point.end());
  }
  arguments.output.write(std::move(table));
}

}  // namespace

void add_nearest(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("nearest", "Write the points of a model that are nearest to given ones");
  auto arguments = std::make_shared<NearestArguments>();
  auto& a = *arguments;
  command->add_option("model", a.model, "A model written by ifsm fit; - is standard input")->required();
  command->add_option("points", a.queries, "A table of points; - is standard input")->required();
  command->add_option("--columns", a.columns, "Columns to read, by header or by number from 1, e.g. x,y")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(column_name());
  add_points_output(*command, a.output);
  command->footer(
      "A line for each point: its parameter on the curve, its distance, and the curve's point there.\n\n"
      "Examples:\n"
      "  ifsm nearest coast.ifsm towns.csv --columns x,y -o nearest.csv\n"
      "  echo 3,4 | ifsm nearest coast.ifsm -\n");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cli
