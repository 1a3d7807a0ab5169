// The edits of ifsm deform as words: what --move and its kin are given.
#pragma once

#include <string>
#include <vector>

#include <ifsm.hpp>

namespace cli {

// Makes the edit that an option's value tells; docs/cli.md has the grammar:
//
// clang-format off
//   move            [LEVEL/]HANDLE:WAY[@HOW]      WAY: +X,Y (by so much), =X,Y (to a place)
//                                                 HOW: smooth=R, linear=R, length, curve
//   move-at         T:WAY[;T:WAY …][@LEVEL]       points of the curve, by handles; @details=LEVEL: by details
//   pin, unpin      [LEVEL/]HANDLE[,HANDLE …]
//   scale-details   FACTOR[@LEVELS]               LEVELS: 3, 2-5, first2, last2; ~F: F levels on each side fade
//   turn-details    DEGREES[@LEVELS]
//   mirror-details  AXIS[@LEVELS]                 x, y, z, w
//   texture         MODEL[@LEVELS], random[=H[,SEED]][@LEVELS]
//   during          BEGIN,END[,EASING]            when the edits that follow take place
//   edits           FILE                          edits that were kept
// clang-format on
//
// Throws Failure{Usage} with the option and its value, Failure{Input} for files; the deformer is then as it was. Gives
// the points that were moved or held, for pictures.
struct Mark {
  int level = -1;  // of a handle; -1: a point of the curve
  std::int64_t handle = 0;
  double parameter = 0;
  bool held = false;  // pinned, or kept where it is
};
std::vector<Mark> bend(ifsm::Deformer& deformer, const std::string& option, const std::string& value);

// The file that such an edit reads; empty when it reads none.
std::string file_of_bend(const std::string& option, const std::string& value);

}  // namespace cli
