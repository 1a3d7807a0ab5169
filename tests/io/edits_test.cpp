// Logs of edits as files: what is read back makes the same curve, bit for bit; what is damaged or another model's is
// refused.
#include "io/edits.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "../deform/support.h"
#include "io/fingerprint.h"

namespace ifsm::core::testing {
namespace {

Bytes bytes_of(const std::string& text) { return {text.begin(), text.end()}; }
std::string text_of(const Bytes& bytes) { return {bytes.begin(), bytes.end()}; }

std::string edited(std::string text, const std::string& from, const std::string& to) {
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

Deformer edited_at_random(const ModelPtr& model, Random& random, int edits, Manner manner = {}) {
  Deformer deformer(model, manner);
  for (int k = 0; k < edits; ++k) {
    deformer.time_by({normal(random), 5 + std::abs(normal(random)), static_cast<Easing>(uniform(random, 0, 3))});
    deformer.apply(any_edit(deformer, random));
  }
  return deformer;
}

TEST(Edits, ComeBackFromBothEncodingsToTheBit) {
  Random random(1);
  for (const Subject& s : subjects(random)) {
    const ModelPtr model = rough(s, random);
    Deformer deformer = edited_at_random(model, random, 6);
    deformer.apply(Pin{1, {0}, true});
    deformer.apply(Texture{{0, 1, 1}, rough(s, random), 0.5, 0, 0xffffffffffffffff});
    for (const Format format : {Format::json, Format::cbor}) {
      const Bytes file = write_edits(deformer, format);
      Deformer again(model);
      again.replay(read_edits(file, again));
      EXPECT_EQ(all(again), all(deformer)) << name(*model);
      EXPECT_EQ(all(again.at_time(2.5)), all(deformer.at_time(2.5))) << name(*model);
      EXPECT_EQ(write_edits(again, format), file) << name(*model);
    }
  }
}

TEST(Edits, OfAnotherModelOrMannerAreRefused) {
  Random random(2);
  const Subject s{casteljau(Shape(Topology::joined, 3, 2)), false, 2};
  const ModelPtr model = rough(s, random);
  const Bytes file = write_edits(edited_at_random(model, random, 3), Format::cbor);

  ModelParts parts = model->parts();
  auto details = std::make_shared<Points>(*parts.details.back());
  details->matrix()(0, 1) = std::nextafter(details->matrix()(0, 1), 1e300);
  parts.details.back() = details;
  const Error other = refusal([&] { read_edits(file, Deformer(std::make_shared<Model>(std::move(parts)))); });
  EXPECT_EQ(other.status(), Status::shape);
  EXPECT_EQ(other.argument(), "model");
  EXPECT_EQ(refusal([&] {
              read_edits(file, Deformer(model, {Turning::rotation, Follow::moved}));
            }).argument(),
            "turning");
  EXPECT_EQ(refusal([&] {
              read_edits(file, Deformer(model, {Turning::similarity, Follow::none}));
            }).argument(),
            "follow");
}

// Equal models have the same; a bit in any part of one gives another.
TEST(Fingerprint, TellsModelsApart) {
  Random random(3);
  std::set<std::string> met;
  for (const Subject& s : subjects(random)) {
    const ModelPtr model = rough(s, random);
    EXPECT_EQ(fingerprint(*model).size(), 16u);
    EXPECT_EQ(fingerprint(*model), fingerprint(*std::make_shared<Model>(model->parts())));
    met.insert(fingerprint(*model));
    ModelParts moved = model->parts();
    moved.center[0] += 1;
    met.insert(fingerprint(Model(moved)));
    ModelParts shifted = model->parts();
    shifted.polygon.matrix()(0, 0) += 1;
    if (s.closed && s.filter->shape().joined())
      shifted.polygon.matrix().bottomRows(1) = shifted.polygon.matrix().row(0);
    met.insert(fingerprint(Model(shifted)));
  }
  EXPECT_EQ(met.size(), 3 * subjects(random).size());
}

struct Small {
  Small() : model(rough({casteljau(Shape(Topology::joined, 3, 2)), false, 2}, random, 9)), deformer(model) {
    Move bend = move(0, {1}, vectors(random, 1, 2));
    deformer.apply(bend);
    deformer.apply(Pin{1, {0, 2}, true});
    Points place = deformer.now().at({0.4});
    place.matrix().array() += 0.01;
    deformer.apply(drag(1, {0.4}, place, Lead::details));
    deformer.apply(Restyle{{0, 1, 0}, 0.5, 0.25, 1});
    deformer.apply(Texture{{1, 1, 0}, model, 0.5, 0, 7});
    json = text_of(write_edits(deformer, Format::json));
  }

  Random random{4};
  ModelPtr model;
  Deformer deformer;
  std::string json;
};

TEST(Edits, NameTheEntryThatIsWrong) {
  const Small small;
  const struct {
    const char *from, *to;
    Status status;
    const char* argument;
  } table[] = {
      {"\"format\":\"ifsm-edits\"", "\"format\":\"ifsm-model\"", Status::format, "format"},
      {"\"version\":1", "\"version\":2", Status::version, "version"},
      {"\"turning\":\"similarity\"", "\"turning\":\"round\"", Status::format, "turning"},
      {"\"follow\":\"moved\",", "", Status::format, "follow"},
      {"\"easing\":\"smooth\"", "\"easing\":\"slow\"", Status::format, "edits[0].easing"},
      {"\"begin\":0", "\"begin\":true", Status::format, "edits[0].begin"},
      {"\"begin\":0", "\"begin\":1e999", Status::not_finite, "edits[0].begin"},
      {"\"begin\":0", "\"begin\":2", Status::range, "edits[0].end"},
      {"\"handles\":[1]", "\"handles\":[1,2]", Status::shape, "edits[0].move.vectors"},
      {"\"handles\":[1]", "\"handles\":[9]", Status::range, "edits[0].handles"},
      {"\"handles\":[1]", "\"handles\":[0.5]", Status::format, "edits[0].move.handles[0]"},
      {"\"level\":0", "\"level\":-1", Status::format, "edits[0].move.level"},
      {"\"level\":0", "\"level\":77", Status::range, "edits[0].level"},
      {"\"reach\":\"nodes\"", "\"reach\":\"far\"", Status::format, "edits[0].move.reach"},
      {"\"move\":", "\"shove\":", Status::format, "edits[0].shove"},
      {"\"hold\":true", "\"hold\":1", Status::format, "edits[1].pin.hold"},
      {"\"lead\":\"details\"", "\"lead\":\"\"", Status::format, "edits[2].drag.lead"},
      {"\"parameters\":[0.4]", "\"parameters\":[1.4]", Status::range, "edits[2].parameters"},
      {"\"mirror\":2", "\"mirror\":3", Status::range, "edits[3].mirror"},
      {"\"share\":1", "\"share\":1.5", Status::range, "edits[3].share"},
      {"\"seed\":\"7\"", "\"seed\":\"-7\"", Status::format, "edits[4].texture.seed"},
      {"\"seed\":\"7\"", "\"seed\":\"18446744073709551616\"", Status::format, "edits[4].texture.seed"},
      {"\"dense\":[", "\"dense\":[1,", Status::shape, "edits[4].texture.details[1].dense"},
      {"\"details\":[", "\"details\":[{},", Status::shape, "edits[4].texture.details"},
  };
  for (const auto& row : table) {
    Deformer deformer(small.model);
    const Error error =
        refusal([&] { deformer.replay(read_edits(bytes_of(edited(small.json, row.from, row.to)), deformer)); });
    EXPECT_EQ(error.argument(), row.argument) << row.to << ": " << error.what();
    EXPECT_EQ(static_cast<int>(error.status()), static_cast<int>(row.status)) << row.to << ": " << error.what();
    EXPECT_EQ(deformer.edits(), 0);
  }
  const std::string two =
      edited(small.json, "\"move\":", "\"pin\":{\"level\":0,\"handles\":[],\"hold\":true},\"move\":");
  EXPECT_EQ(refusal([&] { read_edits(bytes_of(two), small.deformer); }).argument(), "edits[0]");
}

// Cut short, or with any bit turned: an error or other edits, and never anything else.
TEST(Edits, SurviveEveryTruncationAndEveryBitTurned) {
  const Small small;
  for (const Format format : {Format::json, Format::cbor}) {
    const Bytes file = write_edits(small.deformer, format);
    for (std::size_t length = 0; length + 1 < file.size(); ++length)
      refusal([&] { read_edits(std::span(file).first(length), small.deformer); });
    int made = 0;
    for (std::size_t at = 0; at < file.size(); ++at)
      for (const int bits : {0, 1, 2, 4, 8, 16, 32, 64, 128, 255}) {
        Bytes damaged = file;
        damaged[at] = static_cast<std::uint8_t>(damaged[at] ^ bits);
        Deformer deformer(small.model);
        try {
          deformer.replay(read_edits(damaged, deformer));
          ++made;
        } catch (const Error&) {
          EXPECT_EQ(deformer.edits(), 0);
        }
      }
    EXPECT_GT(made, 0);
  }
}

}  // namespace
}  // namespace ifsm::core::testing
