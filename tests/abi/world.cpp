#include "world.h"

#include <algorithm>
#include <cstring>
#include <set>
#include <stdexcept>

namespace misuse {
namespace {

constexpr std::uint8_t canary = 0xA5;
constexpr std::size_t guard = 64;  // bytes behind each output
constexpr std::int32_t control_points = 3;
constexpr std::int32_t maps = 2;

void must(ifsm_status status, const char* what) {
  if (status == IFSM_OK) return;
  ifsm_error error{};
  error.struct_size = sizeof error;
  const bool told = ifsm_last_error(&error) == IFSM_OK;
  throw std::runtime_error(std::string(what) + ": " + (told ? error.message : "?"));
}

// An array of the library, asked for its size first.
template <class T, class Read>
std::vector<T> read(Read function) {
  std::int64_t count = 0;
  must(function(nullptr, 0, &count), "count");
  std::vector<T> values(static_cast<std::size_t>(count));
  must(function(values.data(), count, &count), "values");
  return values;
}

template <class T>
std::vector<std::uint8_t> bytes_of(const T* values, std::size_t count) {
  std::vector<std::uint8_t> bytes(count * sizeof(T));
  if (count > 0) std::memcpy(bytes.data(), values, bytes.size());
  return bytes;
}

}  // namespace

bool is_array_in(const std::string& kind) {
  return kind == "doubles_in" || kind == "ints_in" || kind == "int64s_in" || kind == "bytes_in" || kind == "uints_in";
}
bool is_array_out(const std::string& kind) {
  return kind == "doubles_out" || kind == "ints_out" || kind == "uints_out" || kind == "bytes_out";
}
bool is_output(const std::string& kind) {
  static const std::set<std::string> kinds = {"handle_out", "struct_out", "options_out",
                                              "count_out",  "double_out", "int_out"};
  return is_array_out(kind) || kinds.contains(kind);
}

World::World() {
  std::vector<double>& samples = doubles_["samples"];
  // The way back crosses the way there.
  for (int k = 0; k < 17; ++k)
    samples.insert(samples.end(), {k < 12 ? 1.0 * k : 23.0 - k, static_cast<double>((k * k) % 7)});
  doubles_["polygon"] = {0, 0, 1, 2, 3, 1};
  doubles_["parameters"] = {0, 0.25, 0.5, 1};
  doubles_["two_parameters"] = {0.25, 0.75};
  doubles_["vectors"] = {0.5, 1, -0.25, 2};
  ints_["symbols"] = {0, 1, 1};
  wide_ints_["handles"] = {1, 2};

  ifsm_filter filter{};
  must(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, control_points, maps, &filter), "filter");
  ids_["ifsm_filter"] = filter.id;
  std::vector<double>& matrix = doubles_["R"];
  matrix = read<double>(
      [&](double* to, std::int64_t room, std::int64_t* count) { return ifsm_filter_matrix(filter, to, room, count); });
  const std::size_t rows = (control_points - 1) * maps + 1;
  doubles_["C"].assign(matrix.begin(), matrix.begin() + control_points * rows);  // joined: the first n rows of R

  ifsm_model model{};
  const ifsm_curve samples_curve = curve();
  must(ifsm_model_create(filter, &samples_curve, nullptr, &model), "model");
  ids_["ifsm_model"] = model.id;
  doubles_["control_points"] = read<double>([&](double* to, std::int64_t room, std::int64_t* count) {
    return ifsm_model_control_points(model, to, room, count);
  });
  doubles_["details"] = read<double>([&](double* to, std::int64_t room, std::int64_t* count) {
    return ifsm_model_details(model, 1, IFSM_FRAME_ABSOLUTE, to, room, count);
  });
  saved_ = read<std::uint8_t>([&](std::uint8_t* to, std::int64_t room, std::int64_t* count) {
    return ifsm_model_save(model, IFSM_FORMAT_JSON, to, room, count);
  });
  ifsm_model_info info{};
  info.struct_size = sizeof info;
  must(ifsm_model_describe(model, &info), "info");
  numbers_ = {{"L", info.levels}, {"L-1", info.levels - 1}, {"curves-1", 0}, {"budgets-1", 0}};
  numbers_["H-1"] = 4;  // handles of level 1

  doubles_["maps"] = {.5, 0, 0, 0, .5, 0, .5, 0, .5, 0, .5, 0, .5, 0, 0, 0, .5, .5};  // the gasket's
  doubles_["map_parameters"] = {0, .5, .5, 0, 0, 0, 0, .5, .5, 0, .5, 0, 0, .5, .5, 0, 0, .5};
  doubles_["probabilities"] = {1, 2, 1};
  doubles_["place"] = {.25, .25};
  ids_["ifsm_system"] = fresh("ifsm_system");
  const double growing[] = {0, 4, 0, 0, 0, 0, 0, 0, 0, .5, 0, 0};  // by a word of two
  ifsm_system refuted{};
  must(ifsm_system_create(2, growing, 12, nullptr, 0, &refuted), "refuted system");
  refuted_ = refuted.id;
  system_file_ = read<std::uint8_t>([&](std::uint8_t* to, std::int64_t room, std::int64_t* count) {
    return ifsm_system_save({id("ifsm_system")}, IFSM_FORMAT_FRACTINT, "gasket", to, room, count);
  });
  std::int64_t systems = 0;
  ifsm_system_entry entry{};
  entry.struct_size = sizeof entry;
  while (ifsm_system_catalog(systems, &entry) == IFSM_OK) ++systems;
  numbers_["systems-1"] = systems - 1;

  ids_["ifsm_cancel"] = fresh("ifsm_cancel");
  ids_["ifsm_fit"] = fresh("ifsm_fit");
  ids_["ifsm_deformer"] = fresh("ifsm_deformer");
  edits_ = read<std::uint8_t>([&](std::uint8_t* to, std::int64_t room, std::int64_t* count) {
    return ifsm_deformer_save({id("ifsm_deformer")}, IFSM_FORMAT_CBOR, to, room, count);
  });
}

World::~World() {
  for (const auto& [type, id] : ids_) static_cast<void>(destroy(type, id));
  static_cast<void>(destroy("ifsm_system", refuted_));
}

std::uint64_t World::fresh(const std::string& type) const {
  if (type == "ifsm_cancel") {
    ifsm_cancel made{};
    must(ifsm_cancel_create(&made), "cancel");
    return made.id;
  }
  if (type == "ifsm_filter") {
    ifsm_filter made{};
    must(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, control_points, maps, &made), "filter");
    return made.id;
  }
  if (type == "ifsm_model") {
    ifsm_model made{};
    must(ifsm_model_with_filter({id("ifsm_model")}, {id("ifsm_filter")}, &made), "model");
    return made.id;
  }
  if (type == "ifsm_deformer") return deformer();
  if (type == "ifsm_system") {
    ifsm_system made{};
    must(ifsm_system_create(2, doubles("maps").data(), 18, nullptr, 0, &made), "system");
    return made.id;
  }
  ifsm_fit made{};
  const ifsm_curve one = curve();
  ifsm_fit_curve_options options;  // the stage that every question about a fit can be asked
  must(ifsm_fit_curve_options_init(&options, sizeof options), "options");
  options.control_points = control_points;
  options.iterations = 1;
  must(ifsm_fit_curve(&one, 1, &options, &made), "fit");
  return made.id;
}

// With something to undo, something to make again, and a state that is kept.
std::uint64_t World::deformer() const {
  ifsm_deformer made{};
  must(ifsm_deformer_create({id("ifsm_model")}, nullptr, &made), "deformer");
  const std::int64_t handle = 1;
  const double by[] = {-40, 30};  // across other parts of the curve
  for (int edit = 0; edit < 2; ++edit) must(ifsm_deformer_move(made, 1, &handle, 1, by, 2, nullptr), "move");
  must(ifsm_deformer_keep_as(made, "kept"), "keep");
  must(ifsm_deformer_undo(made), "undo");
  return made.id;
}

ifsm_status World::destroy(const std::string& type, std::uint64_t id) {
  if (type == "ifsm_deformer") return ifsm_deformer_destroy({id});
  if (type == "ifsm_cancel") return ifsm_cancel_destroy({id});
  if (type == "ifsm_filter") return ifsm_filter_destroy({id});
  if (type == "ifsm_model") return ifsm_model_destroy({id});
  if (type == "ifsm_system") return ifsm_system_destroy({id});
  return ifsm_fit_destroy({id});
}

const std::vector<std::uint8_t>& World::saved(const std::string& what) const {
  if (what == "edits") return edits_;
  return what == "system" ? system_file_ : saved_;
}

std::int64_t World::number(const std::string& word) const {
  const auto found = numbers_.find(word);
  return found != numbers_.end() ? found->second : std::stoll(word);
}

ifsm_curve World::curve() const { return {doubles("samples").data(), 17, 2, 0}; }
ifsm_curve World::polygon() const { return {doubles("polygon").data(), control_points, 2, 0}; }

Call::Call(const World& world, const Function& function)
    : world_(world),
      function_(function),
      arguments_(function.parameters.size()),
      buffers_(arguments_.size()),
      elements_(arguments_.size()) {
  for (std::size_t i = 0; i < arguments_.size(); ++i) prepare(i);
  // Output arrays have room for exactly what is told, when asked with NULL and 0.
  for (std::size_t i = 0; i < arguments_.size(); ++i) {
    if (!is_array_out(function.parameters[i].kind)) continue;
    if (run() != IFSM_OK) throw std::runtime_error(function.name + " does not tell how much it wants to write");
    std::memcpy(&elements_[i], arguments_[i + 2].pointer, sizeof elements_[i]);  // array, capacity, count
    elements_[i + 1] = elements_[i];
    arguments_[i + 1].integer = elements_[i];
    buffers_[i].assign(static_cast<std::size_t>(elements_[i]) * function.parameters[i].size + guard, canary);
    arguments_[i].pointer = buffers_[i].data();
  }
  fill();
}

Call::~Call() {
  for (std::size_t i = 0; i < arguments_.size(); ++i)
    if (const Parameter& parameter = function_.parameters[i]; is_own(parameter))
      static_cast<void>(World::destroy(parameter.type, arguments_[i].id));
}

// What a call ends or changes is made for it alone.
bool Call::is_own(const Parameter& parameter) {
  return parameter.kind == "handle" && (parameter.ownership == "destroyed" || parameter.type == "ifsm_deformer");
}

void Call::prepare(std::size_t i) {
  const Parameter& parameter = function_.parameters[i];
  Argument& argument = arguments_[i];
  std::vector<std::uint8_t>& buffer = buffers_[i];
  const std::string& kind = parameter.kind;
  if (kind == "handle") {
    argument.id = is_own(parameter) ? world_.fresh(parameter.type) : world_.id(parameter.type);
    if (parameter.good == "refuted") argument.id = world_.refuted();
  } else if (kind == "enum" || kind == "integer" || kind == "number") {
    argument.integer = std::stoll(parameter.good);
  } else if (kind == "double") {
    argument.real = std::stod(parameter.good);
  } else if (kind == "string" || kind == "name") {
    buffer = bytes_of(parameter.good.c_str(), parameter.good.size() + 1);
  } else if (kind == "doubles_in") {
    const std::vector<double>& values = world_.doubles(parameter.good);
    buffer = bytes_of(values.data(), values.size());
    elements_[i] = static_cast<std::int64_t>(values.size());
  } else if (kind == "ints_in") {
    const std::vector<std::int32_t>& values = world_.ints(parameter.good);
    buffer = bytes_of(values.data(), values.size());
    elements_[i] = static_cast<std::int64_t>(values.size());
  } else if (kind == "int64s_in") {
    const std::vector<std::int64_t>& values = world_.wide_ints(parameter.good);
    buffer = bytes_of(values.data(), values.size());
    elements_[i] = static_cast<std::int64_t>(values.size());
  } else if (kind == "uints_in") {
    const std::vector<std::uint32_t> values = {0, 1, 7, 0xffffffff};
    buffer = bytes_of(values.data(), values.size());
    elements_[i] = static_cast<std::int64_t>(values.size());
  } else if (kind == "bytes_in") {
    buffer = world_.saved(parameter.good);
    elements_[i] = static_cast<std::int64_t>(buffer.size());
  } else if (kind == "count") {
    argument.integer = elements_[i] = elements_[i - 1];
  } else if (kind == "size") {
    argument.integer = static_cast<std::int64_t>(function_.parameters[i - 1].size);
  } else if (kind == "struct_in") {
    ifsm_curve curve = parameter.good == "polygon" ? world_.polygon() : world_.curve();
    curve_points_.assign(curve.points, curve.points + curve.count * curve.dimension);
    curve.points = curve_points_.data();
    buffer = bytes_of(&curve, 1);
    elements_[i] = 1;
  } else if (kind == "options_in") {
    buffer.assign(parameter.size + guard, 0);  // room for the tail of a newer header
    const auto size = static_cast<std::uint32_t>(parameter.size);
    std::memcpy(buffer.data(), &size, sizeof size);
    if (parameter.type == "ifsm_keep_options") {
      ifsm_keep_options options{};
      options.struct_size = size, options.rule = IFSM_KEEP_COUNT, options.count = 2;
      std::memcpy(buffer.data(), &options, sizeof options);
    } else if (parameter.type == "ifsm_fit_options") {
      ifsm_fit_options options{};
      options.struct_size = size, options.control_points = control_points, options.iterations = options.rounds = 1;
      options.polish = -1;  // none
      std::memcpy(buffer.data(), &options, sizeof options);
    } else if (parameter.type == "ifsm_train_options") {
      ifsm_train_options options{};
      options.struct_size = size, options.control_points = control_points, options.iterations = options.rounds = 1;
      std::memcpy(buffer.data(), &options, sizeof options);
    } else if (parameter.type == "ifsm_picture_options") {
      ifsm_picture_options options{};  // small, and quick
      options.struct_size = size, options.width = 8, options.points = 1000;
      std::memcpy(buffer.data(), &options, sizeof options);
    }
  } else if (is_output(kind) && !is_array_out(kind)) {
    buffer.assign(parameter.size + guard, canary);
  }
  if (!buffer.empty()) argument.pointer = buffer.data();
  if (kind == "struct_out") {
    const auto size = static_cast<std::uint32_t>(parameter.size);
    std::memcpy(buffer.data(), &size, sizeof size);
  }
}

void Call::fill() {
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    const Parameter& parameter = function_.parameters[i];
    if (!is_output(parameter.kind)) continue;
    const std::size_t kept = parameter.kind == "struct_out" ? sizeof(std::uint32_t) : 0;  // struct_size
    std::fill(buffers_[i].begin() + static_cast<std::ptrdiff_t>(kept), buffers_[i].end(), canary);
  }
  before_ = buffers_;
}

bool Call::untouched() const { return before_ == buffers_; }

bool Call::guards_stand() const {
  for (std::size_t i = 0; i < buffers_.size(); ++i)
    if (is_output(function_.parameters[i].kind) && !buffers_[i].empty() &&
        std::any_of(buffers_[i].end() - guard, buffers_[i].end(), [](std::uint8_t byte) { return byte != canary; }))
      return false;
  return true;
}

void Call::forget_handles() {
  for (std::size_t i = 0; i < buffers_.size(); ++i) {
    const Parameter& parameter = function_.parameters[i];
    if (parameter.kind != "handle_out") continue;
    std::uint64_t id = 0;
    std::memcpy(&id, buffers_[i].data(), sizeof id);
    static_cast<void>(World::destroy(parameter.type, id));
  }
}

}  // namespace misuse
