// The commands of the program. Each file adds one subcommand: its options, and what it does with them.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <ifsm.hpp>

#include "csv.h"
#include "curves.h"
#include "interrupt.h"
#include "report.h"

namespace cli {

struct Session {
  Interrupt interrupt;
};

void add_fit(CLI::App& program, Session& session);
void add_info(CLI::App& program, Session& session);
void add_synth(CLI::App& program, Session& session);
void add_eval(CLI::App& program, Session& session);
void add_plot(CLI::App& program, Session& session);
void add_train(CLI::App& program, Session& session);
void add_measure(CLI::App& program, Session& session);
void add_nearest(CLI::App& program, Session& session);
void add_refine(CLI::App& program, Session& session);
void add_deform(CLI::App& program, Session& session);
void add_render(CLI::App& program, Session& session);
void add_convert(CLI::App& program, Session& session);
void add_systems(CLI::App& program, Session& session);

// ---- options that several commands share

struct Talk {
  bool quiet = false;
  bool json = false;
};
void add_talk(CLI::App& command, Talk& talk);

// How curves are read.
void add_reading(CLI::App& command, Reading& reading);

// "-19.1,64.9" as an option's value. Throws Failure{Usage}.
Degrees typed_degrees(const std::string& option, const std::string& text);

// Notes on standard error, the first few of them.
void tell_notes(const std::vector<std::string>& notes, const Talk& talk);

// Where points go, and how they are written.
struct PointsOutput {
  std::string path = "-";
  std::string separator = "comma";
  bool no_header = false;

  void write(Table table) const;
};
void add_points_output(CLI::App& command, PointsOutput& output);

// The end of every command whose result went to `output`: the report, if there is one to be told. It is made only then.
void tell_report(const Talk& talk, const std::string& output, const std::function<Json()>& report,
                 std::string (*in_words)(const Json&));
// How a model is written: as --format says, else by the file's name. What cannot be written is refused beforehand.
ifsm::Format format_of(const std::string& output, const std::string& format);
void refuse_binary_on_terminal(const std::string& output, ifsm::Format format);
void check_model_output(const std::string& output, const std::string& format);

// The report goes to standard output; it cannot when the result does.
void refuse_json_beside_result(const Talk& talk, const std::string& output);

}  // namespace cli
