#pragma once

#include <Eigen/Dense>

/// Decompositions and products of dense matrices of any size: compiled once, in dense_instances.cc, and not in each of the files
/// that use them.  Precompiled headers include this header; a file without it compiles its own, with the same results
/// within rounding.
namespace Eigen
{
namespace internal
{
using DoubleBlocks   = gebp_traits<double, double>;
using ProductColumns = blas_data_mapper<double, Index, ColMajor, Unaligned, 1>;
template <int order>
using ConstMapper = const_blas_data_mapper<double, Index, order>;
template <int order>
using PackLeft = gemm_pack_lhs<double, Index, ConstMapper<order>, DoubleBlocks::mr, DoubleBlocks::LhsProgress,
                               DoubleBlocks::LhsPacket4Packing, order>;
template <int order>
using PackRight = gemm_pack_rhs<double, Index, ConstMapper<order>, DoubleBlocks::nr, order>;
} // namespace internal
} // namespace Eigen

#define GESTELL_DENSE_INSTANCES(EXTERN)                                                                                          \
  namespace Eigen                                                                                                                \
  {                                                                                                                              \
  namespace internal                                                                                                             \
  {                                                                                                                              \
  EXTERN template struct gebp_kernel<double, double, Index, ProductColumns, DoubleBlocks::mr, DoubleBlocks::nr>;                 \
  EXTERN template struct gemm_pack_lhs<double, Index, ConstMapper<ColMajor>, DoubleBlocks::mr, DoubleBlocks::LhsProgress,        \
                                       DoubleBlocks::LhsPacket4Packing, ColMajor>;                                               \
  EXTERN template struct gemm_pack_lhs<double, Index, ConstMapper<RowMajor>, DoubleBlocks::mr, DoubleBlocks::LhsProgress,        \
                                       DoubleBlocks::LhsPacket4Packing, RowMajor>;                                               \
  EXTERN template struct gemm_pack_rhs<double, Index, ConstMapper<ColMajor>, DoubleBlocks::nr, ColMajor>;                        \
  EXTERN template struct gemm_pack_rhs<double, Index, ConstMapper<RowMajor>, DoubleBlocks::nr, RowMajor>;                        \
  EXTERN template struct triangular_solve_matrix<double, Index, OnTheLeft, UnitLower, false, ColMajor, ColMajor, 1>;             \
  EXTERN template struct triangular_solve_matrix<double, Index, OnTheLeft, Lower, false, ColMajor, ColMajor, 1>;                 \
  EXTERN template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, ColMajor, ColMajor, 1>;                 \
  EXTERN template struct triangular_solve_matrix<double, Index, OnTheLeft, Upper, false, RowMajor, ColMajor, 1>;                 \
  }                                                                                                                              \
  EXTERN template class HessenbergDecomposition<MatrixXd>;                                                                       \
  EXTERN template class RealSchur<MatrixXd>;                                                                                     \
  EXTERN template class EigenSolver<MatrixXd>;                                                                                   \
  EXTERN template EigenSolver<MatrixXd> &EigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd> &, bool);                      \
  EXTERN template class SelfAdjointEigenSolver<MatrixXd>;                                                                        \
  EXTERN template SelfAdjointEigenSolver<MatrixXd> &SelfAdjointEigenSolver<MatrixXd>::compute(const EigenBase<MatrixXd> &, int); \
  EXTERN template class GeneralizedSelfAdjointEigenSolver<MatrixXd>;                                                             \
  EXTERN template class PartialPivLU<MatrixXd>;                                                                                  \
  EXTERN template class PartialPivLU<MatrixXcd>;                                                                                 \
  EXTERN template class FullPivLU<MatrixXd>;                                                                                     \
  EXTERN template class HouseholderQR<MatrixXd>;                                                                                 \
  EXTERN template class ColPivHouseholderQR<MatrixXd>;                                                                           \
  EXTERN template class CompleteOrthogonalDecomposition<MatrixXd>;                                                               \
  EXTERN template class LLT<MatrixXd>;                                                                                           \
  EXTERN template LLT<MatrixXd> &LLT<MatrixXd>::compute(const EigenBase<MatrixXd> &);                                            \
  EXTERN template class LDLT<MatrixXd>;                                                                                          \
  EXTERN template LDLT<MatrixXd> &LDLT<MatrixXd>::compute(const EigenBase<MatrixXd> &);                                          \
  EXTERN template class JacobiSVD<MatrixXd>;                                                                                     \
  }

GESTELL_DENSE_INSTANCES(extern)
