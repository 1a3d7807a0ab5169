#include "io/system_file.h"

#include <gtest/gtest.h>

#include <random>
#include <string>

#include "base/error.h"
#include "system/named.h"

using namespace ifsm::core;

namespace {

Error error_of(const std::string& text) {
  try {
    read_system({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << text;
  return {Status::ok, "", ""};
}

TEST(SystemFile, GivesEveryNamedSystemBackFromBothEncodings) {
  for (const NamedSystem& each : named_systems()) {
    const auto system = named_system(each.name);
    for (const Format format : {Format::json, Format::cbor}) {
      const Bytes file = write_system(*system, format);
      EXPECT_EQ(*read_system(file), *system) << each.name;
      EXPECT_EQ(write_system(*read_system(file), format), file) << each.name;
    }
  }
}

TEST(SystemFile, KeepsWeightsAsTheyWereGivenAndTheSignOfZero) {
  Affine map;
  map.linear(0, 0) = -0.0, map.linear(1, 1) = 5e-324;
  const System system(2, {map, map}, {3, 0});
  const auto again = read_system(write_system(system, Format::json));
  EXPECT_EQ(again->weights(), (std::vector<double>{3, 0}));
  EXPECT_TRUE(std::signbit(again->maps()[0].linear(0, 0)));
  EXPECT_EQ(again->maps()[1].linear(1, 1), 5e-324);
}

TEST(SystemFile, IsTextThatPeopleCanWrite) {
  const std::string text =
      R"({"format": "ifsm-system", "version": 1, "dimension": 2, "maps": [
           {"matrix": [0.5, 0, 0, 0.5], "shift": [0, 0]}, {"shift": [0.5, 0], "matrix": [0.5, 0, 0, 0.5]},
           {"matrix": [0.5, 0, 0, 0.5], "shift": [0, 0.5]}]})";
  EXPECT_EQ(*read_system({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}),
            *named_system("gasket_right"));
}

TEST(SystemFile, NamesTheEntryThatIsWrong) {
  const auto file = [](const std::string& dimension, const std::string& maps) {
    return R"({"format":"ifsm-system","version":1,"dimension":)" + dimension + R"(,"maps":[)" + maps + "]}";
  };
  const std::string half = R"({"matrix":[0.5,0,0,0.5],"shift":[0,0]})";
  struct Case {
    std::string text;
    Status status;
    std::string argument;
  };
  for (const Case& each : {
           Case{"{}", Status::format, "format"},
           Case{R"({"format":"ifsm-model","version":1})", Status::format, "format"},
           Case{R"({"format":"ifsm-system","version":2})", Status::version, "version"},
           Case{file("4", half), Status::format, "dimension"},
           Case{file("2", ""), Status::format, "maps"},
           Case{file("3", half), Status::shape, "maps[0].matrix"},
           Case{file("2", half + R"(,{"matrix":[0.5,0,0,0.5],"shift":[0]})"), Status::shape, "maps[1].shift"},
           Case{file("2", half + R"(,{"matrix":[0.5,0,0,0.5],"shift":[0,0],"weight":1})"), Status::format,
                "maps[1].weight"},
           Case{file("2", R"({"matrix":[0.5,0,0,0.5],"shift":[0,0],"weight":-2})"), Status::format, "maps[0].weight"},
           Case{file("2", R"({"matrix":[0.5,0,0,0.5],"shift":[0,0],"weight":0})"), Status::format, "maps.weight"},
           Case{file("2", R"({"matrix":[1e999,0,0,0.5],"shift":[0,0]})"), Status::not_finite, "maps[0].matrix[0]"},
       }) {
    const Error error = error_of(each.text);
    EXPECT_EQ(error.status(), each.status) << each.text << "\n" << error.what();
    EXPECT_EQ(error.argument(), each.argument) << each.text << "\n" << error.what();
  }
  std::string many = half;
  for (int k = 0; k < 256; ++k) many += "," + half;
  EXPECT_EQ(error_of(file("2", many)).status(), Status::limit);
}

TEST(SystemFile, SurvivesAnyBytes) {
  std::mt19937_64 random(1);
  for (const Format format : {Format::json, Format::cbor}) {
    const Bytes start = write_system(*named_system("fern"), format);
    for (int k = 0; k < 20000; ++k) {
      Bytes bytes = start;
      for (std::uint64_t change = 0; change < 1 + random() % 4; ++change)
        bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
      bytes.resize(random() % 2 == 0 ? bytes.size() : random() % bytes.size());
      try {
        EXPECT_NE(read_system(bytes), nullptr);
      } catch (const Error& error) {
        EXPECT_FALSE(error.argument().empty()) << error.what();
      }
    }
  }
}

}  // namespace
