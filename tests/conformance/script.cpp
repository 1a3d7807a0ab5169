#include "script.h"

#include <cmath>
#include <limits>
#include <stdexcept>

namespace conformance {
namespace {

// Functions whose numbers go through the platform's log, exp, cos and so on.
bool uses_libm(const std::string& name) {
  static const std::set<std::string> all = {"ifsm_model_dimension",
                                            "ifsm_model_spectrum",
                                            "ifsm_model_refine",
                                            "ifsm_fit_sparse",
                                            "ifsm_fit_curve",
                                            "ifsm_fit_filter",
                                            "ifsm_deformer_restyle",
                                            "ifsm_deformer_texture",
                                            "ifsm_train",
                                            "ifsm_system_from_parameters",
                                            "ifsm_system_parameters",
                                            "ifsm_system_ball",
                                            "ifsm_system_diameter",
                                            "ifsm_system_similarity_dimension",
                                            "ifsm_system_box_dimension"};
  return all.contains(name);
}

[[noreturn]] void fail(const std::string& name, const Json& arguments, const std::string& what) {
  throw std::runtime_error(name + arguments.dump() + ": " + what);
}

Json with(Json array, std::size_t at, const Json& value) {
  array.at(at) = value;
  return array;
}

Json shorter(Json array) {
  array.erase(array.size() - 1);
  return array;
}

const Json not_finite[] = {"nan", "-inf"};

}  // namespace

Json handle(const std::string& name) { return {{"handle", name}}; }
Json text(const std::string& text) { return {{"text", text}}; }
Json real(double number) { return json_of(number); }
Json reals(const std::vector<double>& numbers) { return json_of(numbers); }
Json wide(const std::vector<std::int64_t>& numbers) {
  Json list = Json::array();
  for (const std::int64_t number : numbers) list.push_back(json_of(number));
  return {{"int64", list}};
}
Json symbols(const std::vector<std::int32_t>& numbers) { return json_of(numbers); }
Json output(const char* type) { return {{"output", type}}; }
Json curve(const std::vector<double>& points, int dimension, bool closed) {
  return {{"points", reals(points)}, {"dimension", dimension}, {"closed", closed}};
}
Json curves(std::initializer_list<Json> curves) { return {{"curves", std::vector<Json>(curves)}}; }

std::vector<double> walk() {
  std::vector<double> points;
  for (int k = 0; k < 17; ++k)
    points.insert(points.end(), {k < 12 ? 1.0 * k : 23.0 - k, static_cast<double>((k * k) % 7)});
  return points;
}

Json Script::right(const std::string& name, Json arguments, const std::string& as) {
  const Function& called = function(name);
  check_order(called, arguments);
  Json step = {{"call", name}};
  if (!as.empty()) step["as"] = as;
  if (depends_on_libm(name, arguments, as)) step["libm"] = true;
  step["arguments"] = arguments;
  Call call(called, arguments, objects_);
  if (call.run(as) != IFSM_OK) fail(name, arguments, Call::error(name).dump());
  Json results = call.results();
  step["results"] = results;
  steps_.push_back(std::move(step));
  return results;
}

void Script::wrong(const std::string& name, Json arguments, const Json& instead) {
  for (const auto& [parameter, value] : instead.items()) arguments.at(parameter) = value;
  const Function& called = function(name);
  check_order(called, arguments);
  Call call(called, arguments, objects_);
  if (call.run("unexpected") == IFSM_OK) fail(name, arguments, "is not refused");
  steps_.push_back({{"call", name}, {"arguments", arguments}, {"error", Call::error(name)}});
}

void Script::wrongs(const std::string& name, const Json& arguments, const std::set<std::string>& except) {
  for (const Parameter& parameter : function(name).parameters) {
    if (!arguments.contains(parameter.name) || except.contains(parameter.name)) continue;
    for (const Json& value : wrong_values(parameter, arguments.at(parameter.name)))
      wrong(name, arguments, {{parameter.name, value}});
  }
}

void Script::release(const std::string& name) {
  objects_.release(name);
  steps_.push_back({{"release", name}});
}

// Languages call by position: arguments are all there, and in the parameters' order.
void Script::check_order(const Function& function, const Json& arguments) const {
  auto given = arguments.begin();
  for (const Parameter& parameter : function.parameters) {
    if (parameter.kind == "made" || parameter.kind == "told") continue;
    if (given == arguments.end() || given.key() != parameter.name)
      fail(function.name, arguments, parameter.name + " is missing");
    ++given;
  }
  if (given != arguments.end()) fail(function.name, arguments, "takes no " + given.key());
}

// A deformer that was edited through libm stays so; so does what is made of inexact objects.
bool Script::depends_on_libm(const std::string& name, const Json& arguments, const std::string& as) {
  bool inexact = uses_libm(name);
  for (const Json& value : arguments)
    inexact |= value.is_object() && value.contains("handle") && inexact_.contains(value.at("handle"));
  if (!inexact) return false;
  if (!as.empty()) inexact_.insert(as);
  if (arguments.contains("deformer")) inexact_.insert(arguments.at("deformer").at("handle"));
  return true;
}

std::vector<Json> Script::wrong_values(const Parameter& parameter, const Json& right) const {
  const std::string& kind = parameter.kind;
  std::vector<Json> values;
  if (kind == "handle" && parameter.null == "refused") values.push_back(nullptr);
  if (kind == "int32" || kind == "int64") values = wrong_integers(parameter);
  if (kind == "real") values.assign(std::begin(not_finite), std::end(not_finite));
  if (kind == "text") values = {text("no such name"), text("")};
  if (kind == "doubles") {
    values = {with(right, right.size() / 2, "nan"), with(right, right.size() - 1, "-inf")};
    if (is_limit(parameter.low)) values.push_back(with(right, right.size() - 1, real(-0.25)));
    if (is_limit(parameter.high)) values.push_back(with(right, right.size() - 1, real(1.25)));
    if (parameter.name != "parameters") values.push_back(shorter(right));
  }
  if (kind == "int32s" || kind == "int64s") {
    const char* tag = kind == "int32s" ? "int32" : "int64";
    if (is_limit(parameter.low))
      values.push_back({{tag, with(right.at(tag), right.at(tag).size() - 1, limit(parameter.low) - 1)}});
    if (is_limit(parameter.high)) values.push_back({{tag, with(right.at(tag), 0, limit(parameter.high) + 1)}});
  }
  if (kind == "curve" || kind == "curves") {
    const Json& one = kind == "curve" ? right : right.at("curves").at(0);
    const Json& points = one.at("points");
    std::vector<Json> wrong_curves;
    wrong_curves.push_back(one);
    wrong_curves.back().at("points") = with(points, points.size() / 2, "nan");
    wrong_curves.push_back(curve({1, 2}));
    wrong_curves.push_back(curve(std::vector<double>(15, 1.0), 5));
    for (const Json& wrong : wrong_curves) values.push_back(kind == "curve" ? wrong : curves({wrong}));
    if (kind == "curves") values.push_back(curves({}));
    if (kind == "curves") values.push_back(curves({one, curve({0, 1, 2, 3, 4, 3, 2, 1, 0, 1, 2}, 1)}));
  }
  if (kind == "bytess") {
    const auto hex = right.at("bytes").get<std::string>();
    for (const std::string& wrong :
         {std::string(), std::string("7b7d"), std::string("ff"), hex.substr(0, hex.size() / 4 * 2)})
      values.push_back({{"bytes", wrong}});
  }
  if (kind == "output") values.push_back({{"output", right.at("output")}, {"capacity", 1}});
  return values;
}

// Next to the limits, and one as far out as the type goes.
std::vector<Json> Script::wrong_integers(const Parameter& parameter) const {
  using Narrow = std::numeric_limits<std::int32_t>;
  using Wide = std::numeric_limits<std::int64_t>;
  const bool narrow = parameter.kind == "int32";
  std::vector<Json> values;
  if (is_limit(parameter.low)) values.push_back(json_of(limit(parameter.low) - 1));
  if (is_limit(parameter.high)) values.push_back(json_of(limit(parameter.high) + 1));
  if (is_limit(parameter.high))
    values.push_back(narrow ? json_of(Narrow::max()) : json_of(Wide::max()));
  else if (is_limit(parameter.low))
    values.push_back(narrow ? json_of(Narrow::min()) : json_of(Wide::min()));
  return values;
}

bool Script::is_limit(const std::string& word) const {
  return numbers_.contains(word) || (!word.empty() && word.find_first_not_of("-0123456789") == std::string::npos);
}

std::int64_t Script::limit(const std::string& word) const {
  const auto found = numbers_.find(word);
  return found != numbers_.end() ? found->second : std::stoll(word);
}

}  // namespace conformance
