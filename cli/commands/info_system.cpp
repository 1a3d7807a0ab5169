#include "commands/info_system.h"

#include <cmath>
#include <numbers>

namespace cli {
namespace {

const char* contractive_name(std::int32_t contractive) {
  return contractive > 0 ? "proven" : contractive < 0 ? "refuted" : "undecided";
}

// Of what a system may not have: nothing, where the library says so.
template <class Ask>
Json if_any(const Ask& ask) {
  try {
    return ask();
  } catch (const ifsm::Error&) {
    return nullptr;
  }
}

Json maps_of(const ifsm::System& system, int dimension) {
  const auto maps = system.maps(), parameters = system.parameters(), probabilities = system.probabilities();
  const auto size = static_cast<std::size_t>(dimension * (dimension + 1));
  Json all = Json::array();
  for (std::size_t i = 0; i < probabilities.size(); ++i) {
    const auto row = maps.begin() + static_cast<std::ptrdiff_t>(i * size);
    const auto part = parameters.begin() + static_cast<std::ptrdiff_t>(i * size);
    all.push_back({{"map", i},
                   {"rows", std::vector<double>(row, row + static_cast<std::ptrdiff_t>(size))},
                   {"parameters", std::vector<double>(part, part + static_cast<std::ptrdiff_t>(size))},
                   {"probability", probabilities[i]}});
  }
  return all;
}

std::string line(const std::string& name, const std::string& value) {
  return "  " + name + std::string(18 - name.size(), ' ') + value + "\n";
}

std::string number(const Json& value) { return rounded(value.get<double>()); }

// What is far below the attractor's size is 0 to people.
std::string place(const Json& values, std::size_t first, std::size_t count, double size) {
  constexpr double seen = 1e-7;
  std::string text;
  for (std::size_t k = first; k < first + count; ++k) {
    const double value = values[k].get<double>();
    text += (text.empty() ? "(" : ", ") + rounded(std::abs(value) < seen * size ? 0 : value);
  }
  return text + ")";
}

std::string table_of(const Json& report) {
  const bool plane = report["dimension"] == 2;
  const std::vector<std::string> headings =
      plane ? std::vector<std::string>{"map", "a", "b", "e", "c", "d", "f", "turn", "probability"}
            : std::vector<std::string>{"map",     "scale x", "scale y", "scale z",    "shift x",
                                       "shift y", "shift z", "turn",    "probability"};
  std::vector<std::vector<std::string>> rows;
  for (const auto& map : report["maps"]) {
    const auto& p = map["parameters"];
    std::vector<std::string> row{map["map"].dump()};
    if (plane)
      for (const auto& value : map["rows"]) row.push_back(number(value));
    else
      for (const std::size_t k : {3, 4, 5, 9, 10, 11}) row.push_back(number(p[k]));
    const double turn =
        plane ? p[0].get<double>() : std::hypot(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
    row.push_back(rounded(turn * 180 / std::numbers::pi) + "°");
    row.push_back(number(map["probability"]));
    rows.push_back(row);
  }
  return aligned(headings, rows);
}

}  // namespace

Json report_of_system(const std::string& name, const ifsm::System& system) {
  const auto info = system.describe();
  Json report{{"system", name},
              {"dimension", info.dimension},
              {"maps", maps_of(system, info.dimension)},
              {"active", info.active},
              {"contractive", contractive_name(info.contractive)},
              {"word_length", info.word_length}};
  if (info.contractive < 0) {
    report["witness"] = system.witness();
    report["radius"] = info.radius;
  }
  if (info.contractive <= 0) return report;
  report["box"] = if_any([&] { return system.box(); });
  report["diameter"] = if_any([&] { return system.diameter(); });
  report["similarity_dimension"] = if_any([&] { return system.similarity_dimension(); });
  report["moments"] = if_any([&] { return system.moments(2); });
  return report;
}

std::string system_in_words(const Json& report) {
  const auto d = report["dimension"].get<std::size_t>();
  std::string contractive =
      report["contractive"].get<std::string>() + ", by words of length " + report["word_length"].dump();
  if (report.contains("witness"))
    contractive =
        "refuted: the word " + report["witness"].dump() + " has the spectral radius " + number(report["radius"]);
  std::string words =
      report["system"].get<std::string>() + "\n" +
      line("system",
           counted(report["maps"].size(), "map") + " of " + (d == 2 ? "the plane" : "space") +
               (report["active"] == report["maps"].size() ? "" : ", " + report["active"].dump() + " active")) +
      line("contractive", contractive);
  if (report.contains("box")) {
    const auto told = [&](const char* key, const auto& text) {
      return report[key].is_null() ? std::string("not found") : text(report[key]);
    };
    const double size = report["diameter"].is_null() ? 0 : report["diameter"].get<double>();
    words += line(
        "box", told("box", [&](const Json& box) { return place(box, 0, d, size) + " to " + place(box, d, d, size); }));
    words += line("diameter", told("diameter", number));
    words += line("mean", told("moments", [&](const Json& moments) { return place(moments, 1, d, size); }));
    if (!report["similarity_dimension"].is_null())
      words += line("dimension", rounded(report["similarity_dimension"].get<double>(), 10) +
                                     " (of similarities; an upper bound where pieces overlap)");
  }
  return words + "\n" + table_of(report);
}

Json report_of_file(const std::string& file, const std::vector<std::string>& names) {
  Json all = Json::array();
  for (const auto& name : names) all.push_back(valid_utf8(name));
  return {{"file", file}, {"systems", all}};
}

std::string file_in_words(const Json& report) {
  std::string words =
      report["file"].get<std::string>() + ": " + counted(report["systems"].size(), "system") + "; --name tells one\n";
  for (const auto& name : report["systems"]) words += "  " + printable(name.get<std::string>()) + "\n";
  return words;
}

}  // namespace cli
