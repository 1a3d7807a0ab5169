#include "progress.h"

#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace cli {
namespace {

using namespace std::chrono_literals;

constexpr auto redraw_after = 100ms;
constexpr int bar_cells = 30;
constexpr const char* erase_line = "\r\033[K";

std::size_t terminal_width() {
  winsize size{};
  return ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

int percent(double fraction) { return static_cast<int>(std::floor(fraction * 100)); }

std::string bar(double fraction) {
  const int full = static_cast<int>(std::floor(fraction * bar_cells));
  return "[" + std::string(static_cast<std::size_t>(full), '#') +
         std::string(static_cast<std::size_t>(bar_cells - full), '.') + "]";
}

std::string minutes(std::chrono::steady_clock::duration time) {
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(time).count();
  const auto rest = std::to_string(seconds % 60);
  return std::to_string(seconds / 60) + (rest.size() == 1 ? ":0" : ":") + rest;
}

}  // namespace

Progress::Style Progress::style_of_terminal(bool quiet) {
  const char* terminal = std::getenv("TERM");
  const bool can_erase = terminal && std::string_view(terminal) != "dumb";
  if (quiet) return Style::Quiet;
  return isatty(STDERR_FILENO) && can_erase ? Style::Bar : Style::Lines;
}

Progress::Progress(std::string title, Style style) : title_(std::move(title)), style_(style) {}

Progress::~Progress() {
  if (visible_) std::fputs(erase_line, stderr);
}

void Progress::update(double fraction, std::string_view stage) {
  fraction_ = std::max(fraction_, std::clamp(fraction, 0.0, 1.0));
  if (style_ == Style::Bar) draw(stage);
  if (style_ == Style::Lines) print(stage);
}

void Progress::draw(std::string_view stage) {
  const auto now = Clock::now();
  if (visible_ && now - drawn_ < redraw_after) return;
  const std::string line = title_ + " " + bar(fraction_) + " " + std::to_string(percent(fraction_)) + " %  " +
                           std::string(stage) + "  " + minutes(now - start_);
  // One cell less than the terminal has: a full line would wrap and could not be erased.
  std::fputs((erase_line + line.substr(0, terminal_width() - 1)).c_str(), stderr);
  drawn_ = now;
  visible_ = true;
}

void Progress::print(std::string_view stage) {
  const int quarter = percent(fraction_) / 25;
  if (quarter <= printed_) return;
  std::fprintf(stderr, "%s: %d %% (%.*s)\n", title_.c_str(), quarter * 25, static_cast<int>(stage.size()),
               stage.data());
  printed_ = quarter;
}

}  // namespace cli
