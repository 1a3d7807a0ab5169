#include "io/flame.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "io/fractint.h"
#include "system/moments.h"
#include "system/named.h"

using namespace ifsm::core;

namespace {

// Barnsley's fern as flam3 writes a genome, with what a renderer wants beside it.
const std::string fern =
    "<flame version=\"FLAM3-LNX-3.1.1\" time=\"0\" name=\"fern\" size=\"640 480\" center=\"0 5\" scale=\"40\" "
    "quality=\"100\" palette=\"15\">\n"
    "   <color index=\"0\" rgb=\"0 0 0\"/>\n"
    "   <xform weight=\"0.85\" color=\"0\" linear=\"1\" coefs=\"0.85 -0.04 0.04 0.85 0 1.6\" opacity=\"1\"/>\n"
    "   <xform weight=\"0.07\" color=\"1\" symmetry=\"0\" linear=\"1\" coefs=\"0.2 0.23 -0.26 0.22 0 1.6\"/>\n"
    "   <xform weight=\"0.07\" color=\"1\" linear=\"1\" coefs=\"-0.15 0.26 0.28 0.24 0 0.44\" chaos=\"1 1 1 1\"/>\n"
    "   <xform weight=\"0.01\" color=\"1\" linear=\"1\" coefs=\"0 0 0 0.16 0 0\" spherical=\"0\" julian_power=\"3\"/>\n"
    "   <edit date=\"today\"><flame/></edit>\n"
    "</flame>\n";

std::string flame(const std::string& inside) { return "<flame name=\"x\">\n" + inside + "\n</flame>"; }
std::string xform(const std::string& attributes) { return "<xform weight=\"1\" " + attributes + "/>"; }
const std::string half = "coefs=\".5 0 0 .5 0 0\" ";

SystemPtr only(const std::string& text) {
  const auto all = read_flame(text);
  EXPECT_EQ(all.size(), 1u);
  return all.at(0).system;
}

Error error_of(std::string_view text) {
  try {
    for (const FlameSystem& each : read_flame(text))
      if (each.refused) return *each.refused;
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << text.substr(0, 400);
  return {Status::ok, "", ""};
}

TEST(Flame, ReadsTheFernAmongOthersUnderAnyElement) {
  const std::string file =
      "\xEF\xBB\xBF<?xml version=\"1.0\"?>\n<!DOCTYPE flames [<!ENTITY a \"b\">]>\n<!-- two -->\n"
      "<Flames name=\"all\"><more>" +
      fern + "</more><flame>" + xform("linear=\"1\" " + half) + "</flame></Flames>";
  const auto all = read_flame(file);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "fern");
  EXPECT_EQ(*all[0].system, *named_system("fern"));
  EXPECT_EQ(all[1].name, "2");
  EXPECT_EQ(all[1].system->maps().size(), 1u);
  EXPECT_EQ(read_flame(fern + fern).size(), 2u);
}

TEST(Flame, WhatItReadsGoesThroughFractintsFilesBitForBit) {
  const SystemPtr system = only(fern);
  EXPECT_EQ(*read_fractint(write_fractint("fern", *system))[0].system, *system);
}

TEST(Flame, MultipliesByTheVariationAndMovesAfterwards) {
  const SystemPtr system = only(flame(xform(
      "linear=\"0.25\" linear3D=\".25\" coefs=\"1 2 3 4 5 6\" post=\".5 .125\t.25\n.0625 1e0 +2\" plotmode=\"off\"")));
  const Vector3 x{7, 8, 0};
  const Vector3 inner = .5 * Vector3{1 * 7 + 3 * 8 + 5, 2 * 7 + 4 * 8 + 6, 0};
  EXPECT_EQ(system->maps()[0](x),
            Vector3(.5 * inner.x() + .25 * inner.y() + 1, .125 * inner.x() + .0625 * inner.y() + 2, 0));
}

TEST(Flame, ReadsTheOldFormsOfVariations) {
  for (const char* form : {"linear=\"1\"", "linear3D=\"1\"", "var=\"1 0 0 0\"", "var1=\"0\"",
                           "linear=\".3\" var1=\"0\"", "var1=\"0\" foo=\"0.0\" spherical=\"0\" julian=\"-0\""})
    EXPECT_EQ(only(flame(xform(half + form)))->maps()[0].linear(0, 0), .5) << form;
  EXPECT_EQ(only(flame(xform(half + "linear=\"0\"")))->maps()[0].linear(0, 0), 0);
}

TEST(Flame, ConjugatesByTheFinalTransform) {
  const std::string final = "<finalxform linear=\"2\" coefs=\"1 .25 -.5 2 3 4\" post=\"1 0 .5 1 0 -1\" color=\"0\"/>";
  const SystemPtr plain = only(fern);
  std::string moved = fern;
  moved.insert(moved.find("   <xform"), final);  // first or last, it comes last
  const SystemPtr system = only(moved);
  Affine f;
  f.linear.topLeftCorner<2, 2>() << 2 + .5 * .5, -1 + .5 * 4, .5, 4;
  f.shift << 6 + .5 * 8, 8 - 1, 0;
  for (std::size_t k = 0; k < 4; ++k)
    for (const Vector3& x : {Vector3{1, 0, 0}, Vector3{-2, 9, 0}}) {
      const Vector3 expected = f(plain->maps()[k](x));
      EXPECT_LT((system->maps()[k](f(x)) - expected).norm(), 1e-13 * expected.norm());
    }
  const auto mean = moments(*plain, 1, Vector3::Zero()), after = moments(*system, 1, Vector3::Zero());
  const Vector3 expected = f(Vector3{mean[1], mean[2], 0});
  EXPECT_NEAR(after[1], expected.x(), 1e-11);
  EXPECT_NEAR(after[2], expected.y(), 1e-11);
}

// The moments of what flam3 plays: maps and symmetries, each by its weight.
TEST(Flame, ReplacesSymmetriesByMapsWithTheSameMeasure) {
  std::string text = fern;
  text.insert(text.find("   <edit"), "<symmetry kind=\"-3\"/>");
  const SystemPtr system = only(text);
  EXPECT_EQ(system->maps().size(), 24u);
  EXPECT_EQ(system->contraction().answer, Contractivity::proven);
  const auto m = moments(*system, 2, Vector3::Zero());
  const Vector3 mean{m[1], m[2], 0};
  Matrix3 second = Matrix3::Zero();
  second.topLeftCorner<2, 2>() << m[3], m[4], m[4], m[5];

  std::vector<Affine> played = named_system("fern")->maps();
  std::vector<double> weights = named_system("fern")->weights();
  const double c = -.5, s = std::sqrt(.75);
  for (const auto& [xx, xy, yx, yy] : {std::array{-1., 0., 0., 1.}, {c, -s, s, c}, {c, s, -s, c}}) {
    Affine map;
    map.linear.topLeftCorner<2, 2>() << xx, xy, yx, yy;
    played.push_back(map);
    weights.push_back(1);
  }
  Vector3 mean_after = Vector3::Zero();
  Matrix3 second_after = Matrix3::Zero();
  for (std::size_t k = 0; k < played.size(); ++k) {
    const auto& [a, t] = played[k];
    mean_after += weights[k] / 4 * played[k](mean);
    second_after +=
        weights[k] / 4 *
        (a * second * a.transpose() + a * mean * t.transpose() + t * (a * mean).transpose() + t * t.transpose());
  }
  EXPECT_LT((mean_after - mean).norm(), 1e-12);
  EXPECT_LT((second_after - second).norm(), 1e-11);
}

TEST(Flame, RefusesByName) {
  const std::string good = xform("linear=\"1\" " + half) + "\n";
  struct Case {
    std::string text;
    Status status;
    std::int64_t line;
    std::string says;
  };
  for (const Case& each : {
           Case{"", Status::format, 1, "XML"},
           Case{"<a>\n<b>\n</a>", Status::format, 3, "XML"},
           Case{"<a/>", Status::format, 1, "no <flame>"},
           Case{std::string("<a/>\n\0<b/>", 10), Status::format, 2, "zero byte"},
           Case{"<a>\n<flame/></a>", Status::format, 2, "the flame \"1\" has no <xform>"},
           Case{flame(good + xform(half + "linear=\".5\" spherical=\".5\"")), Status::format, 3,
                "xform 2 of the flame \"x\" has the variation spherical, which is not linear"},
           Case{flame(xform(half + "var=\"0 0 1\"")), Status::format, 2, "spherical"},
           Case{flame(xform(half + "var1=\"13\"")), Status::format, 2, "of the number 13"},
           Case{flame(xform(half + "linear=\"1\" blur_circle=\"1\"")), Status::format, 2, "\"blur_circle\""},
           Case{flame(xform(half + "linear=\"1\" foo=\"bar\"")), Status::format, 2, "\"foo\""},
           Case{flame(xform(half)), Status::format, 2, "no variation"},
           Case{flame(xform("linear=\"1\"")), Status::format, 2, "no \"coefs\""},
           Case{flame("<xform linear=\"1\" " + half + "/>"), Status::format, 2, "no \"weight\""},
           Case{flame("<xform weight=\"-1\" linear=\"1\" " + half + "/>"), Status::format, 2, "negative"},
           Case{flame("<xform weight=\"0\" linear=\"1\" " + half + "/>"), Status::range, 1, "All probabilities are 0"},
           Case{flame(xform(half + half + "linear=\"1\"")), Status::format, 2, "\"coefs\" twice"},
           Case{flame(xform("linear=\"1\" coefs=\"1 2 3 4 5\"")), Status::format, 2, "5 numbers"},
           Case{flame(xform("linear=\"1\" coefs=\"1 2 3 4 5 6 7\"")), Status::format, 2, "7 numbers"},
           Case{flame(xform("linear=\"1\" coefs=\"1 2 3 4 5 &a;\"")), Status::format, 2, "\"&a;\" is no number"},
           Case{flame(xform("linear=\"1\" coefs=\"1 2 3 4 5 nan\"")), Status::not_finite, 2, "\"nan\""},
           Case{flame(xform("linear=\"1\" coefs=\"1 2 3 4 5 1e999\"")), Status::not_finite, 2, "1e999"},
           Case{flame(xform("linear=\"1e200\" coefs=\"1e200 2 3 4 5 6\"")), Status::not_finite, 1, "Map 0"},
           Case{flame(xform(half + "linear=\"1\" chaos=\"1 .5\"")), Status::format, 2, "chaos"},
           Case{flame("<xform weight=\"1\" linear=\"1\" " + half + "><motion/></xform>"), Status::format, 2,
                "<motion>"},
           Case{flame(good + "<finalxform linear=\"1\" coefs=\"1 2 2 4 5 6\"/>"), Status::singular, 3,
                "the finalxform"},
           Case{flame(good + "<finalxform linear=\"1\" " + half + "weight=\"1\"/>"), Status::format, 3, "a weight"},
           Case{flame(good + "<finalxform linear=\"1\" " + half + "opacity=\".5\"/>"), Status::format, 3, "opacity"},
           Case{flame(good + "<finalxform swirl=\"1\" " + half + "/>"), Status::format, 3, "the variation swirl"},
           Case{flame(good + "<finalxform linear=\"1e200\" coefs=\"1e200 0 0 1 0 0\"/>"), Status::not_finite, 3,
                "leaves"},
           Case{flame(good + "<finalxform/>\n<finalxform/>"), Status::format, 1, "second <finalxform>"},
           Case{flame(good + "<symmetry/>"), Status::format, 3, "no \"kind\""},
           Case{flame(good + "<symmetry kind=\"0\"/>"), Status::format, 3, "random"},
           Case{flame(good + "<symmetry kind=\"1.5\"/>"), Status::format, 3, "whole number"},
           Case{flame(good + "<symmetry kind=\"-1e9\"/>"), Status::format, 3, "whole number"},
           Case{flame(good + "<symmetry kind=\"-129\"/>"), Status::limit, 1, "258 maps"},
       }) {
    const Error error = error_of(each.text);
    EXPECT_EQ(error.status(), each.status) << each.text << "\n" << error.what();
    EXPECT_EQ(error.index(), each.line) << each.text << "\n" << error.what();
    EXPECT_EQ(error.argument(), "bytes");
    EXPECT_NE(std::string(error.what()).find(each.says), std::string::npos) << error.what();
  }
}

TEST(Flame, BoundsWhatAFileCanAskFor) {
  const std::string good = xform("linear=\"1\" " + half);
  std::string many;
  for (int k = 0; k < 257; ++k) many += good;
  EXPECT_EQ(error_of(flame(many)).status(), Status::limit);
  std::string flames;
  for (int k = 0; k < 4097; ++k) flames += flame(good);
  EXPECT_EQ(error_of(flames).status(), Status::limit);
  EXPECT_EQ(error_of(std::string((1 << 24) + 1, ' ')).status(), Status::limit);
  std::string deep;
  for (int k = 0; k < 1 << 20; ++k) deep += "<a>";
  EXPECT_EQ(error_of(deep).status(), Status::format);
  deep += flame(good);
  for (int k = 0; k < 1 << 20; ++k) deep += "</a>";
  EXPECT_EQ(read_flame(deep).size(), 1u);
}

TEST(Flame, SurvivesAnyBytes) {
  std::mt19937_64 random(1);
  std::string start = fern;
  start.insert(start.find("   <edit"), "<symmetry kind=\"-2\"/><finalxform linear=\"1\" coefs=\"1 0 0 1 5 5\"/>");
  for (int k = 0; k < 20000; ++k) {
    std::string text = start;
    for (std::uint64_t change = 0; change < 1 + random() % 8; ++change)
      text[random() % text.size()] = static_cast<char>(random());
    text.resize(random() % 2 == 0 ? text.size() : random() % text.size());
    try {
      for (const auto& each : read_flame(text)) EXPECT_NE(each.system == nullptr, !each.refused);
    } catch (const Error& error) {
      EXPECT_GE(error.index(), 1) << error.what();
    }
  }
}

}  // namespace
