// Where samples sit among the places of the finest level: by index, distinct, the first and the last at the ends.
#pragma once

#include "curve/shape.h"

namespace ifsm::core {

class Placement {
 public:
  Placement(Index samples, Index places, bool closed);

  Index samples() const { return samples_; }
  Index places() const { return places_; }
  bool closed() const { return closed_; }

  // The place of sample k: (2k(g-1) + m-1) div (2(m-1)); closed: k g div m.
  Index place(Index sample) const;
  // Its parameter: place / (g - 1); closed: place / g.
  double parameter(Index sample) const;
  // A parameter in units of places, exact at those of samples. Open: 0 … g-1. Closed: 0 … g, g excluded.
  double position(double parameter) const;
  // The same told as 1 - part of a place and part of the next one; a ring's last is followed by its first.
  struct Between {
    Index place, next;
    double part;  // 0 at a place: `next` counts for nothing
  };
  Between between(double parameter) const;

  // Samples at their places, linear between them.
  Points fill(const Points& samples) const;
  // The samples among the places.
  Points pick(const Points& places) const;

 private:
  Index samples_;
  Index places_;
  bool closed_;
};

}  // namespace ifsm::core
