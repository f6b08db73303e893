#include "study/kept/checkpoint.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <string_view>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/messages.hpp"
#include "io/manifest.hpp"
#include "io/program_id.hpp"

namespace thinwall::study {

namespace {

namespace fs = std::filesystem;

constexpr std::size_t sum_length = 64;

/// Lengths of name and bytes, the sum of both, and in the next line both.
std::string record(const std::string& name, const std::string& bytes) {
  return fmt::format("{} {} {}\n{}{}", name.size(), bytes.size(), io::sha256(name + bytes), name, bytes);
}

}  // namespace

Checkpoint::Checkpoint(fs::path file, const std::string& key, bool fresh)
    : file_(std::move(file)), heading_("thinwall-checkpoint 2 " + key + "\n") {
  try {
    read(fresh);
  } catch (const core::DataError& error) {
    core::inform(fmt::format("kept results are not used: {}", error.what()));
  }
}

void Checkpoint::read(bool fresh) {
  std::error_code ignored;
  if (fresh || !fs::exists(file_, ignored)) return;
  const std::string all = core::read_file(file_);
  if (!all.starts_with(heading_)) {
    core::note(fmt::format("{} is of other inputs or of another program; begun anew", file_.filename().string()));
    return;
  }
  std::size_t at = heading_.size();
  while (at < all.size()) {
    const std::size_t end = all.find('\n', at);
    std::size_t name_size = 0, size = 0;
    char sum[sum_length + 1];
    const std::string line = all.substr(at, end == std::string::npos ? 0 : end - at);
    if (std::sscanf(line.c_str(), "%zu %zu %64s", &name_size, &size, sum) != 3) break;
    const std::size_t left = all.size() - end - 1;
    if (left < size || left - size < name_size) break;
    const std::string_view both = std::string_view(all).substr(end + 1, name_size + size);
    if (io::sha256(both) != sum) break;
    note_place_of(std::string(both.substr(0, name_size)));
    pieces_[last_] = both.substr(name_size);
    at = end + 1 + name_size + size;
  }
  begun_ = true;
  if (at == all.size()) return;
  core::inform(fmt::format("the end of {} is damaged; what comes before is used", file_.filename().string()));
  fs::resize_file(file_, at, ignored);
  begun_ = !ignored;
}

const std::string* Checkpoint::find(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  const auto found = pieces_.find(name);
  return found == pieces_.end() ? nullptr : &found->second;
}

void Checkpoint::add(const std::string& name, std::string bytes) {
  const std::lock_guard lock(mutex_);
  if (file_.empty()) return;
  try {
    write(record(name, bytes));
    note_place_of(name);
    pieces_[name] = std::move(bytes);
  } catch (const core::DataError& error) {
    core::warn(fmt::format("{}; the next run begins anew", error.what()));
    file_.clear();
  }
}

void Checkpoint::note_place_of(const std::string& name) {
  sorted_ = sorted_ && (pieces_.empty() || last_ < name);
  last_ = name;
}

void Checkpoint::arrange() {
  const std::lock_guard lock(mutex_);
  if (file_.empty() || sorted_) return;
  std::string all = heading_;
  for (const auto& [name, bytes] : pieces_) all += record(name, bytes);
  try {
    core::write_file_atomically(file_, all);
    last_ = pieces_.rbegin()->first;
    sorted_ = true;
  } catch (const core::DataError& error) {
    core::warn(fmt::format("{}; the kept pieces stay in the order in which they were finished", error.what()));
  }
}

void Checkpoint::write(const std::string& piece) {
  if (!begun_) {
    std::error_code ignored;
    fs::create_directories(file_.parent_path(), ignored);
    core::write_file_atomically(file_, heading_ + piece);
    begun_ = true;
    return;
  }
  std::ofstream out(file_, std::ios::binary | std::ios::app);
  out << piece;
  out.flush();
  if (!out) throw core::DataError(file_.string() + " cannot be written");
}

}  // namespace thinwall::study
