#include "coupling/equilibrium/seated_plays.h"

#include "coupling/equilibrium/static_balance.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/coordinate_sizes.h"
#include "coupling/machine/configuration/plays.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// A play as an ideal joint, s = target.
struct Seat
{
  int      first_measure;
  VectorXd target, force; ///< force on s
};

class Seating
{
public:
  Seating(Machine &machine, const KnownStart &held, const SteadyMotion &motion, const InitialState &state)
      : machine_(machine), balance_(machine, state, &held, &motion), sizes_(coordinate_sizes(machine)), q_(state.q),
        lambda_(VectorXd::Zero(balance_.n_rows()))
  {
    for (const PlacedPlay &own : plays(machine, state.q, motion.v))
      if (own.play.both && own.play.gap > 0. && !own.play.presses() && moves_with(motion, own))
        seats_.push_back({own.first_measure, VectorXd::Zero(own.play.n), VectorXd::Zero(own.play.n)});
  }

  VectorXd position()
  {
    const VectorXd begin = q_;
    if (seats_.empty() || !close()) // in the middle: which forces pass
      return begin;
    choose_sides();
    if (!close())
      return begin;
    return q_;
  }

private:
  static bool moves_with(const SteadyMotion &motion, const PlacedPlay &own)
  {
    return std::find(motion.plays.begin(), motion.plays.end(), own.first_measure) != motion.plays.end();
  }

  /// The seats' plays in the order of the seats.
  std::vector<PlacedPlay> placed() const
  {
    const auto              all = plays(machine_, q_, VectorXd::Zero(q_.size()));
    std::vector<PlacedPlay> own;
    for (const Seat &seat : seats_)
      own.push_back(*std::find_if(all.begin(), all.end(),
                                  [&](const PlacedPlay &p) { return p.first_measure == seat.first_measure; }));
    return own;
  }

  /// Newton's method for the equilibrium with the seats as joints.
  bool close()
  {
    for (const PlacedPlay &own : placed())
      balance_.leave_out(own.first_measure, own.n_measures);
    double        before           = std::numeric_limits<double>::infinity();
    constexpr int most_corrections = 30; // of Newton's method: a few, unless clearances open and close alternately
    for (int k = 0; k < most_corrections; ++k)
    {
      const double size = correct(placed()), scale = std::max(q_.cwiseQuotient(sizes_).cwiseAbs().maxCoeff(), 1e-3);
      if (!std::isfinite(size))
        return false;
      constexpr double seated = 1e-9; // correction, against the size of q: the equilibrium is found later
      // relative to q: below it corrections that no longer decrease are rounding
      constexpr double near_rounding = 1e-6;
      if (size <= seated * scale || (size <= near_rounding * scale && size > 0.3 * before))
        return true;
      before = size;
    }
    return false;
  }

  double correct(const std::vector<PlacedPlay> &own)
  {
    MatrixXd saddle;
    VectorXd residual;
    balance_.evaluate(q_, lambda_, 1., saddle, residual);
    const Eigen::Index n = q_.size(), n_before = saddle.rows();
    Eigen::Index       size = n_before;
    for (const PlacedPlay &place : own)
      size += place.play.n;
    MatrixXd A                          = MatrixXd::Zero(size, size);
    VectorXd b                          = VectorXd::Zero(size);
    A.topLeftCorner(n_before, n_before) = saddle;
    b.head(n_before)                    = -residual;
    Eigen::Index row                    = n_before;
    for (std::size_t i = 0; i < own.size(); row += own[i++].play.n)
    {
      A.block(row, 0, own[i].play.n, n) = own[i].G;
      A.block(0, row, n, own[i].play.n) = -own[i].G.transpose();
      b.segment(row, own[i].play.n)     = seats_[i].target - own[i].s();
      b.head(n) += own[i].G.transpose() * seats_[i].force;
    }
    const VectorXd change = scaled_solution(A, b);
    q_ += change.head(n);
    lambda_ += change.segment(n, lambda_.size());
    row = n_before;
    for (Seat &seat : seats_)
    {
      seat.force += change.segment(row, seat.force.size());
      row += seat.force.size();
    }
    return change.head(n).cwiseQuotient(sizes_).cwiseAbs().maxCoeff();
  }

  /// Solves with rows and columns scaled to equal size, since the matrix mixes stiffnesses and cosines.
  static VectorXd scaled_solution(const MatrixXd &A, const VectorXd &b)
  {
    const auto     inverse = [](double size) { return size > 0. ? 1. / size : 1.; };
    const VectorXd rows    = A.rowwise().norm().unaryExpr(inverse);
    const VectorXd columns = (rows.asDiagonal() * A).colwise().norm().transpose().unaryExpr(inverse);
    const MatrixXd scaled  = rows.asDiagonal() * A * columns.asDiagonal();
    return columns.asDiagonal() * LeastSquaresSolver(scaled).solve(VectorXd(rows.asDiagonal() * b));
  }

  /// The force on s points back into the play: the side is the other one.
  void choose_sides()
  {
    const auto own = placed();
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      const double force = seats_[i].force.norm();
      // relative to all forces: rounding, as in the equilibrium of static starts
      constexpr double no_force = 1e-9;
      if (force > no_force * balance_.forces().sum())
        seats_[i].target = -(own[i].play.gap + own[i].structure->yielding(force)) / force * seats_[i].force;
    }
  }

  Machine          &machine_;
  StaticBalance     balance_;
  VectorXd          sizes_; ///< of large motions
  VectorXd          q_, lambda_;
  std::vector<Seat> seats_;
};

} // namespace

Eigen::VectorXd seated_plays(Machine &machine, const KnownStart &held, const SteadyMotion &motion,
                             const InitialState &state)
{
  return Seating(machine, held, motion, state).position();
}

} // namespace gestell::coupling
