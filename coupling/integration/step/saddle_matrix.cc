#include "coupling/integration/step/saddle_matrix.h"

#include <suitesparse/camd.h>
#include <suitesparse/klu.h>

#include <algorithm>
#include <cmath>
#include <limits>
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

/// KLU's objects with their lifetime: a factor that shows the pivots.
struct SaddleMatrix::PivotSearch
{
  PivotSearch(Sparse &K, std::vector<int> &order)
  {
    klu_defaults(&common);
    common.btf   = 0;  // one block: a mechanism of several parts needs no special case
    common.scale = -1; // K is scaled
    // least ratio of a diagonal pivot to the largest entry of its column: less fill, at a loss of up to four digits
    constexpr double pivot_preference = 1e-4;
    common.tol                        = pivot_preference;
    int *begin = K.outerIndexPtr(), *rows = K.innerIndexPtr();
    symbolic = klu_analyze_given(int(K.cols()), begin, rows, order.data(), order.data(), &common);
    if (!symbolic)
      throw std::runtime_error("SaddleMatrix: KLU rejects the matrix");
    numeric = klu_factor(begin, rows, K.valuePtr(), symbolic, &common);
  }
  ~PivotSearch()
  {
    if (numeric)
      klu_free_numeric(&numeric, &common);
    klu_free_symbolic(&symbolic, &common);
  }
  PivotSearch(const PivotSearch &)            = delete;
  PivotSearch &operator=(const PivotSearch &) = delete;

  bool found() const { return numeric && common.status == KLU_OK; }

  klu_common    common;
  klu_symbolic *symbolic = nullptr;
  klu_numeric  *numeric  = nullptr;
};

SaddleMatrix::SaddleMatrix(const SecondOrderSystem &system)
    : system_(system), n_(system.linear().size()), n_c_(system.joints().n_rows()), weights_(Eigen::VectorXd::Zero(4))
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
    throw std::invalid_argument("the joints of this machine can only be solved condensed, because its frame provides "
                                "no matrices to factorise in every step");
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
  const std::vector<Place> base = places_of_base(), tangent = places_of_tangent(), joints = places_of_joints(),
                           held = places_of_held();
  const int N                   = n_ + n_c_ + int(held_.size());
  Triplets  all;
  for (const std::vector<Place> *places : {&base, &tangent, &joints, &held})
    for (const Place &place : *places)
      all.emplace_back(place.row, place.column, 0.);
  pattern_.resize(N, N);
  pattern_.setFromTriplets(all.begin(), all.end());
  pattern_.makeCompressed();
  parts_ = {{}, scattered(tangent), scattered(joints), scattered(held)};
  for (const Place &place : base)
    parts_.A.push_back(position(place.row, place.column));
  diagonal_.clear();
  for (int j = 0; j < n_; ++j)
    diagonal_.push_back(position(j, j));
  square_.setOnes(N);
  least_.setZero(N);
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

/// -W G^T and G W^T.
std::vector<SaddleMatrix::Place> SaddleMatrix::places_of_joints() const
{
  std::vector<Place> places;
  int                first  = 0;
  const auto        &blocks = system_.joints().blocks();
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    const ConstraintBlock &block = blocks[b];
    for (int k = 0; k < block.n_measures; ++k)
      for (int r = 0; r < block.n_rows; ++r)
        if (system_.joints().depends(b, r, k))
          for_column(system_.forces().directions(), block.first_measure + k,
                     [&](int i, double w)
                     {
                       const int value = first + r + block.n_rows * k, row = n_ + block.first_row + r;
                       places.push_back({value, i, row, -w});
                       places.push_back({value, row, i, w});
                     });
    first += block.n_rows * block.n_measures;
  }
  return places;
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
  forget_pivots();
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

void SaddleMatrix::fill(const Parts &parts, const Eigen::VectorXd &tangent, const ConstraintJacobian &G,
                        double *K) const
{
  for (std::size_t k = 0; k < parts.A.size(); ++k)
    K[parts.A[k]] = A_.valuePtr()[k];
  for (const Scattered &s : parts.tangent)
    K[s.position] -= weights_[3] * s.weight * tangent[s.value];
  const double *values = G.values().data();
  for (const Scattered &s : parts.joints)
    K[s.position] += s.weight * values[s.value];
  for (const Scattered &s : parts.held)
    K[s.position] += s.weight;
}

/// K, and the squares of the factors that scale it.
void SaddleMatrix::fill_pattern(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  double    *K     = pattern_.valuePtr();
  const int *begin = pattern_.outerIndexPtr(), *rows = pattern_.innerIndexPtr();
  std::fill_n(K, pattern_.nonZeros(), 0.);
  fill(parts_, tangent, G, K);
  const auto unit = [](double square) { return square > 0. && std::isfinite(square) ? 1. / square : 1.; };
  for (int j = 0; j < n_; ++j)
    square_[j] = unit(std::abs(K[diagonal_[std::size_t(j)]]));
  for (int j = n_; j < size(); ++j) // column j is minus row j: they involve only motions
  {
    double length = 0.;
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      length += K[k] * K[k] * square_[rows[k]];
    square_[j] = unit(length);
  }
}

void SaddleMatrix::forget_pivots()
{
  factorised_ = false;
  elimination_.reset();
}

bool SaddleMatrix::find_pivots(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  fill_pattern(tangent, G);
  double    *K     = pattern_.valuePtr();
  const int *begin = pattern_.outerIndexPtr(), *rows = pattern_.innerIndexPtr();
  for (int j = 0; j < size(); ++j)
    for (int k = begin[j]; k < begin[j + 1]; ++k)
      K[k] *= std::sqrt(square_[rows[k]] * square_[j]);
  const PivotSearch search(pattern_, order_);
  if (!search.found())
  {
    failed_ = std::clamp(search.common.singular_col, 0, size() - 1);
    return false;
  }
  elimination_ = std::make_unique<Elimination>(pattern_, search.numeric->Pnum, search.symbolic->Q);
  placed_      = parts_;
  for (int &position : placed_.A)
    position = elimination_->place(position);
  for (auto *part : {&placed_.tangent, &placed_.joints, &placed_.held})
    for (Scattered &s : *part)
      s.position = elimination_->place(s.position);
  least_.setConstant(std::numeric_limits<double>::infinity());
  return true;
}

/// False: a pivot of an equation of unit length is a rounding error.
bool SaddleMatrix::is_regular(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  fill_pattern(tangent, G);
  for (int k = 0; k < size(); ++k)
  {
    const double pivot         = std::abs(elimination_->pivot(k));
    failed_                    = elimination_->column(k);
    const double     scale     = std::sqrt(square_[elimination_->row(k)] * square_[failed_]);
    constexpr double dependent = 1e-14; // as in SmallLu
    if (!std::isfinite(pivot) || (failed_ >= n_ && !(pivot * scale > dependent)))
      return false;
    constexpr double little_smaller = 1e-3; // far from rounding, whatever became of the length of the equation
    least_[k]                       = failed_ < n_ ? 0. : little_smaller * pivot;
  }
  return true;
}

bool SaddleMatrix::eliminate(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  std::vector<double> &entries = elimination_->entries();
  std::fill(entries.begin(), entries.end(), 0.);
  fill(placed_, tangent, G, entries.data());
  elimination_->factorise();
  bool   regular = true;
  double sum     = 0.;
  for (int k = 0; k < size(); ++k)
  {
    const double pivot = std::abs(elimination_->pivot(k));
    sum += pivot;
    regular = regular && pivot >= least_[k];
  }
  return (regular && std::isfinite(sum)) || is_regular(tangent, G);
}

bool SaddleMatrix::factorise(const Eigen::VectorXd &tangent, const ConstraintJacobian &G)
{
  factorised_ = elimination_ && eliminate(tangent, G);
  if (!factorised_)
    factorised_ = find_pivots(tangent, G) && eliminate(tangent, G);
  if (!factorised_) // of no use to the next
    elimination_.reset();
  return factorised_;
}

void SaddleMatrix::solve_in_place(Eigen::VectorXd &y) const
{
  elimination_->solve_in_place(y);
}

} // namespace gestell::coupling
