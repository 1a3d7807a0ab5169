#include "io/system_files.h"

#include "../linalg/support.h"
#include "io/fractint.h"
#include "io/system_file.h"
#include "system/named.h"

using namespace ifsm::core;
using namespace ifsm::core::testing;

namespace {

std::span<const std::uint8_t> bytes_of(std::string_view text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

constexpr std::string_view flame = R"(<flame name="half"><xform weight="1" linear="1" coefs=".5 0 0 .5 0 0"/></flame>)";

TEST(SystemFiles, AreToldApartByTheirBeginnings) {
  const SystemPtr fern = named_system("fern");
  for (const Format format : {Format::json, Format::cbor})
    EXPECT_EQ(*read_system_named(write_system(*fern, format), {}), *fern);
  const std::string text = write_fractint("leaf", *fern);
  for (const std::string& start : {std::string(), std::string("\xef\xbb\xbf"), std::string("\n ; a comment\n")})
    EXPECT_EQ(read_system_named(bytes_of(start + text), {})->maps(), fern->maps());
  EXPECT_EQ(read_system_named(bytes_of(flame), "half")->maps()[0].linear(0, 0), .5);
  const std::string marked = "\xef\xbb\xbf" + std::string(flame);
  EXPECT_EQ(read_systems(bytes_of(marked))[0].name, "half");
}

TEST(SystemFiles, OfSeveralAreAskedByName) {
  const std::string text =
      write_fractint("a", *named_system("fern")) + write_fractint("b", *named_system("menger_sponge"));
  EXPECT_EQ(read_system_named(bytes_of(text), "b")->dimension(), 3);
  EXPECT_EQ(read_systems(bytes_of(text)).size(), 2U);
  for (const std::optional<std::string_view> name :
       {std::optional<std::string_view>(), std::optional<std::string_view>("c")}) {
    const Error error = refusal([&] { read_system_named(bytes_of(text), name); });
    EXPECT_EQ(error.status(), Status::range);
    EXPECT_EQ(error.argument(), "name");
    EXPECT_NE(std::string(error.what()).find("\"a\", \"b\""), std::string::npos) << error.what();
  }
}

TEST(SystemFiles, GiveAffineFlamesThoughOthersBesideThemAreNot) {
  const std::string text =
      "<flames>" + std::string(flame) +
      R"(<flame name="bent"><xform weight="1" spherical="1" coefs=".5 0 0 .5 0 0"/></flame></flames>)";
  EXPECT_EQ(read_systems(bytes_of(text)).size(), 2U);
  EXPECT_EQ(read_system_named(bytes_of(text), "half")->maps().size(), 1U);
  const Error error = refusal([&] { read_system_named(bytes_of(text), "bent"); });
  EXPECT_EQ(error.status(), Status::format);
  EXPECT_NE(std::string(error.what()).find("spherical"), std::string::npos);
}

TEST(SystemFiles, OfOneNameTwiceAreRefusedByThatName) {
  const std::string text = write_fractint("a", *named_system("fern")) + write_fractint("a", *named_system("koch"));
  EXPECT_EQ(refusal([&] { read_system_named(bytes_of(text), "a"); }).argument(), "name");
}

TEST(SystemFiles, ThatAreNoneAreRefused) {
  for (const std::string_view text : {"", "  \n", "\xef\xbb\xbf", "{}", "<a/>", "hello", "\x01\x02", "\xa0"}) {
    const Error error = refusal([&] { read_systems(bytes_of(text)); });
    EXPECT_EQ(error.status(), Status::format) << text;
  }
}

}  // namespace
