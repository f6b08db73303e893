#include "case/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <variant>
#include <vector>

#include "io/manifest.hpp"
#include "io/program_id.hpp"

namespace thinwall::cases {

namespace {

namespace fs = std::filesystem;

/// One value in a form that tells every bit of it.
struct Exactly {
  std::string operator()(double x) const { return fmt::format("{:a}", x); }
  std::string operator()(bool x) const { return x ? "true" : "false"; }
  std::string operator()(const std::string& x) const { return fmt::format("{}:{}", x.size(), x); }
  std::string operator()(const Eigen::Vector3d& x) const { return fmt::format("{:a},{:a},{:a}", x.x(), x.y(), x.z()); }
  template <class Item>
  std::string operator()(const std::vector<Item>& list) const {
    std::string text = "[";
    for (const auto& item : list) text += (*this)(item) + ";";
    return text + "]";
  }
};

/// Whether the key is `name` or lies in the table of that name.
bool lies_in(const std::string& key, const std::string& name) {
  return key.starts_with(name) && (key.size() == name.size() || key[name.size()] == '.' || key[name.size()] == '[');
}

/// Whether anything of the undamped part follows from the damping.
bool damping_shapes_part(const Case& source) {
  const bool from_file = source.part && source.part->shape == setup::PartShape::matrices;
  return source.reduction.tolerance || from_file ||
         std::ranges::count(source.updating, setup::FitOf::part, &setup::Updating::on) > 0;
}

/// The points that move along a path, from which the positions of all others follow; none without one.
std::vector<std::string> moving_points(const Case& source) {
  std::vector<std::string> points;
  if (!source.path || !source.cutting) return points;
  points.push_back(source.cutting->at);
  for (const setup::Contact& contact : source.contacts) points.push_back(contact.part_point);
  return points;
}

}  // namespace

std::string key_of(const Case& source, const std::vector<std::string>& without,
                   const std::vector<std::string>& besides) {
  std::string text = io::program_id() + "\n";
  for (const CaseValue& value : source.values) {
    if (std::ranges::any_of(without, [&](const std::string& name) { return lies_in(value.key, name); })) continue;
    text += value.key + "=" + std::visit(Exactly{}, value.value) + "\n";
  }
  for (const std::string& point : source.reduction.interface) text += point + "\n";
  // Their names are among the values, as the case gives them.
  for (const fs::path& file : input_files(source, without)) text += io::sha256_of_file(file) + "\n";
  for (const std::string& word : besides) text += std::to_string(word.size()) + ":" + word + "\n";
  return io::sha256(text);
}

std::string part_key(const Case& source) {
  std::vector<std::string> without{"title", "robot", "contacts", "coupling", "tool", "cutting", "lobes", "machine"};
  if (!damping_shapes_part(source)) without.emplace_back("damping");
  return key_of(source, without, moving_points(source));
}

std::string structure_key(const Case& source) {
  return key_of(source, {"title", "tool", "cutting", "lobes", "machine"}, moving_points(source));
}

std::string charts_key(const Case& source) {
  std::vector<std::string> without{"title", "machine"};
  const bool asks_for_feed = source.cutting && (source.cutting->law == setup::ForceLawKind::power ||
                                                source.cutting->law == setup::ForceLawKind::fractional);
  if (!asks_for_feed) without.emplace_back("cutting.spindle_speed");
  return key_of(source, without);
}

}  // namespace thinwall::cases
