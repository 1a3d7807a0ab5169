// A small world in which every function of the ABI can be called rightly, so that one wrong thing at a time can be
// tried.
#pragma once

#include <ifsm.h>

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "calls.h"

namespace misuse {

// Objects of each kind, and arrays under the names that the tables use in their column "good".
class World {
 public:
  World();
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  std::uint64_t id(const std::string& type) const { return ids_.at(type); }
  const std::map<std::string, std::uint64_t>& ids() const { return ids_; }
  std::uint64_t fresh(const std::string& type) const;  // a new object: owned by the caller
  static ifsm_status destroy(const std::string& type, std::uint64_t id);

  const std::vector<double>& doubles(const std::string& name) const { return doubles_.at(name); }
  const std::vector<std::int32_t>& ints(const std::string& name) const { return ints_.at(name); }
  const std::vector<std::int64_t>& wide_ints(const std::string& name) const { return wide_ints_.at(name); }
  const std::vector<std::uint8_t>& saved(const std::string& what) const;
  std::uint64_t refuted() const { return refuted_; }   // a system that does not contract
  std::int64_t number(const std::string& word) const;  // "7", or "L", "L-1", "H-1", "curves-1", "budgets-1"

  ifsm_curve curve() const;
  ifsm_curve polygon() const;

 private:
  std::uint64_t deformer() const;

  std::map<std::string, std::uint64_t> ids_;
  std::map<std::string, std::vector<double>> doubles_;
  std::map<std::string, std::vector<std::int32_t>> ints_;
  std::map<std::string, std::vector<std::int64_t>> wide_ints_;
  std::vector<std::uint8_t> saved_, edits_, system_file_;
  std::uint64_t refuted_ = 0;
  std::map<std::string, std::int64_t> numbers_;
};

// A right call of one function, with its own copies of everything that it hands in, and outputs among canaries.
class Call {
 public:
  Call(const World& world, const Function& function);
  ~Call();
  Call(const Call&) = delete;
  Call& operator=(const Call&) = delete;

  const Function& function() const { return function_; }
  Argument& operator[](std::size_t parameter) { return arguments_[parameter]; }
  std::vector<std::uint8_t>& buffer(std::size_t parameter) { return buffers_[parameter]; }
  std::vector<double>& curve_points() { return curve_points_; }
  std::int64_t elements(std::size_t parameter) const { return elements_[parameter]; }  // of an array

  ifsm_status run() { return function_.call(arguments_); }
  void fill();                // writes canaries into all outputs
  bool untouched() const;     // nothing has changed since fill()
  bool guards_stand() const;  // nothing behind the outputs has changed
  void forget_handles();      // destroys what a successful run has created

 private:
  static bool is_own(const Parameter& parameter);
  void prepare(std::size_t parameter);

  const World& world_;
  const Function& function_;
  Arguments arguments_;
  std::vector<std::vector<std::uint8_t>> buffers_;  // what pointers point to, by parameter
  std::vector<std::vector<std::uint8_t>> before_;
  std::vector<std::int64_t> elements_;
  std::vector<double> curve_points_;
};

bool is_output(const std::string& kind);
bool is_array_in(const std::string& kind);
bool is_array_out(const std::string& kind);

}  // namespace misuse
