#include "coupling/factors/cholmod_factor.h"

#include "coupling/algebra/node_ordering.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/factors/petsc_factor.h"

#include <suitesparse/cholmod.h>

#include <algorithm>
#include <new>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

std::vector<char> marks_of(const std::vector<int> &held, Eigen::Index n)
{
  std::vector<char> marks(held.empty() ? 0 : n, 0);
  for (const int i : held)
    marks[i] = 1;
  return marks;
}

class CholmodFactor final : public StiffnessFactor
{
public:
  explicit CholmodFactor(FactorMatrices matrices) : matrices_(std::move(matrices)) { cholmod_l_start(&common_); }
  ~CholmodFactor() override
  {
    release();
    cholmod_l_finish(&common_);
  }
  CholmodFactor(const CholmodFactor &)            = delete;
  CholmodFactor &operator=(const CholmodFactor &) = delete;

  void factorise() override
  {
    if (L_)
      return;
    const Eigen::SparseMatrix<double> &C    = matrices_.stiffness();
    const std::vector<char>            held = marks_of(matrices_.held, C.rows());
    LowerPattern                       lower(C, held);
    const std::vector<double>          values = values_in(*lower.view(), C, held);
    cholmod_sparse                    *A      = lower.view();
    cholmod_l_finish(&common_);
    L_ = lower.analysed(node_ordering(C, held), common_);
    require_memory();
    if (const double needed = double(sizeof(double)) * double(L_->xsize); needed > matrices_.available)
    {
      release();
      throw NotEnoughMemory(needed, matrices_.available);
    }
    A->xtype = CHOLMOD_REAL;
    A->x     = const_cast<double *>(values.data());
    cholmod_l_factorize(A, L_, &common_);
    if (common_.status == CHOLMOD_NOT_POSDEF)
    {
      const auto row = static_cast<const SuiteSparse_long *>(L_->Perm)[L_->minor];
      release();
      throw NotPositiveDefinite(int(row));
    }
    require_memory();
  }

  double regularity() const override { return cholmod_l_rcond(L_, &common_); }

  void release() override { cholmod_l_free_factor(&L_, &common_); }

  void solve_in_place(Eigen::Ref<MatrixXd> X) const override
  {
    for (const int i : matrices_.held)
      X.row(i).setZero();
    constexpr Eigen::Index at_once = 16; // columns: more take no less time each, but memory
    for (Eigen::Index first = 0; first < X.cols(); first += at_once)
    {
      auto          columns = X.middleCols(first, std::min(at_once, X.cols() - first));
      cholmod_dense F{};
      F.nrow                  = columns.rows();
      F.ncol                  = columns.cols();
      F.d                     = X.outerStride();
      F.nzmax                 = F.d * F.ncol;
      F.x                     = columns.data();
      F.xtype                 = CHOLMOD_REAL;
      F.dtype                 = CHOLMOD_DOUBLE;
      cholmod_dense *solution = cholmod_l_solve(CHOLMOD_A, L_, &F, &common_);
      if (!solution)
        throw std::bad_alloc();
      columns = Eigen::Map<const MatrixXd>(static_cast<const double *>(solution->x), columns.rows(), columns.cols());
      cholmod_l_free_dense(&solution, &common_);
    }
  }

  Inertia below(double omega) override
  {
    if (!counting_)
      counting_ = petsc_stiffness_factor(
          fem::Ranks::alone(), {&matrices_.stiffness(), matrices_.M, matrices_.held, nullptr, matrices_.available});
    return counting_->below(omega);
  }

  std::unique_ptr<ModeSearch> search(const std::string &eigensolver, const BlockLanczos::Options &options,
                                     const LowestModes &known) const override
  {
    auto inverse = std::make_shared<InverseByColumns>(
        int(matrices_.stiffness().rows()), [this](Eigen::Ref<MatrixXd> X) { solve_in_place(X); }, matrices_.held);
    return search_modes(MPI_COMM_SELF, {std::move(inverse), matrices_.M, matrices_.C}, eigensolver, options, known);
  }

private:
  /// The numbers of C in a pattern of it; a fixed coordinate has the mean of the diagonal.
  static std::vector<double> values_in(const cholmod_sparse &lower, const Eigen::SparseMatrix<double> &C,
                                       const std::vector<char> &held)
  {
    const auto         *begin = static_cast<const SuiteSparse_long *>(lower.p);
    const auto         *rows  = static_cast<const SuiteSparse_long *>(lower.i);
    const double        mean  = C.rows() > 0 ? C.diagonal().cwiseAbs().mean() : 1.;
    std::vector<double> values(begin[C.cols()], 0.);
    for (int j = 0; j < C.outerSize(); ++j)
    {
      const bool fixed = !held.empty() && held[j];
      if (fixed)
      {
        values[begin[j]] = mean > 0. ? mean : 1.;
        continue;
      }
      auto k = begin[j];
      for (Eigen::SparseMatrix<double>::InnerIterator c(C, j); c; ++c)
      {
        while (k < begin[j + 1] && rows[k] < c.row())
          ++k;
        if (k < begin[j + 1] && rows[k] == c.row())
          values[k] = c.value();
      }
    }
    return values;
  }

  void require_memory() const
  {
    if (!L_ || common_.status < CHOLMOD_OK)
      throw std::bad_alloc();
  }

  FactorMatrices                   matrices_;
  mutable cholmod_common           common_;
  cholmod_factor                  *L_ = nullptr;
  std::unique_ptr<StiffnessFactor> counting_;
};

} // namespace

std::unique_ptr<StiffnessFactor> cholmod_stiffness_factor(FactorMatrices matrices)
{
  return std::make_unique<CholmodFactor>(std::move(matrices));
}

} // namespace gestell::coupling
