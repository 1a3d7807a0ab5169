// Files that are damaged, contradict themselves, or ask for too much: each fails with an error that names the cause.
#include <gtest/gtest.h>

#include <rapidcheck/gtest.h>

#include "support.h"

namespace ifsm::core::test {
namespace {

const std::string good =
    R"({"format":"ifsm-model","version":1,"dimension":2,"closed":false,"samples":5,"levels":2,
"filter":{"topology":"joined","control_points":2,"maps":2,"stride":1,"matrix":[1,0.5,0,0,0.5,1,0,1,0]},
"center":[1,2],"diagonal":3,"largest_polygon":2.5,"control_points":[-1,0,1,0.25],
"details":[{"dense":[0.5,-0.5]},{"at":[1],"vectors":[0.125,3e-5]}]})";

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

struct Damage {
  std::string from, to;
  Status status;
  std::string argument;
  std::int64_t index = -1;
};

TEST(Reader, TakesTheFileThatTheTablesDamage) {
  const ModelPtr model = read_model(bytes_of(good));
  EXPECT_EQ(model->details_kept(), 2);
  EXPECT_EQ(model->details(1).matrix()(1, 0), 0.125);
  EXPECT_EQ(model->details(1).matrix()(0, 0), 0);
}

TEST(Reader, TakesWhiteSpaceAByteOrderMarkAndKeysInAnyOrder) {
  EXPECT_FALSE(complaint(bytes_of(" \r\n\t" + good + "\n ")));
  EXPECT_FALSE(complaint(bytes_of("\xef\xbb\xbf" + good)));
  EXPECT_FALSE(complaint(bytes_of(edited(edited(good, R"("format":"ifsm-model","version":1,)", ""), R"(3e-5]}]})",
                                         R"(3e-5]}],"version":1,"format":"ifsm-model"})"))));
}

TEST(Reader, NamesTheEntryThatIsWrong) {
  const Damage table[] = {
      // keys
      {R"("closed":false,)", "", Status::format, "closed"},
      {R"("format":"ifsm-model",)", "", Status::format, "format"},
      {R"("version":1,)", "", Status::format, "version"},
      {R"("maps":2,)", "", Status::format, "filter.maps"},
      {R"("closed":false)", R"("closed":false,"closed":true)", Status::format, "closed"},
      {R"("version":1)", R"("version":1,"version":2)", Status::format, "version"},
      {R"("stride":1)", R"("stride":1,"stride":1)", Status::format, "filter.stride"},
      {R"("closed":false)", R"("closed":false,"colour":"red")", Status::format, "colour"},
      {R"("at":[1])", R"("at":[1],"by":{})", Status::format, "details[1].by"},
      {R"("at":[1])", R"("at":[1],"\u0000\u00e9":1)", Status::format, "details[1].???"},
      // types
      {R"("closed":false)", R"("closed":0)", Status::format, "closed"},
      {R"("samples":5)", R"("samples":5.0)", Status::format, "samples"},
      {R"("samples":5)", R"("samples":"5")", Status::format, "samples"},
      {R"("samples":5)", R"("samples":null)", Status::format, "samples"},
      {R"("samples":5)", R"("samples":[5])", Status::format, "samples"},
      {R"("samples":5)", R"("samples":99999999999999999999)", Status::format, "samples"},
      {R"("version":1)", R"("version":"1")", Status::format, "version"},
      {R"("topology":"joined")", R"("topology":0)", Status::format, "filter.topology"},
      {R"("center":[1,2])", R"("center":1)", Status::format, "center"},
      {R"("center":[1,2])", R"("center":{})", Status::format, "center"},
      {R"("center":[1,2])", R"("center":[1,[2]])", Status::format, "center[1]", 1},
      {R"("center":[1,2])", R"("center":[1,{}])", Status::format, "center[1]", 1},
      {R"("center":[1,2])", R"("center":[1,"2"])", Status::format, "center[1]", 1},
      {R"("at":[1])", R"("at":[1.5])", Status::format, "details[1].at[0]", 0},
      {R"({"dense":[0.5,-0.5]})", "1", Status::format, "details[0]", 0},
      {R"({"dense":[0.5,-0.5]})", "[]", Status::format, "details[0]", 0},
      {R"("diagonal":3)", R"("diagonal":{"x":3})", Status::format, "diagonal"},
      // numbers
      {"0.125", "1e999", Status::not_finite, "details[1].vectors[0]", 0},
      {R"("diagonal":3)", R"("diagonal":-1e999)", Status::not_finite, "diagonal"},
      {"0.125", "NaN", Status::format, "bytes", 327},
      {R"("diagonal":3)", R"("diagonal":-3)", Status::format, "diagonal"},
      {R"("largest_polygon":2.5)", R"("largest_polygon":-1)", Status::format, "largest_polygon"},
      // what they say
      {"ifsm-model", "ifsm-system", Status::format, "format"},
      {R"("version":1)", R"("version":2,"unheard_of":[{}])", Status::version, "version"},
      {R"("version":1)", R"("version":0)", Status::version, "version"},
      {R"("dimension":2)", R"("dimension":0)", Status::format, "dimension"},
      {R"("dimension":2)", R"("dimension":5)", Status::format, "dimension"},
      {R"("dimension":2)", R"("dimension":3)", Status::shape, "center"},
      {"joined", "knotted", Status::format, "filter.topology"},
      {"joined", "square", Status::shape, "filter.matrix"},
      {R"("control_points":2,)", R"("control_points":1,)", Status::format, "filter.control_points"},
      {R"("control_points":2,)", R"("control_points":17,)", Status::format, "filter.control_points"},
      {R"("control_points":2,)", R"("control_points":4294967298,)", Status::format, "filter.control_points"},
      {R"("maps":2)", R"("maps":9)", Status::format, "filter.maps"},
      {R"("stride":1)", R"("stride":0)", Status::format, "filter.stride"},
      {R"("stride":1)", R"("stride":2)", Status::format, "filter.stride"},
      {"0,1,0]", "0,1]", Status::shape, "filter.matrix"},
      {"0.5,0,0,0.5", "0.5,0,0,0.25", Status::singular, "filter.matrix", 1},
      {"0,1,0]", "0,0,0]", Status::singular, "filter.matrix"},
      {"0,1,0]", "0,1,1]", Status::singular, "filter.matrix", 8},
      {"0,1,0]", "0,1e308,0]", Status::singular, "filter.matrix"},
      {R"([-1,0,1,0.25])", "[-1,0,1]", Status::shape, "control_points"},
      {R"("closed":false,"samples":5)", R"("closed":true,"samples":4)", Status::format, "control_points", 2},
      // samples and levels
      {R"("samples":5)", R"("samples":0)", Status::format, "samples"},
      {R"("samples":5)", R"("samples":-5)", Status::format, "samples"},
      {R"("samples":5)", R"("samples":6)", Status::format, "samples"},
      {R"("levels":2)", R"("levels":1)", Status::shape, "details"},
      {R"("levels":2)", R"("levels":3)", Status::shape, "details"},
      {R"("levels":2)", R"("levels":-1)", Status::format, "levels"},
      {R"("levels":2)", R"("levels":41)", Status::format, "levels"},
      {R"("levels":2)", R"("levels":40)", Status::limit, "levels"},
      {R"("levels":2)", R"("levels":30)", Status::limit, "levels"},
      // details
      {"[0.5,-0.5]", "[0.5]", Status::shape, "details[0].dense"},
      {R"("dense":[0.5,-0.5])", R"("dense":[0.5,-0.5],"at":[0],"vectors":[1,1])", Status::format, "details[0]"},
      {R"("at":[1])", R"("at":[0,1])", Status::shape, "details[1].vectors"},
      {R"("at":[1],)", "", Status::shape, "details[1].vectors"},
      {R"(,"vectors":[0.125,3e-5])", "", Status::shape, "details[1].vectors"},
      {R"("at":[1])", R"("at":[2])", Status::format, "details[1].at[0]", 0},
      {R"("at":[1])", R"("at":[-1])", Status::format, "details[1].at[0]", 0},
      {R"("at":[1],"vectors":[)", R"("at":[1,1],"vectors":[1,1,)", Status::format, "details[1].at[1]", 1},
      {R"("at":[1],"vectors":[)", R"("at":[1,0],"vectors":[1,1,)", Status::format, "details[1].at[1]", 1},
      // the text itself
      {"3e-5]}]}", "3e-5]}]} x", Status::format, "bytes"},
      {"3e-5]}]}", "3e-5]}]}{}", Status::format, "bytes"},
      {"3e-5]}]}", "3e-5]}]", Status::format, "bytes"},
      {"3e-5]}]}", "3e-5]}],}", Status::format, "bytes"},
      {R"("closed")", "closed", Status::format, "bytes"},
      {R"("closed")", "/* open? */ \"closed\"", Status::format, "bytes"},
      {"{\"format\"", "[\"format\"", Status::format, "bytes", 0},
      {"{\"format\"", " [\"format\"", Status::format, "bytes"},
      {R"("center":[)", R"("center":[[[[[[[[[)", Status::format, "center[0]", 0},
      {R"({"format")", R"({"x":[[[[[[[[1]]]]]]]],"format")", Status::limit, "bytes", 12},
  };
  for (const Damage& damage : table) {
    const auto error = complaint(bytes_of(edited(good, damage.from, damage.to)));
    ASSERT_TRUE(error) << damage.to << " was taken";
    EXPECT_EQ(error->status(), damage.status) << damage.to << ": " << error->what();
    EXPECT_EQ(error->argument(), damage.argument) << damage.to << ": " << error->what();
    if (damage.argument != "bytes" || damage.index >= 0) {
      EXPECT_EQ(error->index(), damage.index) << damage.to << ": " << error->what();
    }
    EXPECT_GT(std::string(error->what()).size(), 20u);
  }
}

TEST(Reader, RefusesWhatIsNoModelAtAll) {
  for (const std::string& text :
       {std::string(), std::string("{"), std::string("{}"), std::string("  "), std::string("null"), std::string("\xf7"),
        std::string("\xa0"), std::string("\xbf\xff"), std::string("\x89PNG")}) {
    const auto error = complaint(bytes_of(text));
    ASSERT_TRUE(error) << text;
    EXPECT_EQ(error->status(), Status::format) << text;
  }
}

TEST(Reader, RefusesWhatFollowsANul) {
  const auto error = complaint(bytes_of(good + std::string("\0{}", 3)));
  ASSERT_TRUE(error);
  EXPECT_EQ(error->status(), Status::format);
  EXPECT_EQ(error->index(), static_cast<std::int64_t>(good.size()));
}

TEST(Reader, BoundsTextsAndWhiteSpace) {
  const std::string endless(1 << 20, ' '), name(1 << 20, 'a');
  for (const std::string& text : {edited(good, ",", "," + endless), edited(good, "joined", name)}) {
    const auto error = complaint(bytes_of(text));
    ASSERT_TRUE(error);
    EXPECT_EQ(error->status(), Status::limit) << error->what();
  }
}

// -------- CBOR

// {"format": followed by the given bytes
Bytes cbor_header(const Bytes& rest) {
  Bytes bytes = {0xac, 0x66, 'f', 'o', 'r', 'm', 'a', 't'};
  bytes.insert(bytes.end(), rest.begin(), rest.end());
  return bytes;
}

Bytes repeated(const Bytes& pattern, int times) {
  Bytes bytes;
  for (int i = 0; i < times; ++i) bytes.insert(bytes.end(), pattern.begin(), pattern.end());
  return bytes;
}

TEST(Reader, RefusesCborThatNestsOrPromisesTooMuch) {
  const struct {
    Bytes rest;
    Status status;
  } table[] = {
      {repeated({0x7f}, 1 << 20), Status::limit},  // texts in pieces, in pieces, …: no recursion without end
      {repeated({0x7f, 0x60}, 1 << 20), Status::limit},
      {repeated({0x5f}, 1 << 20), Status::limit},  // the same of byte strings
      {repeated({0x81}, 1 << 20), Status::limit},  // arrays in arrays
      {repeated({0x9f}, 1 << 20), Status::limit},
      {repeated({0xa1, 0x60}, 1 << 20), Status::limit},                          // maps in maps
      {repeated({0xc1}, 1 << 20), Status::format},                               // tags on tags
      {{0x9b, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff}, Status::format},  // 2^64 - 1 elements
      {{0x9b, 0x7f, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 1}, Status::format},
      {{0x7b, 0x7f, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 'a'}, Status::format},  // a text of 2^63 - 1 bytes
      {{0x5b, 0x7f, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 'a'}, Status::format},
      {{0x41, 'a'}, Status::format},               // a byte string
      {{0xf7}, Status::format},                    // undefined
      {{0xd9, 0xd9, 0xf7, 0x6a}, Status::format},  // a tag
      {{0x1c}, Status::format},                    // reserved
  };
  for (const auto& damage : table) {
    const auto error = complaint(cbor_header(damage.rest));
    ASSERT_TRUE(error);
    EXPECT_EQ(error->status(), damage.status) << error->what();
  }
}

Bytes good_cbor() { return write_model(*read_model(bytes_of(good)), Format::cbor); }

// The head of `count` arrays or the double itself, replaced where it stands.
Bytes replaced(Bytes bytes, const Bytes& from, const Bytes& to) {
  const auto at = std::search(bytes.begin(), bytes.end(), from.begin(), from.end());
  EXPECT_NE(at, bytes.end());
  const auto place = bytes.erase(at, at + static_cast<std::ptrdiff_t>(from.size()));
  bytes.insert(place, to.begin(), to.end());
  return bytes;
}

const Bytes eighth = {0xfb, 0x3f, 0xc0, 0, 0, 0, 0, 0, 0};  // 0.125, details[1].vectors[0]

TEST(Reader, NamesCborNumbersThatAreNotFinite) {
  for (const Bytes& bad : {Bytes{0xfb, 0x7f, 0xf8, 0, 0, 0, 0, 0, 0}, Bytes{0xfb, 0xff, 0xf0, 0, 0, 0, 0, 0, 0},
                           Bytes{0xfa, 0x7f, 0x80, 0, 0}, Bytes{0xf9, 0x7e, 0x00}}) {
    const auto error = complaint(replaced(good_cbor(), eighth, bad));
    ASSERT_TRUE(error);
    EXPECT_EQ(error->status(), Status::not_finite);
    EXPECT_EQ(error->argument(), "details[1].vectors[0]");
    EXPECT_EQ(error->index(), 0);
    EXPECT_FALSE(std::isfinite(error->value()));
  }
}

TEST(Reader, TakesCborNumbersOfEveryWidth) {
  const auto read_as = [](const Bytes& number) {
    return read_model(replaced(good_cbor(), eighth, number))->details(1).matrix()(1, 0);
  };
  EXPECT_EQ(read_as({0xf9, 0x3e, 0x00}), 1.5);                   // binary16
  EXPECT_EQ(read_as({0xfa, 0x47, 0xc3, 0x50, 0x00}), 100000.0);  // binary32
  EXPECT_EQ(read_as({0x18, 0x64}), 100.0);                       // integers
  EXPECT_EQ(read_as({0x38, 0x63}), -100.0);
  EXPECT_EQ(read_as({0x1b, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff}), 0x1p64);
  EXPECT_EQ(read_as({0x3b, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff}), -0x1p64);  // parsers wrap it to 0
  EXPECT_TRUE(same_bits(read_model(bytes_of(edited(good, "0.125", "-0")))->details(1).matrix()(1, 0), -0.0));
}

TEST(Reader, TakesCborOfUnstatedLengths) {
  Bytes bytes = good_cbor();
  bytes[0] = 0xbf;
  bytes.push_back(0xff);
  EXPECT_FALSE(complaint(bytes));
}

TEST(Reader, RefusesBytesBehindTheValue) {
  Bytes bytes = good_cbor();
  for (const int more : {0x00, 0x20, 0xf6, 0xff}) {
    bytes.push_back(static_cast<std::uint8_t>(more));
    const auto error = complaint(bytes);
    ASSERT_TRUE(error);
    EXPECT_EQ(error->status(), Status::format);
    bytes.pop_back();
  }
}

// -------- whatever happens to a file

TEST(Reader, RefusesEveryTruncation) {
  for (const Bytes& file : {bytes_of(good), good_cbor()})
    for (std::size_t length = 0; length < file.size(); ++length) {
      const auto error = complaint({file.begin(), file.begin() + static_cast<std::ptrdiff_t>(length)});
      ASSERT_TRUE(error) << length;
      EXPECT_EQ(error->status(), Status::format) << length << ": " << error->what();
      EXPECT_LE(error->index(), static_cast<std::int64_t>(length));
    }
}

// A file that loads is written and read again without a loss; any other fails with an Error.
void require_sound(const Bytes& file) {
  try {
    const ModelPtr model = read_model(file);
    ASSERT_TRUE(same_bits(*model, *read_model(write_model(*model, Format::cbor))));
    ASSERT_TRUE(same_bits(*model, *read_model(write_model(*model, Format::json))));
  } catch (const Error& error) {
    ASSERT_NE(error.status(), Status::internal);
    ASSERT_NE(error.status(), Status::range) << error.what();  // kept for arguments of the call
  }
}

TEST(Reader, SurvivesEveryByteReplacedByEveryOther) {
  for (Bytes file : {bytes_of(good), good_cbor()})
    for (std::uint8_t& byte : file) {
      const std::uint8_t before = byte;
      for (int other = 0; other < 256; ++other) {
        byte = static_cast<std::uint8_t>(other);
        require_sound(file);
      }
      byte = before;
    }
}

RC_GTEST_PROP(Reader, SurvivesDamagedRandomModels, (std::uint64_t seed)) {
  Random random(seed);
  Bytes file = write_model(*random_model(random), random.flag() ? Format::json : Format::cbor);
  const int last = static_cast<int>(file.size()) - 1;
  for (int damages = random.integer(1, 4); damages > 0; --damages)
    file[static_cast<std::size_t>(random.integer(0, last))] = static_cast<std::uint8_t>(random.integer(0, 255));
  require_sound(file);
}

}  // namespace
}  // namespace ifsm::core::test
