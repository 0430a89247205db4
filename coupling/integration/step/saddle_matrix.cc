#include "coupling/integration/step/saddle_matrix.h"

#include <suitesparse/camd.h>
#include <suitesparse/klu.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gestell::coupling
{

namespace
{
using Sparse   = Eigen::SparseMatrix<double>;
using Triplets = std::vector<Eigen::Triplet<double>>;

template <typename Use>
void for_column(const Sparse &W, int column, const Use &use)
{
  for (Sparse::InnerIterator it(W, column); it; ++it)
    use(int(it.row()), it.value());
}

} // namespace

/// KLU's objects with their lifetime.
struct SaddleMatrix::Factor
{
  Factor()
  {
    klu_defaults(&common);
    common.btf   = 0;  // one block: a mechanism of several parts needs no special case
    common.scale = -1; // see scale()
    // least ratio of a diagonal pivot to the largest entry of its column: less fill, at a loss of up to four digits
    constexpr double pivot_preference = 1e-4;
    common.tol                        = pivot_preference;
  }
  ~Factor() { clear(); }
  Factor(const Factor &)            = delete;
  Factor &operator=(const Factor &) = delete;

  void clear()
  {
    if (numeric)
      klu_free_numeric(&numeric, &common);
    if (symbolic)
      klu_free_symbolic(&symbolic, &common);
  }

  klu_common    common;
  klu_symbolic *symbolic = nullptr;
  klu_numeric  *numeric  = nullptr;
};

SaddleMatrix::SaddleMatrix(const SecondOrderSystem &system)
    : system_(system), n_(system.linear().size()), n_c_(system.joints().n_rows()), weights_(Eigen::VectorXd::Zero(4)),
      factor_(std::make_unique<Factor>())
{
  collect_base(system);
  analyse();
}

SaddleMatrix::~SaddleMatrix() = default;

std::unique_ptr<SaddleMatrix> SaddleMatrix::for_joints(const SecondOrderSystem &system, JointSolver solver)
{
  const double n_u = double(system.forces().directions().cols()), n_c = system.joints().n_rows();
  if (n_c == 0 || solver == JointSolver::condensed)
    return nullptr;
  if (solver == JointSolver::sparse)
    return std::make_unique<SaddleMatrix>(system);
  try
  {
    auto sparse = std::make_unique<SaddleMatrix>(system);
    // S G^T, its triangular solves, G S G^T and the factor of that.
    const double     condensed = n_u * n_u * n_c + n_c * n_c * n_c / 3.;
    constexpr double per_fill  = 8.; // time of a multiplication with indices against one in a dense row
    return per_fill * sparse->work() < condensed ? std::move(sparse) : nullptr;
  }
  catch (const std::invalid_argument &)
  {
    return nullptr;
  }
}

/// M, B, C on one pattern, the diagonal included.
void SaddleMatrix::collect_base(const SecondOrderSystem &system)
{
  Sparse M, B, C;
  if (!system.linear().sparse_matrices(M, B, C))
    throw std::invalid_argument(
        "the joints of this machine are solved condensed to the measures only: its frame hands out "
        "no matrices that could be factorised in every step");
  Triplets all;
  for (const Sparse *part : {&M, &B, &C})
    for (int j = 0; j < n_; ++j)
      for_column(*part, j, [&](int i, double) { all.emplace_back(i, j, 0.); });
  for (int i = 0; i < n_; ++i)
    all.emplace_back(i, i, 0.);
  A_.resize(n_, n_);
  A_.setFromTriplets(all.begin(), all.end());
  A_.makeCompressed();
  const Sparse *const parts[]   = {&M, &B, &C};
  Eigen::VectorXd    *entries[] = {&M_, &B_, &C_};
  for (int k = 0; k < 3; ++k)
  {
    entries[k]->setZero(A_.nonZeros());
    for (int j = 0; j < n_; ++j)
      for_column(*parts[k], j,
                 [&](int i, double value)
                 {
                   const int *first = A_.innerIndexPtr() + A_.outerIndexPtr()[j];
                   const int *last  = A_.innerIndexPtr() + A_.outerIndexPtr()[j + 1];
                   (*entries[k])[std::lower_bound(first, last, i) - A_.innerIndexPtr()] = value;
                 });
  }
}

int SaddleMatrix::position(int row, int column) const
{
  const int *rows = pattern_.innerIndexPtr(), *begin = pattern_.outerIndexPtr();
  return int(std::lower_bound(rows + begin[column], rows + begin[column + 1], row) - rows);
}

/// Finds the position in K of every entry of A, p' and G.
void SaddleMatrix::analyse()
{
  const std::vector<Place> base = places_of_base(), tangent = places_of_tangent(), held = places_of_held();
  std::vector<Place>       action, motion;
  places_of_joints(action, motion);

  const int N = n_ + n_c_ + int(held_.size());
  Triplets  all;
  for (const std::vector<Place> *places : {&base, &tangent, &std::as_const(action), &std::as_const(motion), &held})
    for (const Place &place : *places)
      all.emplace_back(place.row, place.column, 0.);
  pattern_.resize(N, N);
  pattern_.setFromTriplets(all.begin(), all.end());
  pattern_.makeCompressed();
  of_A_.clear();
  for (const Place &place : base)
    of_A_.push_back(position(place.row, place.column));
  of_tangent_ = scattered(tangent);
  of_action_  = scattered(action);
  of_motion_  = scattered(motion);
  of_held_    = scattered(held);
  scale_.setOnes(N);
  order();
}

std::vector<SaddleMatrix::Place> SaddleMatrix::places_of_base() const
{
  std::vector<Place> places;
  for (int j = 0, k = 0; j < n_; ++j)
    for_column(A_, j, [&](int i, double) { places.push_back({k++, i, j, 1.}); });
  return places;
}

/// W p' W^T.
std::vector<SaddleMatrix::Place> SaddleMatrix::places_of_tangent() const
{
  const Sparse      &W = system_.forces().directions();
  std::vector<Place> places;
  int                first = 0;
  for (const ForceBlock &block : system_.forces().blocks())
  {
    const int k = block.n_measures;
    for (int b = 0; b < k; ++b)
      for (int a = 0; a < k; ++a)
        for_column(W, block.first_measure + a,
                   [&](int i, double w_i)
                   {
                     for_column(W, block.first_measure + b,
                                [&](int j, double w_j) {
                                  places.push_back({first + a + k * b, i, j, w_i * w_j});
                                });
                   });
    first += k * k;
  }
  return places;
}

/// action: -W G^T, motion: G W^T.
void SaddleMatrix::places_of_joints(std::vector<Place> &action, std::vector<Place> &motion) const
{
  int first = 0;
  for (const ConstraintBlock &block : system_.joints().blocks())
  {
    for (int k = 0; k < block.n_measures; ++k)
      for (int r = 0; r < block.n_rows; ++r)
        for_column(system_.forces().directions(), block.first_measure + k,
                   [&](int i, double w)
                   {
                     const int value = first + r + block.n_rows * k, row = n_ + block.first_row + r;
                     action.push_back({value, i, row, -w});
                     motion.push_back({value, row, i, w});
                   });
    first += block.n_rows * block.n_measures;
  }
}

std::vector<SaddleMatrix::Place> SaddleMatrix::places_of_held() const
{
  std::vector<Place> places;
  for (std::size_t h = 0; h < held_.size(); ++h)
    for_column(system_.forces().directions(), held_[h],
               [&](int i, double w)
               {
                 const int row = n_ + n_c_ + int(h);
                 places.push_back({0, i, row, -w});
                 places.push_back({0, row, i, w});
               });
  return places;
}

std::vector<SaddleMatrix::Scattered> SaddleMatrix::scattered(const std::vector<Place> &places) const
{
  std::vector<Scattered> scattered;
  for (const Place &place : places)
    scattered.push_back({place.value, position(place.row, place.column), place.weight});
  return scattered;
}

/// Order: motions, equations, motions with many equations, equations that involve only these; in each set little fill.
void SaddleMatrix::order()
{
  const int       *begin = pattern_.outerIndexPtr(), *rows = pattern_.innerIndexPtr();
  const int        N = size();
  std::vector<int> set(N, 0);
  constexpr int    many_equations = 24; // on one coordinate: it is eliminated after them
  for (int j = 0; j < n_; ++j)
    if (std::count_if(rows + begin[j], rows + begin[j + 1], [this](int i) { return i >= n_; }) > many_equations)
      set[j] = 2;
  for (int j = n_; j < N; ++j)
    set[j] = std::any_of(rows + begin[j], rows + begin[j + 1], [&](int i) { return set[i] == 0; }) ? 1 : 3;
  order_.resize(N);
  double           facts[CAMD_INFO];
  std::vector<int> sets = set; // consecutive numbers are required
  std::vector<int> used = set;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (int &s : sets)
    s = int(std::lower_bound(used.begin(), used.end(), s) - used.begin());
  if (camd_order(N, begin, rows, order_.data(), nullptr, facts, sets.data()) < CAMD_OK)
    throw std::runtime_error("SaddleMatrix: no order of elimination was found");
  work_ = facts[CAMD_NMULTSUBS_LU];
  factor_->clear();
  factorised_       = false;
  factor_->symbolic = klu_analyze_given(N, pattern_.outerIndexPtr(), pattern_.innerIndexPtr(), order_.data(),
                                        order_.data(), &factor_->common);
  if (!factor_->symbolic)
    throw std::runtime_error("SaddleMatrix: KLU refuses the matrix");
}

void SaddleMatrix::hold(const std::vector<HeldMeasure> &held)
{
  const bool same =
      held.size() == held_.size() && std::equal(held.begin(), held.end(), held_.begin(),
                                                [](const HeldMeasure &h, int measure) { return h.measure == measure; });
  if (same)
    return;
  held_.clear();
  for (const HeldMeasure &h : held)
    held_.push_back(h.measure);
  analyse();
}

void SaddleMatrix::set_weights(double w_M, double w_B, double w_C, double f)
{
  const Eigen::Vector4d weights(w_M, w_B, w_C, f);
  if (weights_ == weights)
    return;
  weights_                                                  = weights;
  Eigen::Map<Eigen::VectorXd>(A_.valuePtr(), A_.nonZeros()) = w_M * M_ + w_B * B_ + w_C * C_;
  if (w_B == 0. && w_C == 0.) // M alone has no entries for virtual coordinates: they are fixed
    for (const int i : system_.linear().virtual_coordinates())
      A_.coeffRef(i, i) = w_M;
  factorised_ = false;
}

void SaddleMatrix::fill(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  double *K = pattern_.valuePtr();
  std::fill_n(K, pattern_.nonZeros(), 0.);
  for (std::size_t k = 0; k < of_A_.size(); ++k)
    K[of_A_[k]] = A_.valuePtr()[k];
  for (const Scattered &s : of_tangent_)
    K[s.position] -= weights_[3] * s.weight * tangent[s.value];
  for (const auto *part : {&of_action_, &of_motion_})
    for (const Scattered &s : *part)
      K[s.position] += s.weight * G.values()[s.value];
  for (const Scattered &s : of_held_)
    K[s.position] += s.weight;
}

void SaddleMatrix::scale()
{
  double    *K     = pattern_.valuePtr();
  const int *begin = pattern_.outerIndexPtr(), *rows = pattern_.innerIndexPtr();
  const auto unit = [](double square) { return square > 0. && std::isfinite(square) ? 1. / std::sqrt(square) : 1.; };
  for (int j = 0; j < n_; ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      if (rows[k] == j)
        scale_[j] = unit(std::abs(K[k]));
  for (int j = n_; j < size(); ++j) // column j is minus row j: they involve only motions
  {
    double length = 0.;
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      length += std::pow(K[k] * scale_[rows[k]], 2);
    scale_[j] = unit(length);
  }
  for (int j = 0; j < size(); ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      K[k] *= scale_[rows[k]] * scale_[j];
}

void SaddleMatrix::forget_pivots()
{
  factorised_ = false;
  if (factor_->numeric)
    klu_free_numeric(&factor_->numeric, &factor_->common);
}

bool SaddleMatrix::is_regular()
{
  if (!factor_->numeric || factor_->common.status != KLU_OK)
  {
    failed_ = std::clamp(factor_->common.singular_col, 0, size() - 1);
    return false;
  }
  const auto *pivots = static_cast<const double *>(factor_->numeric->Udiag);
  for (int k = 0; k < size(); ++k)
  {
    failed_                    = factor_->symbolic->Q[k];
    constexpr double dependent = 1e-14; // pivot of an equation of unit length: rounding, as in SmallLu
    if (failed_ < n_ ? !std::isfinite(pivots[k]) : !(std::abs(pivots[k]) > dependent) || !std::isfinite(pivots[k]))
      return false;
  }
  return true;
}

bool SaddleMatrix::factorise(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  fill(tangent, G);
  scale();
  Factor &f   = *factor_;
  factorised_ = false;
  if (f.numeric)
  {
    klu_refactor(pattern_.outerIndexPtr(), pattern_.innerIndexPtr(), pattern_.valuePtr(), f.symbolic, f.numeric,
                 &f.common);
    factorised_ = is_regular();
  }
  if (!factorised_)
  {
    if (f.numeric)
      klu_free_numeric(&f.numeric, &f.common);
    f.numeric =
        klu_factor(pattern_.outerIndexPtr(), pattern_.innerIndexPtr(), pattern_.valuePtr(), f.symbolic, &f.common);
    factorised_ = is_regular();
  }
  if (!factorised_ && f.numeric) // of no use to the next
    klu_free_numeric(&f.numeric, &f.common);
  return factorised_;
}

void SaddleMatrix::solve_in_place(Eigen::VectorXd &y) const
{
  y.array() *= scale_.array();
  klu_solve(factor_->symbolic, factor_->numeric, size(), 1, y.data(), &factor_->common);
  y.array() *= scale_.array();
}

} // namespace gestell::coupling
