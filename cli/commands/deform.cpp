// ifsm deform: a model bent, restyled, given other texture; as a model, a table, a picture, or frames of a film.
#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <optional>

#include "bends.h"
#include "commands/command.h"
#include "commands/values.h"
#include "failure.h"
#include "figures/bent.h"
#include "figures/page.h"
#include "files.h"
#include "models.h"
#include "plot/webp.h"
#include "progress.h"
#include "targets.h"

namespace cli {
namespace {

struct Bend {
  std::string option, value;
};

struct DeformArguments {
  std::string model;
  std::string output;
  std::string format;
  std::string keep_edits;
  std::string turning = "similarity";
  std::string follow = "moved";
  std::vector<Bend> bends;  // in the order of the command line
  std::optional<int> frames;
  double rate = 25;  // frames a second
  figures::PageSize size;
  std::string title;
  Talk talk;
};

constexpr int least_size = 100, most_size = 20000, most_film_size = 16383;  // pixels; WebP's images end there
constexpr int most_frames = 100000;

bool ends_in(const std::string& path, const std::string& extension) { return path.ends_with(extension); }

enum class Kind { Model, Table, Picture, Film };

Kind kind_of(const DeformArguments& arguments) {
  if (!arguments.format.empty()) return Kind::Model;
  const auto& path = arguments.output;
  if (ends_in(path, ".webp")) return Kind::Film;
  if (ends_in(path, ".png") || ends_in(path, ".svg")) return Kind::Picture;
  return ends_in(path, ".csv") ? Kind::Table : Kind::Model;
}

plot::Format picture_format(const std::string& path) {
  return ends_in(path, ".svg") ? plot::Format::Svg : plot::Format::Png;
}

void check_arguments(const DeformArguments& arguments) {
  refuse_json_beside_result(arguments.talk, arguments.output);
  const Kind kind = kind_of(arguments);
  if (kind == Kind::Film && !arguments.frames)
    throw Failure(Exit::Usage, "-o " + arguments.output + " is an animation; add --frames, how many pictures it has.");
  if (kind != Kind::Film && kind != Kind::Picture && arguments.frames)
    throw Failure(Exit::Usage, "--frames makes pictures; -o must end in .webp, or be a pattern such as bend-%03d.png.");
  if (kind == Kind::Film && std::max(arguments.size.width, arguments.size.height) > most_film_size)
    throw Failure(Exit::Usage, "--width, --height: a picture of a .webp has at most " + std::to_string(most_film_size) +
                                   " pixels a side.");
  if (kind == Kind::Model) refuse_binary_on_terminal(arguments.output, format_of(arguments.output, arguments.format));
  if (!arguments.frames || kind == Kind::Film) check_writable(arguments.output);
  check_not_read(arguments.output, {arguments.model});
  if (arguments.keep_edits.empty()) return;
  check_writable(arguments.keep_edits);
  check_not_read(arguments.keep_edits, {arguments.model});
  if (arguments.keep_edits == arguments.output)
    throw Failure(Exit::Usage, "--keep-edits and -o name the same file; give two.");
}

ifsm::Turning turning_of(const std::string& name) {
  return name == "rotation" ? ifsm::Turning::rotation
         : name == "linear" ? ifsm::Turning::linear
                            : ifsm::Turning::similarity;
}

ifsm::Following follow_of(const std::string& name) {
  return name == "each" ? ifsm::Following::each : name == "none" ? ifsm::Following::none : ifsm::Following::moved;
}

figures::Moment moment_of(const ifsm::Deformer& deformer, const ifsm_model_info& info) {
  const std::int64_t handles =
      info.control_points - (info.closed == 1 && info.topology == IFSM_TOPOLOGY_JOINED ? 1 : 0);
  figures::Moment moment{deformer.points(info.levels, 0, info.places), deformer.points(0, 0, handles)};
  if (handles < info.control_points)  // a ring's polygon comes back
    moment.polygon.insert(moment.polygon.end(), moment.polygon.begin(), moment.polygon.begin() + info.dimension);
  return moment;
}

// The edits, as they were told.
std::string note_of(const DeformArguments& arguments) {
  std::string note;
  for (const auto& [option, value] : arguments.bends) note += (note.empty() ? "--" : " --") + option + " " + value;
  return valid_utf8(note);
}

plot::Figure figure_of(const DeformArguments& arguments, const figures::Moment& before, const figures::Moment& after,
                       const ifsm_model_info& info, const figures::Frame& frame) {
  return figures::page_of({figures::bent_panel(before, after, info.dimension, info.closed == 1, frame)},
                          valid_utf8(arguments.title), note_of(arguments), arguments.size);
}

std::string picture(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& end,
                    const ifsm_model_info& info) {
  const auto before = moment_of(start, info), after = moment_of(end, info);
  const auto frame = figures::frame_of({before, after}, info.dimension, info.closed == 1);
  return figure_of(arguments, before, after, info, frame).bytes(picture_format(arguments.output));
}

std::vector<figures::Moment> moments(const DeformArguments& arguments, const ifsm::Deformer& deformer,
                                     const ifsm_model_info& info) {
  const auto told = deformer.describe();
  const int count = *arguments.frames;
  std::vector<figures::Moment> all;
  for (int k = 0; k < count; ++k) {
    const double s = count == 1 ? 1.0 : static_cast<double>(k) / (count - 1);
    all.push_back(
        moment_of(deformer.at_time(k + 1 == count ? told.end : told.begin + s * (told.end - told.begin)), info));
  }
  return all;
}

std::vector<std::string> paths_of(const DeformArguments& arguments) {
  const auto count = static_cast<std::size_t>(*arguments.frames);
  if (count > 1 && arguments.output.find('%') == std::string::npos)
    throw Failure(Exit::Usage, "-o " + arguments.output + " names one file for " + counted(count, "picture") +
                                   "; put %03d into the name, which stands for a picture's number.");
  auto paths = target_paths(arguments.output, "", "", std::vector<std::string>(count)).paths;
  for (const auto& path : paths) check_writable(path);
  return paths;
}

// The film, or its pictures.
std::vector<File> film(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& deformer,
                       const ifsm_model_info& info, Session& session) {
  const Interrupt::Cancellable job(session.interrupt);
  Progress progress("deform", Progress::style_of_terminal(arguments.talk.quiet));
  const bool one_file = kind_of(arguments) == Kind::Film;
  const auto paths = one_file ? std::vector<std::string>() : paths_of(arguments);
  const auto before = moment_of(start, info);
  const auto all = moments(arguments, deformer, info);
  auto seen = all;
  seen.push_back(before);
  const auto frame = figures::frame_of(seen, info.dimension, info.closed == 1);
  std::optional<plot::Animation> animation;
  std::vector<File> files;
  for (std::size_t k = 0; k < all.size(); ++k) {
    progress.update(static_cast<double>(k) / static_cast<double>(all.size()), "frame " + std::to_string(k + 1));
    const auto figure = figure_of(arguments, before, all[k], info, frame);
    if (one_file) {
      if (!animation) animation.emplace(figure.width, figure.height);
      animation->add(figure.pixels(), std::max(1, static_cast<int>(std::lround(1000 / arguments.rate))));
    } else {
      files.push_back({paths[k], figure.bytes(picture_format(arguments.output))});
    }
    job.confirm();
  }
  if (one_file) files.push_back({arguments.output, animation->bytes()});
  progress.update(1, "done");
  return files;
}

File result(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& deformer,
            const ifsm_model_info& info) {
  switch (kind_of(arguments)) {
    case Kind::Picture: return {arguments.output, picture(arguments, start, deformer, info)};
    case Kind::Table:
      return {arguments.output, format_csv({coordinate_names(info.dimension), static_cast<std::size_t>(info.dimension),
                                            deformer.samples()},
                                           ',')};
    default: break;
  }
  const auto bytes = deformer.snapshot().save(format_of(arguments.output, arguments.format));
  return {arguments.output, {bytes.begin(), bytes.end()}};
}

Json report_of(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& deformer,
               const ifsm_model_info& info) {
  Json report{{"model", input_name(arguments.model)},
              {"output", arguments.output},
              {"edits", deformer.describe().edits},
              {"moved", distance(start.samples(), deformer.samples(), info.dimension).max},
              {"size", info.diagonal}};
  if (info.dimension == 2) report["crossings"] = deformer.crossings().size();
  if (arguments.frames) report["frames"] = *arguments.frames;
  return report;
}

std::string in_words(const Json& report) {
  std::string words = report["output"].get<std::string>() + ": " + counted(report["edits"], "edit") +
                      ", samples moved by at most " + rounded(report["moved"]);
  if (report.contains("frames")) words += ", " + counted(report["frames"], "frame");
  if (report.contains("crossings") && report["crossings"] != 0)
    words += "; the curve now crosses itself at " + counted(report["crossings"], "place") + " more";
  return words + "\n";
}

void run(const DeformArguments& arguments, Session& session) {
  check_arguments(arguments);
  const auto model = load_model(arguments.model);
  const auto info = model.describe();
  const ifsm::Deformer start(model);
  ifsm::Deformer deformer(model, turning_of(arguments.turning), follow_of(arguments.follow));
  for (const auto& [option, value] : arguments.bends) bend(deformer, option, value);

  std::vector<File> files;
  if (arguments.frames)
    files = film(arguments, start, deformer, info, session);
  else
    files.push_back(result(arguments, start, deformer, info));
  if (!arguments.keep_edits.empty()) {
    const auto kept = deformer.save(format_of(arguments.keep_edits, ""));
    files.push_back({arguments.keep_edits, {kept.begin(), kept.end()}});
  }
  if (files.size() == 1)
    write_file(files.front().path, files.front().bytes);
  else
    write_files(files, Existing::Replaced);
  tell_report(
      arguments.talk, arguments.output, [&] { return report_of(arguments, start, deformer, info); }, in_words);
}

// Options of edits are told in the order in which they stand.
std::vector<Bend> bends_of(const CLI::App& command, const std::vector<std::string>& names) {
  std::vector<Bend> bends;
  std::map<const CLI::Option*, std::size_t> taken;
  for (const CLI::Option* option : command.parse_order())
    if (const auto name = option->get_single_name(); std::find(names.begin(), names.end(), name) != names.end())
      bends.push_back({name, option->results()[taken[option]++]});
  return bends;
}

}  // namespace

void add_deform(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("deform", "Bend a model, scale or exchange its details; frames of it, too");
  auto arguments = std::make_shared<DeformArguments>();
  auto& a = *arguments;
  command->add_option("model", a.model, "A model written by ifsm fit; - is standard input")->required();
  command
      ->add_option(
          "-o,--output", a.output,
          "What to write: a model; a table (.csv); before and after in a picture (.png, .svg); with --frames an "
          "animation (.webp) or pictures (bend-%03d.png); - is standard output")
      ->required();
  std::vector<std::string> names;
  const auto edit = [&](const char* name, const char* words, const char* told) {
    names.emplace_back(name);
    command->add_option("--" + std::string(name))
        ->description(words)
        ->type_name(told)
        ->expected(1)
        ->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  };
  edit("move",
       "Move a handle, a point of a level (0, the control points, when none is told): by +X,Y or to =X,Y; neighbours "
       "follow",
       "[LEVEL/]HANDLE:WAY[@smooth=R|linear=R,length,curve]");
  edit("move-at", "Drag points of the curve, at parameters, by the least change of a level's handles, or details",
       "T:WAY[;T:WAY][@LEVEL|details=LEVEL]");
  edit("pin", "Handles stay where they are, whatever moves above them", "[LEVEL/]HANDLE,...");
  edit("unpin", "Let them go", "[LEVEL/]HANDLE,...");
  edit("scale-details", "Scale details; LEVELS: 3, 2-5, first2, last2 (default all), ~1: one level on each side fades",
       "FACTOR[@LEVELS]");
  edit("turn-details", "Turn details, counterclockwise", "DEGREES[@LEVELS]");
  edit("mirror-details", "Mirror details", "x|y|z|w[@LEVELS]");
  edit("texture", "Other details: of another model, or random ones of roughness H", "MODEL|random[=H[,SEED]][@LEVELS]");
  edit("during", "When the edits that follow take place; smooth (default), linear, in, out", "BEGIN,END[,EASING]");
  edit("edits", "Make edits that --keep-edits kept", "FILE");
  command->add_option("--turning", a.turning, "What details follow: similarity, rotation, linear (paper 002)")
      ->check(one_of({"similarity", "rotation", "linear"}))
      ->capture_default_str();
  command->add_option("--follow", a.follow, "Whose turn they take: moved nodes', each their own, none")
      ->check(one_of({"moved", "each", "none"}))
      ->capture_default_str();
  command->add_option("--frames", a.frames, "So many pictures, from the first edit's begin to the last one's end")
      ->transform(whole_number(1, most_frames));
  command->add_option("--rate", a.rate, "Frames a second of an animation")
      ->check(number_above_zero())
      ->capture_default_str();
  command->add_option("--width", a.size.width, "Pixels of a picture")->transform(whole_number(least_size, most_size));
  command->add_option("--height", a.size.height, "Pixels")->transform(whole_number(least_size, most_size));
  command->add_option("--title", a.title, "Words above the picture");
  command->add_option("--keep-edits", a.keep_edits, "Write the edits as well, to be made again (.json, else CBOR)");
  command->add_option("--format", a.format, "Write a model, as json or cbor, whatever its name")
      ->check(one_of({"json", "cbor"}));
  add_talk(*command, a.talk);
  command->footer(
      "Edits are made in the order in which they stand.\n\n"
      "Examples:\n"
      "  ifsm deform coast.ifsm --move 2:+10,4 -o bent.ifsm\n"
      "  ifsm deform coast.ifsm --move-at '0.31:+0,25@3' --scale-details 1.5@last2 -o bent.png\n"
      "  ifsm deform coast.ifsm --move 5/12:+20,0@smooth=8 --texture random=0.6,7@last3 -o bent.csv\n"
      "  ifsm deform coast.ifsm --during 0,2 --move 2:+80,0 --during 1,3 --scale-details 0@last4 --frames 75 -o "
      "bend.webp\n");
  command->callback([arguments, command, names, &session] {
    arguments->bends = bends_of(*command, names);
    run(*arguments, session);
  });
}

}  // namespace cli
