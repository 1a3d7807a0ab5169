#include "io/model_writer.h"

#include <bit>
#include <cmath>

namespace ifsm::core {
namespace {

// To the bit: a negative zero is stored, so that everything comes back.
bool is_stored(const Points& details, Index i) {
  for (Index axis = 0; axis < details.dimension(); ++axis)
    if (std::bit_cast<std::uint64_t>(details.plane(axis)[static_cast<std::size_t>(i)]) != 0) return true;
  return false;
}

class ModelWriter {
 public:
  ModelWriter(const Model& model, Emitter& out) : model_(model), parts_(model.parts()), out_(out) {}

  void write() {
    out_.object(12);
    text("format", format_name);
    integer("version", format_version);
    integer("dimension", model_.dimension());
    out_.key("closed"), out_.boolean(model_.closed());
    integer("samples", parts_.samples);
    integer("levels", model_.levels());
    write_filter();
    out_.key("center"), out_.array(model_.dimension());
    for (const double value : parts_.center) number(value, "center");
    out_.end();
    out_.key("diagonal"), number(parts_.diagonal, "diagonal");
    out_.key("largest_polygon"), number(parts_.largest_polygon, "largest_polygon");
    vectors("control_points", parts_.polygon);
    out_.key("details"), out_.array(model_.levels());
    for (int level = 0; level < model_.levels(); ++level) write_level(model_.details(level));
    out_.end();
    out_.end();
  }

 private:
  void text(std::string_view key, std::string_view value) { out_.key(key), out_.text(value); }
  void integer(std::string_view key, Index value) { out_.key(key), out_.integer(value); }

  void number(double value, const char* argument) {
    if (!std::isfinite(value))
      throw Error(Status::numerical, argument,
                  std::string("The model's ") + argument + " hold " + text_of(value) +
                      ", which a file cannot; edit the model so that it stays in the range of doubles.")
          .with(value);
    out_.number(value);
  }

  void write_filter() {
    const Shape& shape = model_.shape();
    const RowMatrix& matrix = model_.filter().matrix();
    out_.key("filter"), out_.object(5);
    text("topology", topology_name(shape.topology()));
    integer("control_points", shape.control_points());
    integer("maps", shape.maps());
    integer("stride", shape.stride());
    out_.key("matrix"), out_.array(matrix.size());
    for (Index i = 0; i < matrix.size(); ++i) number(matrix.data()[i], "matrix");
    out_.end();
    out_.end();
  }

  void write_level(const Points& details) {
    const std::vector<Index> at = stored(details);
    const auto kept = static_cast<Index>(at.size());
    if (kept == 0)
      out_.object(0);
    else if (kept * (1 + details.dimension()) < details.size())
      write_sparse(details, at);
    else
      out_.object(1), vectors("dense", details);
    out_.end();
  }

  void write_sparse(const Points& details, const std::vector<Index>& at) {
    out_.object(2);
    out_.key("at"), out_.array(static_cast<Index>(at.size()));
    for (const Index i : at) out_.integer(i);
    out_.end();
    out_.key("vectors"), out_.array(static_cast<Index>(at.size()) * details.dimension());
    for (const Index i : at) vector(details, i, "details");
    out_.end();
  }

  static std::vector<Index> stored(const Points& details) {
    std::vector<Index> at;
    for (Index i = 0; i < details.count(); ++i)
      if (is_stored(details, i)) at.push_back(i);
    return at;
  }

  void vectors(const char* key, const Points& points) {
    out_.key(key), out_.array(points.size());
    for (Index i = 0; i < points.count(); ++i) vector(points, i, key);
    out_.end();
  }

  void vector(const Points& points, Index i, const char* argument) {
    for (Index axis = 0; axis < points.dimension(); ++axis)
      number(points.plane(axis)[static_cast<std::size_t>(i)], argument);
  }

  const Model& model_;
  const ModelParts& parts_;
  Emitter& out_;
};

void require_loadable(const Model& model, std::size_t bytes) {
  const Index doubles = tree_doubles(model.shape(), model.dimension(), model.levels());
  if (doubles <= most_tree_doubles(bytes)) return;
  throw Error(Status::limit, "model",
              "The model's tree has " + std::to_string(doubles) + " doubles, nearly all zero; files of " +
                  std::to_string(bytes) + " bytes may ask for " + std::to_string(most_tree_doubles(bytes)) +
                  ". Make the sketch of a model with fewer levels.")
      .with(static_cast<double>(doubles));
}

}  // namespace

Bytes write_model(const Model& model, Format format) {
  Bytes bytes;
  ModelWriter(model, *make_emitter(format, bytes)).write();
  require_loadable(model, bytes.size());
  return bytes;
}

}  // namespace ifsm::core
