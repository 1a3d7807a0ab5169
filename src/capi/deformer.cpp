// Deformers: the one mutable kind.
#include "deform/deformer.h"

#include <ifsm.h>

#include <cstring>
#include <set>

#include "capi/arguments.h"
#include "capi/curves.h"
#include "capi/deforming.h"
#include "capi/guarded.h"
#include "capi/nouns.h"
#include "capi/rows.h"
#include "curve/evaluate.h"
#include "io/edits.h"

namespace ifsm::core {
namespace {

// A deformer for one call: other calls are refused until it ends.
class Held {
 public:
  explicit Held(ifsm_deformer handle) : shared_(borrow(handle)) {
    if (!shared_->busy.test_and_set(std::memory_order_acquire)) return;
    throw Error(
        Status::busy, "deformer",
        "Another call is using this deformer; wait until it has ended, or give each thread a deformer of its own.");
  }
  ~Held() { shared_->busy.clear(std::memory_order_release); }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;

  Deformer& operator*() const { return shared_->deformer; }
  Deformer* operator->() const { return &shared_->deformer; }

 private:
  std::shared_ptr<Deforming> shared_;
};

std::vector<Index> handles_of(const std::int64_t* handles, std::int64_t count) {
  const auto given = input(handles, count, "handles", "handle_count");
  return {given.begin(), given.end()};
}

// Points of the deformer's dimension; `count` doubles.
Points vectors_of(const Deformer& deformer, const double* values, std::int64_t count, Index needed,
                  const char* argument, const char* count_argument) {
  const auto given = input(values, count, argument, count_argument);
  require_count(given.count, checked_product(needed, deformer.model().dimension(), argument), count_argument);
  require_finite(given.data, given.count, argument);
  return Points::from_interleaved(given.data, needed, deformer.model().dimension());
}

std::string name_of(const char* name) {
  constexpr std::size_t longest = 255;
  const char* const given = &required(name, "name");
  const std::size_t length = strnlen(given, longest + 1);
  if (length == 0 || length > longest)
    throw Error(Status::range, "name", "name must have 1 to 255 bytes; give the state a name to be found by.")
        .with(static_cast<double>(length));
  return {given, length};
}

std::vector<double> parameters_of(const double* parameters, std::int64_t count) {
  const auto given = input(parameters, count, "parameters", "parameter_count");
  return {given.begin(), given.end()};
}

using SegmentPair = std::pair<Index, Index>;

SegmentPair segments_of(const Polyline& polyline, const Crossing& crossing) {
  constexpr double rounding = 1e-9;  // of a position that is told as a parameter
  const auto segment = [&](double parameter) { return static_cast<Index>(polyline.position(parameter) + rounding); };
  return {segment(crossing.first_p), segment(crossing.first_q)};
}

// Of the curve as it is, those between segments that do not meet in the model.
std::vector<Crossing> crossings_caused(const Deformer& deformer) {
  const Model& model = deformer.model();
  const Polyline before(model);
  const Polyline after(deformer.now().places(model.levels(), 0, deformer.now().count(model.levels())), model.closed());
  std::set<SegmentPair> had;
  for (const Crossing& crossing : crossings(before)) had.insert(segments_of(before, crossing));
  std::vector<Crossing> caused = crossings(after);
  std::erase_if(caused, [&](const Crossing& crossing) { return had.contains(segments_of(after, crossing)); });
  return caused;
}

}  // namespace
}  // namespace ifsm::core

using namespace ifsm::core;

ifsm_status ifsm_deformer_options_init(ifsm_deformer_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_deformer_create(ifsm_model model_handle, const ifsm_deformer_options* given, ifsm_deformer* deformer) {
  return guarded(__func__, [&] {
    const auto model = borrow(model_handle);
    const ifsm_deformer_options options = read_options(given);
    const Manner manner{choice(options.turning, Turning::linear, "turning"),
                        choice(options.follow, Follow::none, "follow")};
    in_range(options.reserved, 0, 0, "reserved");
    required(deformer, "deformer");
    issue(std::make_shared<Deforming>(Deformer(model, manner)), *deformer);
  });
}

ifsm_status ifsm_deformer_describe(ifsm_deformer handle, ifsm_deformer_info* info) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const Model& model = deformer->model();
    ifsm_deformer_info told{};
    told.dimension = static_cast<int32_t>(model.dimension());
    told.levels = model.levels();
    told.closed = model.closed() ? 1 : 0;
    told.undoable = deformer->undoable();
    told.redoable = deformer->redoable();
    told.edits = deformer->edits();
    const auto times = deformer->times();
    told.begin = times ? times->begin : 0;
    told.end = times ? times->end : 0;
    Report(info, "info").write(told);
  });
}

ifsm_status ifsm_deformer_destroy(ifsm_deformer deformer) {
  return guarded(__func__, [&] { destroy(deformer); });
}

ifsm_status ifsm_move_options_init(ifsm_move_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_deformer_move(ifsm_deformer handle, int32_t level, const int64_t* handles, int64_t handle_count,
                               const double* vectors, int64_t vector_count, const ifsm_move_options* given) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const ifsm_move_options options = read_options(given);
    Move edit;
    edit.level = level;
    edit.handles = handles_of(handles, handle_count);
    edit.vectors = vectors_of(*deformer, vectors, vector_count, handle_count, "vectors", "vector_count");
    edit.places = in_range(options.places, 0, 1, "places") == 1;
    edit.reach = choice(options.reach, Reach::curve, "reach");
    edit.falloff = choice(options.falloff, Falloff::smooth, "falloff");
    edit.ruler = choice(options.ruler, Ruler::length, "ruler");
    in_range(options.reserved, 0, 0, "reserved");
    require_finite(options.radius, "radius");
    edit.radius = options.radius;
    deformer->apply(edit);
  });
}

ifsm_status ifsm_deformer_pin(ifsm_deformer handle, int32_t level, const int64_t* handles, int64_t handle_count,
                              int32_t hold) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    deformer->apply(Pin{level, handles_of(handles, handle_count), in_range(hold, 0, 1, "hold") == 1});
  });
}

ifsm_status ifsm_deformer_drag(ifsm_deformer handle, int32_t level, int32_t lead, const double* parameters,
                               int64_t parameter_count, const double* places, int64_t place_count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    Drag edit;
    edit.level = level;
    edit.lead = choice(lead, Lead::details, "lead");
    edit.parameters = parameters_of(parameters, parameter_count);
    edit.places = vectors_of(*deformer, places, place_count, parameter_count, "places", "place_count");
    deformer->apply(edit);
  });
}

ifsm_status ifsm_restyle_options_init(ifsm_restyle_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_deformer_restyle(ifsm_deformer handle, int32_t first, int32_t last, double scale,
                                  const ifsm_restyle_options* given) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const ifsm_restyle_options options = read_options(given);
    in_range(options.mirror, 0, deformer->model().dimension(), "mirror");
    in_range(options.reserved, 0, 0, "reserved");
    deformer->apply(Restyle{{first, last, options.fade}, scale, options.angle, options.mirror - 1});
  });
}

ifsm_status ifsm_texture_options_init(ifsm_texture_options* options, uint32_t size) {
  return guarded(__func__, [&] { init_options(options, size); });
}

ifsm_status ifsm_deformer_texture(ifsm_deformer handle, int32_t first, int32_t last,
                                  const ifsm_texture_options* given) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const ifsm_texture_options options = read_options(given);
    require_finite(options.size, "size");
    Texture edit{{first, last, options.fade},
                 borrow_if_any(options.from, "from"),
                 options.roughness,
                 options.size,
                 options.seed};
    if (edit.roughness == 0) edit.roughness = 0.5;
    deformer->apply(edit);
  });
}

ifsm_status ifsm_deformer_undo(ifsm_deformer handle) {
  return guarded(__func__, [&] { Held(handle)->undo(); });
}

ifsm_status ifsm_deformer_redo(ifsm_deformer handle) {
  return guarded(__func__, [&] { Held(handle)->redo(); });
}

ifsm_status ifsm_deformer_keep_as(ifsm_deformer handle, const char* name) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    deformer->keep_as(name_of(name));
  });
}

ifsm_status ifsm_deformer_go_to(ifsm_deformer handle, const char* name) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    deformer->go_to(name_of(name));
  });
}

ifsm_status ifsm_deformer_time(ifsm_deformer handle, double begin, double end, int32_t easing) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    deformer->time_by({begin, end, choice(easing, Easing::out, "easing")});
  });
}

ifsm_status ifsm_deformer_at_time(ifsm_deformer handle, double time, ifsm_deformer* frame) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    required(frame, "frame");
    issue(std::make_shared<Deforming>(deformer->at_time(time)), *frame);
  });
}

ifsm_status ifsm_deformer_save(ifsm_deformer handle, int32_t format, uint8_t* bytes, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const auto file = write_edits(*deformer, choice(format, Format::cbor, "format"));
    deliver(
        static_cast<int64_t>(file.size()), output(bytes, capacity, "bytes"),
        required(count, "count"), [&]() -> const auto& { return file; });
  });
}

ifsm_status ifsm_deformer_replay(ifsm_deformer handle, const uint8_t* bytes, int64_t count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const auto file = input(bytes, count, "bytes", "count");
    deformer->replay(read_edits({file.begin(), file.end()}, *deformer));
  });
}

ifsm_status ifsm_deformer_crossings(ifsm_deformer handle, double* rows, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const auto to = output(rows, capacity, "rows");
    required(count, "count");
    deliver_rows(rows_of(crossings_caused(*deformer)), to, *count);
  });
}

ifsm_status ifsm_deformer_points(ifsm_deformer handle, int32_t level, int64_t first, int64_t number, double* points,
                                 int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    deformer->now().check_window(level, first, number);
    deliver(number * deformer->model().dimension(), output(points, capacity, "points"), required(count, "count"),
            [&] { return deformer->now().places(level, first, number); });
  });
}

ifsm_status ifsm_deformer_changed(ifsm_deformer handle, int32_t level, int64_t* first, int64_t* number) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    required(first, "first");
    required(number, "number");
    const auto window = deformer->changed(level);
    *first = window.first;
    *number = window.count;
  });
}

ifsm_status ifsm_deformer_samples(ifsm_deformer handle, double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const Model& model = deformer->model();
    deliver(model.placement().samples() * model.dimension(), output(points, capacity, "points"),
            required(count, "count"), [&] { return deformer->now().samples(); });
  });
}

ifsm_status ifsm_deformer_evaluate(ifsm_deformer handle, const double* parameters, int64_t parameter_count,
                                   double* points, int64_t capacity, int64_t* count) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    const auto at = parameters_of(parameters, parameter_count);
    require_parameters(deformer->model(), at);
    deliver(checked_product(parameter_count, deformer->model().dimension(), "parameter_count"),
            output(points, capacity, "points"), required(count, "count"), [&] { return deformer->now().at(at); });
  });
}

ifsm_status ifsm_deformer_snapshot(ifsm_deformer handle, ifsm_model* model) {
  return guarded(__func__, [&] {
    const Held deformer(handle);
    required(model, "model");
    issue(deformer->now().snapshot(), *model);
  });
}
