#include "io/frf/uff_mesh.hpp"

#include <algorithm>
#include <array>
#include <set>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/frf/uff_units.hpp"

namespace thinwall::io {

namespace {

constexpr std::size_t longest_line = 250;
constexpr long largest_label = 999999999;
constexpr int color = 7;

/// True for elements that have a record of orientation and cross-sections.
bool is_beam(int descriptor) {
  constexpr std::array beams{11, 21, 22, 23, 24};
  return std::find(beams.begin(), beams.end(), descriptor) != beams.end();
}

// ---- Writing ----

void require_label(long label, const char* what) {
  if (label > 0 && label <= largest_label) return;
  throw core::InputError("the label " + std::to_string(label) + " of " + what + " must be positive, below 10 digits");
}

void require_known(const std::set<long>& known, long node, const std::string& where) {
  if (!known.contains(node)) throw core::InputError(where + " names node " + std::to_string(node) + ", which is none");
}

void require_writable(const UffMesh& mesh) {
  std::set<long> known;
  for (const UffNode& node : mesh.nodes) {
    require_label(node.label, "a node");
    if (!known.insert(node.label).second)
      throw core::InputError("node " + std::to_string(node.label) + " is there twice");
    if (!node.position.allFinite())
      throw core::InputError("the position of node " + std::to_string(node.label) + " is not finite");
  }
  for (const UffElement& element : mesh.elements) {
    require_label(element.label, "an element");
    if (element.nodes.empty()) throw core::InputError("element " + std::to_string(element.label) + " has no nodes");
    for (const long node : element.nodes) require_known(known, node, "element " + std::to_string(element.label));
  }
  for (const UffTraceLine& line : mesh.lines) {
    require_label(line.label, "a trace line");
    const std::string where = "trace line " + std::to_string(line.label);
    if (line.nodes.empty() || line.nodes.size() > longest_line) {
      throw core::InputError(where + " has " + std::to_string(line.nodes.size()) + " nodes; write 1 to 250");
    }
    for (const long node : line.nodes) {
      if (node != 0) require_known(known, node, where);
    }
  }
}

std::string opened(int number) {
  return std::string(uff_delimiter) + "\n" + integer_field(number, 6) + "\n";
}

std::string closed() {
  return std::string(uff_delimiter) + "\n";
}

/// The labels in the format 8I10.
std::string labels_text(const std::vector<long>& labels) {
  std::string text;
  for (std::size_t i = 0; i < labels.size(); ++i) {
    text += integer_field(labels[i], 10);
    if (i % 8 == 7 || i + 1 == labels.size()) text += "\n";
  }
  return text;
}

/// The nodes in the formats 4I10 and 3D25.16, with E for the exponent, which every program reads.
std::string nodes_text(const UffMesh& mesh) {
  std::string text = opened(2411);
  for (const UffNode& node : mesh.nodes) {
    text +=
        integer_field(node.label, 10) + integer_field(1, 10) + integer_field(1, 10) + integer_field(color, 10) + "\n";
    for (const double coordinate : node.position) add_real_field(text, coordinate, 25, 16);
    text += "\n";
  }
  return text + closed();
}

/// The nodes in the format 4I10,1P3E13.5.
std::string old_nodes_text(const UffMesh& mesh) {
  std::string text = opened(15);
  for (const UffNode& node : mesh.nodes) {
    text += integer_field(node.label, 10) + integer_field(0, 10) + integer_field(0, 10) + integer_field(color, 10);
    for (const double coordinate : node.position) add_real_field(text, coordinate, 13, 5);
    text += "\n";
  }
  return text + closed();
}

/// The elements in the format 6I10: label, descriptor, physical and material table, colour, number of nodes.
std::string elements_text(const UffMesh& mesh) {
  std::string text = opened(2412);
  for (const UffElement& element : mesh.elements) {
    text += integer_field(element.label, 10) + integer_field(element.descriptor, 10) + integer_field(1, 10) +
            integer_field(1, 10) + integer_field(color, 10) +
            integer_field(static_cast<long>(element.nodes.size()), 10) + "\n";
    if (is_beam(element.descriptor)) text += integer_field(0, 10) + integer_field(1, 10) + integer_field(1, 10) + "\n";
    text += labels_text(element.nodes);
  }
  return text + closed();
}

std::string line_text(const UffTraceLine& line) {
  return opened(82) + integer_field(line.label, 10) + integer_field(static_cast<long>(line.nodes.size()), 10) +
         integer_field(color, 10) + "\n" + text_field(line.name, uff_record_width) + "\n" + labels_text(line.nodes) +
         closed();
}

// ---- Reading ----

bool has_nodes(const UffDataSet& set) {
  return set.number == 2411 || set.number == 15;
}

void require_global(const UffRecords& records, long system) {
  if (system == 0 || system == 1) return;
  refuse(records, "a node in coordinate system " + std::to_string(system) + "; export nodes in the global one");
}

double metres(const std::optional<UffUnits>& units, std::optional<double> unit_in_m, const UffRecords& records) {
  if (unit_in_m) return *unit_in_m;
  if (!units) refuse(records, "nodes before any data set 164, which tells their unit; state the unit of length");
  return 1.0 / units->length;
}

/// Reads nodes of data set 2411 (two records for each) or 15 (one record, with 3E13.5 behind the labels).
void take_nodes(const UffDataSet& set, double in_m, UffMesh& mesh) {
  UffRecords records = set.records;
  const bool is_old = set.number == 15;
  while (!at_end(records)) {
    const std::string_view labels = take_record(records);
    UffNode node;
    node.label = integer(records, labels, 0, 10);
    require_global(records, integer(records, labels, 10, 10, 0));
    const std::string_view record = is_old ? labels : take_record(records);
    for (std::size_t k = 0; k < 3; ++k) {
      const double coordinate = is_old ? real(records, record, 40 + 13 * k, 13) : real(records, record, 25 * k, 25);
      node.position(static_cast<Eigen::Index>(k)) = in_m * coordinate;
    }
    mesh.nodes.push_back(node);
  }
}

void take_elements(const UffDataSet& set, UffMesh& mesh) {
  UffRecords records = set.records;
  while (!at_end(records)) {
    const std::string_view heading = take_record(records);
    UffElement element;
    element.label = integer(records, heading, 0, 10);
    element.descriptor = static_cast<int>(integer(records, heading, 10, 10));
    const long count = integer(records, heading, 50, 10);
    if (count <= 0) refuse(records, "an element with " + std::to_string(count) + " nodes");
    if (is_beam(element.descriptor)) (void)take_record(records);
    std::string_view record;
    for (long i = 0; i < count; ++i) {
      if (i % 8 == 0) record = take_record(records);
      element.nodes.push_back(integer(records, record, static_cast<std::size_t>(10 * (i % 8)), 10));
    }
    mesh.elements.push_back(std::move(element));
  }
}

void take_line(const UffDataSet& set, UffMesh& mesh) {
  UffRecords records = set.records;
  const std::string_view heading = take_record(records);
  UffTraceLine line;
  line.label = integer(records, heading, 0, 10);
  const long stated = integer(records, heading, 10, 10, 0);
  line.name = take_record(records);
  while (!at_end(records)) {
    const std::string_view record = take_record(records);
    for (std::size_t start = 0; start < record.size(); start += 10) {
      line.nodes.push_back(integer(records, record, start, 10));
    }
  }
  if (static_cast<long>(line.nodes.size()) != stated) {
    note(mesh.notes, set.records,
         "a trace line states " + std::to_string(stated) + " nodes and has " + std::to_string(line.nodes.size()));
  }
  mesh.lines.push_back(std::move(line));
}

void note_unknown(const std::string& source, UffMesh& mesh) {
  std::set<long> known;
  for (const UffNode& node : mesh.nodes) known.insert(node.label);
  std::size_t unknown = 0;
  for (const UffElement& element : mesh.elements) {
    for (const long node : element.nodes) unknown += known.contains(node) ? 0 : 1;
  }
  for (const UffTraceLine& line : mesh.lines) {
    for (const long node : line.nodes) unknown += node == 0 || known.contains(node) ? 0 : 1;
  }
  if (unknown == 0) return;
  mesh.notes.push_back(source + ": elements and trace lines name nodes that the file does not have, " +
                       std::to_string(unknown) + " times");
}

}  // namespace

void write_uff_mesh(const std::filesystem::path& path, const UffMesh& mesh) {
  require_writable(mesh);
  std::string text = header_sets("thinwall geometry", "nodes, elements and trace lines") + nodes_text(mesh);
  if (!mesh.elements.empty()) text += elements_text(mesh);
  for (const UffTraceLine& line : mesh.lines) text += line_text(line);
  core::write_file_atomically(path, text);
}

std::string test_geometry_text(const UffMesh& mesh) {
  require_writable(mesh);
  std::string text = old_nodes_text(mesh);
  for (const UffTraceLine& line : mesh.lines) text += line_text(line);
  return text;
}

UffMesh uff_mesh(std::string_view bytes, const std::string& source, std::optional<double> unit_in_m) {
  UffMesh mesh;
  std::optional<UffUnits> units;
  for (const UffDataSet& set : universal_data_sets(bytes, source, mesh.notes)) {
    if (set.number == 164) units = read_units(set);
    if (has_nodes(set)) take_nodes(set, metres(units, unit_in_m, set.records), mesh);
    if (set.number == 2412) take_elements(set, mesh);
    if (set.number == 82) take_line(set, mesh);
  }
  if (mesh.nodes.empty()) throw core::DataError(source + ": holds no nodes (data set 2411 or 15)");
  note_unknown(source, mesh);
  return mesh;
}

bool has_uff_nodes(const std::filesystem::path& path) {
  UffNotes notes;
  const std::string bytes = core::read_file(path);
  return std::ranges::any_of(universal_data_sets(bytes, path.string(), notes), has_nodes);
}

UffMesh read_uff_mesh(const std::filesystem::path& path, std::optional<double> unit_in_m) {
  return uff_mesh(core::read_file(path), path.string(), unit_in_m);
}

}  // namespace thinwall::io
