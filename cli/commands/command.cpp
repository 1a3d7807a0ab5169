#include "commands/command.h"

#include <unistd.h>

#include <map>

#include "failure.h"
#include "files.h"

namespace cli {
namespace {

bool ends_with(const std::string& text, const std::string& end) {
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

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

ifsm::Format format_of(const std::string& output, const std::string& format) {
  if (!format.empty()) return format == "json" ? ifsm::Format::json : ifsm::Format::cbor;
  return ends_with(output, ".json") ? ifsm::Format::json : ifsm::Format::cbor;
}

void check_model_output(const std::string& output, const std::string& format) {
  if (output == "-" && format_of(output, format) == ifsm::Format::cbor && isatty(STDOUT_FILENO))
    throw Failure(Exit::Usage, "CBOR is not for a terminal; add --format json, or name a file with -o.");
  check_writable(output);
}

void refuse_json_beside_result(const Talk& talk, const std::string& output) {
  if (talk.json && output == "-")
    throw Failure(Exit::Usage, "--json and the result both want standard output; name a file with -o.");
}

}  // namespace cli
