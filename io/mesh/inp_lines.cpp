#include "io/mesh/inp_lines.hpp"

#include <algorithm>
#include <utility>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "io/surface_text.hpp"

namespace thinwall::io {

namespace {

constexpr std::size_t most_within = 10;
constexpr int most_inclusions = 1000;

}  // namespace

std::string included_file(const std::filesystem::path& path) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(path, error))
    throw core::DataError("the included file \"" + path.string() +
                          "\" is not there, or no plain file: put it there, or write its lines in its place");
  return core::read_file(path);
}

InpLines::InpLines(std::string_view bytes, InpInclude include, mesh::LabelledMesh& mesh)
    : bytes_(bytes), include_(std::move(include)), mesh_(mesh) {
  open_.push_back({mesh.path, {}, 0, 0, 0});
}

std::string_view InpLines::text(const OpenFile& file) const {
  return &file == &open_.front() ? bytes_ : std::string_view(file.bytes);
}

bool InpLines::next(std::string_view& line) {
  while (!open_.empty()) {
    OpenFile& file = open_.back();
    const std::string_view rest = text(file).substr(file.at);
    if (rest.empty()) {
      close();
      continue;
    }
    const auto end = std::min(rest.find('\n'), rest.size());
    line = without_blanks(rest.substr(0, end));
    file.at += std::min(end + 1, rest.size());
    ++file.line;
    ++number_;
    if (!line.empty() && !line.starts_with("**")) return true;
  }
  return false;
}

void InpLines::include(const std::string& name) {
  const auto fail = [this](const std::string& what) { mesh::fail_at(mesh_, number_, what); };
  if (name.empty()) fail("*INCLUDE lacks INPUT=file");
  std::string slashes = name;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  const auto path = (std::filesystem::path(mesh_.path).parent_path() / slashes).lexically_normal();
  const auto same = [&path](const OpenFile& file) { return file.path.lexically_normal() == path; };
  if (std::any_of(open_.begin(), open_.end(), same)) fail("the file " + io::quoted(name) + " includes itself");
  if (open_.size() > most_within) fail("more than 10 files include each other; write their lines into one");
  if (++inclusions_ > most_inclusions) fail("more than 1000 files are included; write their lines into one");
  if (with_mesh_.contains(path))
    fail("the file " + io::quoted(name) + " has nodes or elements and is included for the second time");
  std::string bytes;
  try {
    bytes = include_(path);
  } catch (const core::DataError& error) {
    fail(error.what());
  }
  known_.insert(path);
  open_.push_back({path, std::move(bytes), 0, 0, mesh_.nodes.size() + mesh_.cells.size()});
  note_origin();
}

void InpLines::note_origin() {
  if (open_.empty()) return;
  const OpenFile& file = open_.back();
  mesh_.origins.push_back({number_ + 1, file.path.string(), file.line + 1});
}

void InpLines::close() {
  const OpenFile& file = open_.back();
  if (open_.size() > 1 && mesh_.nodes.size() + mesh_.cells.size() > file.mesh_size) with_mesh_.insert(file.path);
  open_.pop_back();
  note_origin();
}

std::string_view without_blanks(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace thinwall::io
