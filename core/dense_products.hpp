#pragma once
// Eigen's kernels for products and triangular solutions of dynamic size, compiled once, in dense_products.cpp. A file
// that multiplies matrices compiles them for itself otherwise, which takes clang one to four seconds and gives the
// linker up to forty copies. The header is among the precompiled headers (cmake/ThinwallTargets.cmake), so that no file
// has to include it: a file that is compiled without it works as well, with copies of its own.
//
// A kernel takes as many rows and columns at once as suit the vector unit; these numbers are Eigen's traits.

#include <Eigen/Core>
#include <complex>

// The kernels, each after the words of INSTANCE: `extern template` here, `template` in dense_products.cpp.
#define THINWALL_PRODUCT_KERNELS(INSTANCE)                                          \
  THINWALL_MATRIX_PRODUCT(INSTANCE, double, double, false)                          \
  THINWALL_MATRIX_PRODUCT(INSTANCE, double, Complex, false)                         \
  THINWALL_MATRIX_PRODUCT(INSTANCE, Complex, double, false)                         \
  THINWALL_MATRIX_PRODUCT(INSTANCE, Complex, Complex, false)                        \
  THINWALL_MATRIX_PRODUCT(INSTANCE, Complex, Complex, true)                         \
  THINWALL_LEFT_PACKING(INSTANCE, double, double, ColMajor)                         \
  THINWALL_LEFT_PACKING(INSTANCE, double, double, RowMajor)                         \
  THINWALL_LEFT_PACKING(INSTANCE, double, Complex, ColMajor)                        \
  THINWALL_LEFT_PACKING(INSTANCE, double, Complex, RowMajor)                        \
  THINWALL_LEFT_PACKING(INSTANCE, Complex, double, ColMajor)                        \
  THINWALL_LEFT_PACKING(INSTANCE, Complex, Complex, ColMajor)                       \
  THINWALL_LEFT_PACKING(INSTANCE, Complex, Complex, RowMajor)                       \
  THINWALL_RIGHT_PACKING(INSTANCE, double, ColMajor)                                \
  THINWALL_RIGHT_PACKING(INSTANCE, double, RowMajor)                                \
  THINWALL_RIGHT_PACKING(INSTANCE, Complex, ColMajor)                               \
  THINWALL_RIGHT_PACKING(INSTANCE, Complex, RowMajor)                               \
  THINWALL_VECTOR_PRODUCT(INSTANCE, double, RowMajor, false, double, ColMajor, 0)   \
  THINWALL_VECTOR_PRODUCT(INSTANCE, double, ColMajor, false, double, RowMajor, 0)   \
  THINWALL_VECTOR_PRODUCT(INSTANCE, double, ColMajor, false, double, ColMajor, 0)   \
  THINWALL_VECTOR_PRODUCT(INSTANCE, double, RowMajor, false, double, RowMajor, 1)   \
  THINWALL_VECTOR_PRODUCT(INSTANCE, double, RowMajor, false, Complex, ColMajor, 0)  \
  THINWALL_VECTOR_PRODUCT(INSTANCE, double, ColMajor, false, Complex, RowMajor, 0)  \
  THINWALL_VECTOR_PRODUCT(INSTANCE, Complex, RowMajor, false, double, ColMajor, 0)  \
  THINWALL_VECTOR_PRODUCT(INSTANCE, Complex, ColMajor, false, double, RowMajor, 0)  \
  THINWALL_VECTOR_PRODUCT(INSTANCE, Complex, RowMajor, false, Complex, ColMajor, 0) \
  THINWALL_VECTOR_PRODUCT(INSTANCE, Complex, ColMajor, false, Complex, RowMajor, 0) \
  THINWALL_VECTOR_PRODUCT(INSTANCE, Complex, RowMajor, true, Complex, ColMajor, 0)  \
  THINWALL_VECTOR_PRODUCT(INSTANCE, Complex, ColMajor, true, Complex, RowMajor, 0)  \
  THINWALL_TRIANGULAR_SOLUTION(INSTANCE, double, Lower, ColMajor)                   \
  THINWALL_TRIANGULAR_SOLUTION(INSTANCE, double, Upper, ColMajor)                   \
  THINWALL_TRIANGULAR_SOLUTION(INSTANCE, double, Upper, RowMajor)                   \
  THINWALL_TRIANGULAR_SOLUTION(INSTANCE, double, UnitLower, ColMajor)               \
  THINWALL_TRIANGULAR_SOLUTION(INSTANCE, Complex, Upper, ColMajor)                  \
  THINWALL_TRIANGULAR_SOLUTION(INSTANCE, Complex, UnitLower, ColMajor)              \
  THINWALL_TRIANGULAR_PRODUCT(INSTANCE, Upper, RowMajor)                            \
  THINWALL_TRIANGULAR_PRODUCT(INSTANCE, UnitUpper, RowMajor)                        \
  THINWALL_TRIANGULAR_PRODUCT(INSTANCE, Lower, ColMajor)                            \
  THINWALL_TRIANGULAR_PRODUCT(INSTANCE, UnitLower, ColMajor)                        \
  INSTANCE struct triangular_matrix_vector_product<Index, UnitUpper, double, false, double, false, RowMajor>;

#define THINWALL_MATRIX_PRODUCT(INSTANCE, Left, Right, conjugate_left)                                \
  INSTANCE struct gebp_kernel<Left, Right, Index,                                                     \
                              blas_data_mapper<gebp_traits<Left, Right>::ResScalar, Index, ColMajor>, \
                              gebp_traits<Left, Right>::mr, gebp_traits<Left, Right>::nr, conjugate_left, false>;

#define THINWALL_LEFT_PACKING(INSTANCE, Left, Right, Order)                                                            \
  INSTANCE struct gemm_pack_lhs<Left, Index, const_blas_data_mapper<Left, Index, Order>, gebp_traits<Left, Right>::mr, \
                                gebp_traits<Left, Right>::LhsProgress, gebp_traits<Left, Right>::LhsPacket4Packing,    \
                                Order>;

#define THINWALL_RIGHT_PACKING(INSTANCE, Right, Order)                                     \
  INSTANCE struct gemm_pack_rhs<Right, Index, const_blas_data_mapper<Right, Index, Order>, \
                                gebp_traits<double, Right>::nr, Order>;

#define THINWALL_VECTOR_PRODUCT(INSTANCE, Left, LeftOrder, conjugate_left, Right, RightOrder, version)       \
  INSTANCE struct general_matrix_vector_product<Index, Left, const_blas_data_mapper<Left, Index, LeftOrder>, \
                                                LeftOrder, conjugate_left, Right,                            \
                                                const_blas_data_mapper<Right, Index, RightOrder>, false, version>;

#define THINWALL_TRIANGULAR_SOLUTION(INSTANCE, Scalar, Triangle, Order) \
  INSTANCE struct triangular_solve_matrix<Scalar, Index, OnTheLeft, Triangle, false, Order, ColMajor, 1>;

#define THINWALL_TRIANGULAR_PRODUCT(INSTANCE, Triangle, Order)                                                   \
  INSTANCE struct product_triangular_matrix_matrix<double, Index, Triangle, true, Order, false, ColMajor, false, \
                                                   ColMajor, 1>;

namespace Eigen::internal {
/// The scalar of the kernels for complex matrices.
using Complex = std::complex<double>;
THINWALL_PRODUCT_KERNELS(extern template)
}  // namespace Eigen::internal
