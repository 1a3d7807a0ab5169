// ifsm: the program. What it computes, it asks of the library, through the C ABI alone.
#include <cstdio>
#include <exception>
#include <new>

#include <ifsm.hpp>

#include "commands/command.h"
#include "commands/usage.h"
#include "failure.h"

namespace {

constexpr const char* footer =
    "Exit codes:\n"
    "  0    fine\n"
    "  1    the computation failed\n"
    "  2    usage: an option, a value, or a combination that does not go\n"
    "  3    input: a file that is missing, unreadable, or not what it should be\n"
    "  4    output: a file that cannot be written\n"
    "  130  cancelled by Ctrl-C or a signal; no file was written\n"
    "\n"
    "Examples:\n"
    "  ifsm fit coast.csv --closed -o coast.ifsm\n"
    "  ifsm info coast.ifsm\n"
    "  ifsm synth coast.ifsm --details 64 --resolve=choice -o sketch.csv\n"
    "  ifsm eval coast.ifsm --at 0.25,0.5\n"
    "  ifsm measure coast.ifsm\n"
    "  ifsm refine coast.ifsm --levels 3 -o finer.ifsm\n"
    "  ifsm plot coast.ifsm -o coast.svg\n"
    "  ifsm render fern -o fern.png\n"
    "\n"
    "ifsm COMMAND --help tells the options of a command.\n";

int fail(cli::Exit code, const char* message) {
  std::fprintf(stderr, "ifsm: %s\n", message);
  return static_cast<int>(code);
}

int run(int argc, char** argv) {
  cli::Session session;
  CLI::App program("Fractal detail models of measured curves, and iterated function systems", "ifsm");
  program.set_version_flag("--version", "ifsm " + ifsm::version());
  program.require_subcommand(1);
  program.footer(footer);
  for (const auto add :
       {cli::add_fit, cli::add_info, cli::add_synth, cli::add_eval, cli::add_plot, cli::add_measure, cli::add_nearest,
        cli::add_refine, cli::add_deform, cli::add_train, cli::add_render, cli::add_convert, cli::add_systems})
    add(program, session);
  cli::check_command(program, argc, argv);
  try {
    program.parse(argc, argv);
    return static_cast<int>(cli::Exit::Fine);
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return program.exit(error);  // --help, --version
    return fail(cli::Exit::Usage, cli::sentence_of(program, error).c_str());
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const cli::Failure& failure) {
    return fail(failure.code, failure.what());
  } catch (const ifsm::Cancelled&) {
    return fail(cli::Exit::Cancelled, cli::cancelled);
  } catch (const ifsm::Error& error) {
    // What the commands let through unchecked are numbers that the library found out of its range.
    return fail(error.status == IFSM_ERROR_RANGE ? cli::Exit::Usage : cli::Exit::Computing, error.what());
  } catch (const std::bad_alloc&) {
    return fail(cli::Exit::Computing, "there is not enough memory for this; ask for less, e.g. fewer points.");
  } catch (const std::exception& error) {
    return fail(cli::Exit::Computing, error.what());
  }
}
