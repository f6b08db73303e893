#include "io/matrices/mat_version.hpp"

#include <fstream>
#include <string>

#include "io/matrices/mat4.hpp"

namespace thinwall::io {

MatVersion mat_version(std::string_view bytes) {
  constexpr std::string_view hdf5 = "\x89HDF\r\n\x1a\n";
  constexpr std::size_t behind_the_title = 512;  // where MATLAB lets HDF5 begin
  const bool has_title = bytes.size() > behind_the_title && bytes.substr(behind_the_title).starts_with(hdf5);
  if (bytes.starts_with("MATLAB 7.3") || bytes.starts_with(hdf5) || has_title) return MatVersion::hdf5;
  if (bytes.starts_with("MATLAB")) return MatVersion::five;
  return is_mat4(bytes) ? MatVersion::four : MatVersion::none;
}

MatVersion mat_version_of_file(const std::filesystem::path& path) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(path, ignored)) return MatVersion::none;
  std::string head(1024, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(file.gcount()));
  return mat_version(head);
}

}  // namespace thinwall::io
