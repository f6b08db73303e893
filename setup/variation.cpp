#include "setup/variation.hpp"

namespace thinwall::setup {

double value_of(const Variation& variation, const VariedSetup& varied, const std::string& name) {
  const auto found = varied.values.find(name);
  return found == varied.values.end() ? variation.value(name) : found->second;
}

VariedSetup with_value(const Variation& variation, const VariedSetup& varied, const std::string& name, double value) {
  NamedValues values = varied.values;
  values[name] = value;
  return {variation.with(values), values};
}

}  // namespace thinwall::setup
