#include "reduction/methods/method.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "core/error.hpp"
#include "core/nearest_name.hpp"

namespace thinwall::reduction {

namespace {

constexpr std::array<std::pair<Method, const char*>, 8> table{{
    {Method::guyan, "guyan"},
    {Method::craig_bampton, "craig_bampton"},
    {Method::characteristic_constraint_modes, "characteristic_constraint_modes"},
    {Method::rubin, "rubin"},
    {Method::macneal, "macneal"},
    {Method::craig_chang, "craig_chang"},
    {Method::dual_craig_bampton, "dual_craig_bampton"},
    {Method::modal_truncation, "modal_truncation"},
}};

}  // namespace

const std::vector<Method>& all_methods() {
  static const std::vector<Method> methods = [] {
    std::vector<Method> all(table.size());
    std::transform(table.begin(), table.end(), all.begin(), [](const auto& row) { return row.first; });
    return all;
  }();
  return methods;
}

std::string name(Method method) {
  return table.at(static_cast<std::size_t>(method)).second;
}

Method method_named(const std::string& name) {
  std::vector<std::string> names;
  for (const auto& [method, text] : table) {
    if (name == text) return method;
    names.emplace_back(text);
  }
  std::string known;
  for (const std::string& each : names) known += (known.empty() ? "" : ", ") + each;
  throw core::InputError("there is no reduction \"" + name + "\"" + core::did_you_mean(name, names) +
                         "; it must be one of " + known);
}

bool holds_the_interface(Method method) {
  return method == Method::guyan || method == Method::craig_bampton ||
         method == Method::characteristic_constraint_modes;
}

int modes_for_size(Method method, int size, int interface_dofs, int rigid_motions, int characteristic) {
  switch (method) {
    case Method::guyan:
      return size == interface_dofs ? 0 : -1;
    case Method::craig_bampton:
      return size - interface_dofs;
    case Method::characteristic_constraint_modes:
      return size - characteristic;
    case Method::modal_truncation:
      return size - rigid_motions;
    case Method::rubin:
    case Method::macneal:
    case Method::craig_chang:
    case Method::dual_craig_bampton:
      break;
  }
  return size - interface_dofs - rigid_motions;
}

}  // namespace thinwall::reduction
