#include "coupling/reduction/parts/condensed_part.h"

#include "coupling/algebra/multifrontal.h"
#include "coupling/algebra/sparse_cholesky.h"
#include "coupling/eigensolvers/block_lanczos.h"
#include "coupling/eigensolvers/sturm_check.h"
#include "coupling/integration/system/convergence_failure.h"
#include "coupling/reduction/shapes/reduction_basis.h"
#include "fem/values/available_memory.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;
using Sparse = Eigen::SparseMatrix<double>;

SparseCholesky factor_of(const PartOfFrame &part)
{
  try
  {
    SparseCholesky   factor(part.sums.C, part.held, fem::available_memory());
    constexpr double regular_pivots = 1e-13; // ratio of pivots: below it C22 is singular up to rounding
    if (factor.pivot_ratio() > regular_pivots)
      return factor;
  }
  catch (const NotPositiveDefinite &)
  {
  }
  if (!part.prestress.empty())
    throw std::invalid_argument(part.prestress + ": prestress beyond buckling: " + part.name +
                                " buckles with its interface fixed, so the frame buckles at less than 1 times these "
                                "loads; reduce them or their 'factor', or stiffen the frame");
  throw std::invalid_argument("parts: " + part.name +
                              " moves freely although its interface is fixed; a frame of unconnected bodies without "
                              "supports cannot be cut into parts; remove 'parts'");
}

/// Whether the inertia of C - omega^2 M in the gap above the modes gives as many.
bool has_all(const PartOfFrame &part, const SparseCholesky &factor, const LowestModes &modes,
             const ModeSearch::Gap &gap)
{
  const VectorXd   moved    = moved_by_rounding(modes.V, part.sums.C.diagonal());
  constexpr double places[] = {0.5, 0.3, 0.7, 0.2, 0.8}; // in the gap, tried in this order
  for (const double place : places)
  {
    const double shift = std::isfinite(gap.high) ? gap.low + place * (gap.high - gap.low) : gap.low * (1. + place);
    if (const Inertia below = factor.inertia(part.sums.C, part.sums.M, shift * shift);
        below.growth < largest_growth(modes.omega, moved, gap.high, shift))
      return below.negative == gap.below;
  }
  throw ConvergenceFailure("parts: the modes of " + part.name + " cannot be counted below " +
                           rounded(gap.high / two_pi) + " Hz; request another number of modes");
}

/// The lowest modes, none of them missing.  C is away while they are searched.
LowestModes modes_of(PartOfFrame &part, const SparseCholesky &factor, int count)
{
  constexpr int         largest = 128; // block: of a frequency that is repeated as often
  BlockLanczos::Options options;
  for (; options.block <= largest; options.block *= 4)
  {
    LowestModes     modes;
    ModeSearch::Gap gap{};
    part.sums.C  = fem::SparseMatrix();
    options.room = 2 * count + 4 * options.block; // little memory: it restarts two or three times
    {
      BlockLanczos search(part.sums.M, std::make_shared<InverseByFactor>(factor, part.held), options);
      search.find(count);
      gap   = search.gap_above(count);
      modes = search.modes(gap.below);
    }
    part.sums.C = part.stiffness();
    if (has_all(part, factor, modes, gap))
      return {modes.omega.head(count), modes.V.leftCols(count), modes.bound.head(count)};
  }
  throw ConvergenceFailure("parts: some of the lowest " + std::to_string(count) + " modes of " + part.name +
                           " are not found; request another number of modes");
}

/// Rows of the interface, -1 elsewhere.
std::vector<int> places_of(const std::vector<int> &held, Index n)
{
  std::vector<int> place(n, -1);
  for (std::size_t k = 0; k < held.size(); ++k)
    place[held[k]] = int(k);
  return place;
}

void hold(Eigen::Ref<MatrixXd> X, const std::vector<int> &held)
{
  for (const int i : held)
    X.row(i).setZero();
}

/// The fronts of the interior with the coordinates held as rows below: what they pass on condenses A to these.
FrontSelection with_border(const Fronts &inner, const Sparse &pattern, const std::vector<int> &held)
{
  const std::vector<int> border = places_of(held, inner.n);
  const int              n2     = inner.n - int(held.size());
  std::vector<int>       place(inner.n, -1), front_of(inner.n, -1);
  FrontSelection         all;
  for (int k = 0; k < inner.n; ++k)
    if (border[inner.order[k]] < 0)
    {
      place[k] = int(all.order.size());
      all.order.push_back(inner.order[k]);
    }
  all.order.insert(all.order.end(), held.begin(), held.end());
  for (int s = 0; s < inner.count; ++s)
    std::fill(front_of.begin() + inner.first[s], front_of.begin() + inner.first[s + 1], s);

  std::vector<std::vector<int>> passed(inner.count); // rows of the interface from fronts before
  for (int s = 0; s < inner.count; ++s)
  {
    if (border[inner.order[inner.first[s]]] >= 0)
      continue; // alone, as all of its couplings are removed
    std::vector<int> rows = std::move(passed[s]);
    for (int k = inner.first[s]; k < inner.first[s + 1]; ++k)
      for (Sparse::InnerIterator a(pattern, inner.order[k]); a; ++a)
        if (border[a.row()] >= 0)
          rows.push_back(n2 + border[a.row()]);
    std::sort(rows.begin(), rows.end());
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (int k = inner.begin[s]; k < inner.begin[s + 1]; ++k)
      all.rows.push_back(place[inner.rows[k]]);
    all.rows.insert(all.rows.end(), rows.begin(), rows.end());
    const int width = inner.first[s + 1] - inner.first[s];
    all.first.push_back(all.first.back() + width);
    all.begin.push_back(int(all.rows.size()));
    if (inner.begin[s + 1] - inner.begin[s] > width)
    {
      std::vector<int> &to = passed[front_of[inner.rows[inner.begin[s] + width]]];
      to.insert(to.end(), rows.begin(), rows.end());
    }
  }
  return all;
}

/// S = A11 - A12 A22^-1 A21 of A = C + sigma X, lower triangle.
MatrixXd condensed(const FrontSelection &all, const PartOfFrame &part, const Sparse &X, double sigma)
{
  const Sparse &C      = part.sums.C;
  const Index   n1     = Index(part.held.size());
  const Fronts  fronts = all.fronts();
  const int     n2     = fronts.n - int(n1);
  fem::require_available("parts: " + part.name + " with " + std::to_string(n1) + " interface DOFs",
                         sizeof(double) * (double(multifrontal_workspace(fronts)) + double(n1) * double(n1)),
                         "Use fewer parts, or a coarser mesh.");
  MatrixXd     S = MatrixXd::Zero(n1, n1);
  const Border border{[&](int s, const double *contribution)
                      {
                        const int  *rows = fronts.rows + fronts.begin[s] + (fronts.first[s + 1] - fronts.first[s]);
                        const Index r    = fronts.rows + fronts.begin[s + 1] - rows;
                        for (Index j = 0; j < r; ++j)
                          for (Index i = j; i < r; ++i)
                            S(rows[i] - n2, rows[j] - n2) += contribution[i + j * r];
                      }};
  const int failed = multifrontal_cholesky(
      fronts, {C, &X, -sigma, {}, 1.}, [](int, const double *) {}, border);
  if (failed >= 0)
    throw NotPositiveDefinite(failed);
  const std::vector<int> place = places_of(part.held, C.rows());
  const auto             add   = [&](const Sparse &A, double factor)
  {
    for (Index k = 0; k < n1; ++k)
      for (Sparse::InnerIterator a(A, part.held[k]); a; ++a)
        if (place[a.row()] >= k)
          S(place[a.row()], k) += factor * a.value();
  };
  add(C, 1.);
  add(X, sigma);
  return S;
}

/// Columns of a matrix at the interface [n_p x n1].
Sparse columns_of(const Sparse &A, const std::vector<int> &held)
{
  Sparse result(A.rows(), Index(held.size()));
  for (std::size_t k = 0; k < held.size(); ++k)
  {
    result.startVec(Index(k));
    for (Sparse::InnerIterator a(A, held[k]); a; ++a)
      result.insertBack(a.row(), Index(k)) = a.value();
  }
  result.finalize();
  return result;
}

/// A part with its modes.
struct PartSpace
{
  const PartOfFrame    &part;
  const SparseCholesky &factor;
  const Sparse         &C_1; // columns at the interface
  const MatrixXd       &V;
  const VectorXd       &omega;

  /// Psi^T X and V^T X below each other [(n1+m) x k] of loads or rows [n_p x k].
  MatrixXd project(MatrixXd X) const
  {
    MatrixXd result(C_1.cols() + V.cols(), X.cols());
    result << X(part.held, Eigen::all), V.transpose() * X;
    hold(X, part.held);
    factor.solve_in_place(X);
    result.topRows(C_1.cols()) -= C_1.transpose() * X;
    return result;
  }
  /// C22^-1 X - V22 diag(1/omega^2) V22^T X of loads on the interior.
  MatrixXd answer_beyond_modes(MatrixXd X) const
  {
    const MatrixXd modal = omega.cwiseAbs2().cwiseInverse().asDiagonal() * (V.transpose() * X);
    factor.solve_in_place(X);
    return X - V * modal;
  }
};

/// CondensedPart::forces.
MatrixXd condensed_forces(const PartSpace &space)
{
  const PartOfFrame &part = space.part;
  const Index        n = space.C_1.cols() + space.V.cols(), k = Index(part.forces.size());
  MatrixXd           result(3 * n + 3, k);
  const auto         inside = [&](VectorXd fem::FrameOutput::*row, Index first, Index count)
  {
    MatrixXd rows = MatrixXd::Zero(part.sums.M.rows(), count);
    for (Index j = 0; j < count; ++j)
      if (const VectorXd &own = part.forces[std::size_t(first + j)].*row; own.size() > 0)
        rows.col(j) = own;
    hold(rows, part.held);
    return rows;
  };
  constexpr Index together = 16; // right-hand sides
  for (Index first = 0; first < k; first += together)
  {
    const Index    count = std::min(together, k - first);
    const MatrixXd on_q = inside(&fem::FrameOutput::on_q, first, count), w = space.answer_beyond_modes(on_q),
                   Mw = part.sums.M * w, Bw = part.alpha * Mw + part.damping * w;
    result.middleCols(first, count) << space.project(on_q),
        space.project(inside(&fem::FrameOutput::on_v, first, count) - Bw),
        space.project(inside(&fem::FrameOutput::on_a, first, count) - Mw), part.load.transpose() * w;
  }
  return result;
}

/// Size of the largest eigenvalue of D x = lambda C22 x, to some ten per cent.
double largest_against_stiffness(const PartOfFrame &part, const SparseCholesky &factor)
{
  constexpr int rounds = 8;
  MatrixXd      x      = MatrixXd::Ones(part.damping.rows(), 1);
  double        size   = 0.;
  for (int round = 0; round < rounds; ++round)
  {
    hold(x, part.held);
    x /= std::max(x.norm(), 1e-300);
    x = part.damping * x;
    hold(x, part.held);
    factor.solve_in_place(x);
    size = x.norm();
  }
  return size;
}

} // namespace

int modes_below(const PartOfFrame &part, double omega)
{
  return SparseCholesky::without_numbers(part.sums.C, part.held)
      .inertia(part.sums.C, part.sums.M, omega * omega)
      .negative;
}

CondensedPart condense(PartOfFrame part, int n_modes)
{
  const Sparse  &C = part.sums.C, &M = part.sums.M;
  const Index    n1    = Index(part.held.size());
  const bool     whole = contains(C, M) && contains(C, part.damping);
  const Sparse   C_1   = columns_of(C, part.held);
  CondensedPart  result;
  SparseCholesky factor = factor_of(part);
  LowestModes    modes  = modes_of(part, factor, n_modes);
  result.V              = std::move(modes.V);
  result.omega          = std::move(modes.omega);
  const VectorXd square = result.omega.cwiseAbs2();
  result.M_1V           = columns_of(M, part.held).transpose() * result.V;
  result.M_1V -= (C_1.transpose() * result.V) * square.cwiseInverse().asDiagonal();

  const PartSpace space{part, factor, C_1, result.V, result.omega};
  MatrixXd        load = part.load;
  hold(load, part.held);
  result.load       = space.project(std::move(load));
  result.forces     = condensed_forces(space);
  const bool damped = part.damping.nonZeros() > 0;
  double     tau    = 0.;
  MatrixXd   of_modes;
  if (damped)
  {
    constexpr double step = 1e-4; // of the stiffness: the relative error of D* is twice its square
    of_modes              = space.project(part.damping * result.V);
    tau                   = step / std::max(largest_against_stiffness(part, factor), 1e-300);
  }
  factor.release();

  // Rounding of S counts omega_mesh^2 / sigma times in M*: below 1e-7 with this share of the square of the highest
  // mode.
  constexpr double share        = 3e-4;
  const double     sigma        = share * square[n_modes - 1];
  result.sigma                  = 2. * share * sigma;
  const Sparse         pattern  = whole ? Sparse() : Sparse(Sparse(C + M) + part.damping);
  const SparseCholesky analysis = whole ? std::move(factor) : SparseCholesky::without_numbers(pattern, part.held);
  const FrontSelection all      = with_border(analysis.fronts(), whole ? C : pattern, part.held);
  result.C                      = condensed(all, part, M, 0.);
  const auto derivative         = [&](const Sparse &X, double step)
  {
    MatrixXd S = 4. * condensed(all, part, X, step); // of second order
    S -= condensed(all, part, X, 2. * step);
    S -= 3. * result.C;
    S /= 2. * step;
    return S;
  };
  result.M              = derivative(M, sigma);
  const VectorXd weight = sigma * (0.5 * (square.array() + sigma) * (square.array() + 2. * sigma)).rsqrt();
  result.M.selfadjointView<Eigen::Lower>().rankUpdate(MatrixXd(result.M_1V * weight.asDiagonal()));
  if (damped)
  {
    result.damping.resize(n1 + n_modes, n1 + n_modes);
    result.damping.rightCols(n_modes)            = of_modes;
    result.damping.topLeftCorner(n1, n1)         = derivative(part.damping, tau).selfadjointView<Eigen::Lower>();
    result.damping.bottomLeftCorner(n_modes, n1) = of_modes.topRows(n1).transpose();
  }
  return result;
}

RecoveredPart recover(PartOfFrame part, const CondensedPart &condensed, const MatrixXd &X, const MatrixXd &beyond,
                      const MatrixXd &modes)
{
  const Sparse        &M = part.sums.M, C_1 = columns_of(part.sums.C, part.held);
  const Index          n1 = Index(part.held.size()), n = M.rows(), m = condensed.omega.size(), k = X.cols();
  const SparseCholesky factor = factor_of(part);
  part.sums.C                 = fem::SparseMatrix();
  const VectorXd flexibility  = condensed.omega.cwiseAbs2().cwiseInverse();
  const auto     psi          = [&](const auto &q1) // Psi q_1
  {
    MatrixXd U = C_1 * -q1;
    hold(U, part.held);
    factor.solve_in_place(U);
    U(part.held, Eigen::all) = q1;
    return U;
  };

  RecoveredPart result;
  result.T.resize(n, k);
  MatrixXd        moved    = MatrixXd::Zero(n, modes.cols()); // Psi q_1 of the modes
  constexpr Index together = 16;                              // right-hand sides
  for (Index first = 0; first < k; first += together)
  {
    const Index    count              = std::min(together, k - first);
    const MatrixXd U                  = psi(X.block(0, first, n1, count));
    result.T.middleCols(first, count) = U + condensed.V * X.block(n1, first, m, count);
    moved += U * modes.middleRows(first, count);
  }
  MatrixXd inertia;
  symmetric_product(M, moved, inertia);
  hold(inertia, part.held);
  moved = inertia;
  factor.solve_in_place(moved);
  const MatrixXd of_modes = condensed.V.transpose() * inertia;
  result.left_out =
      inertia.cwiseProduct(moved).colwise().sum() - (flexibility.asDiagonal() * of_modes.cwiseAbs2()).colwise().sum();

  result.beyond = psi(beyond.topRows(n1)) + condensed.V * beyond.bottomRows(m);
  if (beyond.cols() == 0)
    return result;
  MatrixXd load = part.load;
  hold(load, part.held);
  result.beyond += PartSpace{part, factor, C_1, condensed.V, condensed.omega}.answer_beyond_modes(std::move(load));
  return result;
}

StaticPart condense_statics(const PartOfFrame &part, VectorXd f)
{
  const Sparse C_1 = columns_of(part.sums.C, part.held);
  StaticPart   result;
  hold(f, part.held);
  SparseCholesky factor = factor_of(part);
  factor.solve_in_place(f);
  factor.release();
  result.load              = -(C_1.transpose() * f);
  const FrontSelection all = with_border(factor.fronts(), part.sums.C, part.held);
  result.C                 = condensed(all, part, part.sums.C, 0.);
  return result;
}

VectorXd recover_statics(const PartOfFrame &part, VectorXd f, const VectorXd &q1)
{
  f -= columns_of(part.sums.C, part.held) * q1;
  hold(f, part.held);
  factor_of(part).solve_in_place(f);
  f(part.held) = q1;
  return f;
}

} // namespace gestell::coupling
