#include "app/option_keys.hpp"

#include <algorithm>
#include <utility>

#include "case/problem.hpp"
#include "case/reader.hpp"

namespace thinwall::app {

cases::Case read_with_options(const std::filesystem::path& path, const std::vector<std::string>& overrides,
                              std::size_t written, std::span<const OptionKey> keys) {
  try {
    return cases::read_case(path, overrides);
  } catch (const cases::CaseError& error) {
    std::vector<cases::Problem> problems = error.problems;
    for (cases::Problem& problem : problems) {
      if (problem.line >= -static_cast<int>(written)) continue;
      const auto is_of = [&](const OptionKey& one) { return problem.text.starts_with(std::string(one.key) + ":"); };
      const auto found = std::ranges::find_if(keys, is_of);
      std::string text = found == keys.end() ? std::move(problem.text)
                                             : std::string(found->option) + problem.text.substr(found->key.size());
      problem = {0, 0, std::move(text)};
    }
    throw cases::CaseError(error.source, std::move(problems));
  }
}

}  // namespace thinwall::app
