// Pages: PNG and SVG of the sizes asked for, whatever is on them.
#include "figures/page.h"

#include <gtest/gtest.h>

#include "figures/panels.h"

namespace figures {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (auto at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++found;
  return found;
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = at; i < at + 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

TEST(Page, IsAsLargeAsAskedFor) {
  const auto page = page_of({plot::Panel(), plot::Panel()}, "", "", {400, 300});
  const auto png = page.bytes(plot::Format::Png);
  EXPECT_EQ(png.substr(1, 3), "PNG");
  EXPECT_EQ(big_endian(png, 16), 400u);
  EXPECT_EQ(big_endian(png, 20), 300u);
  const auto svg = page.bytes(plot::Format::Svg);
  EXPECT_NE(svg.find("width=\"400px\" height=\"300px\""), svg.npos) << svg.substr(0, 300);
}

TEST(Page, OneSideAloneKeepsItsShape) {
  const auto usual = page_of({plot::Panel()}, "", "", {});
  const auto half = page_of({plot::Panel()}, "", "", {usual.width / 2, 0});
  EXPECT_NEAR(half.height, usual.height / 2, 1);
  EXPECT_EQ(page_of({plot::Panel()}, "", "", {0, usual.height}).width, usual.width);
}

TEST(Page, AnSvgTellsItsTitleToThoseWhoDoNotSeeIt) {
  const auto svg = page_of({plot::Panel()}, "a < b & \"c\"\x01", "", {}).bytes(plot::Format::Svg);
  EXPECT_NE(svg.find("<title>a &lt; b &amp; \"c\" </title>"), svg.npos);
}

// Drawing must not hang, throw or divide by nothing, however little there is to draw.
TEST(Panels, OfOddCurvesCanBeDrawn) {
  const std::vector<cli::Samples> odd{{{0, 0, 1, 2}, 2, false},
                                      {{0, 0, 1, 2}, 2, true},
                                      {{7, 7, 7}, 1, false},
                                      {{5e5, 6e6, 5e5, 6e6}, 2, true},
                                      {{1e300, -1e300, 1, 2}, 2, false},
                                      {{1e-300, 0, 0, 1e-300}, 2, false},
                                      {{0, 0, 0, 1, 1, 1}, 3, false},
                                      {{0, 0, 0, 0, 1, 1, 1, 1}, 4, true}};
  for (const auto& samples : odd) {
    const ifsm::Model model(ifsm::Filter::named("casteljau"), samples.curve());
    const ifsm::Cancel cancel;
    const auto points = model.samples();
    std::vector<plot::Panel> panels;
    for (auto&& shown : {samples_panel({samples}), curve_panel(model), polygon_panel(model), attractor_panel(model),
                         levels_panel(model, cancel), budgets_panel(model, cancel), scalogram_of(model),
                         residuals_panel(points, points, samples.dimension, samples.closed, "")}) {
      EXPECT_FALSE(shown.numbers.is_null());
      panels.push_back(shown.panel);
    }
    const auto page = page_of(panels, "odd", "", {});
    EXPECT_EQ(count(page.bytes(plot::Format::Svg), "<svg"), 1u);
    EXPECT_FALSE(page.bytes(plot::Format::Png).empty());
  }
}

}  // namespace
}  // namespace figures
