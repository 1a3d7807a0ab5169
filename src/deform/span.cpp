#include "deform/span.h"

#include "base/error.h"

namespace ifsm::core {

double Span::share(double time) const {
  if (time >= end) return 1;
  if (!(time > begin)) return 0;
  // Halves: a difference of large times may be infinite.
  const double s = (time / 2 - begin / 2) / (end / 2 - begin / 2);
  switch (easing) {
    case Easing::linear: return s;
    case Easing::in: return s * s;
    case Easing::out: return s * (2 - s);
    case Easing::smooth: break;
  }
  return s * s * (3 - 2 * s);
}

void require_span(const Span& span) {
  require_finite(span.begin, "begin");
  require_finite(span.end, "end");
  if (span.begin <= span.end) return;
  throw Error(
      Status::range, "end",
      "end is " + text_of(span.end) + " and begin " + text_of(span.begin) + "; an edit ends when it begins, or later.")
      .with(span.end);
}

}  // namespace ifsm::core
