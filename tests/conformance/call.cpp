#include "call.h"

#include <algorithm>
#include <stdexcept>

namespace conformance {

const Function& function(const std::string& name) {
  for (const Function& one : functions())
    if (one.name == name) return one;
  throw std::runtime_error("no function " + name);
}

ifsm_status Call::run(const std::string& as) {
  ifsm_status status = function_.call(*this);
  if (status == IFSM_OK && !outputs_.empty()) {
    for (auto& [name, output] : outputs_) output.resize(output.count);
    status = function_.call(*this);
  }
  if (status == IFSM_OK && keep_ != nullptr) keep_(as);
  return status;
}

Json Call::results() const {
  Json results = Json::object();
  if (!returned_.is_null()) results["result"] = returned_;
  for (const Parameter& parameter : function_.parameters)
    if (const auto writer = writers_.find(parameter.name); writer != writers_.end())
      results[parameter.name] = writer->second();
  return results;
}

Json Call::error(const std::string& function) {
  ifsm_error told{};
  told.struct_size = sizeof told;
  if (ifsm_last_error(&told) != IFSM_OK || told.function != function)
    throw std::runtime_error(function + " failed without telling so");
  return {{"status", ifsm_status_name(told.status)},
          {"argument", told.argument},
          {"index", json_of(told.index)},
          {"value", json_of(told.value)},
          {"required", json_of(told.required)}};
}

const double* Call::numbers(const Json& value, std::int64_t& count) {
  if (value.is_null()) return nullptr;
  std::vector<double>& read_here = numbers_.emplace_back();
  read(value, read_here);
  count = static_cast<std::int64_t>(read_here.size());
  return read_here.data();
}

ifsm_curve Call::read_curve(const Json& given) {
  ifsm_curve curve{};
  curve.points = numbers(given.at("points"), curve.count);
  curve.dimension = given.at("dimension").get<std::int32_t>();
  curve.count /= curve.dimension;
  curve.closed = given.at("closed").get<bool>() ? 1 : 0;
  return curve;
}

const ifsm_curve* Call::curve(const char* name) {
  if (argument(name).is_null()) return nullptr;
  auto& curve = stored<ifsm_curve>(name);
  curve = read_curve(argument(name));
  return &curve;
}

const ifsm_curve* Call::curves(const char* name) {
  auto& curves = stored<std::vector<ifsm_curve>>(name);
  curves.clear();
  for (const Json& given : argument(name).at("curves")) curves.push_back(read_curve(given));
  return curves.data();
}

ifsm_bindings::KnownSamples Call::known(const char* name) {
  auto& kinds = stored<std::deque<std::vector<std::int32_t>>>(std::string(name) + " kinds");
  auto& samples = stored<std::vector<ifsm_fit_samples>>(name);
  samples.clear();
  for (const Json& given : argument(name).at("known")) {
    ifsm_fit_samples known{};
    known.parameters = numbers(given.at("parameters"), known.parameter_count);
    known.weights = numbers(given.at("weights"), known.weight_count);
    known.covariances = numbers(given.at("covariances"), known.covariance_count);
    std::int64_t values = 0;
    known.constraint_parameters = numbers(given.at("constraint_parameters"), known.constraint_count);
    known.constraint_values = numbers(given.at("constraint_values"), values);
    if (!given.at("constraint_kinds").is_null()) read(given.at("constraint_kinds"), kinds.emplace_back());
    known.constraint_kinds = known.constraint_count == 0 ? nullptr : kinds.back().data();
    known.fixed_ends = given.at("fixed_ends").get<bool>() ? 1 : 0;
    samples.push_back(known);
  }
  return {samples.data(), static_cast<std::int64_t>(samples.size())};
}

}  // namespace conformance
