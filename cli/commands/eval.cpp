// ifsm eval: the curve at parameters.
#include <memory>

#include "commands/command.h"
#include "curves.h"
#include "failure.h"
#include "files.h"
#include "models.h"

namespace cli {
namespace {

struct EvalArguments {
  std::string model;
  std::string at;
  std::string file;
  bool limit = false;
  PointsOutput output;
  Talk talk;
};

struct Parameters {
  std::vector<double> values;
  Exit blame;  // what a bad one is: usage when typed, input when read
};

std::vector<double> column(const std::string& text, const std::string& source) {
  auto table = parse_csv(text, source);
  if (table.columns != 1)
    throw Failure(Exit::Input,
                  source + " has " + std::to_string(table.columns) + " columns; parameters are one number a line.");
  return table.values;
}

// "0.25,0.5": one number after the other, as a table of one line.
std::vector<double> typed(const std::string& text) {
  try {
    return parse_csv(text, "--at").values;
  } catch (const Failure&) {
    throw Failure(Exit::Usage, "--at: '" + text + "' is no list of numbers, such as 0.25,0.5.");
  }
}

Parameters parameters_of(const EvalArguments& arguments) {
  if (!arguments.at.empty() && arguments.at != "-") return {typed(arguments.at), Exit::Usage};
  const auto path = arguments.at == "-" ? "-" : arguments.file;
  return {column(read_file(path), input_name(path)), Exit::Input};
}

void check_range(const Parameters& parameters, const ifsm_model_info& info) {
  if (info.closed == 1) return;
  for (std::size_t i = 0; i < parameters.values.size(); ++i) {
    const double value = parameters.values[i];
    if (value >= 0 && value <= 1) continue;
    throw Failure(parameters.blame, "parameter " + std::to_string(i + 1) + " is " + shortest(value) +
                                        "; an open curve has the parameters 0 to 1.");
  }
}

Table table_of(const std::vector<double>& parameters, const std::vector<double>& points, int dimension) {
  Table table{coordinate_names(dimension), static_cast<std::size_t>(dimension) + 1, {}};
  table.names.insert(table.names.begin(), "t");
  const auto d = static_cast<std::size_t>(dimension);
  for (std::size_t k = 0; k < parameters.size(); ++k) {
    table.values.push_back(parameters[k]);
    for (std::size_t i = 0; i < d; ++i) table.values.push_back(points[k * d + i]);
  }
  return table;
}

Json json_of(const std::string& model, const Table& table) {
  Json rows = Json::array();
  for (std::size_t row = 0; row < table.rows(); ++row) {
    const auto first = table.values.begin() + static_cast<std::ptrdiff_t>(row * table.columns);
    rows.push_back(
        {{"t", *first}, {"point", std::vector<double>(first + 1, first + static_cast<std::ptrdiff_t>(table.columns))}});
  }
  return {{"model", model}, {"points", rows}};
}

void run(const EvalArguments& arguments) {
  if (arguments.at.empty() == arguments.file.empty())
    throw Failure(Exit::Usage, "give the parameters with --at or with --params.");
  const bool both = arguments.model == "-" && (arguments.at == "-" || arguments.file == "-");
  if (both) throw Failure(Exit::Usage, "the model and the parameters cannot both come from standard input.");
  check_writable(arguments.output.path);
  check_not_read(arguments.output.path, {arguments.model, arguments.at == "-" ? "-" : arguments.file});
  const auto model = load_model(arguments.model);
  const auto parameters = parameters_of(arguments);
  const auto info = model.describe();
  check_range(parameters, info);
  const auto points = model.evaluate(parameters.values, arguments.limit ? ifsm::Follow::limit : ifsm::Follow::polyline);
  auto table = table_of(parameters.values, points, info.dimension);
  if (arguments.talk.json)
    write_file(arguments.output.path, text_of(json_of(input_name(arguments.model), table)));
  else
    arguments.output.write(std::move(table));
}

}  // namespace

void add_eval(CLI::App& program, Session&) {
  auto* command = program.add_subcommand("eval", "Write the points of a model at given parameters");
  auto arguments = std::make_shared<EvalArguments>();
  auto& a = *arguments;
  command->add_option("model", a.model, "A model written by ifsm fit; - is standard input")->required();
  auto* at = command->add_option("--at", a.at, "Parameters, e.g. 0.25,0.5; - reads them from standard input");
  command->add_option("--params", a.file, "A file of parameters, one a line")->excludes(at);
  command->add_flag("--limit", a.limit, "Go on below the finest level, instead of following its polyline");
  add_points_output(*command, a.output);
  command->add_flag("--json", a.talk.json, "Write JSON instead of a table");
  command->footer(
      "Parameters run from 0 to 1; on a closed curve any number's fraction counts.\n\n"
      "Examples:\n"
      "  ifsm eval coast.ifsm --at 0.25,0.5\n"
      "  seq 0 0.01 1 | ifsm eval coast.ifsm --at - -o points.csv\n"
      "  ifsm eval coast.ifsm --params parameters.csv --limit\n");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace cli
