#include <iostream>

#include "app/case_run.hpp"
#include "app/command_line.hpp"
#include "app/signals.hpp"
#include "core/memory.hpp"

int main(int argc, char** argv) {
  thinwall::core::keep_freed_memory();
  thinwall::app::install_signal_handlers();
  return thinwall::app::run_command_line(argc, argv, thinwall::app::run_case, std::cout, std::cerr);
}
