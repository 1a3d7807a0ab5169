// The list of calls, while it is made: each is run as it is added, and kept with what came of it.
#pragma once

#include <initializer_list>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "call.h"

namespace conformance {

class Script {
 public:
  // A call that succeeds; what it makes is called `as`. Its results.
  Json right(const std::string& name, Json arguments, const std::string& as = "");
  // A call that is refused; `instead` replaces some of the arguments.
  void wrong(const std::string& name, Json arguments, const Json& instead = Json::object());
  // Each thing that the tables of tests/abi say to be wrong, one at a time, in a call that is otherwise right; but not
  // in the parameters named `except`.
  void wrongs(const std::string& name, const Json& arguments, const std::set<std::string>& except = {});
  // A language lets go of an object here.
  void release(const std::string& name);

  // What a word in the tables' columns low and high stands for, e.g. "L": levels of the model that is in use.
  void let(const std::string& word, std::int64_t number) { numbers_[word] = number; }

  const std::vector<Json>& steps() const { return steps_; }

 private:
  void check_order(const Function& function, const Json& arguments) const;
  bool depends_on_libm(const std::string& name, const Json& arguments, const std::string& as);
  std::vector<Json> wrong_values(const Parameter& parameter, const Json& right) const;
  std::vector<Json> wrong_integers(const Parameter& parameter) const;
  bool is_limit(const std::string& word) const;
  std::int64_t limit(const std::string& word) const;

  std::vector<Json> steps_;
  Objects objects_;
  std::map<std::string, std::int64_t> numbers_;
  std::set<std::string> inexact_;  // objects whose numbers went through libm
};

// Values, short enough to write many of them.
Json handle(const std::string& name);
Json text(const std::string& text);
Json real(double number);
Json reals(const std::vector<double>& numbers);
Json wide(const std::vector<std::int64_t>& numbers);
Json symbols(const std::vector<std::int32_t>& numbers);
Json output(const char* type);
Json curve(const std::vector<double>& points, int dimension = 2, bool closed = false);
Json curves(std::initializer_list<Json> curves);

// The nouns' parts of the file, in this order: objects of earlier ones serve later ones.
void add_library(Script& script);
void add_filters(Script& script);
void add_models(Script& script);
void add_questions(Script& script);
void add_fits(Script& script);
void add_deformers(Script& script);
void add_systems(Script& script);
void add_pictures(Script& script);

// A walk of 17 points whose way back crosses the way there: every place of a model of n = 3, N = 2 at level 3.
std::vector<double> walk();

}  // namespace conformance
