// ifsm deform: a model bent, restyled, given other texture; as a model, a table, a picture, or frames of a film.
#include <algorithm>
#include <cctype>
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
  std::optional<std::string> keep_edits;
  std::string turning, follow;  // empty: as the edits that are read were made, else similarity and moved
  std::vector<Bend> bends;      // in the order of the command line
  std::optional<int> frames;
  double rate = 25;  // frames a second
  figures::PageSize size;
  std::string title;
  Talk talk;
};

constexpr int least_size = 100, most_size = 20000, most_film_size = 16383;  // pixels; WebP's images end there
constexpr int most_frames = 100000;

bool ends_in(std::string path, const std::string& extension) {
  std::transform(path.begin(), path.end(), path.begin(), [](unsigned char c) { return std::tolower(c); });
  return path.ends_with(extension);
}

enum class Kind { Model, Table, Picture, Film };

Kind kind_of(const DeformArguments& arguments) {
  if (!arguments.format.empty()) return Kind::Model;
  const auto& path = arguments.output;
  if (ends_in(path, ".webp")) return Kind::Film;
  if (ends_in(path, ".png") || ends_in(path, ".svg")) return Kind::Picture;
  if (ends_in(path, ".csv")) return Kind::Table;
  if (goes_to_standard_output(path) || ends_in(path, ".ifsm") || ends_in(path, ".json") || ends_in(path, ".cbor"))
    return Kind::Model;
  throw Failure(Exit::Usage, "-o " + path + " ends in none of .ifsm, .json, .cbor (models), .csv, .png, .svg, .webp; " +
                                 "add --format cbor to write a model.");
}

plot::Format picture_format(const std::string& path) {
  return ends_in(path, ".svg") ? plot::Format::Svg : plot::Format::Png;
}

// A picture's number stands in it: %d, or %03d.
bool is_pattern(const std::string& path) {
  const auto at = path.find('%');
  if (at == std::string::npos || path.find('%', at + 1) != std::string::npos) return false;
  const auto rest = path.substr(at + 1);
  return rest.starts_with("d") ||
         (rest.size() > 2 && rest[0] == '0' && rest[1] >= '1' && rest[1] <= '9' && rest[2] == 'd');
}

void check_frames(const DeformArguments& arguments, Kind kind) {
  const auto& output = arguments.output;
  if (kind == Kind::Film && !arguments.frames)
    throw Failure(Exit::Usage, "-o " + output + " is an animation; add --frames, how many pictures it has.");
  if (!arguments.frames || kind == Kind::Film) return;
  if (!arguments.format.empty())
    throw Failure(Exit::Usage, "--frames makes pictures, and --format a model; leave one of them out.");
  if (kind != Kind::Picture)
    throw Failure(Exit::Usage, "--frames makes pictures; -o must end in .webp, or be a pattern such as bend-%03d.png.");
  if (!is_pattern(output) && *arguments.frames > 1)
    throw Failure(Exit::Usage, "-o " + output + " names one file for " +
                                   counted(static_cast<std::size_t>(*arguments.frames), "picture") +
                                   "; put %d or %03d into the name, once, which stands for a picture's number from 1.");
}

std::vector<std::string> outputs_of(const DeformArguments& arguments) {
  const bool many = arguments.frames && kind_of(arguments) == Kind::Picture && is_pattern(arguments.output);
  if (!many) return {arguments.output};
  return target_paths(arguments.output, "", "", std::vector<std::string>(static_cast<std::size_t>(*arguments.frames)))
      .paths;
}

void check_arguments(const DeformArguments& arguments) {
  refuse_json_beside_result(arguments.talk, arguments.output);
  const Kind kind = kind_of(arguments);
  check_frames(arguments, kind);
  if (kind == Kind::Film && std::max(arguments.size.width, arguments.size.height) > most_film_size)
    throw Failure(Exit::Usage, "--width, --height: a picture of a .webp has at most " + std::to_string(most_film_size) +
                                   " pixels a side.");
  if (kind == Kind::Model) refuse_binary_on_terminal(arguments.output, format_of(arguments.output, arguments.format));
  if (!arguments.bends.empty() && arguments.bends.back().option == "during")
    throw Failure(Exit::Usage, "--during " + arguments.bends.back().value + ": say it before the edits that it times.");
  std::vector<std::string> inputs{arguments.model};
  for (const auto& [option, value] : arguments.bends)
    if (const auto file = file_of_bend(option, value); !file.empty()) inputs.push_back(file);
  if (std::count(inputs.begin(), inputs.end(), "-") > 1)
    throw Failure(Exit::Usage, "the model and what edits read cannot both come from standard input; name files.");
  const auto outputs = outputs_of(arguments);
  for (const auto& output : outputs) {
    check_writable(output);
    check_not_read(output, inputs);
  }
  if (!arguments.keep_edits) return;
  const auto& keep = *arguments.keep_edits;
  if (goes_to_standard_output(keep))
    throw Failure(Exit::Usage, "--keep-edits goes to a file beside the result; name one.");
  check_writable(keep);
  check_not_read(keep, inputs, "--keep-edits");
  if (std::find(outputs.begin(), outputs.end(), keep) != outputs.end())
    throw Failure(Exit::Usage, "--keep-edits and -o name the same file, " + keep + "; give two.");
}

ifsm::Turning turning_of(const std::string& name) {
  return name == "rotation" ? ifsm::Turning::rotation
         : name == "linear" ? ifsm::Turning::linear
                            : ifsm::Turning::similarity;
}

ifsm::Following follow_of(const std::string& name) {
  return name == "each" ? ifsm::Following::each : name == "none" ? ifsm::Following::none : ifsm::Following::moved;
}

figures::Moment moment_of(const ifsm::Deformer& deformer, const ifsm_model_info& info,
                          const std::vector<Mark>& marks = {}) {
  const std::int64_t handles =
      info.control_points - (info.closed == 1 && info.topology == IFSM_TOPOLOGY_JOINED ? 1 : 0);
  figures::Moment moment{deformer.points(info.levels, 0, info.places), deformer.points(0, 0, handles)};
  if (handles < info.control_points)  // a ring's polygon comes back
    moment.polygon.insert(moment.polygon.end(), moment.polygon.begin(), moment.polygon.begin() + info.dimension);
  for (const auto& mark : marks) {
    const auto place =
        mark.level < 0 ? deformer.evaluate({mark.parameter}) : deformer.points(mark.level, mark.handle, 1);
    auto& all = mark.held ? moment.held : moment.moved;
    all.insert(all.end(), place.begin(), place.end());
  }
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
                    const ifsm_model_info& info, const std::vector<Mark>& marks) {
  const auto before = moment_of(start, info), after = moment_of(end, info, marks);
  const auto frame = figures::frame_of({before, after}, info.dimension, info.closed == 1);
  return figure_of(arguments, before, after, info, frame).bytes(picture_format(arguments.output));
}

std::vector<figures::Moment> moments(const DeformArguments& arguments, const ifsm::Deformer& deformer,
                                     const ifsm_model_info& info, const std::vector<Mark>& marks) {
  const auto told = deformer.describe();
  const int count = *arguments.frames;
  std::vector<figures::Moment> all;
  for (int k = 0; k < count; ++k) {
    const double s = count == 1 ? 1.0 : static_cast<double>(k) / (count - 1);
    all.push_back(
        moment_of(deformer.at_time(k + 1 == count ? told.end : told.begin + s * (told.end - told.begin)), info, marks));
  }
  return all;
}

// The film, or its pictures. A signal ends it on the spot: nothing is written yet.
std::vector<File> film(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& deformer,
                       const ifsm_model_info& info, const std::vector<Mark>& marks) {
  Progress progress("deform", Progress::style_of_terminal(arguments.talk.quiet));
  const auto before = moment_of(start, info);
  const auto all = moments(arguments, deformer, info, marks);
  auto seen = all;
  seen.push_back(before);
  const auto frame = figures::frame_of(seen, info.dimension, info.closed == 1);
  const bool one_file = kind_of(arguments) == Kind::Film;
  const auto paths = outputs_of(arguments);
  std::optional<plot::Animation> animation;
  std::vector<File> files;
  for (std::size_t k = 0; k < all.size(); ++k) {
    progress.update(static_cast<double>(k) / static_cast<double>(all.size()), "frame " + std::to_string(k + 1));
    const auto figure = figure_of(arguments, before, all[k], info, frame);
    if (one_file) {
      if (!animation) animation.emplace(figure.width, figure.height);
      animation->add(figure.pixels(), static_cast<double>(k + 1) / arguments.rate);
    } else {
      files.push_back({paths[k], figure.bytes(picture_format(arguments.output))});
    }
  }
  if (one_file) files.push_back({arguments.output, animation->bytes()});
  progress.update(1, "done");
  return files;
}

File result(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& deformer,
            const ifsm_model_info& info, const std::vector<Mark>& marks) {
  switch (kind_of(arguments)) {
    case Kind::Picture: return {arguments.output, picture(arguments, start, deformer, info, marks)};
    case Kind::Table:
      return {arguments.output, format_csv({coordinate_names(info.dimension), static_cast<std::size_t>(info.dimension),
                                            deformer.samples()},
                                           ',')};
    default: break;
  }
  const auto bytes = deformer.snapshot().save(format_of(arguments.output, arguments.format));
  return {arguments.output, {bytes.begin(), bytes.end()}};
}

// null: too many to be counted.
Json crossings_of(const ifsm::Deformer& deformer) {
  try {
    return deformer.crossings().size();
  } catch (const ifsm::Error& error) {
    if (error.status != IFSM_ERROR_LIMIT) throw;
    return nullptr;
  }
}

Json report_of(const DeformArguments& arguments, const ifsm::Deformer& start, const ifsm::Deformer& deformer,
               const ifsm_model_info& info) {
  Json report{{"model", input_name(arguments.model)},
              {"output", arguments.output},
              {"edits", deformer.describe().edits},
              {"moved", distance(start.samples(), deformer.samples(), info.dimension).max},
              {"size", info.diagonal}};
  if (info.dimension == 2) report["crossings"] = crossings_of(deformer);
  if (arguments.frames) report["frames"] = *arguments.frames;
  return report;
}

std::string in_words(const Json& report) {
  std::string words = report["output"].get<std::string>() + ": " + counted(report["edits"], "edit") +
                      ", samples moved by at most " + rounded(report["moved"]);
  if (report.contains("frames")) words += ", " + counted(report["frames"], "frame");
  if (report.contains("crossings") && report["crossings"] != 0)
    words += "; the curve now crosses itself at " + (report["crossings"].is_null()
                                                         ? std::string("millions of places")
                                                         : counted(report["crossings"], "place") + " more");
  return words + "\n";
}

// A deformer that turns as it is asked to, or as the first edits that are read were made.
ifsm::Deformer deformer_of(const DeformArguments& arguments, const ifsm::Model& model) {
  const auto edits = std::find_if(arguments.bends.begin(), arguments.bends.end(),
                                  [](const Bend& bend) { return bend.option == "edits"; });
  if (edits != arguments.bends.end() && arguments.turning.empty() && arguments.follow.empty() && edits->value != "-") {
    const auto read = read_file(edits->value);
    const std::vector<std::uint8_t> bytes(read.begin(), read.end());
    for (const auto turning : {ifsm::Turning::similarity, ifsm::Turning::rotation, ifsm::Turning::linear})
      for (const auto follow : {ifsm::Following::moved, ifsm::Following::each, ifsm::Following::none}) {
        try {
          ifsm::Deformer(model, turning, follow).replay(bytes);
          return ifsm::Deformer(model, turning, follow);
        } catch (const ifsm::Error& error) {
          if (error.argument != "turning" && error.argument != "follow") return ifsm::Deformer(model, turning, follow);
        }
      }
  }
  return ifsm::Deformer(model, turning_of(arguments.turning), follow_of(arguments.follow));
}

void run(const DeformArguments& arguments) {
  check_arguments(arguments);
  const auto model = load_model(arguments.model);
  const auto info = model.describe();
  const ifsm::Deformer start(model);
  ifsm::Deformer deformer = deformer_of(arguments, model);
  std::vector<Mark> marks;
  for (const auto& [option, value] : arguments.bends)
    for (const auto& mark : bend(deformer, option, value)) marks.push_back(mark);

  std::vector<File> files;
  if (arguments.frames)
    files = film(arguments, start, deformer, info, marks);
  else
    files.push_back(result(arguments, start, deformer, info, marks));
  const auto report = report_of(arguments, start, deformer, info);  // it may fail, and then nothing is written
  if (arguments.keep_edits) {
    const auto kept = deformer.save(format_of(*arguments.keep_edits, ""));
    files.push_back({*arguments.keep_edits, {kept.begin(), kept.end()}});
  }
  if (files.size() == 1)
    write_file(files.front().path, files.front().bytes);
  else
    write_files(files, Existing::Replaced);
  tell_report(
      arguments.talk, arguments.output, [&] { return report; }, in_words);
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

void add_deform(CLI::App& program, Session&) {
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
  command->add_option("--turning", a.turning, "What details follow: similarity (default), rotation, linear (paper 002)")
      ->check(one_of({"similarity", "rotation", "linear"}));
  command->add_option("--follow", a.follow, "Whose turn they take: moved nodes' (default), each their own, none")
      ->check(one_of({"moved", "each", "none"}));
  command->add_option("--frames", a.frames, "So many pictures, from the first edit's begin to the last one's end")
      ->transform(whole_number(1, most_frames));
  command->add_option("--rate", a.rate, "Frames a second of an animation")
      ->check(number_between("0.01", "1000"))
      ->capture_default_str();
  command->add_option("--width", a.size.width, "Pixels of a picture")->transform(whole_number(least_size, most_size));
  command->add_option("--height", a.size.height, "Pixels")->transform(whole_number(least_size, most_size));
  command->add_option("--title", a.title, "Words above the picture");
  command->add_option("--keep-edits", a.keep_edits, "Write the edits as well, to be made again (.json, else CBOR)");
  command->add_option("--format", a.format, "Write a model, as json or cbor, whatever its name")
      ->check(one_of({"json", "cbor"}));
  add_talk(*command, a.talk);
  command->footer(
      "Edits are made in the order in which they stand. Bending wants a model made with --filter casteljau; under "
      "coast\n"
      "and fitted filters, smooth parts tear.\n\n"
      "Examples:\n"
      "  ifsm deform coast.ifsm --move 2:+10,4 -o bent.ifsm\n"
      "  ifsm deform coast.ifsm --move-at '0.31:+0,25@3' --scale-details 1.5@last2 -o bent.png\n"
      "  ifsm deform coast.ifsm --move 5/12:+20,0@smooth=8 --texture random=0.6,7@last3 -o bent.csv\n"
      "  ifsm deform coast.ifsm --during 0,2 --move 2:+80,0 --during 1,3 --scale-details 0@last4 --frames 75 -o "
      "bend.webp\n");
  command->callback([arguments, command, names] {
    arguments->bends = bends_of(*command, names);
    run(*arguments);
  });
}

}  // namespace cli
