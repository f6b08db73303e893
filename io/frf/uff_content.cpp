#include "io/frf/uff_content.hpp"

#include <algorithm>
#include <initializer_list>
#include <set>

#include "core/error.hpp"
#include "io/frf/universal_file.hpp"

namespace thinwall::io {

namespace {

/// The reader's value; if it refuses the file, none, and its message is added to `refused`.
template <typename Reader>
auto taken(Reader read, std::vector<std::string>& refused) -> std::optional<decltype(read())> {
  try {
    return read();
  } catch (const core::DataError& error) {
    refused.emplace_back(error.what());
    return std::nullopt;
  }
}

}  // namespace

bool begins_as_universal_file(std::string_view bytes) {
  if (!bytes.starts_with(uff_delimiter)) return false;
  const auto behind = bytes.find_first_not_of(' ', uff_delimiter.size());
  return behind != std::string_view::npos && (bytes[behind] == '\n' || bytes[behind] == '\r');
}

UffContent uff_content(std::string_view bytes, const std::string& source, std::optional<double> unit_in_m,
                       const UffReading& reading) {
  UffContent content;
  UffNotes notes;  // the readers of the parts note the same
  for (const UffDataSet& set : universal_data_sets(bytes, source, notes)) ++content.data_sets[set.number];
  const auto has = [&](std::initializer_list<int> numbers) {
    return std::ranges::any_of(numbers, [&](int number) { return content.data_sets.contains(number); });
  };
  if (has({15, 2411, 2412, 82}))
    content.geometry = taken([&] { return uff_mesh(bytes, source, unit_in_m); }, content.refused);
  if (has({55})) content.shapes = taken([&] { return uff_shapes(bytes, source); }, content.refused);
  if (has({58})) content.frfs = taken([&] { return uff_entries(bytes, source, reading); }, content.refused);
  return content;
}

std::vector<long> nodes_without_place(const UffContent& content) {
  if (!content.geometry || !content.shapes) return {};
  std::set<long> placed;
  for (const UffNode& node : content.geometry->nodes) placed.insert(node.label);
  std::set<long> missing;
  for (const UffShape& shape : content.shapes->shapes)
    for (const long node : shape.nodes)
      if (!placed.contains(node)) missing.insert(node);
  return {missing.begin(), missing.end()};
}

}  // namespace thinwall::io
