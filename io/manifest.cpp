#include "io/manifest.hpp"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <system_error>

#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/parallel.hpp"

namespace thinwall::io {

namespace {

/// One running digest. libcrypto fails here only for lack of memory or if the algorithm is not available.
class Sha256 {
 public:
  Sha256() { require(context_ && EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) == 1); }

  void add(std::string_view bytes) { require(EVP_DigestUpdate(context_.get(), bytes.data(), bytes.size()) == 1); }

  std::string hex() {
    std::array<unsigned char, EVP_MAX_MD_SIZE> digest{};
    unsigned int size = 0;
    require(EVP_DigestFinal_ex(context_.get(), digest.data(), &size) == 1);
    constexpr std::string_view digits = "0123456789abcdef";
    std::string text;
    for (unsigned int i = 0; i < size; ++i) {
      text += digits[digest[i] >> 4U];
      text += digits[digest[i] & 0xFU];
    }
    return text;
  }

 private:
  static void require(bool ok) {
    if (!ok) throw core::NumericalError("libcrypto cannot compute SHA-256; check the installation of libssl3");
  }

  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_{EVP_MD_CTX_new(), &EVP_MD_CTX_free};
};

}  // namespace

std::string sha256(std::string_view bytes) {
  Sha256 digest;
  digest.add(bytes);
  return digest.hex();
}

std::string sha256_of_file(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  Sha256 digest;
  std::vector<char> piece(1U << 16U);
  while (file) {
    file.read(piece.data(), static_cast<std::streamsize>(piece.size()));
    digest.add({piece.data(), static_cast<std::size_t>(file.gcount())});
  }
  if (!file.eof()) {
    throw core::DataError("cannot read \"" + path.string() + "\"; check that it is a file and may be read");
  }
  return digest.hex();
}

std::vector<FileRecord> file_records(const std::filesystem::path& folder) {
  std::vector<FileRecord> records;
  try {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
      if (!entry.is_regular_file() || core::is_partial_name(entry.path())) continue;
      records.push_back({entry.path().lexically_relative(folder).generic_string(), entry.file_size(), {}});
    }
  } catch (const std::filesystem::filesystem_error& error) {
    throw core::DataError("cannot list \"" + folder.string() + "\": " + error.code().message());
  }
  std::sort(records.begin(), records.end(), [](const auto& a, const auto& b) { return a.name < b.name; });
  core::parallel_for(records.size(),
                     [&](std::size_t i) { records[i].sha256 = sha256_of_file(folder / records[i].name); });
  return records;
}

}  // namespace thinwall::io
