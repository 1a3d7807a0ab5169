#include "io/emitter.h"

#include <gtest/gtest.h>

#include <limits>

#include "support.h"

namespace ifsm::core::test {
namespace {

Bytes emitted(Format format, const std::function<void(Emitter&)>& say) {
  Bytes bytes;
  say(*make_emitter(format, bytes));
  return bytes;
}

std::string json_number(double value) {
  const auto say = [&](Emitter& out) { out.object(1), out.key("x"), out.number(value), out.end(); };
  const std::string text = text_of(emitted(Format::json, say));
  return text.substr(6, text.size() - 9);  // between {⏎"x": and ⏎}⏎
}

TEST(Emitter, PartsJsonValuesByCommasAndNothingElse) {
  const auto say = [](Emitter& out) {
    out.object(3);
    out.key("a"), out.array(2), out.integer(1), out.integer(2), out.end();
    out.key("b"), out.array(2), out.object(0), out.end(), out.object(1), out.key("c"), out.boolean(true), out.end();
    out.end();
    out.key("d"), out.text("e");
    out.end();
  };
  EXPECT_EQ(text_of(emitted(Format::json, say)), "{\n\"a\":[1,2],\n\"b\":[\n{},\n{\"c\":true}],\n\"d\":\"e\"\n}\n");
}

TEST(Emitter, WritesTheShortestDecimalsAndTheSignOfZero) {
  EXPECT_EQ(json_number(0.1), "0.1");
  EXPECT_EQ(json_number(3), "3");
  EXPECT_EQ(json_number(0.0), "0");
  EXPECT_EQ(json_number(-0.0), "-0.0");
  EXPECT_EQ(json_number(1e300), "1e+300");
  EXPECT_EQ(json_number(std::numeric_limits<double>::denorm_min()), "5e-324");
}

TEST(Emitter, WritesCborHeadsAsRfc8949AppendixAHasThem) {
  const auto integer = [](Index value) { return emitted(Format::cbor, [&](Emitter& out) { out.integer(value); }); };
  EXPECT_EQ(integer(23), (Bytes{0x17}));
  EXPECT_EQ(integer(24), (Bytes{0x18, 0x18}));
  EXPECT_EQ(integer(1000), (Bytes{0x19, 0x03, 0xe8}));
  EXPECT_EQ(integer(1000000), (Bytes{0x1a, 0x00, 0x0f, 0x42, 0x40}));
  EXPECT_EQ(integer(1000000000000), (Bytes{0x1b, 0x00, 0x00, 0x00, 0xe8, 0xd4, 0xa5, 0x10, 0x00}));
  EXPECT_EQ(emitted(Format::cbor, [](Emitter& out) { out.number(1.1); }),
            (Bytes{0xfb, 0x3f, 0xf1, 0x99, 0x99, 0x99, 0x99, 0x99, 0x9a}));
  EXPECT_EQ(emitted(Format::cbor, [](Emitter& out) { out.array(2), out.boolean(false), out.text("IETF"), out.end(); }),
            (Bytes{0x82, 0xf4, 0x64, 'I', 'E', 'T', 'F'}));
  EXPECT_EQ(emitted(Format::cbor, [](Emitter& out) { out.object(25); }), (Bytes{0xb8, 0x19}));
}

}  // namespace
}  // namespace ifsm::core::test
