// What both sides of the format of edits agree on: docs/format.md.
#pragma once

#include <array>
#include <string_view>

#include "deform/deformer.h"
#include "io/format.h"

namespace ifsm::core {

constexpr std::string_view edits_format_name = "ifsm-edits";
constexpr Index edits_format_version = 1;

// Names of the values of each choice, in their order.
template <class Choice>
struct Names;
template <>
struct Names<Turning> {
  static constexpr std::array names = {"similarity", "rotation", "linear"};
};
template <>
struct Names<Follow> {
  static constexpr std::array names = {"moved", "each", "none"};
};
template <>
struct Names<Reach> {
  static constexpr std::array names = {"nodes", "curve"};
};
template <>
struct Names<Falloff> {
  static constexpr std::array names = {"none", "linear", "smooth"};
};
template <>
struct Names<Ruler> {
  static constexpr std::array names = {"handles", "length"};
};
template <>
struct Names<Lead> {
  static constexpr std::array names = {"handles", "details"};
};
template <>
struct Names<Easing> {
  static constexpr std::array names = {"smooth", "linear", "in", "out"};
};

template <class Choice>
constexpr std::string_view name_of(Choice choice) {
  return Names<Choice>::names[static_cast<std::size_t>(choice)];
}

}  // namespace ifsm::core
