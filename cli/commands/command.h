// The commands of the program. Each file adds one subcommand: its options, and what it does with them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>
#include <ifsm.hpp>

#include "csv.h"
#include "interrupt.h"

namespace cli {

struct Session {
  Interrupt interrupt;
};

void add_fit(CLI::App& program, Session& session);
void add_info(CLI::App& program, Session& session);
void add_synth(CLI::App& program, Session& session);
void add_eval(CLI::App& program, Session& session);
void add_measure(CLI::App& program, Session& session);
void add_nearest(CLI::App& program, Session& session);
void add_refine(CLI::App& program, Session& session);

// ---- options that several commands share

struct Talk {
  bool quiet = false;
  bool json = false;
};
void add_talk(CLI::App& command, Talk& talk);

// Where points go, and how they are written.
struct PointsOutput {
  std::string path = "-";
  std::string separator = "comma";
  bool no_header = false;

  void write(Table table) const;
};
void add_points_output(CLI::App& command, PointsOutput& output);

// How a model is written: as --format says, else by the file's name. What cannot be written is refused beforehand.
ifsm::Format format_of(const std::string& output, const std::string& format);
void check_model_output(const std::string& output, const std::string& format);

// The report goes to standard output; it cannot when the result does.
void refuse_json_beside_result(const Talk& talk, const std::string& output);

}  // namespace cli
