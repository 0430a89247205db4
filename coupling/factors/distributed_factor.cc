#include "coupling/factors/distributed_factor.h"

#include "coupling/eigensolvers/slepc/mode_search.h"
#include "coupling/eigensolvers/slepc/registered_types.h"
#include "coupling/factors/mumps_factor.h"
#include "coupling/integration/system/convergence_failure.h"
#include "fem/parallel/petsc_session.h"
#include "fem/values/available_memory.h"

#include <petscksp.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr const char *solver_prefix = "reduction_st_"; // of the solver that options choose

bool has_option(const char *name)
{
  PetscBool given = PETSC_FALSE;
  PetscOptionsHasName(nullptr, matrix_prefix, name, &given);
  return given == PETSC_TRUE;
}

PetscOwned<Mat> dense_columns(MPI_Comm comm, int rows, int all_rows, Eigen::Ref<MatrixXd> X)
{
  Mat result = nullptr;
  require(MatCreateDense(comm, rows, PETSC_DECIDE, all_rows, int(X.cols()), X.data(), &result));
  return PetscOwned<Mat>(result);
}

/// Numbers in [-1, 1) by row of the frame, on any number of ranks the same.
VectorXd irregular(int first, int count)
{
  constexpr double golden = 0.6180339887498949;
  VectorXd         x(count);
  for (int i = 0; i < count; ++i)
    x(i) = 2. * std::fmod(golden * double(first + i + 1), 1.) - 1.;
  return x;
}

VectorXd diagonal_of(Mat A, int owned)
{
  Vec d = nullptr;
  require(MatCreateVecs(A, nullptr, &d));
  const PetscOwned<Vec> made(d);
  require(MatGetDiagonal(A, d));
  const PetscScalar *values = nullptr;
  VecGetArrayRead(d, &values);
  VectorXd result = VectorXd::Map(values, owned);
  VecRestoreArrayRead(d, &values);
  return result;
}

} // namespace

bool options_choose_solver()
{
  fem::petsc_session();
  char      name[64] = "";
  PetscBool given    = PETSC_FALSE;
  PetscOptionsGetString(nullptr, solver_prefix, "-pc_factor_mat_solver_type", name, sizeof name, &given);
  return (given && name != std::string(own_factor)) || has_option("-st_pc_type") || has_option("-st_ksp_type");
}

/// MUMPS, or the solver of PETSC_OPTIONS.
struct DistributedFactor::Solver
{
  PetscOwned<Mat> factor;
  PetscOwned<Mat> C; ///< of a chosen solver
  PetscOwned<KSP> chosen;

  bool make_chosen(MPI_Comm comm, PetscOwned<Mat> stiffness)
  {
    C       = std::move(stiffness);
    KSP ksp = nullptr;
    PC  pc  = nullptr;
    require(KSPCreate(comm, &ksp));
    chosen.reset(ksp);
    char      type[64] = "";
    PetscBool given    = PETSC_FALSE;
    PetscOptionsGetString(nullptr, solver_prefix, "-pc_type", type, sizeof type, &given);
    const bool direct = !given || type == std::string(PCCHOLESKY) || type == std::string(PCLU);
    require(KSPSetOperators(ksp, C.get(), C.get()));
    require(KSPSetOptionsPrefix(ksp, solver_prefix));
    require(KSPSetType(ksp, direct ? KSPPREONLY : KSPCG));
    constexpr double rounding = 1e-12; // relative residual: what a direct solver leaves, roughly
    constexpr int    most     = 10000; // iterations: conjugate gradients without a good preconditioner on thin plates
    require(KSPSetTolerances(ksp, rounding, PETSC_DEFAULT, PETSC_DEFAULT, most));
    require(KSPGetPC(ksp, &pc));
    require(PCSetType(pc, PCCHOLESKY));
    require(KSPSetFromOptions(ksp));
    require(KSPSetUp(ksp));
    PCFailedReason failed = PC_NOERROR; // of this rank
    require(PCGetFailedReason(pc, &failed));
    int any_failed = failed != PC_NOERROR;
    MPI_Allreduce(MPI_IN_PLACE, &any_failed, 1, MPI_INT, MPI_MAX, comm);
    return any_failed == 0;
  }

  /// F [all columns] -> X
  void solve(Mat F, Mat X) const
  {
    if (factor)
      return require(MatMatSolve(factor.get(), F, X));
    require(KSPMatSolve(chosen.get(), F, X));
    Mat product = nullptr;
    require(MatMatMult(C.get(), X, MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
    const PetscOwned<Mat> residual(product);
    require(MatAXPY(product, -1., F, SAME_NONZERO_PATTERN));
    PetscReal left = 0., load = 0.;
    MatNorm(product, NORM_FROBENIUS, &left);
    MatNorm(F, NORM_FROBENIUS, &load);
    // The residual of a direct solver is below eps times the condition, 1e9 for fine meshes.
    constexpr double largest_residual = 1e-6;
    if (!(left <= largest_residual * load))
      throw ConvergenceFailure("the solver of PETSC_OPTIONS leaves " + std::to_string(left / load) +
                               " of the load as residual, but at most 1e-6 is sufficient; add "
                               "-reduction_st_ksp_rtol 1e-12, choose a better preconditioner (-reduction_st_pc_type), "
                               "or remove the options that begin with -reduction_st");
  }
};

DistributedFactor::DistributedFactor(const fem::Ranks &ranks, const FactorMatrices &on_first)
    : ranks_(ranks), on_first_(on_first), available_(ranks.first() ? on_first.available : fem::available_memory()),
      rows_(ranks, ranks.first() ? &on_first.stiffness() : nullptr, on_first.held)
{
  fem::petsc_session();
  const auto take = [&](Eigen::SparseMatrix<double> *from, PetscOwned<Mat> &to)
  {
    bool given = from != nullptr;
    ranks.broadcast(given);
    if (!given)
      return;
    to = rows_.distributed(from);
    if (from)
      Eigen::SparseMatrix<double>(from->rows(), from->cols()).swap(*from);
  };
  take(on_first.given_C, given_C_);
  take(on_first.given_M, given_M_);
  put_away(given_M_, stored_M_);
}

/// Rows for which several ranks have no use until they are loaded.
void DistributedFactor::put_away(PetscOwned<Mat> &rows, StoredRows &stored) const
{
  if (rows && ranks_.size() > 1 && (stored = rows_.stored(rows.get())))
    rows.reset();
}

namespace
{

PetscOwned<Mat> shared(Mat A)
{
  PetscObjectReference(PetscObject(A));
  return PetscOwned<Mat>(A);
}

} // namespace

PetscOwned<Mat> DistributedFactor::stiffness() const
{
  return stored_C_ ? rows_.loaded(stored_C_) : given_C_ ? shared(given_C_.get()) : rows_.distributed(on_first_.C);
}

PetscOwned<Mat> DistributedFactor::mass() const
{
  return stored_M_ ? rows_.loaded(stored_M_) : given_M_ ? shared(given_M_.get()) : rows_.distributed(on_first_.M);
}

DistributedFactor::~DistributedFactor() = default;

bool DistributedFactor::factorise()
{
  if (solver_ || rows_.size() == 0)
    return true;
  const QuietPetsc quiet;
  auto             C        = stiffness();
  const VectorXd   D        = diagonal_of(C.get(), rows_.owned());
  auto             solver   = std::make_unique<Solver>();
  bool             definite = true;
  if (options_choose_solver())
    definite = solver->make_chosen(ranks_.comm(), std::move(C));
  else
  {
    solver->factor = mumps_factor(ranks_, C.get(), true, available_);
    definite       = solver->factor != nullptr;
  }
  if (!definite)
    return false;
  solver_     = std::move(solver);
  regularity_ = regularity_of(D);
  return regularity_ > 0.; // LU and iterative solvers accept an indefinite matrix
}

void DistributedFactor::release()
{
  solver_.reset();
}

void DistributedFactor::solve(Eigen::Ref<MatrixXd> X) const
{
  if (rows_.size() == 0 || X.cols() == 0)
    return;
  if (!solver_)
    throw std::logic_error("DistributedFactor: call factorise() first");
  const QuietPetsc quiet;
  MatrixXd         F = X, result(X.rows(), X.cols());
  const auto       f = dense_columns(ranks_.comm(), rows_.owned(), rows_.size(), F);
  const auto       x = dense_columns(ranks_.comm(), rows_.owned(), rows_.size(), result);
  solver_->solve(f.get(), x.get());
  X = result;
}

void DistributedFactor::solve_on_first(Eigen::Ref<MatrixXd> X) const
{
  int columns = int(X.cols());
  ranks_.broadcast(columns);
  constexpr int at_once = 16; // right-hand sides: more take no less time each
  for (int first = 0; first < columns; first += at_once)
  {
    const int width = std::min(at_once, columns - first);
    MatrixXd  none(0, width);
    auto      part = [&]() -> Eigen::Ref<MatrixXd>
    { return ranks_.first() ? Eigen::Ref<MatrixXd>(X.middleCols(first, width)) : Eigen::Ref<MatrixXd>(none); };
    MatrixXd rows = rows_.deal_out(part(), width);
    solve(rows);
    rows_.collect(rows, part());
  }
}

double DistributedFactor::regularity_of(const VectorXd &D) const
{
  VectorXd x        = irregular(rows_.first(), rows_.owned());
  double   quotient = 0.;
  for (int round = 0; round < 2; ++round) // of inverse iteration, which makes motions with little stiffness prevail
  {
    const VectorXd f = D.cwiseProduct(x);
    MatrixXd       y = f;
    solve(y);
    double sums[] = {y.col(0).dot(f), y.col(0).dot(D.cwiseProduct(y.col(0)))}; // y^T C y, y^T D y
    ranks_.sum(sums, 2);
    quotient = sums[0] / sums[1];
    x        = y / std::sqrt(sums[1]);
  }
  return quotient;
}

Inertia DistributedFactor::inertia(double sigma) const
{
  if (rows_.size() == 0)
    return {};
  const QuietPetsc quiet;
  auto             A = stiffness(); // C - sigma M
  if (given_C_)
  {
    Mat copy = nullptr;
    require(MatDuplicate(given_C_.get(), MAT_COPY_VALUES, &copy));
    A.reset(copy);
  }
  const VectorXd D = diagonal_of(A.get(), rows_.owned());
  require(MatAXPY(A.get(), -sigma, mass().get(), DIFFERENT_NONZERO_PATTERN));
  const auto factor   = mumps_factor(ranks_, A.get(), false, available_);
  PetscInt   negative = 0, zero = 0, positive = 0;
  require(MatGetInertia(factor.get(), &negative, &zero, &positive));

  // |D^-1/2 r| / |D^1/2 x| of a solution, D = diag(C): a lower bound of |D^-1/2 E D^-1/2|, of which random loads reach
  // most
  MatrixXd   b = irregular(rows_.first(), rows_.owned()).cwiseProduct(D.cwiseSqrt()), x(b.rows(), 1);
  const auto f = dense_columns(ranks_.comm(), rows_.owned(), rows_.size(), b);
  const auto y = dense_columns(ranks_.comm(), rows_.owned(), rows_.size(), x);
  require(MatMatSolve(factor.get(), f.get(), y.get()));
  Mat product = nullptr;
  require(MatMatMult(A.get(), y.get(), MAT_INITIAL_MATRIX, PETSC_DEFAULT, &product));
  const PetscOwned<Mat> made(product);
  require(MatAXPY(product, -1., f.get(), SAME_NONZERO_PATTERN));
  const PetscScalar *residual = nullptr;
  MatDenseGetArrayRead(product, &residual);
  const VectorXd r = VectorXd::Map(residual, rows_.owned());
  MatDenseRestoreArrayRead(product, &residual);
  double sums[] = {(r.array().square() / D.array()).sum(), (x.col(0).array().square() * D.array()).sum()};
  ranks_.sum(sums, 2);
  const double growth = std::sqrt(sums[0] / sums[1]) / std::numeric_limits<double>::epsilon();
  return {int(negative), zero > 0 || !std::isfinite(growth) ? INFINITY : std::max(1., growth)};
}

namespace
{

class InverseOnRanks final : public InverseStiffness
{
public:
  InverseOnRanks(const DistributedFactor &factor, const fem::Ranks &ranks, const LocalRows &rows, int size)
      : factor_(factor), ranks_(ranks), rows_(rows), size_(size), order_(rows.count())
  {
    for (int i = 0; i < rows.count(); ++i)
      order_[i] = i;
  }

  void solve_in_place(MultiVector &X) const override
  {
    for (int p = 0; p < X.n_panels(); ++p)
      rows_.add_up(X.panel(p), X.lanes());
    MatrixXd columns(rows_.owned(), X.columns());
    for (int j = 0; j < X.columns(); ++j)
      for (int i = 0; i < rows_.owned(); ++i)
        columns(i, j) = X(i, j);
    factor_.solve(columns);
    for (int j = 0; j < X.columns(); ++j)
      for (int i = 0; i < rows_.owned(); ++i)
        X(i, j) = columns(i, j);
    for (int p = 0; p < X.n_panels(); ++p)
      rows_.complete(X.panel(p), X.lanes());
  }

  const std::vector<int> &order() const override { return order_; }
  const std::vector<int> &held() const override { return none_; }
  int                     size() const override { return size_; }
  int                     owned() const override { return rows_.owned(); }
  int                     place(int row) const override { return rows_.row_of(row); }

  void complete(MatrixXd &X) const override
  {
    RowMajor by_rows = X;
    rows_.complete(by_rows.data(), int(X.cols()));
    X = by_rows;
  }
  void add_up(MatrixXd &X) const override
  {
    RowMajor by_rows = X;
    rows_.add_up(by_rows.data(), int(X.cols()));
    X = by_rows;
  }
  void sum(MatrixXd &X) const override { ranks_.sum(X.data(), X.size()); }
  void share(MatrixXd &X) const override { ranks_.broadcast(X.data(), X.size()); }

private:
  using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  const DistributedFactor &factor_;
  const fem::Ranks        &ranks_;
  const LocalRows         &rows_;
  int                      size_;
  std::vector<int>         order_, none_;
};

/// The search of this rank, with its part of the matrices.
class SearchOnRanks final : public ModeSearch
{
public:
  LocalRows                       rows;
  fem::SparseMatrix               M{}, C{};
  std::shared_ptr<InverseOnRanks> inverse{};
  std::unique_ptr<ModeSearch>     modes_of_rows{};

  explicit SearchOnRanks(LocalRows rows) : rows(std::move(rows)) {}
  void        find(int count) override { modes_of_rows->find(count); }
  LowestModes modes(int count) const override { return modes_of_rows->modes(count); }
  Gap         gap_above(int count) const override { return modes_of_rows->gap_above(count); }
};

} // namespace

std::unique_ptr<ModeSearch> DistributedFactor::search(const std::string           &eigensolver,
                                                      const BlockLanczos::Options &options,
                                                      const LowestModes           *known_on_first)
{
  const bool with_C = eigensolver != "block-lanczos" || has_option("-eps_type");
  put_away(given_C_, stored_C_); // the space of the search takes its place
  auto             M = mass(), C = with_C ? stiffness() : PetscOwned<Mat>();
  std::vector<Mat> matrices{M.get()};
  if (C)
    matrices.push_back(C.get());
  auto found     = std::make_unique<SearchOnRanks>(LocalRows(rows_, matrices));
  found->inverse = std::make_shared<InverseOnRanks>(*this, ranks_, found->rows, rows_.size());
  found->M       = found->rows.part_of(M.get());
  M.reset();
  if (C)
    found->C = found->rows.part_of(C.get());

  int count = known_on_first ? int(known_on_first->omega.size()) : 0;
  ranks_.broadcast(count);
  LowestModes known{VectorXd(count), MatrixXd::Zero(found->rows.count(), count), VectorXd::Zero(count)};
  if (count > 0)
  {
    const MatrixXd none(0, count);
    if (known_on_first)
      known.omega = known_on_first->omega;
    if (known_on_first && known_on_first->bound.size() == count)
      known.bound = known_on_first->bound;
    ranks_.broadcast(known.omega.data(), count);
    ranks_.broadcast(known.bound.data(), count);
    known.V.topRows(rows_.owned()) = rows_.deal_out(known_on_first ? known_on_first->V : none, count);
    found->inverse->complete(known.V);
  }
  found->modes_of_rows =
      search_modes(ranks_.comm(), {found->inverse, &found->M, found->C.size() > 0 ? &found->C : nullptr}, eigensolver,
                   options, known);
  return found;
}

void DistributedFactor::add_product_on_first(Given which, const Eigen::Ref<const MatrixXd> &X,
                                             Eigen::Ref<MatrixXd> Y) const
{
  int columns = int(X.cols());
  ranks_.broadcast(columns);
  const auto      A = given(which);
  const LocalRows local(rows_, {A.get()});
  constexpr int   at_once = 16; // columns: more would take memory
  for (int first = 0; first < columns; first += at_once)
  {
    const int  width = std::min(at_once, columns - first);
    const auto from = ranks_.first() ? first : 0, taken = ranks_.first() ? width : 0;
    MatrixXd   sum = rows_.deal_out(Y.middleCols(from, taken), width);
    local.add_product(A.get(), rows_.deal_out(X.middleCols(from, taken), width), sum);
    rows_.collect(sum, Y.middleCols(from, taken));
  }
}

LowestModes DistributedFactor::on_first(LowestModes own) const
{
  MatrixXd V(ranks_.first() ? rows_.coordinates() : 0, own.V.cols());
  rows_.collect(own.V.topRows(rows_.owned()), V);
  own.V = std::move(V);
  return own;
}

} // namespace gestell::coupling
