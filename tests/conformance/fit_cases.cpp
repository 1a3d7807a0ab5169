// Fits and training, of few iterations: it is what they are told and tell that is tried here.
#include "script.h"

namespace conformance {
namespace {

Json with_watch(Json arguments) {
  arguments["cancel"] = nullptr;
  arguments["progress"] = nullptr;
  return arguments;
}

Json shape() {
  return {{"curves", curves({curve(walk())})}, {"threads", 1}, {"start", nullptr}, {"control_points", 3}, {"maps", 2}};
}

Json sparse() {
  Json fit = shape();
  fit.update({{"budgets", wide({6, 8})}, {"iterations", 1}, {"rounds", -1}, {"polish", 1}, {"distance", 0}});
  fit = with_watch(fit);
  fit["within"] = real(0);
  return fit;
}

Json stage_curve() {
  Json fit = shape();
  fit.update({{"fixed_filter", 0},
              {"parameters", 0},
              {"reparameterise", 0},
              {"loss", 0},
              {"loss_scale", real(0)},
              {"levels", 0},
              {"starts", 1},
              {"iterations", 1},
              {"tolerance", real(0)},
              {"samples", {{"known", Json::array()}}}});
  return with_watch(fit);
}

Json stage_filter() {
  Json fit = shape();
  fit.update({{"kept_levels", 2}, {"iterations", 1}, {"tolerance", real(0)}});
  return with_watch(fit);
}

Json train() {
  Json fit = shape();
  fit.update({{"budgets", wide({6})},
              {"hold_out", 0},
              {"rounds", 1},
              {"iterations", 1},
              {"condition", real(0)},
              {"reach", real(0)}});
  return with_watch(fit);
}

// Of every fit that is made, all that may be wrong with it, of a shorter curve, which is written so often.
void refuse_to_begin(Script& script, const std::string& name, Json arguments) {
  std::vector<double> points = walk();
  points.resize(10);
  arguments.at("curves") = curves({curve(points)});
  script.wrongs(name, arguments);
  script.wrong(name, arguments, {{"cancel", handle("cancelled")}});
  script.wrong(name, arguments, {{"progress", {{"callback", "stop"}}}});
  script.wrong(name, arguments, {{"start", handle("square")}});
  script.wrong(name, arguments, {{"control_points", 1}});
  script.wrong(name, arguments, {{"maps", 1}});
}

Json samples() {
  return {{"parameters", nullptr},
          {"weights", nullptr},
          {"covariances", nullptr},
          {"constraint_kinds", nullptr},
          {"constraint_parameters", nullptr},
          {"constraint_values", nullptr},
          {"fixed_ends", false}};
}

Json known(const Json& said) {
  Json all = samples();
  all.update(said);
  return {{"known", Json::array({all})}};
}

void add_known(Script& script, const Json& fit) {
  std::vector<double> weights(17, 1.0), at(17);
  for (std::size_t k = 0; k < at.size(); ++k) at[k] = static_cast<double>(k) / 16, weights[k] += at[k];
  Json given = fit;
  given.update({{"parameters", 3}, {"iterations", 1}});
  given.at("samples") = known({{"parameters", reals(at)},
                               {"weights", reals(weights)},
                               {"constraint_kinds", {{"int32", {1, 2}}}},
                               {"constraint_parameters", reals({0.5, 0})},
                               {"constraint_values", reals({8, 1, 1, 2})},
                               {"fixed_ends", false}});
  script.right("ifsm_fit_curve", given, "constrained");
  script.right("ifsm_fit_parameters", {{"fit", handle("constrained")}, {"curve", 0}, {"parameters", output("double")}});
  script.right("ifsm_fit_describe_budget", {{"fit", handle("constrained")}, {"curve", 0}, {"budget", 0}});
  script.right(
      "ifsm_fit_curve",
      [&] {
        Json held = fit;
        held.at("samples") = known({{"fixed_ends", true}});
        return held;
      }(),
      "held");
  weights[3] = -1;
  script.wrong("ifsm_fit_curve", fit, {{"samples", known({{"weights", reals(weights)}})}});
  script.wrong("ifsm_fit_curve", fit, {{"samples", known({{"weights", reals({1, 2, 3})}})}});
  script.wrong("ifsm_fit_curve", fit, {{"samples", known({{"covariances", reals({1, 0, 0})}})}});
  script.wrong("ifsm_fit_curve", fit, {{"parameters", 3}});  // none are given
  at[2] = std::numeric_limits<double>::quiet_NaN();
  script.wrong("ifsm_fit_curve", fit, {{"parameters", 3}, {"samples", known({{"parameters", reals(at)}})}});
  script.wrong("ifsm_fit_curve", fit,
               {{"samples", known({{"constraint_kinds", {{"int32", {3}}}},
                                   {"constraint_parameters", reals({0.5})},
                                   {"constraint_values", reals({8, 1})}})}});
}

void add_telling(Script& script) {
  for (const char* name : {"sparse", "fitted", "fitted filter"}) {
    const Json fit = handle(name);
    script.right("ifsm_fit_describe", {{"fit", fit}});
    script.right("ifsm_fit_describe_budget", {{"fit", fit}, {"curve", 0}, {"budget", 0}});
    script.right("ifsm_fit_model", {{"fit", fit}, {"curve", 0}}, "fit's model");
    script.right("ifsm_model_describe", {{"model", handle("fit's model")}});
    script.right("ifsm_fit_sketch", {{"fit", fit}, {"curve", 0}, {"budget", 0}}, "fit's sketch");
    script.right("ifsm_model_control_points", {{"model", handle("fit's sketch")}, {"points", output("double")}});
    script.right("ifsm_fit_parameters", {{"fit", fit}, {"curve", 0}, {"parameters", output("double")}});
  }
  const Json fit = handle("fitted");
  const Json covariance = {{"fit", fit}, {"curve", 0}, {"covariance", output("double")}};
  const Json along = {{"fit", fit}, {"curve", 0}, {"parameters", reals({0, 0.5, 1})}, {"covariance", output("double")}};
  script.right("ifsm_fit_covariance", covariance);
  script.right("ifsm_fit_curve_covariance", along);
  script.right("ifsm_fit_filter_covariance", {{"fit", fit}, {"covariance", output("double")}});
  script.wrong("ifsm_fit_covariance", covariance, {{"fit", handle("sparse")}});  // of another stage

  script.wrongs("ifsm_fit_describe", {{"fit", fit}});
  script.wrongs("ifsm_fit_describe_budget", {{"fit", fit}, {"curve", 0}, {"budget", 0}});
  script.wrongs("ifsm_fit_model", {{"fit", fit}, {"curve", 0}});
  script.wrongs("ifsm_fit_sketch", {{"fit", fit}, {"curve", 0}, {"budget", 0}});
  script.wrongs("ifsm_fit_parameters", {{"fit", fit}, {"curve", 0}, {"parameters", output("double")}});
  script.wrongs("ifsm_fit_covariance", covariance);
  script.wrongs("ifsm_fit_curve_covariance", along);
  script.wrongs("ifsm_fit_filter_covariance", {{"fit", fit}, {"covariance", output("double")}});
}

}  // namespace

void add_fits(Script& script) {
  script.let("curves-1", 0);
  script.let("budgets-1", 0);  // of stage curve
  script.right("ifsm_fit_sparse", sparse(), "sparse");
  script.right("ifsm_fit_curve", stage_curve(), "fitted");
  Json fixed = stage_curve();
  fixed.update({{"start", handle("filter")}, {"fixed_filter", 1}});
  script.right("ifsm_fit_curve", fixed, "fixed");
  script.right("ifsm_fit_covariance", {{"fit", handle("fixed")}, {"curve", 0}, {"covariance", output("double")}});
  script.right("ifsm_fit_filter", stage_filter(), "fitted filter");
  script.right("ifsm_train", train(), "trained");
  script.right("ifsm_filter_describe", {{"filter", handle("trained")}});
  add_known(script, fixed);
  add_telling(script);

  refuse_to_begin(script, "ifsm_fit_sparse", sparse());
  refuse_to_begin(script, "ifsm_fit_curve", stage_curve());
  refuse_to_begin(script, "ifsm_fit_filter", stage_filter());
  refuse_to_begin(script, "ifsm_train", train());
}

}  // namespace conformance
