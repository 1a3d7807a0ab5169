// How far a computation is: a bar on a terminal, a few plain lines elsewhere, nothing when quiet.
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace cli {

class Progress {
 public:
  enum class Style { Bar, Lines, Quiet };

  // The style that suits standard error.
  static Style style_of_terminal(bool quiet);

  Progress(std::string title, Style style);
  ~Progress();  // leaves a clean line behind
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // fraction 0 … 1; one that is smaller than an earlier one is taken as that.
  void update(double fraction, std::string_view stage);

 private:
  using Clock = std::chrono::steady_clock;
  void draw(std::string_view stage);
  void print(std::string_view stage);

  std::string title_;
  Style style_;
  Clock::time_point start_ = Clock::now();
  Clock::time_point drawn_{};
  double fraction_ = 0;
  int printed_ = -1;  // the last quarter printed
  bool visible_ = false;
};

}  // namespace cli
