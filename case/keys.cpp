#include "case/keys.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <variant>
#include <vector>

#include "io/manifest.hpp"
#include "io/program_id.hpp"

namespace thinwall::cases {

namespace {

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

/// True if the key is `name` or lies in the table of that name.
bool lies_in(const std::string& key, const std::string& name) {
  return key.starts_with(name) && (key.size() == name.size() || key[name.size()] == '.' || key[name.size()] == '[');
}

}  // namespace

std::string key_of(const Case& source, const std::vector<std::string>& without) {
  std::string text = io::program_id() + "\n";
  for (const CaseValue& value : source.values) {
    if (std::ranges::any_of(without, [&](const std::string& name) { return lies_in(value.key, name); })) continue;
    text += value.key + "=" + std::visit(Exactly{}, value.value) + "\n";
  }
  for (const std::string& point : source.reduction.interface) text += point + "\n";
  // Their names are among the values, as the case gives them.
  for (const DataFile& file : source.data_files)
    if (std::ranges::find(without, file.section) == without.end()) text += file.sha256 + "\n";
  return io::sha256(text);
}

}  // namespace thinwall::cases
