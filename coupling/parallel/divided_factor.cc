#include "coupling/parallel/divided_factor.h"

#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/parallel/matrix_parts.h"
#include "fem/mesh/memory_estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using SparseMatrix = Eigen::SparseMatrix<double>;

std::vector<int> counted(int n)
{
  std::vector<int> all(n);
  std::iota(all.begin(), all.end(), 0);
  return all;
}

/// The pattern of C, or of both where M joins coordinates that C does not.
SparseCholesky analysis(const MatricesOnFirst &matrices)
{
  if (!matrices.M || contains(*matrices.C, *matrices.M))
    return SparseCholesky::without_numbers(*matrices.C, matrices.held);
  SparseMatrix both = *matrices.C + *matrices.M;
  both.makeCompressed();
  return SparseCholesky::without_numbers(both, matrices.held);
}

} // namespace

/// Contributions of the shares to the top.
struct DividedFactor::Passing
{
  const DividedFactor             &factor;
  std::vector<std::vector<double>> made = {}; // here
  std::size_t                      next = 0;  // next contribution of rank 0 itself

  Border of_share()
  {
    return {{},
            [this](int front, const double *contribution)
            {
              const Fronts         f    = factor.own_.fronts();
              const std::ptrdiff_t rows = f.begin[front + 1] - f.begin[front] - (f.first[front + 1] - f.first[front]);
              made.emplace_back(contribution, contribution + rows * rows);
            }};
  }
  /// Rank 0 keeps its own.
  void send() const
  {
    for (std::size_t k = 0; !factor.ranks_.first() && k < made.size(); ++k)
      factor.ranks_.send(made[k].data(), std::ptrdiff_t(made[k].size()), 0);
  }
  /// Rank 0: the fronts without columns come in the order in which each rank made what they pass on.
  Border of_top()
  {
    std::vector<int> giver_of_front;
    const Fronts     f = factor.top_.fronts();
    for (int s = 0, k = 0; s < f.count; ++s)
      giver_of_front.push_back(f.first[s + 1] > f.first[s] ? 0 : factor.givers_[k++]);
    return {[this, f, giver_of_front](int front, double *to)
            {
              const std::ptrdiff_t rows = f.begin[front + 1] - f.begin[front];
              if (giver_of_front[front] > 0)
                return factor.ranks_.receive(to, rows * rows, giver_of_front[front]);
              std::copy(made[next].begin(), made[next].end(), to);
              made[next++] = {};
            },
            {}};
  }
};

DividedFactor::DividedFactor(const fem::Ranks &ranks, const MatricesOnFirst &on_first)
    : ranks_(ranks), on_first_(on_first)
{
  if (on_first_.given_C)
    on_first_.C = on_first_.given_C;
  std::unique_ptr<const SparseCholesky> whole;
  std::unique_ptr<const FrontDivision>  division;
  ranks_.agree(
      [&]
      {
        if (!ranks_.first())
          return;
        whole    = std::make_unique<const SparseCholesky>(analysis(on_first_));
        division = std::make_unique<const FrontDivision>(whole->fronts(), ranks_.size());
        n_       = int(on_first_.C->rows());
        typical_ = std::max(on_first_.C->diagonal().cwiseAbs().mean(), 1e-300);
      });
  ranks_.broadcast(n_);
  ranks_.broadcast(typical_);
  if (ranks_.first())
    divide(*division);
  else
    receive_share();
}

void DividedFactor::divide(const FrontDivision &division)
{
  for (int rank = 0; rank < ranks_.size(); ++rank)
  {
    const FrontSelection share = division.share(rank);
    columns_of_.emplace_back(share.order.begin(), share.order.begin() + share.columns());
  }
  held_marks_.assign(n_, 0);
  for (const int i : on_first_.held)
    held_marks_[i] = 1;
  for (int rank = 1; rank < ranks_.size(); ++rank)
    send_share(division, rank);
  keep_share(division);
}

namespace
{

std::vector<int> held_rows(const FrontSelection &share, const std::vector<char> &marks)
{
  std::vector<int> rows;
  for (int k = 0; k < int(share.order.size()); ++k)
    if (marks[share.order[k]])
      rows.push_back(k);
  return rows;
}

} // namespace

void DividedFactor::send_share(const FrontDivision &division, int rank)
{
  const FrontSelection   share = division.share(rank);
  const std::vector<int> held  = held_rows(share, held_marks_);
  for (const std::vector<int> *list : {&share.first, &share.begin, &share.rows, &share.places, &held})
    ranks_.send(*list, rank);
  send(ranks_, lower_part(*on_first_.C, share.order, share.columns()), rank);
  send(ranks_,
       on_first_.M ? additive_part(*on_first_.M, share.order, share.columns(), false) : SparseMatrix(n_rows(), 0),
       rank);
}

void DividedFactor::keep_share(const FrontDivision &division)
{
  own_         = division.share(0);
  top_         = division.top();
  givers_      = division.givers();
  coordinates_ = own_.order;
  held_        = held_rows(own_, held_marks_);
  if (!on_first_.given_C)
    return;
  C_ = lower_part(*on_first_.C, coordinates_, n_rows());
  SparseMatrix none;
  none.swap(*on_first_.given_C);
  own_.order = counted(n_rows());
  top_.order.assign(own_.order.begin() + n_own(), own_.order.end());
  mark_held_rows();
}

fem::SparseMatrix DividedFactor::own_M() const
{
  if (!ranks_.first())
    return M_;
  return additive_part(*on_first_.M, coordinates_, n_own(), true);
}

fem::SparseMatrix DividedFactor::own_C() const
{
  if (ranks_.first())
    return additive_part(*on_first_.C, coordinates_, n_own(), true);
  SparseMatrix lower(n_rows(), n_rows());
  lower.leftCols(n_own()) = C_.leftCols(n_own()); // without the diagonal of the border
  SparseMatrix full       = lower.selfadjointView<Eigen::Lower>();
  full.makeCompressed();
  return full;
}

/// Marks the rows of this rank in the eliminated matrix.
void DividedFactor::mark_held_rows()
{
  held_marks_.assign(n_rows(), 0);
  for (const int k : held_)
    held_marks_[k] = 1;
}

void DividedFactor::receive_share()
{
  for (std::vector<int> *list : {&own_.first, &own_.begin, &own_.rows, &own_.places, &held_})
    *list = ranks_.receive<int>(0);
  C_         = receive_matrix(ranks_);
  M_         = receive_matrix(ranks_);
  own_.order = counted(int(C_.rows()));
  mark_held_rows();
}

/// The matrix C - sigma M: by coordinates where rank 0 has it as a whole, otherwise by rows.
HeldMatrix DividedFactor::matrix(double sigma) const
{
  const bool          whole = ranks_.first() && !on_first_.given_C;
  const SparseMatrix &M     = whole && on_first_.M ? *on_first_.M : M_;
  return {whole ? *on_first_.C : C_, sigma != 0. ? &M : nullptr, sigma, held_marks_, typical_};
}

/// Rank 0: of a place in the matrix of a rank.
int DividedFactor::coordinate_of(int rank, int place) const
{
  if (rank > 0)
    return columns_of_[rank][place];
  return on_first_.given_C ? coordinates_[place] : place;
}

/// The coordinate that a rank names by its place, on rank 0; -1 on all if none names one.
int DividedFactor::told_to_first(int place) const
{
  std::vector<double> places(ranks_.size(), 0.);
  places[ranks_.rank()] = place + 1.;
  ranks_.sum(places.data(), ranks_.size());
  for (int rank = 0; rank < ranks_.size(); ++rank)
    if (const int found = int(places[rank]) - 1; found >= 0)
      return ranks_.first() ? coordinate_of(rank, found) : found;
  return -1;
}

/// Memory for L and the work on it.
void DividedFactor::reserve()
{
  L_     = TiledPanels(own_.fronts());
  L_top_ = TiledPanels(top_.fronts());
  const double needed =
      sizeof(double) * (double(L_.size()) + double(L_top_.size()) + double(multifrontal_workspace(own_.fronts())));
  if (const double available = fem::available_memory(); needed > available)
    throw NotEnoughMemory(needed, available);
  L_.reserve();
  L_top_.reserve();
}

namespace
{

/// Computes and stores the factor of some fronts.
/// @returns -1, or the coordinate of a pivot that is not a positive number.
int factor_into(TiledPanels &L, const Fronts &fronts, const HeldMatrix &A, const Border &border)
{
  int failed = multifrontal_cholesky(
      fronts, A, [&](int s, const double *panel) { L.put(s, panel); }, border);
  if (failed < 0)
    L.for_each_pivot([&](int column, double pivot) { failed = std::isfinite(pivot) ? failed : fronts.order[column]; });
  return failed;
}

} // namespace

int DividedFactor::factorise()
{
  if (factored_)
    return -1;
  const HeldMatrix A = matrix(0.);
  Passing          passing{*this};
  int              failed = -1;
  ranks_.agree(
      [&]
      {
        reserve();
        failed = factor_into(L_, own_.fronts(), A, passing.of_share());
      });
  failed = told_to_first(failed);
  if (failed < 0)
  {
    passing.send();
    if (ranks_.first())
      failed = factor_into(L_top_, top_.fronts(), A, passing.of_top());
    failed = told_to_first(failed);
  }
  factored_ = failed < 0;
  if (!factored_)
    release();
  return failed;
}

void DividedFactor::release()
{
  L_.release();
  L_top_.release();
  factored_ = false;
}

double DividedFactor::pivot_ratio() const
{
  double     smallest = INFINITY, largest = 0.;
  const auto look = [&](int, double pivot)
  { smallest = std::min(smallest, pivot), largest = std::max(largest, pivot); };
  L_.for_each_pivot(look);
  L_top_.for_each_pivot(look);
  std::vector<double> all(2 * ranks_.size(), 0.);
  all[2 * ranks_.rank()]     = smallest;
  all[2 * ranks_.rank() + 1] = largest;
  ranks_.sum(all.data(), std::ptrdiff_t(all.size()));
  for (int rank = 0; rank < ranks_.size(); ++rank)
    smallest = std::min(smallest, all[2 * rank]), largest = std::max(largest, all[2 * rank + 1]);
  return largest > 0. ? std::pow(smallest / largest, 2) : 1.;
}

void DividedFactor::solve_in_place(MultiVector &X) const
{
  const TriangularSolve &sweeps = block_triangular_solve(X.lanes());
  const TiledFactor      own = L_.tiles(), top = L_top_.tiles();
  const std::ptrdiff_t   numbers = std::ptrdiff_t(n_border()) * X.lanes();
  for (int p = 0; p < X.n_panels(); ++p)
  {
    double *const border = X.panel(p) + std::ptrdiff_t(own_.columns()) * X.lanes();
    sweeps.forward(own, X.panel(p));
    ranks_.sum_on_first(border, numbers);
    if (ranks_.first())
    {
      sweeps.forward(top, border);
      sweeps.backward(top, border);
    }
    ranks_.broadcast(border, numbers);
    sweeps.backward(own, X.panel(p));
  }
}

void DividedFactor::solve_on_first(Eigen::Ref<MatrixXd> X) const
{
  for (const int i : on_first_.held)
    X.row(i).setZero();
  int columns = int(X.cols());
  ranks_.broadcast(columns);
  const std::vector<int> all         = counted(n_rows());
  constexpr int          block_width = 16; // right-hand sides that are dealt out together
  for (int first = 0; first < columns; first += block_width)
  {
    const int width = std::min(block_width, columns - first);
    MatrixXd  rows(n_rows(), width), none(0, width);
    if (ranks_.first())
      deal_out(X.middleCols(first, width), rows);
    else
    {
      deal_out(none, rows);
      rows.bottomRows(n_border()).setZero(); // loads add up
    }
    MultiVector block(n_rows(), width);
    block.take(rows, all);
    solve_in_place(block);
    block.give(rows, all);
    if (ranks_.first())
      collect(rows, X.middleCols(first, width));
    else
      collect(rows, none);
  }
}

Inertia DividedFactor::inertia(double sigma) const
{
  const HeldMatrix A = matrix(sigma);
  Passing          passing{*this};
  Inertia          own, top;
  ranks_.agree([&] { own = multifrontal_inertia(own_.fronts(), A, passing.of_share()); });
  passing.send();
  if (ranks_.first())
    top = multifrontal_inertia(top_.fronts(), A, passing.of_top());
  double sums[] = {double(own.negative + top.negative), own.growth - 1. + top.growth - 1.};
  ranks_.sum(sums, 2);
  return {int(sums[0]), 1. + sums[1]};
}

void DividedFactor::deal_out(const Eigen::Ref<const MatrixXd> &X, MatrixXd &rows) const
{
  for (int rank = 1; ranks_.first() && rank < ranks_.size(); ++rank)
  {
    const MatrixXd theirs = X(columns_of_[rank], Eigen::all);
    ranks_.send(theirs.data(), theirs.size(), rank);
  }
  MatrixXd own(own_.columns(), rows.cols()), border(n_border(), rows.cols());
  if (ranks_.first())
  {
    rows   = X(coordinates_, Eigen::all);
    border = rows.bottomRows(n_border());
  }
  else
  {
    ranks_.receive(own.data(), own.size(), 0);
    rows.topRows(own.rows()) = own;
  }
  ranks_.broadcast(border.data(), border.size());
  rows.bottomRows(n_border()) = border;
}

void DividedFactor::collect(const MatrixXd &rows, Eigen::Ref<MatrixXd> X) const
{
  if (!ranks_.first())
  {
    const MatrixXd own = rows.topRows(own_.columns());
    return ranks_.send(own.data(), own.size(), 0);
  }
  X(coordinates_, Eigen::all) = rows;
  for (int rank = 1; rank < ranks_.size(); ++rank)
  {
    MatrixXd theirs(columns_of_[rank].size(), rows.cols());
    ranks_.receive(theirs.data(), theirs.size(), rank);
    X(columns_of_[rank], Eigen::all) = theirs;
  }
}

InverseOnRanks::InverseOnRanks(const DividedFactor &factor) : factor_(factor), order_(counted(factor.n_rows())) {}

/// The border is rank 0's.
int InverseOnRanks::owned() const
{
  return factor_.ranks().first() ? factor_.n_rows() : factor_.n_own();
}

void InverseOnRanks::complete(MatrixXd &X) const
{
  MatrixXd border = X.bottomRows(X.rows() - factor_.n_own());
  factor_.ranks().broadcast(border.data(), border.size());
  X.bottomRows(border.rows()) = border;
}

void InverseOnRanks::add_up(MatrixXd &X) const
{
  MatrixXd border = X.bottomRows(X.rows() - factor_.n_own());
  factor_.ranks().sum_on_first(border.data(), border.size());
  X.bottomRows(border.rows()) = border;
}

void InverseOnRanks::sum(MatrixXd &X) const
{
  factor_.ranks().sum(X.data(), X.size());
}

void InverseOnRanks::share(MatrixXd &X) const
{
  factor_.ranks().broadcast(X.data(), X.size());
}

} // namespace gestell::coupling
