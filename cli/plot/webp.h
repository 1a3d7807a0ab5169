// Pictures one after the other, as one file.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace plot {

struct Pixels {
  int width = 0, height = 0;
  std::vector<std::uint32_t> values;  // row by row, 0xAARRGGBB
};

// An animation without losses, over and over. Frames are of one size. Throws std::runtime_error.
class Animation {
 public:
  Animation(int width, int height);
  void add(const Pixels& frame, double until);  // seconds from the begin
  std::string bytes();

 private:
  struct Encoder;
  struct Release {
    void operator()(Encoder* encoder) const;
  };
  int width_, height_;
  int now_ = 0;  // milliseconds
  std::unique_ptr<Encoder, Release> encoder_;
};

}  // namespace plot
