// When an edit takes place: from a begin to an end, by more and more. What a keyframe is made of.
#pragma once

#include <cstdint>

namespace ifsm::core {

enum class Easing : std::int32_t { smooth = 0, linear = 1, in = 2, out = 3 };

// In any unit. An edit that begins as it ends is made at once.
struct Span {
  double begin = 0;
  double end = 1;
  Easing easing = Easing::smooth;

  // How much of the edit is made at a time: 0 until it begins, exactly 1 from its end on, between them s of the part of
  // the time that has passed: 3 s² - 2 s³, s, s², or 1 - (1 - s)².
  double share(double time) const;

  friend bool operator==(const Span&, const Span&) = default;
};

// Range errors: "begin", "end", for times that are not finite or run backwards.
void require_span(const Span& span);

}  // namespace ifsm::core
