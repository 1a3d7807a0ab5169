// The commands of the program. Each file adds one subcommand: its options, and what it does with them.
#pragma once

#include <string>

#include <CLI/CLI.hpp>

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
void add_train(CLI::App& program, Session& session);

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

// The report goes to standard output; it cannot when the result does.
void refuse_json_beside_result(const Talk& talk, const std::string& output);

}  // namespace cli
