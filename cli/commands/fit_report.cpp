#include "commands/fit_report.h"

#include "csv.h"

namespace cli {
namespace {

const char* reason_name(std::int32_t reason) {
  switch (reason) {
    case IFSM_FIT_CONVERGED: return "converged";
    case IFSM_FIT_ITERATIONS: return "all iterations used";
    case IFSM_FIT_START_BEST: return "nothing better than the start";
  }
  return "unknown";
}

Json json_of(const ifsm::Fit& fit) {
  const auto report = fit.describe();
  Json json{{"reason", reason_name(report.reason)},
            {"iterations", report.iterations},
            {"start_cost", report.start_cost},
            {"final_cost", report.final_cost},
            {"start_condition", report.start_condition},
            {"final_condition", report.final_condition},
            {"budgets", Json::array()}};
  for (std::int64_t i = 0; i < report.budgets; ++i) {
    const auto row = fit.describe_budget(0, i);
    json["budgets"].push_back({{"budget", row.budget},
                               {"details", row.details},
                               {"start_details", row.start_details},
                               {"start_rms", row.start_rms},
                               {"start_max", row.start_max},
                               {"rms", row.rms},
                               {"max", row.max}});
  }
  return json;
}

std::string number(const Json& value) { return std::to_string(value.get<std::int64_t>()); }

std::string words_of_fit(const Json& fit) {
  std::vector<std::vector<std::string>> rows;
  for (const auto& row : fit["budgets"])
    rows.push_back({number(row["budget"]), number(row["start_details"]), number(row["details"]),
                    rounded(row["start_rms"]), rounded(row["rms"]), rounded(row["start_max"]), rounded(row["max"])});
  return counted(fit["iterations"], "iteration") + " (" + fit["reason"].get<std::string>() + "), condition of R " +
         rounded(fit["start_condition"]) + " -> " + rounded(fit["final_condition"]) + "\n\n" +
         aligned({"budget", "start details", "fitted details", "start RMS", "fitted RMS", "start max", "fitted max"},
                 rows);
}

// In full, as ifsm synth --unproject wants it.
std::string middle_of(const Json& report) {
  return shortest(report["middle"]["longitude"]) + "," + shortest(report["middle"]["latitude"]);
}

std::string words_of_plane(const Json& report) {
  return report.contains("middle") ? "projected to kilometres about " + middle_of(report) + "\n" : "";
}

std::string words_of_sketch(const Json& report) {
  if (!report.contains("sketch")) return "";
  const auto& apart = report["sketch"];
  return "the sketch: RMS " + rounded(apart["rms"]) + ", at most " + rounded(apart["max"]) + " and Hausdorff " +
         rounded(apart["hausdorff"]) + " from the samples\n";
}

std::string words_of_one(const Json& report) {
  const std::string text = report["input"].get<std::string>() + ": " + counted(report["samples"], "sample") +
                           ", dimension " + number(report["dimension"]) +
                           (report["closed"] ? ", closed\n" : ", open\n") + report["output"].get<std::string>() + ": " +
                           counted(report["levels"], "level") + ", n = " + number(report["control_points"]) +
                           ", N = " + number(report["maps"]) + ", " + counted(report["bytes"], "byte") + " of " +
                           report["format"].get<std::string>() + "\n" + words_of_plane(report);
  return text + words_of_sketch(report) + (report.contains("fit") ? words_of_fit(report["fit"]) : "");
}

std::vector<std::string> headings_of_result(const Json& model) {
  if (model.contains("sketch")) return {"details", "RMS", "max", "Hausdorff"};
  if (model.contains("fit")) return {"budget", "start RMS", "fitted RMS"};
  return {};
}

// What the sketch keeps, and how far it is; else, of a fit, its largest budget.
std::vector<std::string> result_of(const Json& model) {
  const auto row = model.contains("fit") ? model["fit"]["budgets"].back() : Json();
  if (model.contains("sketch")) {
    const auto& apart = model["sketch"];
    return {number(row.is_null() ? model["details_kept"] : row["details"]), rounded(apart["rms"]),
            rounded(apart["max"]), rounded(apart["hausdorff"])};
  }
  if (row.is_null()) return {};
  return {number(row["budget"]), rounded(row["start_rms"]), rounded(row["rms"])};
}

// A line a model.
std::string words_of_several(const Json& report) {
  const auto& models = report["models"];
  std::vector<std::string> headings{"model", "curve", "samples", "dimension", "", "bytes"};
  if (models.front().contains("middle")) headings.emplace_back("middle");
  for (auto& heading : headings_of_result(models.front())) headings.push_back(std::move(heading));
  std::vector<std::vector<std::string>> rows;
  for (const auto& model : models) {
    rows.push_back({model["output"].get<std::string>(), printable(model.value("curve", "")), number(model["samples"]),
                    number(model["dimension"]), model["closed"] ? "closed" : "open", number(model["bytes"])});
    if (model.contains("middle")) rows.back().push_back(middle_of(model));
    for (auto& cell : result_of(model)) rows.back().push_back(std::move(cell));
  }
  return report["input"].get<std::string>() + ": " + counted(models.size(), "curve") + "\n\n" +
         aligned(headings, rows, 2);
}

}  // namespace

Json report_of(const Samples& samples, const FittedModel& fitted, const WrittenModel& written) {
  const auto info = fitted.model.describe();
  Json report{{"output", written.path},
              {"format", written.format == ifsm::Format::json ? "json" : "cbor"},
              {"bytes", written.bytes},
              {"samples", info.samples},
              {"dimension", info.dimension},
              {"closed", info.closed == 1},
              {"levels", info.levels},
              {"control_points", info.control_points},
              {"maps", info.maps},
              {"details", info.details},
              {"details_kept", info.details_kept}};
  if (!samples.name.empty()) report["curve"] = samples.name;
  if (samples.middle)
    report["middle"] = {{"longitude", samples.middle->longitude}, {"latitude", samples.middle->latitude}};
  if (fitted.apart)
    report["sketch"] = {
        {"rms", fitted.apart->rms}, {"max", fitted.apart->largest}, {"hausdorff", fitted.apart->hausdorff}};
  if (fitted.fit) report["fit"] = json_of(*fitted.fit);
  return report;
}

std::string in_words(const Json& report) {
  return report.contains("models") ? words_of_several(report) : words_of_one(report);
}

}  // namespace cli
