#pragma once
// The program's command line, called as a function.

#include <sstream>
#include <string>
#include <vector>

#include "app/command_line.hpp"

namespace thinwall::tests {

/// The exit code of a command and what it prints.
struct Outcome {
  int code = -1;
  std::string out, err;
};

/// `thinwall` with these words behind it; `run` stands for the pipeline.
inline Outcome call(std::vector<std::string> words, const app::RunCase& run = {}) {
  words.insert(words.begin(), "thinwall");
  std::vector<const char*> argv;
  for (const auto& word : words) argv.push_back(word.c_str());
  std::ostringstream out, err;
  const int code = app::run_command_line(static_cast<int>(argv.size()), argv.data(), run, out, err);
  return {code, out.str(), err.str()};
}

}  // namespace thinwall::tests
