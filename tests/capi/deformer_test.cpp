// Deformers through the C ABI: what each function answers, and that one call at a time has them.
#include <atomic>
#include <cmath>
#include <string>
#include <thread>
#include <vector>

#include "shapes.h"
#include "support.h"

namespace {

class Deformers : public testing::Test {
 protected:
  void SetUp() override {
    WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 5, 2, &filter));
    const ifsm_curve curve = curve_of(wave_);
    WORKS(ifsm_model_create(filter, &curve, nullptr, &model));
    WORKS(ifsm_deformer_create(model, nullptr, &deformer));
  }
  void TearDown() override {
    WORKS(ifsm_deformer_destroy(deformer));
    WORKS(ifsm_model_destroy(model));
    WORKS(ifsm_filter_destroy(filter));
  }

  std::vector<double> samples() { return samples_of(deformer); }
  static std::vector<double> samples_of(ifsm_deformer of) {
    int64_t count = 0;
    EXPECT_EQ(ifsm_deformer_samples(of, nullptr, 0, &count), IFSM_OK);
    std::vector<double> values(static_cast<size_t>(count));
    EXPECT_EQ(ifsm_deformer_samples(of, values.data(), count, &count), IFSM_OK);
    return values;
  }
  static std::vector<double> samples_of(ifsm_model of) {
    int64_t count = 0;
    EXPECT_EQ(ifsm_model_samples(of, nullptr, 0, &count), IFSM_OK);
    std::vector<double> values(static_cast<size_t>(count));
    EXPECT_EQ(ifsm_model_samples(of, values.data(), count, &count), IFSM_OK);
    return values;
  }
  ifsm_deformer_info info() {
    ifsm_deformer_info told{};
    told.struct_size = sizeof told;
    EXPECT_EQ(ifsm_deformer_describe(deformer, &told), IFSM_OK);
    return told;
  }

  const std::vector<double> wave_ = wavy(129);
  ifsm_filter filter{};
  ifsm_model model{};
  ifsm_deformer deformer{};
};

TEST_F(Deformers, AreTheModelBeforeAnEditAndAfterUndoingAll) {
  const std::vector<double> before = samples();
  EXPECT_EQ(before, samples_of(model));
  const int64_t handles[] = {1, 2};
  const double by[] = {1, 2, 3, 4};
  WORKS(ifsm_deformer_move(deformer, 0, handles, 2, by, 4, nullptr));
  WORKS(ifsm_deformer_restyle(deformer, 1, 2, 0.5, nullptr));
  EXPECT_NE(samples(), before);
  EXPECT_EQ(info().undoable, 2);
  EXPECT_EQ(info().edits, 2);
  WORKS(ifsm_deformer_keep_as(deformer, "bent"));
  const std::vector<double> bent = samples();
  WORKS(ifsm_deformer_undo(deformer));
  WORKS(ifsm_deformer_undo(deformer));
  EXPECT_EQ(samples(), before);
  EXPECT_EQ(info().redoable, 2);
  FAILS(ifsm_deformer_undo(deformer), IFSM_ERROR_RANGE, "deformer");
  WORKS(ifsm_deformer_go_to(deformer, "bent"));
  EXPECT_EQ(samples(), bent);
  EXPECT_EQ(info().edits, 2);
  FAILS(ifsm_deformer_go_to(deformer, "straight"), IFSM_ERROR_RANGE, "name");
  FAILS(ifsm_deformer_keep_as(deformer, std::string(256, 'x').c_str()), IFSM_ERROR_RANGE, "name");
  FAILS(ifsm_deformer_keep_as(deformer, ""), IFSM_ERROR_RANGE, "name");
}

TEST_F(Deformers, UpdateTheCallersBufferByTheWindowThatChanged) {
  const int32_t finest = info().levels;
  int64_t count = 0;
  WORKS(ifsm_deformer_points(deformer, finest, 0, 129, nullptr, 0, &count));
  std::vector<double> buffer(static_cast<size_t>(count)), whole = buffer;
  WORKS(ifsm_deformer_points(deformer, finest, 0, 129, buffer.data(), count, &count));
  const int64_t handle = 9;
  const double by[] = {0.5, -1};
  WORKS(ifsm_deformer_move(deformer, 3, &handle, 1, by, 2, nullptr));
  int64_t first = 0, number = 0;
  WORKS(ifsm_deformer_changed(deformer, finest, &first, &number));
  EXPECT_LE(number, 17);
  WORKS(ifsm_deformer_points(deformer, finest, first, number, buffer.data() + 2 * first, 2 * number, &count));
  WORKS(ifsm_deformer_points(deformer, finest, 0, 129, whole.data(), 258, &count));
  EXPECT_EQ(buffer, whole);
}

TEST_F(Deformers, DragPointsAndGiveModels) {
  const double at[] = {0.25, 0.7};
  double places[4], now[4];
  int64_t count = 0;
  WORKS(ifsm_deformer_evaluate(deformer, at, 2, places, 4, &count));
  places[2] += 0.5;
  WORKS(ifsm_deformer_drag(deformer, 3, IFSM_LEAD_HANDLES, at, 2, places, 4));
  WORKS(ifsm_deformer_evaluate(deformer, at, 2, now, 4, &count));
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(now[k], places[k], 1e-10);
  ifsm_model snapshot{};
  WORKS(ifsm_deformer_snapshot(deformer, &snapshot));
  const std::vector<double> told = samples_of(snapshot), wanted = samples();
  ASSERT_EQ(told.size(), wanted.size());
  for (size_t k = 0; k < told.size(); ++k) EXPECT_NEAR(told[k], wanted[k], 1e-10);
  WORKS(ifsm_model_destroy(snapshot));
  const double same[] = {0.25, 0.25};
  FAILS(ifsm_deformer_drag(deformer, 3, IFSM_LEAD_HANDLES, same, 2, places, 4), IFSM_ERROR_SINGULAR, "parameters");
}

TEST_F(Deformers, RefuseMovesOfPinsAndTextureOfOtherShapes) {
  const int64_t handles[] = {4, 5};
  const double by[] = {1, 1, 1, 1};
  WORKS(ifsm_deformer_pin(deformer, 2, handles + 1, 1, 1));
  const std::vector<double> before = samples();
  FAILS(ifsm_deformer_move(deformer, 2, handles, 2, by, 4, nullptr), IFSM_ERROR_RANGE, "handles");
  EXPECT_EQ(last_error().index, 1);
  ifsm_filter other{};
  ifsm_model stranger{};
  const ifsm_curve curve = curve_of(wave_);
  WORKS(ifsm_filter_named("casteljau", IFSM_TOPOLOGY_JOINED, 3, 2, &other));
  WORKS(ifsm_model_create(other, &curve, nullptr, &stranger));
  ifsm_texture_options options;
  WORKS(ifsm_texture_options_init(&options, sizeof options));
  options.from = stranger;
  FAILS(ifsm_deformer_texture(deformer, 0, 1, &options), IFSM_ERROR_SHAPE, "from");
  EXPECT_EQ(samples(), before);
  WORKS(ifsm_model_destroy(stranger));
  WORKS(ifsm_filter_destroy(other));
}

TEST_F(Deformers, SaveTheirEditsAndMakeThemAgainOnTheSameModelAlone) {
  const int64_t handles[] = {1, 3};
  const double by[] = {1, 2, 3, 4};
  WORKS(ifsm_deformer_time(deformer, 2, 4, IFSM_EASING_LINEAR));
  WORKS(ifsm_deformer_move(deformer, 0, handles, 2, by, 4, nullptr));
  WORKS(ifsm_deformer_time(deformer, 4, 4, IFSM_EASING_OUT));
  WORKS(ifsm_deformer_restyle(deformer, 2, 3, 0.5, nullptr));
  WORKS(ifsm_deformer_pin(deformer, 1, handles, 1, 1));
  WORKS(ifsm_deformer_undo(deformer));
  for (const int32_t format : {IFSM_FORMAT_JSON, IFSM_FORMAT_CBOR}) {
    int64_t count = 0;
    WORKS(ifsm_deformer_save(deformer, format, nullptr, 0, &count));
    std::vector<uint8_t> file(static_cast<size_t>(count));
    WORKS(ifsm_deformer_save(deformer, format, file.data(), count, &count));
    ifsm_deformer again{}, frames[2] = {};
    WORKS(ifsm_deformer_create(model, nullptr, &again));
    WORKS(ifsm_deformer_replay(again, file.data(), count));
    WORKS(ifsm_deformer_at_time(deformer, 3, &frames[0]));
    WORKS(ifsm_deformer_at_time(again, 3, &frames[1]));
    EXPECT_EQ(samples_of(again), samples());
    EXPECT_EQ(samples_of(frames[0]), samples_of(frames[1]));
    EXPECT_NE(samples_of(frames[0]), samples());
    // A frame knows the edits of its time: the move by half, and no restyle.
    ifsm_deformer_info told{};
    told.struct_size = sizeof told;
    WORKS(ifsm_deformer_describe(frames[0], &told));
    EXPECT_EQ(told.edits, 1);

    EXPECT_EQ(ifsm_deformer_replay(again, file.data(), count - 2), IFSM_ERROR_FORMAT);
    EXPECT_STREQ(last_error().argument, "bytes");
    ifsm_model other{};
    WORKS(ifsm_deformer_snapshot(again, &other));
    ifsm_deformer stranger{};
    WORKS(ifsm_deformer_create(other, nullptr, &stranger));
    FAILS(ifsm_deformer_replay(stranger, file.data(), count), IFSM_ERROR_SHAPE, "model");
    for (const ifsm_deformer one : {again, frames[0], frames[1], stranger}) WORKS(ifsm_deformer_destroy(one));
    WORKS(ifsm_model_destroy(other));
  }
  EXPECT_EQ(info().begin, 2);
  EXPECT_EQ(info().end, 4);
  FAILS(ifsm_deformer_time(deformer, 2, 1, IFSM_EASING_LINEAR), IFSM_ERROR_RANGE, "end");
}

TEST_F(Deformers, TellTheCrossingsThatTheyCaused) {
  int64_t before = 0, count = -1;
  WORKS(ifsm_model_crossings(model, nullptr, 0, &before));
  WORKS(ifsm_deformer_crossings(deformer, nullptr, 0, &count));
  EXPECT_EQ(count, 0);
  // The two inner control points change sides: a loop.
  const int64_t inner[] = {1, 3};
  const double by[] = {10, 10, -10, 10};
  WORKS(ifsm_deformer_move(deformer, 0, inner, 2, by, 4, nullptr));
  WORKS(ifsm_deformer_crossings(deformer, nullptr, 0, &count));
  ASSERT_GT(count, 0);
  EXPECT_EQ(count % 6, 0);
  std::vector<double> rows(static_cast<size_t>(count));
  WORKS(ifsm_deformer_crossings(deformer, rows.data(), count, &count));
  for (size_t row = 0; row < rows.size(); row += 6) {
    double points[4];
    int64_t number = 0;
    WORKS(ifsm_deformer_evaluate(deformer, &rows[row], 2, points, 4, &number));
    EXPECT_NEAR(points[0], points[2], 1e-9);
    EXPECT_NEAR(points[1], points[3], 1e-9);
    EXPECT_NEAR(points[0], rows[row + 4], 1e-9);
  }
  ifsm_model now{};
  WORKS(ifsm_deformer_snapshot(deformer, &now));
  int64_t all = 0;
  WORKS(ifsm_model_crossings(now, nullptr, 0, &all));
  EXPECT_LE(count, all);
  EXPECT_GE(count, all - before);
  WORKS(ifsm_model_destroy(now));
  WORKS(ifsm_deformer_undo(deformer));
  WORKS(ifsm_deformer_crossings(deformer, nullptr, 0, &count));
  EXPECT_EQ(count, 0);
}

TEST_F(Deformers, KeepTheirModelAlive) {
  const std::vector<double> before = samples();
  WORKS(ifsm_model_destroy(model));
  model = {};
  EXPECT_EQ(samples(), before);
}

TEST_F(Deformers, AreBusyForASecondThreadAndNeverHalfEdited) {
  const int64_t handle = 2;
  std::vector<std::thread> threads;
  std::atomic<int> done{0}, refused{0}, other{0};
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&, t] {
      const double by[] = {0.25 * (t + 1), -0.5};
      for (int k = 0; k < 200; ++k) {
        const ifsm_status status = ifsm_deformer_move(deformer, 1, &handle, 1, by, 2, nullptr);
        ++(status == IFSM_OK ? done : status == IFSM_ERROR_BUSY ? refused : other);
        double points[34];
        int64_t count = 0;
        const ifsm_status read = ifsm_deformer_points(deformer, 2, 0, 17, points, 34, &count);
        if (read != IFSM_OK && read != IFSM_ERROR_BUSY) ++other;
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(other, 0);
  EXPECT_EQ(done + refused, 800);
  EXPECT_EQ(info().edits, done);
}

}  // namespace
