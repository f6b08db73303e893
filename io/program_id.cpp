#include "io/program_id.hpp"

#include <elf.h>
#include <fmt/format.h>
#include <link.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <string_view>

#include "io/manifest.hpp"

namespace thinwall::io {

namespace {

/// The build ID among the notes in a segment of an ELF file: each note is a header, a name and a description, padded to
/// four bytes.
std::string build_id_in(std::string_view notes) {
  const auto padded = [](std::size_t size) { return (size + 3) / 4 * 4; };
  ElfW(Nhdr) note;
  while (notes.size() >= sizeof note) {
    std::memcpy(&note, notes.data(), sizeof note);
    const std::size_t name = sizeof note, description = name + padded(note.n_namesz);
    if (notes.size() < description + note.n_descsz) break;
    if (note.n_type == NT_GNU_BUILD_ID && notes.substr(name, 3) == "GNU") {
      std::string digits;
      for (const char byte : notes.substr(description, note.n_descsz))
        digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
      return digits;
    }
    notes.remove_prefix(std::min(notes.size(), description + padded(note.n_descsz)));
  }
  return {};
}

/// The build ID of the program, which dl_iterate_phdr lists before its libraries.
std::string build_id() {
  std::string id;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* found) {
        for (int i = 0; i < info->dlpi_phnum; ++i) {
          const ElfW(Phdr)& segment = info->dlpi_phdr[i];
          auto& digits = *static_cast<std::string*>(found);
          if (segment.p_type != PT_NOTE || !digits.empty()) continue;
          digits = build_id_in({reinterpret_cast<const char*>(info->dlpi_addr + segment.p_vaddr), segment.p_memsz});
        }
        return 1;
      },
      &id);
  return id;
}

}  // namespace

const std::string& program_id() {
  static const std::string id = [] {
    const std::string linked = build_id();
    return linked.empty() ? sha256_of_file("/proc/self/exe") : linked;
  }();
  return id;
}

}  // namespace thinwall::io
