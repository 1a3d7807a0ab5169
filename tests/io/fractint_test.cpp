#include "io/fractint.h"

#include <gtest/gtest.h>

#include <random>

#include "base/error.h"
#include "system/named.h"

using namespace ifsm::core;

namespace {

Error error_of(std::string_view text) {
  try {
    read_fractint(text);
  } catch (const Error& error) {
    return error;
  }
  ADD_FAILURE() << text;
  return {Status::ok, "", ""};
}

TEST(Fractint, ReadsPlaneAndSpaceCommentsAndCommas) {
  const auto all = read_fractint(
      "; a collection\r\n"
      "comment { whatever 1 2 ; } 3 \n }\n"
      "fern { ; Barnsley\n"
      "  0 0 0 .16 0 0 .01\n"
      "  .85 .04 -.04, .85 0 +1.6 .85 ; the main one\n"
      "  .2 -.26 .23 .22 0 1.6 .07\n"
      " -.15 .28 .26 .24 0 .44 .07 }\n"
      "3dfern (3D)\n"
      "{\n"
      " 0 0 0 0 .18 0 0 0 0 0 0 0 .01\n"
      " .85 0 0 0 .85 .1 0 -.1 .85 0 1.6 0 .85\n"
      " .2 -.2 0 .2 .2 0 0 0 .3 0 .8 0 .07\n"
      " -.2 .2 0 .2 .2 0 0 0 .3 0 .8 0 .07\n"
      "}");
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].name, "fern");
  const auto fern = named_system("fern");
  EXPECT_EQ(all[0].system->maps()[1], fern->maps()[0]);
  EXPECT_EQ(all[0].system->maps()[0], fern->maps()[3]);
  EXPECT_EQ(all[0].system->weights(), (std::vector<double>{.01, .85, .07, .07}));
  EXPECT_EQ(all[1].name, "3dfern");
  EXPECT_EQ(*all[1].system, *named_system("fern_3d"));
}

TEST(Fractint, GivesEveryNamedSystemBackBitForBit) {
  std::string file;
  for (const NamedSystem& each : named_systems()) file += write_fractint(each.name, *named_system(each.name));
  const auto all = read_fractint(file);
  ASSERT_EQ(all.size(), named_systems().size());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const auto system = named_system(named_systems()[k].name);
    EXPECT_EQ(all[k].name, named_systems()[k].name);
    EXPECT_EQ(all[k].system->dimension(), system->dimension());
    EXPECT_EQ(all[k].system->maps(), system->maps()) << all[k].name;
    EXPECT_EQ(all[k].system->weights(), system->weights().empty() ? system->probabilities() : system->weights());
  }
}

TEST(Fractint, WritesNamesThatAreWords) {
  const auto fern = named_system("fern");
  EXPECT_EQ(read_fractint(write_fractint("a {b}; (3D)", *fern))[0].name, "a__b____3D_");
  EXPECT_EQ(read_fractint(write_fractint("", *fern))[0].name, "_");
  EXPECT_EQ(read_fractint(write_fractint("Comment", *fern))[0].name, "Comment_");
}

TEST(Fractint, NamesTheLineThatIsWrong) {
  const std::string fern = "fern {\n 0 0 0 .16 0 0 .01\n";
  struct Case {
    std::string text;
    Status status;
    std::int64_t line;
  };
  for (const Case& each :
       {Case{"", Status::format, 1}, Case{"; nothing\n\n", Status::format, 1}, Case{"fern", Status::format, 1},
        Case{"\n\n{ 1 }", Status::format, 3}, Case{fern, Status::format, 1}, Case{"fern {}", Status::format, 1},
        Case{fern + " 1 2 3 }", Status::format, 3}, Case{"n {\n 1 2\n 3 4 }", Status::format, 1},
        Case{fern + " .5 0 0\n .5 0 0 1 .5 0 0 .5\n 0 0 1 1 }", Status::format, 3},
        Case{fern + " .5 0 0 .5 0 0 -1 }", Status::range, 3}, Case{fern + " 1 x 3 }", Status::format, 3},
        Case{fern + " 1 1e400 3 }", Status::not_finite, 3}, Case{fern + " nan }", Status::not_finite, 3},
        Case{fern + " 0x10 }", Status::format, 3}, Case{"\ncomment { abc", Status::format, 2},
        Case{"\nflat { 0 0 0 0 0 0 0 }", Status::range, 2}, Case{"n { .5 0 0 .5 0 0 -1 }", Status::range, 1},
        Case{"} fern {", Status::format, 1}}) {
    const Error error = error_of(each.text);
    EXPECT_EQ(error.status(), each.status) << each.text << "\n" << error.what();
    EXPECT_EQ(error.index(), each.line) << each.text << "\n" << error.what();
    EXPECT_EQ(error.argument(), "bytes");
  }
  std::string many = "many {\n";
  for (int k = 0; k < 257; ++k) many += ".5 0 0 .5 0 0 1\n";
  EXPECT_EQ(error_of(many + "}").status(), Status::limit);
}

TEST(Fractint, SurvivesAnyBytes) {
  std::mt19937_64 random(1);
  const std::string start =
      write_fractint("fern", *named_system("fern")) + write_fractint("sponge", *named_system("fern_3d"));
  for (int k = 0; k < 20000; ++k) {
    std::string text = start;
    for (std::uint64_t change = 0; change < 1 + random() % 8; ++change)
      text[random() % text.size()] = static_cast<char>(random());
    text.resize(random() % 2 == 0 ? text.size() : random() % text.size());
    try {
      for (const auto& each : read_fractint(text)) EXPECT_NE(each.system, nullptr);
    } catch (const Error& error) {
      EXPECT_GE(error.index(), 1) << error.what();
    }
  }
}

}  // namespace
