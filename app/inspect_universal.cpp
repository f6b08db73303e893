#include "app/inspect_universal.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/median.hpp"
#include "core/units.hpp"
#include "io/frf/one_reference.hpp"
#include "io/frf/uff_content.hpp"
#include "io/json_file.hpp"
#include "setup/measured.hpp"

namespace thinwall::app {

namespace {

using nlohmann::json;

constexpr std::size_t most_rows = 40;

std::string more_text(std::size_t count, const char* what) {
  return count > most_rows ? fmt::format("    … and {} more {}\n", count - most_rows, what) : "";
}

/// "12 FRFs", "1 FRF".
std::string counted(std::size_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

/// The name of a DOF, "node 3.-z" of one against an axis.
std::string name_of(const dynamics::Dof& dof) {
  if (dof.direction.minCoeff() > -1.0) return dynamics::name(dof);
  return dof.point + (dof.kind == dynamics::DofKind::rotation ? ".-r" : ".-") +
         dynamics::name({"", -dof.direction, dynamics::DofKind::translation}).substr(1);
}

void add_geometry(const io::UffMesh& mesh, std::string& text, json& document) {
  Eigen::Vector3d low = mesh.nodes.front().position, high = low;
  for (const io::UffNode& node : mesh.nodes) {
    low = low.cwiseMin(node.position);
    high = high.cwiseMax(node.position);
  }
  const Eigen::Vector3d mm = 1e3 * (high - low);
  text += fmt::format("  geometry: {} within {:.5g} x {:.5g} x {:.5g} mm, {}, {}\n", counted(mesh.nodes.size(), "node"),
                      mm.x(), mm.y(), mm.z(), counted(mesh.lines.size(), "trace line"),
                      counted(mesh.elements.size(), "element"));
  document["geometry"] = {{"nodes", mesh.nodes.size()},
                          {"trace_lines", mesh.lines.size()},
                          {"elements", mesh.elements.size()},
                          {"lowest_m", {low.x(), low.y(), low.z()}},
                          {"highest_m", {high.x(), high.y(), high.z()}}};
}

/// The node that moves most in a shape, and the direction of its largest component.
std::string largest_motion(const io::UffShape& shape) {
  if (shape.displacement.size() == 0) return "";
  Eigen::Index row = 0, column = 0;
  shape.displacement.cwiseAbs().maxCoeff(&row, &column);
  constexpr std::array directions{"x", "y", "z", "rx", "ry", "rz"};
  return fmt::format("node {} in {}", shape.nodes[static_cast<std::size_t>(row)],
                     directions.at(static_cast<std::size_t>(column)));
}

void add_shapes(const std::vector<io::UffShape>& shapes, std::string& text, json& document) {
  text += fmt::format("  shapes: {}\n    {:>6} {:>12} {:>10}  {:<8} {:>6}  {}\n", shapes.size(), "number", "frequency",
                      "damping", "kind", "nodes", "moves most");
  json list = json::array();
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    const io::UffShape& shape = shapes[i];
    const char* kind = shape.is_complex ? "complex" : "normal";
    list.push_back({{"number", shape.number},
                    {"frequency_hz", shape.frequency_hz},
                    {"damping_ratio", shape.damping_ratio},
                    {"kind", kind},
                    {"nodes", shape.nodes.size()}});
    if (i >= most_rows) continue;
    text += fmt::format("    {:>6} {:>9.2f} Hz {:>8.3f} %  {:<8} {:>6}  {}\n", shape.number, shape.frequency_hz,
                        100.0 * shape.damping_ratio, kind, shape.nodes.size(), largest_motion(shape));
  }
  text += more_text(shapes.size(), "shapes");
  document["shapes"] = list;
}

void add_frfs(const std::vector<io::MeasuredEntry>& entries, std::string& text, json& document) {
  text += fmt::format("  FRFs: {} (record = NUMBER names one in a case)\n    {:>6}  {:<16} {:<16} {:>6} {:>22}  {}\n",
                      entries.size(), "record", "response", "force", "lines", "band", "coherence (median)");
  json list = json::array();
  for (std::size_t i = 0; i < entries.size(); ++i) {
    const io::MeasuredFrf& frf = entries[i].frf;
    const double from = frf.axis.hz(0), to = frf.axis.hz(frf.axis.size() - 1);
    const bool coherent = frf.coherence.size() > 0;
    json row{{"record", i + 1},
             {"response", name_of(entries[i].response)},
             {"force", name_of(entries[i].force)},
             {"lines", frf.axis.size()},
             {"from_hz", from},
             {"to_hz", to}};
    if (coherent) row["median_coherence"] = core::median({frf.coherence.begin(), frf.coherence.end()});
    list.push_back(row);
    if (i >= most_rows) continue;
    text +=
        fmt::format("    {:>6}  {:<16} {:<16} {:>6} {:>22}  {}\n", i + 1, name_of(entries[i].response),
                    name_of(entries[i].force), frf.axis.size(), fmt::format("{:.6g} to {:.6g} Hz", from, to),
                    coherent ? fmt::format("{:.3f}", core::median({frf.coherence.begin(), frf.coherence.end()})) : "-");
  }
  text += more_text(entries.size(), "FRFs");
  document["frfs"] = list;
}

/// The way in which the FRFs were measured, where one sensor or hammer stayed.
void add_reference(const io::MeasuredEntries& frfs, std::string& text, json& document) {
  if (frfs.entries.size() < 2) return;
  const auto reference = io::reference_of(frfs.entries);
  if (!reference) {
    text += "  test: several references, for no DOF is in all FRFs\n";
    return;
  }
  const std::string name = dynamics::name(*reference);
  try {
    const io::ReferenceColumn column = io::reference_column({frfs.entries, {}});
    text +=
        fmt::format("  test: one reference, {}; {} make one column of receptances of a force there, {} by reciprocity",
                    name, counted(column.measured.response.responses.size(), "DOF"), column.by_reciprocity);
    text += column.by_reciprocity > 0 ? ", since the hammer moved\n" : "\n";
    for (const std::string& note : column.measured.notes) text += "  note: " + note + "\n";
    if (column.driving_point < 0)
      text += "  note: no FRF has response and force at " + name + ", so shapes of this test have no scale\n";
    document["reference"] = {{"dof", name},
                             {"responses", column.measured.response.responses.size()},
                             {"by_reciprocity", column.by_reciprocity},
                             {"has_driving_point", column.driving_point >= 0}};
  } catch (const core::DataError& error) {
    text += fmt::format("  test: one reference, {}, but its FRFs make no column: {}\n", name, error.what());
  }
}

void add_notes(const io::UffContent& content, std::string& text, json& document) {
  std::vector<std::string> notes;
  const auto add = [&](const std::vector<std::string>& more) {
    for (const std::string& note : more)  // the parts of a file share the notes on its data sets
      if (std::ranges::find(notes, note) == notes.end()) notes.push_back(note);
  };
  if (content.geometry) add(content.geometry->notes);
  if (content.shapes) add(content.shapes->notes);
  if (content.frfs) add(content.frfs->notes);
  if (const auto nodes = io::nodes_without_place(content); !nodes.empty())
    add({fmt::format("no place in the geometry has {} of the shapes, first node {}", counted(nodes.size(), "node"),
                     nodes.front())});
  for (const std::string& note : notes) text += "  note: " + note + "\n";
  for (const std::string& refusal : content.refused) text += "  not read: " + refusal + "\n";
  document["notes"] = notes;
  document["not_read"] = content.refused;
}

std::string data_sets_text(const io::UffContent& content) {
  std::string list;
  for (const auto& [number, count] : content.data_sets)
    list += fmt::format("{}{}{}", list.empty() ? "" : ", ", number, count > 1 ? fmt::format(" ({} times)", count) : "");
  return list.empty() ? "none" : list;
}

}  // namespace

bool is_universal_file(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return false;
  if (setup::frf_file_kind(file) == setup::FrfFileKind::universal) return true;
  std::ifstream stream(file, std::ios::binary);
  std::string first(90, '\0');  // a line of a universal file has 80 characters
  stream.read(first.data(), static_cast<std::streamsize>(first.size()));
  first.resize(static_cast<std::size_t>(stream.gcount()));
  return io::begins_as_universal_file(first);
}

Inspection inspect_universal(const std::filesystem::path& file, const std::string& unit,
                             const std::optional<std::filesystem::path>& json_file) {
  std::optional<double> unit_in_m;
  if (!unit.empty()) unit_in_m = core::parse_quantity("1 " + unit, core::kind::length);
  const io::UffContent content = io::uff_content(core::read_file(file), file.string(), unit_in_m);
  std::string text = fmt::format("{}: universal file with data sets {}\n", file.string(), data_sets_text(content));
  json document{{"data_sets", json::object()}};
  for (const auto& [number, count] : content.data_sets) document["data_sets"][std::to_string(number)] = count;
  if (content.geometry) add_geometry(*content.geometry, text, document);
  if (content.shapes) add_shapes(content.shapes->shapes, text, document);
  if (content.frfs) add_frfs(content.frfs->entries, text, document);
  if (content.frfs) add_reference(*content.frfs, text, document);
  add_notes(content, text, document);
  const bool empty = !content.geometry && !content.shapes && !content.frfs;
  if (empty && content.refused.empty())
    text += "  nothing here is read: geometry is in 15, 2411, 2412 and 82, shapes in 55, FRFs in 58\n";
  if (json_file) io::write_json(*json_file, document);
  return {text, !empty && content.refused.empty()};
}

}  // namespace thinwall::app
