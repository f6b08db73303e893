#pragma once
// CalculiX as another program.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace thinwall {

inline bool ccx_is_installed() {
  return std::system("command -v ccx > /dev/null 2>&1") == 0;
}

/// Runs ccx on the file and reads the frequencies (Hz) off the first table of its .dat file: lines of five numbers, the
/// fourth in Hz.
inline std::vector<double> ccx_frequencies(const std::filesystem::path& input) {
  std::filesystem::path stem = input;
  stem.replace_extension();
  const std::string command = "cd '" + stem.parent_path().string() +
                              "' && OMP_NUM_THREADS=1 OPENBLAS_NUM_THREADS=1 ccx '" + stem.string() + "' > '" +
                              stem.string() + ".log' 2>&1";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(stem.string() + ".dat");
  std::vector<double> frequencies;
  for (std::string line; std::getline(file, line);) {
    if (line.find("P A R T I C I P A T I O N") != std::string::npos) break;
    std::istringstream words(line);
    double number[5];
    if (words >> number[0] >> number[1] >> number[2] >> number[3] >> number[4]) frequencies.push_back(number[3]);
  }
  return frequencies;
}

}  // namespace thinwall
