// The lowest modes of K φ = λ M φ by SLEPc and MUMPS, from matrices that bench/fem_modes wrote: the peer of bench/run.
//   slepc_modes FOLDER [PETSc's and SLEPc's options]      prints one JSON object on rank 0
// FOLDER holds K.petsc and M.petsc. Krylov-Schur on the shift-invert operator about 0, Cholesky by MUMPS; all of it can
// be changed by options. Of its own: -sbaij stores one triangle; -nodes says that three rows in a row are a node, which
// lets MUMPS order the graph of nodes (its ICNTL(15)).

#include <slepceps.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "bench/stages.hpp"

namespace {

PetscErrorCode load(const std::string& path, Mat* A) {
  PetscFunctionBeginUser;
  PetscViewer viewer = nullptr;
  PetscBool sbaij = PETSC_FALSE;
  PetscBool nodes = PETSC_FALSE;
  PetscCall(PetscViewerBinaryOpen(PETSC_COMM_WORLD, path.c_str(), FILE_MODE_READ, &viewer));
  PetscCall(MatCreate(PETSC_COMM_WORLD, A));
  PetscCall(MatSetType(*A, MATAIJ));
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-nodes", &nodes));
  if (nodes) PetscCall(MatSetBlockSize(*A, 3));
  PetscCall(MatLoad(*A, viewer));
  PetscCall(PetscViewerDestroy(&viewer));
  PetscCall(MatSetOption(*A, MAT_SYMMETRIC, PETSC_TRUE));
  PetscCall(PetscOptionsHasName(nullptr, nullptr, "-sbaij", &sbaij));
  if (sbaij) PetscCall(MatConvert(*A, MATSBAIJ, MAT_INPLACE_MATRIX, A));
  PetscCall(MatSetOption(*A, MAT_SPD, PETSC_TRUE));
  PetscFunctionReturn(0);
}

PetscErrorCode prepare(EPS eps, Mat K, Mat M, PC* pc) {
  PetscFunctionBeginUser;
  ST st = nullptr;
  KSP ksp = nullptr;
  PetscCall(EPSSetOperators(eps, K, M));
  PetscCall(EPSSetProblemType(eps, EPS_GHEP));
  PetscCall(EPSSetType(eps, EPSKRYLOVSCHUR));
  PetscCall(EPSSetDimensions(eps, 10, PETSC_DEFAULT, PETSC_DEFAULT));
  PetscCall(EPSSetTarget(eps, 0.0));
  PetscCall(EPSSetWhichEigenpairs(eps, EPS_TARGET_MAGNITUDE));
  PetscCall(EPSGetST(eps, &st));
  PetscCall(STSetType(st, STSINVERT));
  PetscCall(STGetKSP(st, &ksp));
  PetscCall(KSPSetType(ksp, KSPPREONLY));
  PetscCall(KSPGetPC(ksp, pc));
  PetscCall(PCSetType(*pc, PCCHOLESKY));
  PetscCall(PCFactorSetMatSolverType(*pc, MATSOLVERMUMPS));
  PetscCall(EPSSetFromOptions(eps));
  PetscFunctionReturn(0);
}

/// Seconds that rank 0 spent in one of PETSc's events.
PetscErrorCode seconds_in(const char* event, double* seconds) {
  PetscFunctionBeginUser;
  PetscLogEvent id = -1;
  PetscEventPerfInfo info{};
  PetscCall(PetscLogEventGetId(event, &id));
  PetscCall(PetscLogEventGetPerfInfo(PETSC_DETERMINE, id, &info));
  *seconds = info.time;
  PetscFunctionReturn(0);
}

PetscErrorCode report(EPS eps, PC pc, double set_up_s, double solve_s) {
  PetscFunctionBeginUser;
  double order_s = 0.0;
  double analysis_s = 0.0;
  double factor_s = 0.0;
  PetscCall(seconds_in("MatGetOrdering", &order_s));
  PetscCall(seconds_in("MatCholFctrSym", &analysis_s));
  PetscCall(seconds_in("MatCholFctrNum", &factor_s));
  Mat factor = nullptr;
  PetscInt entries = 0;
  PetscReal flops = 0.0;
  PetscInt converged = 0;
  PetscCall(PCFactorGetMatrix(pc, &factor));
  PetscCall(MatMumpsGetInfog(factor, 29, &entries));
  PetscCall(MatMumpsGetRinfog(factor, 3, &flops));
  PetscCall(EPSGetConverged(eps, &converged));
  double memory = thinwall::bench::peak_memory_bytes();
  PetscCall(MPIU_Allreduce(MPI_IN_PLACE, &memory, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD));
  PetscInt wanted = 0;
  PetscCall(EPSGetDimensions(eps, &wanted, nullptr, nullptr));
  std::string frequencies;
  PetscReal worst = 0.0;
  for (PetscInt i = 0; i < std::min(wanted, converged); ++i) {
    PetscScalar lambda = 0.0;
    PetscReal error = 0.0;
    PetscCall(EPSGetEigenvalue(eps, i, &lambda, nullptr));
    PetscCall(EPSComputeError(eps, i, EPS_ERROR_RELATIVE, &error));
    worst = std::max(worst, error);
    char number[40];
    PetscCall(PetscSNPrintf(number, sizeof number, "%s%.12g", i > 0 ? ", " : "",
                            std::sqrt(std::max(lambda, 0.0)) / (2.0 * std::numbers::pi)));
    frequencies += number;
  }
  PetscCall(PetscPrintf(
      PETSC_COMM_WORLD,
      "{\"program\": \"slepc\", \"ordering_s\": %.4f, \"factor_s\": %.4f, \"eigen_s\": %.4f, \"total_s\": %.4f, "
      "\"factor_nonzeros\": %.0f, \"factor_flops\": %.6g, \"worst_relative_error\": %.3g, \"peak_memory_bytes\": %.0f, "
      "\"converged\": %s, \"frequencies_hz\": [%s]}\n",
      order_s + analysis_s, factor_s, set_up_s + solve_s - order_s - analysis_s - factor_s, set_up_s + solve_s,
      entries < 0 ? -1e6 * entries : 1.0 * entries, flops, worst, memory, converged >= wanted ? "true" : "false",
      frequencies.c_str()));
  PetscFunctionReturn(0);
}

PetscErrorCode run(const std::string& folder) {
  PetscFunctionBeginUser;
  Mat K = nullptr;
  Mat M = nullptr;
  EPS eps = nullptr;
  PC pc = nullptr;
  PetscCall(load(folder + "/K.petsc", &K));
  PetscCall(load(folder + "/M.petsc", &M));
  PetscCall(EPSCreate(PETSC_COMM_WORLD, &eps));
  PetscCall(prepare(eps, K, M, &pc));
  PetscCallMPI(MPI_Barrier(PETSC_COMM_WORLD));
  thinwall::bench::Stopwatch watch;
  PetscCall(EPSSetUp(eps));
  const double set_up_s = watch.lap();
  PetscCall(EPSSolve(eps));
  const double solve_s = watch.lap();
  PetscCall(report(eps, pc, set_up_s, solve_s));
  PetscCall(EPSDestroy(&eps));
  PetscCall(MatDestroy(&K));
  PetscCall(MatDestroy(&M));
  PetscFunctionReturn(0);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: slepc_modes FOLDER [options of PETSc and SLEPc]\n");
    return 2;
  }
  PetscCall(SlepcInitialize(&argc, &argv, nullptr, nullptr));
  PetscCall(PetscLogDefaultBegin());
  PetscCall(run(argv[1]));
  PetscCall(SlepcFinalize());
  return 0;
}
