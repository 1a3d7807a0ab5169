// ifsm render: pictures and points of a system.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <memory>
#include <numbers>
#include <optional>

#include "commands/command.h"
#include "commands/values.h"
#include "failure.h"
#include "files.h"
#include "image.h"
#include "progress.h"
#include "systems.h"

namespace cli {
namespace {

struct RenderArguments {
  std::string system;
  std::optional<std::string> name;
  std::string output;
  std::string format;
  std::optional<int> size;
  std::vector<double> window;
  std::string colour = "tone", palette = "dusk", background = "none";
  double azimuth = 35, elevation = 25, field = 30;  // degrees
  std::optional<std::int64_t> points;
  ifsm::PictureOptions options;
  std::vector<const CLI::Option*> of_pictures;
  Talk talk;
};

const std::vector<std::string> colours{"tone", "symbol", "address", "set", "distance"};
const std::vector<std::string> palettes{"dusk", "sea", "fern", "ember", "ink"};
constexpr std::int64_t usual_points = 100000;  // of a file of points

template <class Enum>
Enum number_of(const std::vector<std::string>& words, const std::string& word) {
  return static_cast<Enum>(std::find(words.begin(), words.end(), word) - words.begin());
}

std::string format_of(const RenderArguments& arguments) {
  std::string format = arguments.format;
  if (format.empty())
    for (const char* known : {"png", "ply", "csv"})
      if (arguments.output.ends_with(std::string(".") + known)) format = known;
  if (format.empty())
    throw Failure(Exit::Usage, "-o " + arguments.output + " ends in none of .png, .ply and .csv; add --format.");
  return format;
}

// "#rgb", "#rrggbb", "#rrggbbaa", "white", "black", "none".
std::uint32_t colour_code(const std::string& given) {
  std::string text = given;
  if (text.size() == 4 && text.front() == '#') text = {'#', text[1], text[1], text[2], text[2], text[3], text[3]};
  if (text == "none") return 0;
  if (text == "white") return 0xffffffff;
  if (text == "black") return 0x000000ff;
  const bool right = (text.size() == 7 || text.size() == 9) && text.front() == '#' &&
                     text.find_first_not_of("0123456789abcdefABCDEF", 1) == text.npos;
  if (!right)
    throw Failure(Exit::Usage,
                  "--background: '" + text + "' is no colour; give #rgb, #rrggbb, #rrggbbaa, white, black or none.");
  const auto code = static_cast<std::uint32_t>(std::stoul(text.substr(1), nullptr, 16));
  return text.size() == 9 ? code : code << 8 | 0xff;
}

// A job that signals cancel, and a bar.
class Job {
 public:
  Job(Session& session, const RenderArguments& arguments)
      : cancellable_(session.interrupt), progress_("render", Progress::style_of_terminal(arguments.talk.quiet)) {}

  // What is computed takes that part of the time.
  void attach(ifsm::PictureOptions& options, double part) {
    options.cancel = &cancellable_.token();
    options.progress = [this, part](double fraction, const std::string& stage) {
      progress_.update(part * fraction, stage);
      return false;
    };
    written_from_ = part;
  }
  // And what is written, the rest.
  void tell_written(double fraction) {
    confirm();
    progress_.update(written_from_ + (1 - written_from_) * fraction, "PNG");
  }
  void confirm() const { cancellable_.confirm(); }

 private:
  double written_from_ = 1;
  Interrupt::Cancellable cancellable_;
  Progress progress_;
};

ifsm::PictureOptions options_of(const RenderArguments& arguments) {
  constexpr double degree = std::numbers::pi / 180;
  ifsm::PictureOptions options = arguments.options;
  if (arguments.size) options.width = options.height = *arguments.size;
  if (!arguments.window.empty()) {
    if (arguments.window.size() != 4)
      throw Failure(Exit::Usage, "--window has " + counted(arguments.window.size(), "number") +
                                     "; give four: left,bottom,right,top.");
    options.left = arguments.window[0], options.bottom = arguments.window[1];
    options.right = arguments.window[2], options.top = arguments.window[3];
    if (!(options.right > options.left && options.top > options.bottom))
      throw Failure(Exit::Usage, "--window: left,bottom,right,top is " + shortest(options.left) + "," +
                                     shortest(options.bottom) + "," + shortest(options.right) + "," +
                                     shortest(options.top) + "; give numbers with left < right and bottom < top.");
  }
  options.colour = number_of<ifsm::Colour>(colours, arguments.colour);
  options.palette = number_of<ifsm::Palette>(palettes, arguments.palette);
  options.background = colour_code(arguments.background);
  options.azimuth = arguments.azimuth * degree;
  options.elevation = arguments.elevation * degree;
  options.field = arguments.field * degree;
  // All three zero mean the library's own view.
  if (options.azimuth == 0 && options.elevation == 0 && options.field == 0) options.azimuth = 360 * degree;
  if (arguments.points) options.points = *arguments.points;
  return options;
}

struct Result {
  std::string bytes;
  Json report;
};

// What the system itself is to blame for: no attractor; or, of space, what only the plane has.
void refuse_system(const ifsm::Error& error, const RenderArguments& arguments) {
  if (error.argument == "window" || error.argument == "right" || error.argument == "top" || error.argument == "left" ||
      error.argument == "bottom")
    throw Failure(Exit::Usage, std::string("--window: ") + error.what());
  if (error.argument == "tolerance") throw Failure(Exit::Usage, std::string("--tolerance: ") + error.what());
  if (error.argument != "system") return;
  if (error.status == IFSM_ERROR_SHAPE)
    throw Failure(Exit::Usage, "--colour " + arguments.colour + ": " + error.what());
  if (error.status == IFSM_ERROR_RANGE || error.status == IFSM_ERROR_NUMERICAL)
    throw Failure(Exit::Input, arguments.system + ": " + error.what());
}

// Proven: the attractor's box lies beside the window.
bool misses(const ifsm::System& system, const ifsm_picture_report& window) {
  if (system.describe().dimension != 2) return false;
  const auto box = system.box();
  return box[0] > window.right || box[2] < window.left || box[1] > window.top || box[3] < window.bottom;
}

Result picture(const ifsm::System& system, ifsm::PictureOptions options, Job& job) {
  constexpr double drawn_part = .75;  // of the time of a large picture with the usual number of points
  job.attach(options, drawn_part);
  const auto drawn = system.render(options);
  const auto& told = drawn.report;
  return {png_of(drawn.values, told.width, told.height, [&](double fraction) { job.tell_written(fraction); }),
          {{"misses", told.inside == 0 && told.met == 0 && misses(system, told)},
           {"width", told.width},
           {"height", told.height},
           {"window", {told.left, told.bottom, told.right, told.top}},
           {"points", told.points},
           {"inside", told.inside},
           {"met", told.met},
           {"undecided", told.undecided}}};
}

Result points(const ifsm::System& system, ifsm::PictureOptions options, const std::string& format,
              const std::string& title, Job& job) {
  job.attach(options, 1);
  if (options.points == 0) options.points = usual_points;
  const int dimension = system.describe().dimension;
  auto values = system.sample(options);
  const Json report{{"points", options.points}, {"dimension", dimension}};
  if (format == "ply")
    return {
        ply_of(values, dimension, system.sample_addresses(1, options), "points of " + printable(title) + ", by ifsm"),
        report};
  Table table;
  table.names = dimension == 2 ? std::vector<std::string>{"x", "y"} : std::vector<std::string>{"x", "y", "z"};
  table.columns = static_cast<std::size_t>(dimension);
  table.values = std::move(values);
  return {format_csv(table), report};
}

std::string in_words(const Json& report) {
  const std::string output = report["output"].get<std::string>() + ": ";
  const std::string size = "; " + report["bytes"].dump() + " bytes of " + report["format"].get<std::string>() + "\n";
  if (!report.contains("window")) return output + report["points"].dump() + " points" + size;
  const auto end = [&](std::size_t k) { return report["window"][k].get<double>(); };
  // So many digits that the ends differ.
  const auto side = [&](std::size_t k) {
    const double width = end(k % 2 + 2) - end(k % 2), far = std::max(std::abs(end(k % 2)), std::abs(end(k % 2 + 2)));
    return rounded(end(k), std::clamp(4 + static_cast<int>(std::log10(far / width)), 4, 17));
  };
  std::string words = output + report["width"].dump() + " x " + report["height"].dump() + " pixels, x from " + side(0) +
                      " to " + side(2) + ", y from " + side(1) + " to " + side(3);
  if (report["points"] != 0)
    words += "; " + report["inside"].dump() + " of " + report["points"].dump() + " points inside";
  if (report["met"] != 0 || report["undecided"] != 0)
    words += "; of the computed ones " + report["met"].dump() + " met, " + report["undecided"].dump() + " undecided";
  if (report["misses"] == true) words += ": the window misses the attractor";
  return words + size;
}

// Options that say how a picture looks, beside an output that has none.
void refuse_idle_options(const RenderArguments& arguments, const std::string& format) {
  for (const CLI::Option* option : arguments.of_pictures)
    if (option->count() > 0 && format != "png")
      throw Failure(Exit::Usage,
                    option->get_name() + " is of pictures, and " + arguments.output + " holds points; leave it out.");
  const auto idle = [&](const char* name, bool counts, const std::string& with) {
    for (const CLI::Option* option : arguments.of_pictures)
      if (option->check_name(name) && option->count() > 0 && !counts)
        throw Failure(Exit::Usage, std::string(name) + " goes with --colour " + with + "; leave it out.");
  };
  const std::string& colour = arguments.colour;
  idle("--symbols", colour == "address", "address");
  idle("--tolerance", colour == "set" || colour == "distance", "set or distance");
  const bool draws_points = colour != "set" && colour != "distance";
  for (const auto& [name, given] :
       {std::pair("--points", arguments.points.has_value()), std::pair("--seed", arguments.options.seed != 0)})
    if (given && !draws_points)
      throw Failure(Exit::Usage, std::string(name) + " does not go with --colour " + colour +
                                     ", which draws nothing at random; leave it out.");
}

// Of the plane there is one view.
void refuse_view(const RenderArguments& arguments) {
  for (const CLI::Option* option : arguments.of_pictures)
    for (const char* name : {"--azimuth", "--elevation", "--field"})
      if (option->check_name(name) && option->count() > 0)
        throw Failure(Exit::Usage, std::string(name) + " goes with systems of space, and " + arguments.system +
                                       " is one of the plane; leave it out.");
}

void run(const RenderArguments& arguments, Session& session) {
  refuse_json_beside_result(arguments.talk, arguments.output);
  const std::string format = format_of(arguments);
  refuse_idle_options(arguments, format);
  auto options = options_of(arguments);
  check_writable(arguments.output);
  if (!names_system(arguments.system)) check_not_read(arguments.output, {arguments.system});
  const auto system = load_system(arguments.system, arguments.name);
  if (system.describe().dimension == 2) refuse_view(arguments);
  const std::string title = title_of_system(arguments.system, arguments.name);
  Result result;
  try {
    Job job(session, arguments);
    result = format == "png" ? picture(system, options, job) : points(system, options, format, title, job);
    job.confirm();
  } catch (const ifsm::Error& error) {
    refuse_system(error, arguments);
    throw;
  }
  write_file(arguments.output, result.bytes);
  const auto report = [&] {
    Json whole{{"system", title}, {"output", arguments.output}, {"format", format}, {"bytes", result.bytes.size()}};
    whole.update(result.report);
    return whole;
  };
  tell_report(arguments.talk, arguments.output, report, in_words);
}

}  // namespace

void add_render(CLI::App& program, Session& session) {
  auto* command = program.add_subcommand("render", "Draw a system, or write points of it");
  auto arguments = std::make_shared<RenderArguments>();
  auto& a = *arguments;
  command->add_option("system", a.system, "A system's name, e.g. fern, or a file; - is standard input")->required();
  command->add_option("-o,--output", a.output, "What to write: .png, or points as .ply or .csv; - is standard output")
      ->required();
  command->add_option("--name", a.name, "Which of a file of several");
  auto* size = command->add_option("--size", a.size, "Pixels along both sides (default 1024)")
                   ->transform(whole_number(1, 32768));
  command->add_option("--width", a.options.width, "Pixels")->transform(whole_number(1, 32768))->excludes(size);
  command->add_option("--height", a.options.height, "Pixels (default: as wide)")
      ->transform(whole_number(1, 32768))
      ->excludes(size);
  command->add_option("--window", a.window, "left,bottom,right,top (default: around the attractor)")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--colour,--color", a.colour,
                   "tone: how dense, or in space how near; symbol: by piece; address: by address; set: met for "
                   "certain; distance")
      ->check(one_of(colours))
      ->capture_default_str();
  command->add_option("--palette", a.palette, "dusk, sea, fern, ember, ink")
      ->check(one_of(palettes))
      ->capture_default_str();
  command->add_option("--symbols", a.options.symbols, "Of addresses, so many symbols (default: all)")
      ->transform(whole_number(1, 16));
  command->add_option("--background", a.background, "#rgb, #rrggbb, #rrggbbaa, white, black")->capture_default_str();
  command
      ->add_option("--points", a.points,
                   "Points to play (default: enough for 16 a pixel, in space 32; of a file 100000)")
      ->transform(whole_number(1, std::uint64_t{1} << 50));
  command->add_option("--seed", a.options.seed, "Another seed, other points")
      ->transform(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->capture_default_str();
  command->add_option("--oversample", a.options.oversample, "Pixels computed for each, along both sides (default 2)")
      ->transform(whole_number(1, 8));
  command->add_option("--tolerance", a.options.tolerance, "Of sets and distances, in pixels")
      ->check(number_between("0", "1"));
  command->add_option("--azimuth", a.azimuth, "Space: degrees about the z axis")
      ->check(number_between("-360", "360"))
      ->capture_default_str();
  command->add_option("--elevation", a.elevation, "Space: degrees above the xy plane")
      ->check(number_between("-360", "360"))
      ->capture_default_str();
  command->add_option("--field", a.field, "Space: the angle of view in degrees; 0 for parallel lines")
      ->check(number_between("0", "170"))
      ->capture_default_str();
  command->add_option("--format", a.format, "png, ply or csv (default: as the name ends)")
      ->check(one_of({"png", "ply", "csv"}));
  for (const char* name : {"--size", "--width", "--height", "--window", "--colour", "--palette", "--symbols",
                           "--background", "--oversample", "--tolerance", "--azimuth", "--elevation", "--field"})
    a.of_pictures.push_back(command->get_option(name));
  add_talk(*command, a.talk);
  command->footer(
      "Examples:\n"
      "  ifsm render fern -o fern.png\n"
      "  ifsm render dragon --colour address --palette sea --background white -o dragon.png\n"
      "  ifsm render fern --window 0,2,2,4 --size 2048 -o part.png\n"
      "  ifsm render sponge --azimuth 50 --elevation 30 -o sponge.png\n"
      "  ifsm render sponge --points 1000000 -o sponge.ply\n");
  command->callback([arguments, &session] { run(*arguments, session); });
}

}  // namespace cli
