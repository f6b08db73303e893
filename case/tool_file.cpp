#include "case/tool_file.hpp"

#include <utility>

#include "case/binding.hpp"
#include "case/checks/tool_checks.hpp"
#include "case/problem.hpp"
#include "case/schema/schema.hpp"
#include "case/toml_values.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"

namespace thinwall::cases {

setup::Tool read_tool(const std::filesystem::path& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored))
    throw core::InputError("no tool at \"" + file.string() + "\": it is a TOML file with a table [tool]");
  const std::string text = core::read_file(file);
  ReadValues read = read_values(text, file.string(), case_schema());
  if (!read.problems.empty()) throw CaseError({file.string(), text}, std::move(read.problems));
  const Case bound = bind_case(std::move(read.values), file.parent_path());
  if (!bound.tool) throw core::InputError(file.string() + ": there is no [tool]; add it with teeth and diameter");
  Findings findings{bound.values, {}};
  if (bound.tool->swap) check_swapped_tools(*bound.tool, findings);
  if (!findings.problems.empty()) throw CaseError({file.string(), text}, std::move(findings.problems));
  return *bound.tool;
}

}  // namespace thinwall::cases
