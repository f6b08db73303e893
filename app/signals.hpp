#pragma once
// The signals by which a user or a machine ends the program.

namespace thinwall::app {

/// Makes SIGINT and SIGTERM ask the computation to stop (core::request_interrupt); a second signal ends the program at
/// once. A computation looks at the request between pieces of work; a piece that takes longer (a large eigenproblem, a
/// call of a meshing library, a flush to a slow disk) is cut short 0.3 s after the signal: what is unfinished on the
/// disk is removed, "interrupted" is said and the program ends with exit code 130. Results are as whole then as after
/// any interruption, since files appear whole or not at all. To be called once.
void install_signal_handlers();

/// A short piece of work that is not cut short: while one lives the program ends by itself only. One at a time.
class Undisturbed {
 public:
  Undisturbed();
  ~Undisturbed();
  Undisturbed(const Undisturbed&) = delete;
  Undisturbed& operator=(const Undisturbed&) = delete;
};

}  // namespace thinwall::app
