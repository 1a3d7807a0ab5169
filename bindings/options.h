// Functions of ifsm.h that take an options struct, with its fields as arguments: in the struct's order, the struct's
// own zeros for defaults. Each does what the function of its name does.
#pragma once

#include <ifsm.h>

namespace ifsm_bindings {

// What is known about curves' samples, as ifsm_fit_samples: borrowed by the call.
struct KnownSamples {
  const ifsm_fit_samples *samples;
  int64_t count;  // one a curve, or 0
};

// An options struct of this header's size; all fields zero.
template <class Options>
Options defaults(ifsm_status (*init)(Options *, uint32_t)) {
  Options options{};
  static_cast<void>(init(&options, sizeof options) == IFSM_OK);  // it refuses sizes alone, and this one is right
  return options;
}

inline ifsm_status ifsm_model_create(ifsm_filter filter, const ifsm_curve *curve, int32_t levels, ifsm_model *model) {
  auto options = defaults(ifsm_model_options_init);
  options.levels = levels;
  return ::ifsm_model_create(filter, curve, &options, model);
}

inline ifsm_status ifsm_model_keep(ifsm_model model, int32_t rule, int64_t kept_count, double threshold,
                                   int32_t resolve, int32_t distance, ifsm_cancel cancel,
                                   ifsm_progress_callback progress, void *user, ifsm_model *kept) {
  auto options = defaults(ifsm_keep_options_init);
  options.rule = rule;
  options.count = kept_count;
  options.threshold = threshold;
  options.resolve = resolve;
  options.distance = distance;
  options.cancel = cancel;
  options.progress = progress;
  options.user = user;
  return ::ifsm_model_keep(model, &options, kept);
}

inline ifsm_status ifsm_model_dimension(ifsm_model model, int32_t method, int32_t scales, double smallest,
                                        double largest, ifsm_dimension_report *report, double *rows, int64_t capacity,
                                        int64_t *count) {
  auto options = defaults(ifsm_dimension_options_init);
  options.method = method;
  options.scales = scales;
  options.smallest = smallest;
  options.largest = largest;
  return ::ifsm_model_dimension(model, &options, report, rows, capacity, count);
}

inline ifsm_status ifsm_model_refine(ifsm_model model, int32_t levels, uint64_t seed, int32_t learned, double roughness,
                                     ifsm_model *refined) {
  auto options = defaults(ifsm_refine_options_init);
  options.levels = levels;
  options.seed = seed;
  options.learned = learned;
  options.roughness = roughness;
  return ::ifsm_model_refine(model, &options, refined);
}

inline ifsm_status ifsm_fit_sparse(const ifsm_curve *curves, int64_t curve_count, int32_t threads, ifsm_filter start,
                                   int32_t control_points, int32_t maps, const int64_t *budgets, int64_t budget_count,
                                   int32_t iterations, int32_t rounds, int32_t polish, int32_t distance,
                                   ifsm_cancel cancel, ifsm_progress_callback progress, void *user, double within,
                                   ifsm_fit *fit) {
  auto options = defaults(ifsm_fit_options_init);
  options.threads = threads;
  options.start = start;
  options.control_points = control_points;
  options.maps = maps;
  options.budgets = budgets;
  options.budget_count = budget_count;
  options.iterations = iterations;
  options.rounds = rounds;
  options.polish = polish;
  options.distance = distance;
  options.cancel = cancel;
  options.progress = progress;
  options.user = user;
  options.within = within;
  return ::ifsm_fit_sparse(curves, curve_count, &options, fit);
}

inline ifsm_status ifsm_fit_curve(const ifsm_curve *curves, int64_t curve_count, int32_t threads, ifsm_filter start,
                                  int32_t control_points, int32_t maps, int32_t fixed_filter, int32_t parameters,
                                  int32_t reparameterise, int32_t loss, double loss_scale, int32_t levels,
                                  int32_t starts, int32_t iterations, double tolerance, KnownSamples samples,
                                  ifsm_cancel cancel, ifsm_progress_callback progress, void *user, ifsm_fit *fit) {
  auto options = defaults(ifsm_fit_curve_options_init);
  options.threads = threads;
  options.start = start;
  options.control_points = control_points;
  options.maps = maps;
  options.fixed_filter = fixed_filter;
  options.parameters = parameters;
  options.reparameterise = reparameterise;
  options.loss = loss;
  options.loss_scale = loss_scale;
  options.levels = levels;
  options.starts = starts;
  options.iterations = iterations;
  options.tolerance = tolerance;
  options.samples = samples.samples;
  options.sample_count = samples.count;
  options.cancel = cancel;
  options.progress = progress;
  options.user = user;
  return ::ifsm_fit_curve(curves, curve_count, &options, fit);
}

inline ifsm_status ifsm_fit_filter(const ifsm_curve *curves, int64_t curve_count, int32_t threads, ifsm_filter start,
                                   int32_t control_points, int32_t maps, int32_t kept_levels, int32_t iterations,
                                   double tolerance, ifsm_cancel cancel, ifsm_progress_callback progress, void *user,
                                   ifsm_fit *fit) {
  auto options = defaults(ifsm_fit_filter_options_init);
  options.threads = threads;
  options.start = start;
  options.control_points = control_points;
  options.maps = maps;
  options.kept_levels = kept_levels;
  options.iterations = iterations;
  options.tolerance = tolerance;
  options.cancel = cancel;
  options.progress = progress;
  options.user = user;
  return ::ifsm_fit_filter(curves, curve_count, &options, fit);
}

inline ifsm_status ifsm_train(const ifsm_curve *curves, int64_t curve_count, int32_t threads, ifsm_filter start,
                              int32_t control_points, int32_t maps, const int64_t *budgets, int64_t budget_count,
                              int32_t hold_out, int32_t rounds, int32_t iterations, double condition, double reach,
                              ifsm_cancel cancel, ifsm_progress_callback progress, void *user, ifsm_filter *filter,
                              ifsm_train_report *report) {
  auto options = defaults(ifsm_train_options_init);
  options.threads = threads;
  options.start = start;
  options.control_points = control_points;
  options.maps = maps;
  options.budgets = budgets;
  options.budget_count = budget_count;
  options.hold_out = hold_out;
  options.rounds = rounds;
  options.iterations = iterations;
  options.condition = condition;
  options.reach = reach;
  options.cancel = cancel;
  options.progress = progress;
  options.user = user;
  return ::ifsm_train(curves, curve_count, &options, filter, report);
}

inline ifsm_status ifsm_deformer_create(ifsm_model model, int32_t turning, int32_t follow, ifsm_deformer *deformer) {
  auto options = defaults(ifsm_deformer_options_init);
  options.turning = turning;
  options.follow = follow;
  return ::ifsm_deformer_create(model, &options, deformer);
}

inline ifsm_status ifsm_deformer_move(ifsm_deformer deformer, int32_t level, const int64_t *handles,
                                      int64_t handle_count, const double *vectors, int64_t vector_count, int32_t places,
                                      int32_t reach, int32_t falloff, int32_t ruler, double radius) {
  auto options = defaults(ifsm_move_options_init);
  options.places = places;
  options.reach = reach;
  options.falloff = falloff;
  options.ruler = ruler;
  options.radius = radius;
  return ::ifsm_deformer_move(deformer, level, handles, handle_count, vectors, vector_count, &options);
}

inline ifsm_status ifsm_deformer_restyle(ifsm_deformer deformer, int32_t first, int32_t last, double scale,
                                         int32_t fade, int32_t mirror, double angle) {
  auto options = defaults(ifsm_restyle_options_init);
  options.fade = fade;
  options.mirror = mirror;
  options.angle = angle;
  return ::ifsm_deformer_restyle(deformer, first, last, scale, &options);
}

inline ifsm_status ifsm_deformer_texture(ifsm_deformer deformer, int32_t first, int32_t last, int32_t fade,
                                         ifsm_model from, double roughness, double size, uint64_t seed) {
  auto options = defaults(ifsm_texture_options_init);
  options.fade = fade;
  options.from = from;
  options.roughness = roughness;
  options.size = size;
  options.seed = seed;
  return ::ifsm_deformer_texture(deformer, first, last, &options);
}

// Of pictures each function takes the fields that count for it; the others are zero.

// What any number of points or pixels has: how many threads, and who asks to stop.
inline ifsm_picture_options watched(int32_t threads, ifsm_cancel cancel, ifsm_progress_callback progress, void *user) {
  auto options = defaults(ifsm_picture_options_init);
  options.threads = threads;
  options.cancel = cancel;
  options.progress = progress;
  options.user = user;
  return options;
}

// And what a picture has besides.
inline ifsm_picture_options picture(ifsm_picture_options options, int32_t width, int32_t height, double left,
                                    double bottom, double right, double top) {
  options.width = width;
  options.height = height;
  options.left = left;
  options.bottom = bottom;
  options.right = right;
  options.top = top;
  return options;
}

inline ifsm_status ifsm_system_histogram(ifsm_system system, int32_t width, int32_t height, int32_t threads,
                                         double left, double bottom, double right, double top, uint64_t seed,
                                         int64_t points, ifsm_cancel cancel, ifsm_progress_callback progress,
                                         void *user, ifsm_picture_report *report, uint32_t *counts, int64_t capacity,
                                         int64_t *count) {
  auto options = picture(watched(threads, cancel, progress, user), width, height, left, bottom, right, top);
  options.seed = seed;
  options.points = points;
  return ::ifsm_system_histogram(system, &options, report, counts, capacity, count);
}

inline ifsm_status ifsm_system_set(ifsm_system system, int32_t width, int32_t height, int32_t threads, double left,
                                   double bottom, double right, double top, double tolerance, ifsm_cancel cancel,
                                   ifsm_progress_callback progress, void *user, ifsm_picture_report *report,
                                   uint8_t *pixels, int64_t capacity, int64_t *count) {
  auto options = picture(watched(threads, cancel, progress, user), width, height, left, bottom, right, top);
  options.tolerance = tolerance;
  return ::ifsm_system_set(system, &options, report, pixels, capacity, count);
}

inline ifsm_status ifsm_system_distances(ifsm_system system, int32_t width, int32_t height, int32_t threads,
                                         double left, double bottom, double right, double top, double tolerance,
                                         ifsm_cancel cancel, ifsm_progress_callback progress, void *user,
                                         ifsm_picture_report *report, double *distances, int64_t capacity,
                                         int64_t *count) {
  auto options = picture(watched(threads, cancel, progress, user), width, height, left, bottom, right, top);
  options.tolerance = tolerance;
  return ::ifsm_system_distances(system, &options, report, distances, capacity, count);
}

inline ifsm_status ifsm_system_render(ifsm_system system, int32_t width, int32_t height, int32_t threads, double left,
                                      double bottom, double right, double top, uint64_t seed, int64_t points,
                                      double tolerance, int32_t colour, int32_t palette, const uint8_t *stops,
                                      int64_t stop_count, int32_t symbols, int32_t oversample, uint32_t background,
                                      double azimuth, double elevation, double field, ifsm_cancel cancel,
                                      ifsm_progress_callback progress, void *user, ifsm_picture_report *report,
                                      uint8_t *rgba, int64_t capacity, int64_t *count) {
  auto options = picture(watched(threads, cancel, progress, user), width, height, left, bottom, right, top);
  options.seed = seed;
  options.points = points;
  options.tolerance = tolerance;
  options.colour = colour;
  options.palette = palette;
  options.stops = stops;
  options.stop_count = stop_count;
  options.symbols = symbols;
  options.oversample = oversample;
  options.background = background;
  options.azimuth = azimuth;
  options.elevation = elevation;
  options.field = field;
  return ::ifsm_system_render(system, &options, report, rgba, capacity, count);
}

inline ifsm_status ifsm_tone_map(const uint32_t *counts, int64_t pixel_count, int32_t palette, const uint8_t *stops,
                                 int64_t stop_count, uint32_t background, uint8_t *rgba, int64_t capacity,
                                 int64_t *count) {
  auto options = defaults(ifsm_picture_options_init);
  options.palette = palette;
  options.stops = stops;
  options.stop_count = stop_count;
  options.background = background;
  return ::ifsm_tone_map(counts, pixel_count, &options, rgba, capacity, count);
}

inline ifsm_status ifsm_system_sample(ifsm_system system, int32_t threads, uint64_t seed, int64_t point_count,
                                      ifsm_cancel cancel, ifsm_progress_callback progress, void *user, double *points,
                                      int64_t capacity, int64_t *count) {
  auto options = watched(threads, cancel, progress, user);
  options.seed = seed;
  options.points = point_count;
  return ::ifsm_system_sample(system, &options, points, capacity, count);
}

inline ifsm_status ifsm_system_sample_addresses(ifsm_system system, int32_t threads, uint64_t seed, int64_t point_count,
                                                ifsm_cancel cancel, ifsm_progress_callback progress, void *user,
                                                int32_t length, int32_t *symbols, int64_t capacity, int64_t *count) {
  auto options = watched(threads, cancel, progress, user);
  options.seed = seed;
  options.points = point_count;
  return ::ifsm_system_sample_addresses(system, &options, length, symbols, capacity, count);
}

}  // namespace ifsm_bindings
