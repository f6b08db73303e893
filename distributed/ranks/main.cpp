// thinwall-mpi FOLDER: the ranks that factorise large matrices for `thinwall run CASE --ranks N`, which starts them.

#include <mpi.h>
#include <sys/prctl.h>

#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>

#include "core/error.hpp"
#include "distributed/ranks/orders.hpp"

namespace {

/// Tells the program that started the ranks why they end, and ends all of them.
int end_all(const char* kind, const std::exception& error) {
  std::cout << "= " << kind << ' ' << error.what() << std::endl;
  return MPI_Abort(MPI_COMM_WORLD, 1);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fprintf(stderr, "usage: thinwall-mpi FOLDER\nthinwall run CASE --ranks N starts it under mpirun\n");
    return 2;
  }
  ::prctl(PR_SET_PDEATHSIG, SIGKILL);  // mpirun's death, by which an interrupted run ends the ranks
  MPI_Init(&argc, &argv);
  try {
    thinwall::distributed::carry_out_orders(argv[1]);
  } catch (const thinwall::core::DataError& error) {
    return end_all("data_error", error);
  } catch (const std::exception& error) {
    return end_all("failed", error);
  }
  MPI_Finalize();
  return 0;
}
