#pragma once
// How many threads the libraries below may take.

namespace thinwall::linalg {

/// Threads of OpenBLAS and CHOLMOD from here on. CHOLMOD's own OpenMP loops ask for four threads whatever the machine
/// has, and spin between the small ones: allowing no active level turns them off. BLAS gets `blas` threads: all for a
/// large factorisation, whose supernodes keep them busy, one wherever the products are small or our own threads call
/// it.
struct LibraryThreads {
  explicit LibraryThreads(int blas);
};

}  // namespace thinwall::linalg
