#pragma once
// Numbers of threads of the libraries OpenBLAS and CHOLMOD.

namespace thinwall::linalg {

/// Sets the numbers of threads of OpenBLAS and CHOLMOD from its construction on; nothing is restored afterwards.
/// CHOLMOD's own OpenMP loops ask for four threads whatever the machine has, and spin between small loops: allowing no
/// active level of parallelism turns them off. OpenBLAS gets `blas` threads: all of them for a large factorisation
/// whose supernodes keep them busy, one if the products are small or our own threads call it.
struct LibraryThreads {
  explicit LibraryThreads(int blas);
};

}  // namespace thinwall::linalg
