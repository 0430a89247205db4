#include "coupling/sensitivity/motion_linearisation.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{
using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double shift = 1e-7; ///< step of its measures, relative to the size of an element

/// (plus - minus)/2 step as a sparse matrix; empty if it is zero.
Eigen::SparseMatrix<double> quotient(const Eigen::SparseMatrix<double> &minus, const Eigen::SparseMatrix<double> &plus,
                                     double step)
{
  Eigen::SparseMatrix<double> difference = (plus - minus) / (2. * step);
  difference.prune(0.);
  return difference.nonZeros() > 0 ? difference : Eigen::SparseMatrix<double>();
}

/// The same for a matrix that is known by its products, column by column. A product with a vector without zeros shows
/// whether there is a difference: results that are equal bit by bit mean equal matrices.
template <typename Product>
Eigen::SparseMatrix<double> quotient(const LinearSystem &minus, const LinearSystem &plus, Product product, double step)
{
  const Index n = minus.size();
  VectorXd    x(n), below(n), above(n);
  for (Index i = 0; i < n; ++i)
    x[i] = 1. + 0.37 * std::sin(1. + double(i));
  const auto multiply = [&]
  {
    (minus.*product)(x, below);
    (plus.*product)(x, above);
    return below != above;
  };
  if (!multiply())
    return {};
  std::vector<Eigen::Triplet<double>> entries;
  x.setZero();
  for (Index j = 0; j < n; ++j)
  {
    x[j] = 1.;
    if (multiply())
      for (Index i = 0; i < n; ++i)
        if (above[i] != below[i])
          entries.emplace_back(int(i), int(j), (above[i] - below[i]) / (2. * step));
    x[j] = 0.;
  }
  Eigen::SparseMatrix<double> difference(n, n);
  difference.setFromTriplets(entries.begin(), entries.end());
  return difference;
}
} // namespace

void MotionLinearisation::clear_rates(const MotionState &state, Linearised &at) const
{
  at.r_t.setZero(state.q.size());
  at.p_t.setZero(state.local.u.size());
  at.gamma_t.setZero(machine_.joints().n_rows());
}

void require_variational(const Machine &machine)
{
  if (machine.forces().need_multipliers())
    throw std::invalid_argument(
        "sensitivities: friction in an ideal joint depends on the joint force, which the variational equations do not "
        "include; make the joint compliant, or use differences of two runs with --set");
}

MotionLinearisation::MotionLinearisation(Machine &machine, const std::vector<ParameterTwins> &twins)
    : machine_(machine), twins_(twins),
      consistent_((require_variational(machine), machine), "the variational equations"), virtual_rates_(machine)
{
  const Index n_c = machine.joints().n_rows();
  for (VectorXd *x : {&rate_, &g_})
    x->setZero(n_c);
  G_minus_ = G_plus_ = ConstraintJacobian(machine.joints().blocks());
  moved_.resize(machine);
  blocks_ = machine.forces().blocks();
  inexact_.assign(blocks_.size(), 0);
  find_changes();
}

void MotionLinearisation::find_changes()
{
  for (const ParameterTwins &twin : twins_)
  {
    const LinearSystem &below = twin.minus.machine->linear(), &above = twin.plus.machine->linear();
    Changes             change;
    change.M    = quotient(below, above, &LinearSystem::mass_times, twin.step);
    change.B    = quotient(below, above, &LinearSystem::damping_times, twin.step);
    change.C    = quotient(below, above, &LinearSystem::stiffness_times, twin.step);
    change.load = !below.excitation().is_constant() || below.excitation().constant() != above.excitation().constant();
    change.W = quotient(twin.minus.machine->forces().directions(), twin.plus.machine->forces().directions(), twin.step);
    changes_.push_back(std::move(change));
  }
}

void MotionLinearisation::complete(MotionState &state)
{
  const auto &W           = machine_.forces().directions();
  state.local.t           = state.t;
  state.local.u.noalias() = W.transpose() * state.q;
  state.local.v.noalias() = W.transpose() * state.v;
  keep_held_rates(machine_, state.local.v);
  state.a.resize(state.q.size());
  consistent_.solve(state.q, state.v, state.a, state.local, work_);
  virtual_rates_.settle(state.q, state.v, state.local);
  for (const int i : machine_.linear().virtual_coordinates())
    state.a[i] = 0.;
}

void MotionLinearisation::begin_piece(const std::vector<MotionState> &passed)
{
  for (Changes &what : changes_)
    what.forces = what.joints = true;
  of_accelerations_ = true;
  for (const MotionState &state : passed)
    find_inexact(state);
  Linearised at;
  MatrixXd   p, g, g_rate, gamma, P_a;
  for (const MotionState &state : passed)
  {
    linearise(state, at);
    for (auto &[sum, part] : {std::pair(&p, &at.p), std::pair(&g, &at.g), std::pair(&g_rate, &at.g_rate),
                              std::pair(&gamma, &at.gamma), std::pair(&P_a, &at.P_a)})
    {
      if (sum->size() == 0)
        sum->setZero(part->rows(), part->cols());
      *sum += part->cwiseAbs();
    }
  }
  for (std::size_t k = 0; k < changes_.size() && !passed.empty(); ++k)
  {
    changes_[k].forces = !p.col(Index(k)).isZero(0.);
    changes_[k].joints = changes_[k].forces || !g.col(Index(k)).isZero(0.) || !g_rate.col(Index(k)).isZero(0.) ||
                         !gamma.col(Index(k)).isZero(0.);
  }
  of_accelerations_ = passed.empty() || !P_a.isZero(0.);
  of_time_          = passed.empty();
  for (const MotionState &state : passed)
  {
    clear_rates(state, at);
    add_at(passed.front().t, -1., state, at);
    add_at(state.t, 1., state, at);
    of_time_ = of_time_ || !at.r_t.isZero(0.) || !at.p_t.isZero(0.) || !at.gamma_t.isZero(0.);
  }
}

void MotionLinearisation::linearise(const MotionState &state, Linearised &at, double way)
{
  const Index n = machine_.size(), n_u = state.local.u.size(), n_c = machine_.joints().n_rows(), K = int(twins_.size());
  at.P_u.setZero(n_u, n_u);
  at.P_v.setZero(n_u, n_u);
  product_.resize(n_u);
  machine_.forces().derivatives(state.local, product_, at.P_u, at.P_v);
  differentiate(state, inexact_, 1., at);
  if (of_accelerations_)
  {
    at.P_a.resize(n_u, n_u);
    machine_.forces().tangent(state.local, 0., 0., 1., product_, at.P_a);
  }
  else
    at.P_a.setZero(n_u, n_u);
  for (const HeldMeasure &h : machine_.forces().held())
    for (MatrixXd *P : {&at.P_u, &at.P_v, &at.P_a})
      P->row(h.measure).setZero();
  at.r.setZero(n, K);
  at.p.setZero(n_u, K);
  for (MatrixXd *x : {&at.g, &at.g_rate, &at.gamma})
    x->setZero(n_c, K);
  const bool turns = std::any_of(changes_.begin(), changes_.end(), [](const Changes &c) { return c.W.size() > 0; });
  for (MatrixXd *x : {&at.u, &at.v, &at.a})
    x->setZero(turns ? n_u : 0, turns ? K : 0);
  for (int k = 0; k < K; ++k)
  {
    add_loads(state, k, at);
    if (changes_[std::size_t(k)].forces)
      add_forces(state, k, at);
  }
  if (n_c > 0)
    add_joints(state, at);
  clear_rates(state, at);
  if (way > 0. && of_time_)
    add_rates(state, way, at);
}

void MotionLinearisation::add_loads(const MotionState &state, int k, Linearised &at)
{
  const ParameterTwins &twin  = twins_[std::size_t(k)];
  const Changes        &what  = changes_[std::size_t(k)];
  const LinearSystem   &below = twin.minus.machine->linear(), &above = twin.plus.machine->linear();
  for (const auto &[matrix, x] :
       {std::pair(&what.M, &state.a), std::pair(&what.B, &state.v), std::pair(&what.C, &state.q)})
    if (matrix->size() > 0)
      at.r.col(k).noalias() -= *matrix * *x;
  if (what.load)
  {
    minus_.resize(state.q.size());
    plus_.resize(state.q.size());
    below.excitation().at(state.t, minus_);
    above.excitation().at(state.t, plus_);
    at.r.col(k) += 0.5 / twin.step * (plus_ - minus_);
  }
  if (what.W.size() == 0)
    return;
  at.r.col(k) += what.W * state.local.p;
  at.u.col(k) = what.W.transpose() * state.q;
  at.v.col(k) = what.W.transpose() * state.v;
  at.a.col(k) = what.W.transpose() * state.a;
}

void MotionLinearisation::add_forces(const MotionState &state, int k, Linearised &at)
{
  const ParameterTwins &twin = twins_[std::size_t(k)];
  minus_ = plus_ = state.local.p;
  twin.minus.machine->forces().force(state.local, minus_);
  twin.plus.machine->forces().force(state.local, plus_);
  at.p.col(k) = (plus_ - minus_) * (0.5 / twin.step);
}

/// Loads, forces and g'' that the same motion has at another time.
void MotionLinearisation::add_at(double t, double factor, const MotionState &state, Linearised &at)
{
  moved_   = state.local;
  moved_.t = t;
  plus_.resize(state.q.size());
  machine_.linear().excitation().at(t, plus_);
  at.r_t += factor * plus_;
  plus_ = state.local.p;
  machine_.forces().force(moved_, plus_);
  at.p_t += factor * plus_;
  if (at.gamma_t.size() == 0)
    return;
  JointTerms terms;
  joint_terms(machine_, moved_, terms, G_plus_);
  at.gamma_t += factor * terms.acceleration;
  plus_.setZero();
  G_plus_.set_forces(state.local.lambda, plus_);
  for (const ConstraintBlock &block : machine_.joints().blocks())
    at.p_t.segment(block.first_measure, block.n_measures) +=
        factor * plus_.segment(block.first_measure, block.n_measures);
}

/// Adds rates by difference quotients of order 4.
void MotionLinearisation::add_rates(const MotionState &state, double way, Linearised &at)
{
  for (const auto &[by, weight] : {std::pair(way, 8. / 12.), std::pair(2. * way, -1. / 12.)})
    for (const double sign : {1., -1.})
      add_at(state.t + sign * by, sign * weight / way, state, at);
}

/// Step of a measure of a block, or of its rate, for difference quotients.
double MotionLinearisation::way(const ForceBlock &block, int measure, bool rates, const LocalState &local)
{
  const double x = std::abs(rates ? local.v[measure] : local.u[measure]);
  // [m/s, rad/s] speed below which the step is that of this speed; quotients with wider steps check the result
  constexpr double slow = 1e-3;
  const double     size = rates ? slow : block.size > 0. ? block.size : 1.;
  return shift * std::max(x, size);
}

/// Quotients for P_u and P_v of the blocks that are marked, by moving the same measure of all at once `by` ways.
void MotionLinearisation::differentiate(const MotionState &state, const std::vector<char> &marked, double by,
                                        Linearised &at)
{
  int most = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    most = marked[b] ? std::max(most, blocks_[b].n_measures) : most;
  for (int j = 0; j < most; ++j)
    for (const bool rates : {false, true})
    {
      const auto far = [&](const ForceBlock &block)
      { return by * way(block, block.first_measure + j, rates, state.local); };
      const auto forces_at = [&](double sign, VectorXd &p)
      {
        moved_      = state.local;
        VectorXd &x = rates ? moved_.v : moved_.u;
        for (std::size_t b = 0; b < blocks_.size(); ++b)
          if (marked[b] && j < blocks_[b].n_measures)
            x[blocks_[b].first_measure + j] += sign * far(blocks_[b]);
        p = state.local.p;
        machine_.forces().force(moved_, p);
      };
      forces_at(-1., minus_);
      forces_at(1., plus_);
      for (std::size_t b = 0; b < blocks_.size(); ++b)
        if (const ForceBlock &block = blocks_[b]; marked[b] && j < block.n_measures)
          (rates ? at.P_v : at.P_u).col(block.first_measure + j).segment(block.first_measure, block.n_measures) =
              (plus_ - minus_).segment(block.first_measure, block.n_measures) * (0.5 / far(block));
    }
}

/// Marks blocks with a derivative that differs from the quotient of the forces, even if it is small compared with the
/// others of its block: a stiff element on a measure that rotates is stiff along it, with force over length across it.
void MotionLinearisation::find_inexact(const MotionState &state)
{
  const Index n_u = state.local.u.size();
  Linearised  reported, seen, wide;
  for (Linearised *at : {&reported, &seen, &wide})
  {
    at->P_u.setZero(n_u, n_u);
    at->P_v.setZero(n_u, n_u);
  }
  product_.resize(n_u);
  machine_.forces().derivatives(state.local, product_, reported.P_u, reported.P_v);
  const std::vector<char> all(blocks_.size(), 1);
  differentiate(state, all, 1., seen);
  constexpr double wider = 3.; // times the step, for quotients that show the error of the others
  differentiate(state, all, wider, wide);
  for (std::size_t b = 0; b < blocks_.size(); ++b)
    for (const bool rates : {false, true})
      for (int i = blocks_[b].first_measure; i < blocks_[b].first_measure + blocks_[b].n_measures; ++i)
      {
        double terms = 0.;
        for (int j = blocks_[b].first_measure; j < blocks_[b].first_measure + blocks_[b].n_measures; ++j)
          terms += std::abs(reported.P_u(i, j)) * way(blocks_[b], j, false, state.local) / shift +
                   std::abs(reported.P_v(i, j)) * way(blocks_[b], j, true, state.local) / shift;
        for (int j = blocks_[b].first_measure; j < blocks_[b].first_measure + blocks_[b].n_measures; ++j)
        {
          const auto       of       = [&](const Linearised &at) { return (rates ? at.P_v : at.P_u)(i, j); };
          constexpr double digit    = 1e-15; // of the terms of a force, their rounding
          const double     rounding = digit * terms / way(blocks_[b], j, rates, state.local);
          // times what quotients of both differ by, and rounding: a difference that is none of theirs
          constexpr double sure = 10.;
          if (!(std::abs(of(reported) - of(seen)) <= sure * (std::abs(of(seen) - of(wide)) + rounding)))
            inexact_[b] = 1;
        }
      }
}

/// The terms at a motion, and G.
void MotionLinearisation::joint_terms(const Machine &machine, const LocalState &local, JointTerms &terms,
                                      ConstraintJacobian &G)
{
  for (VectorXd *x : {&terms.g, &terms.rate, &terms.acceleration})
    x->resize(G.n_rows());
  machine.joints().constraints(local, terms.g, G);
  machine.joints().rates(local, terms.rate, terms.acceleration);
  G.add_product(1., local.v, terms.rate);
  G.add_product(1., local.a, terms.acceleration);
}

void MotionLinearisation::add_joints(const MotionState &state, Linearised &at)
{
  const Index n_c = machine_.joints().n_rows(), n_u = state.local.u.size();
  if (at.G.n_rows() != n_c)
    at.G = ConstraintJacobian(machine_.joints().blocks());
  machine_.joints().constraints(state.local, g_, at.G);
  for (MatrixXd *x : {&at.Gamma_u, &at.Gamma_v, &at.G_rate})
    x->setZero(n_c, n_u);
  bend_joints(state, &LocalState::u, at.Gamma_u, &at);
  bend_joints(state, &LocalState::v, at.Gamma_v, nullptr);
  JointTerms below, above;
  VectorXd   p_below = VectorXd::Zero(n_u), p_above = p_below;
  for (int k = 0; k < int(twins_.size()); ++k)
  {
    if (!changes_[std::size_t(k)].joints)
      continue;
    const ParameterTwins &twin     = twins_[std::size_t(k)];
    const double          quotient = 0.5 / twin.step;
    joint_terms(*twin.minus.machine, state.local, below, G_minus_);
    joint_terms(*twin.plus.machine, state.local, above, G_plus_);
    at.g.col(k)      = quotient * (above.g - below.g);
    at.g_rate.col(k) = quotient * (above.rate - below.rate);
    at.gamma.col(k)  = quotient * (above.acceleration - below.acceleration);
    p_below.setZero();
    p_above.setZero();
    G_minus_.set_forces(state.local.lambda, p_below);
    G_plus_.set_forces(state.local.lambda, p_above);
    for (const ConstraintBlock &block : machine_.joints().blocks())
      at.p.col(k).segment(block.first_measure, block.n_measures) =
          quotient * (p_above - p_below).segment(block.first_measure, block.n_measures);
  }
}

/// Derivatives of G u'' + bias by measures, and of G u' + rate and G^T lambda by positions, into `of_u`, by moving the
/// same measure of all joints at once: no two share one.
void MotionLinearisation::bend_joints(const MotionState &state, VectorXd LocalState::*moved, MatrixXd &Gamma,
                                      Linearised *of_u)
{
  const auto &blocks = machine_.joints().blocks();
  int         most   = 0;
  for (const ConstraintBlock &block : blocks)
    most = std::max(most, block.n_measures);
  JointTerms below, above;
  VectorXd   p_below = VectorXd::Zero(Gamma.cols()), p_above = p_below;
  for (JointTerms *terms : {&below, &above})
    terms->acceleration.resize(Gamma.rows());
  const auto find = [&](JointTerms &terms, ConstraintJacobian &G)
  {
    if (of_u)
      joint_terms(machine_, moved_, terms, G);
    else // G does not depend on u'
      machine_.joints().rates(moved_, rate_, terms.acceleration);
  };
  for (int j = 0; j < most; ++j)
  {
    const auto way = [&](const ConstraintBlock &block)
    {
      const double     size = block.size > 0. ? block.size : 1.;
      constexpr double bend = 1e-6; // step of its measures, relative to the size of a joint
      return bend * (of_u ? size : std::max(size, std::abs((state.local.*moved)[block.first_measure + j])));
    };
    const auto move = [&](double sign)
    {
      moved_ = state.local;
      for (const ConstraintBlock &block : blocks)
        if (j < block.n_measures)
          (moved_.*moved)[block.first_measure + j] += sign * way(block);
    };
    move(-1.);
    find(below, G_minus_);
    move(1.);
    find(above, G_plus_);
    if (of_u)
    {
      G_minus_.set_forces(state.local.lambda, p_below);
      G_plus_.set_forces(state.local.lambda, p_above);
    }
    for (const ConstraintBlock &block : blocks)
    {
      if (j >= block.n_measures)
        continue;
      const double quotient = 0.5 / way(block);
      const int    column   = block.first_measure + j;
      const auto   take     = [&](MatrixXd &to, const VectorXd &minus, const VectorXd &plus, int first, int n)
      { to.col(column).segment(first, n) = quotient * (plus - minus).segment(first, n); };
      take(Gamma, below.acceleration, above.acceleration, block.first_row, block.n_rows);
      if (!of_u)
        continue;
      take(of_u->G_rate, below.rate, above.rate, block.first_row, block.n_rows);
      take(of_u->P_u, p_below, p_above, block.first_measure, block.n_measures);
    }
  }
}

} // namespace gestell::coupling
