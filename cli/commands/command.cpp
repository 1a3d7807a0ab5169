#include "commands/command.h"

#include <map>

#include "failure.h"
#include "files.h"

namespace cli {
namespace {

const std::map<std::string, char> separators{{"comma", ','}, {"semicolon", ';'}, {"tab", '\t'}, {"blank", ' '}};

}  // namespace

void add_talk(CLI::App& command, Talk& talk) {
  command.add_flag("--json", talk.json, "Report as JSON on standard output");
  command.add_flag("-q,--quiet", talk.quiet, "No progress, no notes, no report in words");
}

void add_points_output(CLI::App& command, PointsOutput& output) {
  command.add_option("-o,--output", output.path, "Table to write; - is standard output")->capture_default_str();
  command.add_option("--separator", output.separator, "What stands between the columns: comma, semicolon, tab, blank")
      ->check([](const std::string& name) {
        return separators.count(name) ? "" : "'" + name + "' is none of comma, semicolon, tab, blank";
      })
      ->capture_default_str();
  command.add_flag("--no-header", output.no_header, "Leave the line of column names out");
}

void PointsOutput::write(Table table) const {
  if (no_header) table.names.clear();
  write_file(path, format_csv(table, separators.at(separator)));
}

void refuse_json_beside_result(const Talk& talk, const std::string& output) {
  if (talk.json && output == "-")
    throw Failure(Exit::Usage, "--json and the result both want standard output; name a file with -o.");
}

}  // namespace cli
