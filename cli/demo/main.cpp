// ifsm-demo: a coast taken apart, told by few details, and drawn.
#include <cstdio>
#include <filesystem>
#include <string>
#include <utility>

#include "demo/pictures.h"
#include "demo/study.h"
#include "failure.h"
#include "files.h"
#include "progress.h"
#include "report.h"

namespace {

namespace fs = std::filesystem;

fs::path made(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!fs::is_directory(folder))
    throw cli::Failure(cli::Exit::Output,
                       folder.string() + " is not a directory and cannot be made: " + error.message() + ".");
  return folder;
}

demo::Study studied(demo::Plan plan) {
  cli::Progress progress("fit", cli::Progress::style_of_terminal(false));
  return demo::study(std::move(plan), [&](double fraction, const std::string& stage) {
    progress.update(fraction, stage);
    return false;
  });
}

void write(const fs::path& path, const std::string& bytes) {
  cli::write_file(path.string(), bytes);
  std::printf("%s\n", path.c_str());
}

void run(const std::string& input, const fs::path& folder) {
  auto plan = demo::plan(input);
  made(folder);
  const auto study = studied(std::move(plan));
  const auto table = demo::table_of(study);
  std::printf("%s\n", table.c_str());
  write(folder / "errors.txt", table);
  const auto bytes = study.model.save(ifsm::Format::cbor);
  write(folder / fs::path(input).stem().concat(".ifsm"), {bytes.begin(), bytes.end()});
  write(folder / "01-coast.png", demo::coast_picture(study));
  write(folder / "02-levels.png", demo::levels_picture(study));
  write(folder / "03-details.png", demo::details_picture(study));
  write(folder / "04-scalogram.png", demo::scalogram_picture(study));
  write(folder / "05-errors.png", demo::errors_picture(study));
}

void usage(std::FILE* out) {
  std::fputs(
      "usage: ifsm-demo COAST.csv FOLDER\n"
      "Fits the closed curve in COAST.csv (two columns, in km) and writes a model, a table of errors and five\n"
      "pictures into FOLDER.\n",
      out);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc == 2 && (argv[1] == std::string("--help") || argv[1] == std::string("-h"))) {
    usage(stdout);
    return 0;
  }
  if (argc != 3) {
    usage(stderr);
    return static_cast<int>(cli::Exit::Usage);
  }
  try {
    run(argv[1], argv[2]);
    return 0;
  } catch (const cli::Failure& failure) {
    std::fprintf(stderr, "ifsm-demo: %s\n", failure.what());
    return static_cast<int>(failure.code);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "ifsm-demo: %s\n", error.what());
    return static_cast<int>(cli::Exit::Computing);
  }
}
