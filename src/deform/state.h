// A curve as edits have left it: a model dressed in a look, in a pose. A value, told against the model, never against
// the state before it, so that order does not matter where edits do not meet, and nothing is lost by editing.
#pragma once

#include <vector>

#include "deform/look.h"
#include "deform/pose.h"

namespace ifsm::core {

// Places of a level, one after the other.
struct Window {
  Index first, count;
};

// What an edit may have changed: what hangs on nodes first … last of a level. Level 0: all.
struct Touched {
  int level = 0;
  Index first = 0, last = 0;

  // The places of the level `of` that are told by these nodes, or by nodes that these are below.
  Window places(const Model& model, int of) const;
};

struct State {
  State(ModelPtr of, Manner in);  // the model as it is

  ModelPtr model;
  Manner manner;
  Pose pose;
  Look look;
  BasePtr base;  // the model in that look

  // Borrowed from this state, which must not change.
  Posed posed() const { return {*base, pose, manner}; }

  // Handles of a level.
  Index count(int level) const;
  // What follows is told in the samples' coordinates, or a numerical error when edits have led it out of the doubles'
  // range.
  Points places(int level, Index first, Index number) const;
  void check_window(int level, Index first, Index number) const;  // what places() refuses: "level", "first", "number"
  // Points of the finest polyline. Open: parameters 0 … 1; closed: any, modulo 1.
  Points at(const std::vector<double>& parameters) const;
  // The curve at the samples.
  Points samples() const;
  // A model of its own.
  ModelPtr snapshot() const;
};

// What an edit makes of a state, and where.
struct Edited {
  State state;
  Touched touched = {};
};

// From the centre.
Points points_at(const Model& model, const Posed& posed, const std::vector<double>& parameters);

// Refuses a pose whose points or displacements have left the doubles' range.
void require_finite(const Pose& pose);

}  // namespace ifsm::core
