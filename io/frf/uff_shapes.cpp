#include "io/frf/uff_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/frf/uff_units.hpp"

namespace thinwall::io {

namespace {

using Complex = std::complex<double>;
using dynamics::Dof;
using dynamics::DofKind;
using dynamics::ModalModel;

// Codes of the format.
constexpr int normal_mode = 2;
constexpr int complex_first_order = 3;
constexpr int complex_second_order = 7;
constexpr int translation_vector = 2;
constexpr int translation_and_rotation_vector = 3;
constexpr int displacement = 8;
constexpr int real_data = 2;
constexpr int complex_data = 5;

// ---- A modal model as shapes ----

/// The points of the table in its order, one row of a shape for each.
std::vector<std::string> points_of(const ModalModel& model) {
  std::vector<std::string> points;
  for (const Dof& dof : model.dofs) {
    if (dof.kind == DofKind::modal) continue;
    if (std::find(points.begin(), points.end(), dof.point) == points.end()) points.push_back(dof.point);
  }
  return points;
}

Eigen::MatrixXcd displacements(const ModalModel& model, const std::vector<std::string>& points,
                               const Eigen::VectorXcd& phi) {
  const bool rotates =
      std::any_of(model.dofs.begin(), model.dofs.end(), [](const Dof& dof) { return dof.kind == DofKind::rotation; });
  Eigen::MatrixXcd u = Eigen::MatrixXcd::Zero(static_cast<Eigen::Index>(points.size()), rotates ? 6 : 3);
  for (std::size_t i = 0; i < model.dofs.size(); ++i) {
    const Dof& dof = model.dofs[i];
    if (dof.kind == DofKind::modal) continue;
    const auto row = std::find(points.begin(), points.end(), dof.point) - points.begin();
    u.row(row).segment(dof.kind == DofKind::rotation ? 3 : 0, 3) +=
        phi(static_cast<Eigen::Index>(i)) * dof.direction.transpose();
  }
  return u;
}

/// The phase factor c for which c φ is real, if there is one, which is the case for |Σφ²| = Σ|φ|².
std::optional<Complex> phase_to_real(const Eigen::VectorXcd& phi) {
  const Complex square = (phi.array() * phi.array()).sum();
  const double size = phi.squaredNorm();
  if (!(std::abs(square) >= (1.0 - 1e-9) * size) || !(size > 0.0)) return std::nullopt;
  return std::conj(std::sqrt(square / std::abs(square)));
}

// ---- Writing ----

void add_reals(std::string& text, const std::vector<double>& values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!std::isfinite(values[i])) throw core::NumericalError("a mode shape or its scaling is not finite");
    add_real_field(text, values[i], 13, 5);
    if (i % 6 == 5 || i + 1 == values.size()) text += "\n";
  }
}

std::string shape_text(const UffShape& shape) {
  if (static_cast<Eigen::Index>(shape.nodes.size()) != shape.displacement.rows() ||
      (shape.displacement.cols() != 3 && shape.displacement.cols() != 6)) {
    throw core::InputError("mode " + std::to_string(shape.number) + " has " + std::to_string(shape.nodes.size()) +
                           " nodes and displacements " + std::to_string(shape.displacement.rows()) + " x " +
                           std::to_string(shape.displacement.cols()) + "; give a row of 3 or 6 to every node");
  }
  const auto columns = static_cast<long>(shape.displacement.cols());
  std::string text = std::string(uff_delimiter) + "\n    55\n";
  for (const char* id : {"mode shape", "NONE", "NONE", "NONE", "NONE"}) text += text_field(id, uff_record_width) + "\n";
  for (const long field :
       {1L, static_cast<long>(shape.is_complex ? complex_first_order : normal_mode),
        static_cast<long>(columns == 3 ? translation_vector : translation_and_rotation_vector),
        static_cast<long>(displacement), static_cast<long>(shape.is_complex ? complex_data : real_data), columns}) {
    text += integer_field(field, 10);
  }
  text += "\n" + integer_field(2, 10) + integer_field(shape.is_complex ? 6 : 4, 10) + integer_field(1, 10) +
          integer_field(shape.number, 10) + "\n";
  const Complex b = -shape.pole * shape.modal_a;
  add_reals(text, shape.is_complex
                      ? std::vector<double>{shape.pole.real(), shape.pole.imag(), shape.modal_a.real(),
                                            shape.modal_a.imag(), b.real(), b.imag()}
                      : std::vector<double>{shape.frequency_hz, shape.modal_mass, shape.damping_ratio, 0.0});
  for (std::size_t i = 0; i < shape.nodes.size(); ++i) {
    text += integer_field(shape.nodes[i], 10) + "\n";
    std::vector<double> values;
    for (const Complex& value : shape.displacement.row(static_cast<Eigen::Index>(i))) {
      values.push_back(value.real());
      if (shape.is_complex) values.push_back(value.imag());
    }
    add_reals(text, values);
  }
  return text + std::string(uff_delimiter) + "\n";
}

// ---- Reading ----

/// The next `count` numbers in the format 6E13.5.
std::vector<double> take_reals(UffRecords& records, std::size_t count) {
  std::vector<double> values;
  std::string_view record;
  for (std::size_t i = 0; i < count; ++i) {
    if (i % 6 == 0) record = take_record(records);
    values.push_back(real(records, record, 13 * (i % 6), 13));
  }
  return values;
}

void take_scaling(UffRecords& records, UffShape& shape) {
  const std::string_view integers = take_record(records);
  shape.number = static_cast<int>(integer(records, integers, 30, 10, 0));
  if (!shape.is_complex) {
    const std::vector<double> values = take_reals(records, 4);
    shape.frequency_hz = values[0];
    shape.modal_mass = values[1];
    shape.damping_ratio = values[2];
    return;
  }
  const std::vector<double> values = take_reals(records, 6);
  shape.pole = {values[0], values[1]};
  shape.modal_a = {values[2], values[3]};
  const double size = std::abs(shape.pole);
  shape.frequency_hz = size / (2.0 * std::numbers::pi);
  shape.damping_ratio = size > 0.0 ? -shape.pole.real() / size : 0.0;
}

/// The shape of a data set 55; empty if it is no mode.
std::optional<UffShape> read_shape(const UffDataSet& set, UffNotes& notes) {
  UffRecords records = set.records;
  for (int k = 0; k < 5; ++k) (void)take_record(records);
  const std::string_view definition = take_record(records);
  const long analysis = integer(records, definition, 10, 10);
  const long data = integer(records, definition, 40, 10);
  const long columns = integer(records, definition, 50, 10);
  const bool is_mode = analysis == normal_mode || analysis == complex_first_order || analysis == complex_second_order;
  if (!is_mode || (columns != 3 && columns != 6) || (data != real_data && data != complex_data)) {
    note(notes, set.records,
         "data at nodes of analysis type " + std::to_string(analysis) + ", data type " + std::to_string(data) + ", " +
             std::to_string(columns) + " values a node are passed over");
    return std::nullopt;
  }
  UffShape shape;
  shape.is_complex = analysis != normal_mode;
  take_scaling(records, shape);
  const std::size_t parts = data == complex_data ? 2 : 1;
  std::vector<Complex> values;
  while (!at_end(records)) {
    shape.nodes.push_back(integer(records, take_record(records), 0, 10));
    const std::vector<double> of_node = take_reals(records, parts * static_cast<std::size_t>(columns));
    for (std::size_t i = 0; i < of_node.size(); i += parts) {
      values.emplace_back(of_node[i], parts == 2 ? of_node[i + 1] : 0.0);
    }
  }
  using RowMajor = Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  shape.displacement =
      Eigen::Map<const RowMajor>(values.data(), static_cast<Eigen::Index>(shape.nodes.size()), columns);
  return shape;
}

}  // namespace

std::vector<UffShape> shapes_of(const ModalModel& model, const std::map<std::string, long>& nodes) {
  const std::vector<std::string> points = points_of(model);
  std::vector<long> labels;
  for (const std::string& point : points) {
    const auto found = nodes.find(point);
    if (found == nodes.end()) throw core::InputError("the point \"" + point + "\" has no node number; give it one");
    labels.push_back(found->second);
  }
  std::vector<UffShape> shapes;
  for (const int k : dynamics::oscillating_modes(model)) {
    const Eigen::VectorXcd phi = model.right.col(k);
    if ((model.left.col(k) - phi).norm() > 1e-9 * phi.norm()) {
      throw core::InputError("mode " + std::to_string(shapes.size() + 1) +
                             " has another shape for forces than for responses, which data set 55 cannot hold");
    }
    UffShape shape;
    shape.number = static_cast<int>(shapes.size()) + 1;
    shape.pole = model.poles(k);
    const dynamics::ModeSummary summary = dynamics::summarise(shape.pole);
    shape.frequency_hz = summary.frequency_hz;
    shape.damping_ratio = summary.damping_ratio;
    shape.modal_a = model.scaling(k);
    shape.nodes = labels;
    const auto phase = phase_to_real(phi);
    const Complex c = phase.value_or(1.0);
    // The shape is multiplied by c, and a by c², because residues stay: (c φ)(c φ)ᵀ/(c² a) = φ φᵀ/a.
    const Complex mass = c * c * shape.modal_a / Complex(0.0, 2.0 * shape.pole.imag());
    shape.is_complex = !phase || !(mass.real() > 0.0) || std::abs(mass.imag()) > 1e-6 * std::abs(mass);
    if (!shape.is_complex) shape.modal_mass = mass.real();
    shape.displacement = displacements(model, points, shape.is_complex ? phi : Eigen::VectorXcd(c * phi));
    if (!shape.is_complex) shape.displacement = shape.displacement.real().cast<Complex>().eval();
    shapes.push_back(std::move(shape));
  }
  return shapes;
}

void write_uff_shapes(const std::filesystem::path& path, const std::vector<UffShape>& shapes, const UffMesh& geometry) {
  std::string text = header_sets("thinwall modes", "mode shapes");
  if (!geometry.nodes.empty()) text += test_geometry_text(geometry);
  for (const UffShape& shape : shapes) text += shape_text(shape);
  core::write_file_atomically(path, text);
}

UffShapes uff_shapes(std::string_view bytes, const std::string& source) {
  UffShapes read;
  bool told = false;
  for (const UffDataSet& set : universal_data_sets(bytes, source, read.notes)) {
    if (set.number == 164) {
      const UffUnits units = read_units(set);
      told = true;
      if (std::abs(units.length - 1.0) > 1e-9 || std::abs(units.force - 1.0) > 1e-9) {
        refuse(set.records, "mode shapes in other units than SI; export them in metres and newtons");
      }
    }
    if (set.number != 55) continue;
    if (auto shape = read_shape(set, read.notes)) read.shapes.push_back(*std::move(shape));
  }
  if (read.shapes.empty()) throw core::DataError(source + ": holds no mode shapes (data set 55)");
  if (!told) read.notes.push_back(source + ": has no data set 164; the shapes are taken to be in SI");
  return read;
}

UffShapes read_uff_shapes(const std::filesystem::path& path) {
  return uff_shapes(core::read_file(path), path.string());
}

}  // namespace thinwall::io
