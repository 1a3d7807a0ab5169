#include "commands/command.h"
#include "commands/values.h"

#include <unistd.h>
#include <cmath>

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

void add_reading(CLI::App& command, Reading& reading) {
  static const std::map<std::string, Gaps> ways{{"split", Gaps::Split}, {"bridge", Gaps::Bridged}};
  command.add_option("--columns", reading.columns, "Columns to read, by header or number from 1, e.g. x,y")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(column_name());
  command.add_flag("--closed", reading.closed, "The curve is a ring: the last point joins the first");
  command
      .add_option_function<std::string>(
          "--gaps", [&reading](const std::string& way) { reading.gaps = ways.at(way); },
          "Cells that are NaN or empty: split makes a curve of each piece, bridge goes straight across")
      ->check([](const std::string& way) {
        return ways.count(way) > 0 ? "" : "'" + way + "' is neither split nor bridge";
      });
  static const std::string own = "own";
  command.add_flag("--project{" + own + "}")
      ->description(
          "Longitude and latitude in degrees become kilometres on a plane about each curve's middle, or about "
          "--project=LON,LAT")
      ->each([&reading](const std::string& middle) {
        reading.project = ToPlane{};
        if (middle != own) reading.project->middle = typed_degrees("--project", middle);
      });
  command.add_flag("--flat", reading.flat, "Leave the altitudes of GeoJSON out");
}

Degrees typed_degrees(const std::string& option, const std::string& text) {
  const auto fail = [&] {
    throw Failure(Exit::Usage,
                  option + ": '" + text +
                      "' is no longitude and latitude in degrees, e.g. -19.1,64.9; longitudes from -360 to "
                      "360, latitudes between -90 and 90.");
  };
  std::vector<double> values;
  try {
    values = parse_csv(text, option).values;
  } catch (const Failure&) {
    fail();
  }
  if (values.size() != 2 || std::abs(values[0]) > 360 || std::abs(values[1]) >= 90) fail();
  return {values[0], values[1]};
}

void tell_notes(const std::vector<std::string>& notes, const Talk& talk) {
  constexpr std::size_t most = 8;
  if (talk.quiet) return;
  for (std::size_t i = 0; i < notes.size() && i < most; ++i) note(notes[i]);
  if (notes.size() > most) note("and " + counted(notes.size() - most, "note") + " more.");
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

void tell_report(const Talk& talk, const std::string& output, const std::function<Json()>& report,
                 std::string (*in_words)(const Json&)) {
  if (goes_to_standard_output(output) || (talk.quiet && !talk.json)) return;
  const auto told = report();
  print(talk.json ? text_of(told) : in_words(told));
}

ifsm::Format format_of(const std::string& output, const std::string& format) {
  if (!format.empty()) return format == "json" ? ifsm::Format::json : ifsm::Format::cbor;
  return ends_with(output, ".json") ? ifsm::Format::json : ifsm::Format::cbor;
}

void refuse_binary_on_terminal(const std::string& output, ifsm::Format format) {
  if (format == ifsm::Format::cbor && isatty(STDOUT_FILENO) && goes_to_standard_output(output))
    throw Failure(Exit::Usage, "CBOR is not for a terminal; add --format json, or name a file with -o.");
}

void check_model_output(const std::string& output, const std::string& format) {
  refuse_binary_on_terminal(output, format_of(output, format));
  check_writable(output);
}

void refuse_json_beside_result(const Talk& talk, const std::string& output) {
  if (talk.json && goes_to_standard_output(output))
    throw Failure(Exit::Usage, "--json and the result both want standard output; name a file with -o.");
}

}  // namespace cli
