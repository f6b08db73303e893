#include "linalg/library_threads.hpp"

#include <omp.h>

extern "C" void openblas_set_num_threads(int);

namespace thinwall::linalg {

LibraryThreads::LibraryThreads(int blas) {
  omp_set_max_active_levels(0);
  openblas_set_num_threads(blas);
}

}  // namespace thinwall::linalg
