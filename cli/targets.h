// Where the models of several curves go: a name for each, made from what -o says.
#pragma once

#include <string>
#include <vector>

namespace cli {

struct Targets {
  std::vector<std::string> paths;  // one a curve, all different
  bool made_up = false;            // from a pattern or a folder: they should replace nothing by accident
};

// `output` is a file's name (of one curve alone), a pattern or a folder that exists. In a pattern %d stands for the
// curve's number from 1 (%03d: with zeros before it), %s for its name, or its number when it has none, %% for %. In a
// folder one curve gets `stem` and `extension`, several get their number and name between them as well.
// Throws Failure{Usage} when several curves would share a file.
Targets target_paths(const std::string& output, const std::string& stem, const std::string& extension,
                     const std::vector<std::string>& names);

// Whether `output` names a folder, which exists or not: "models/" does.
bool is_folder(const std::string& output);

// A name as part of a file's: letters and digits of any script, everything else an underscore; may be empty.
std::string file_name_of(const std::string& name);

}  // namespace cli
