#include "coupling/equilibrium/static_equilibrium.h"

#include "coupling/algebra/dense_modes.h"
#include "coupling/equilibrium/small_motions.h"
#include "coupling/integration/system/dense_solvers.h"
#include "coupling/machine/configuration/coordinate_sizes.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace gestell::coupling
{

namespace
{

constexpr int    most_iterations = 50, most_parts = 64; ///< Newton's take some ten, each of up to 64 parts of the way
constexpr double converged = 1e-13;                     ///< correction, against the size of q
constexpr double singular  = 1e-14;                     ///< smallest pivot of the scaled saddle matrix
constexpr double balanced  = 1e-9; ///< residual relative to its forces that is treated as zero along a rigid-body mode
constexpr double stays     = 1e-6; ///< an initial position this close to an equilibrium is accepted as one
constexpr double soft      = 1e-8; ///< smallest stiffness of a coordinate relative to the stiffest
constexpr double long_way  = 0.5;  ///< a correction beyond is gone in parts

// Motions and positions are measured in coordinate_sizes().

// Relaxation.  Steps count in the time in which the machine's forces move its masses by its size: about 0.3 s of a
// metre under its weight.
constexpr int    most_steps = 1000, most_of_step = 15, most_pushes = 5;
constexpr double first_step = 0.03, shortest_step = 3e-9, longest_step = 3e3;
constexpr double way_of_step = 0.3, growing_way = 0.1; ///< in a step; share of the way so far, for lengths
constexpr double settled_at = 30.;                     ///< a step so long is ruled by stiffness, not by inertia
constexpr double settled    = 1e-7;                    ///< its motion, against the size of q
constexpr double push       = 0.01;                    ///< off an unstable equilibrium
constexpr double cancelled  = 1e-10; ///< share of an energy that is rounding: motions of a reduced frame that cost none

using Eigen::MatrixXd;
using Eigen::VectorXd;

class Equilibrium
{
public:
  Equilibrium(Machine &machine, const InitialState &from, const KnownStart *held = nullptr,
              const SteadyMotion *motion = nullptr)
      : machine_(machine), balance_(machine, from, held, motion), n_(machine.size()), sizes_(coordinate_sizes(machine)),
        q_(from.q), lambda_(VectorXd::Zero(balance_.n_rows())), M_(dense_mass(machine)), floating_(n_, 0),
        inertia_(n_, 0)
  {
  }

  /// After this call inertia balances the loads along unconstrained motions.
  void relieve()
  {
    const auto [Z, K, circulatory] = admissible();
    if (Z.cols() == 0)
      return;
    if (circulatory)
    {
      if (Eigen::FullPivLU<MatrixXd>(K).setThreshold(cancelled).isInvertible())
        return; // no motion is free
      throw std::invalid_argument(
          "inertia relief is not available for follower forces, such as a load with carried_by, on an unsupported "
          "machine: no single acceleration balances them; support the machine, or start with rule = \"given\"");
    }
    const DenseModes modes = dense_modes(K, Z.transpose() * M_ * Z, cancelled);
    const auto       n     = ((modes.omega.array() + modes.growth.array()) == 0.).count();
    floating_              = Z * modes.V.leftCols(n); // first ones, as omega ascends; growing motions are excluded
    if (modes.growth.head(n).any())
      floating_.resize(n_, 0);
    inertia_ = M_ * floating_;
  }

  /// The acceleration R R^T (f_t + W p) of an unsupported machine, which a note states; empty for others.
  VectorXd relief()
  {
    if (floating_.cols() == 0)
      return {};
    MatrixXd saddle;
    VectorXd residual;
    balance_.evaluate(q_, lambda_, 1., saddle, residual);
    const MatrixXd loads        = machine_.translation_loads();
    const MatrixXd translations = floating_.transpose() * loads; // R^T M of unit translations: their squares are masses
    const VectorXd acceleration = -floating_.transpose() * residual.head(n_);
    std::ostringstream text;
    text << "the machine is unsupported in " << floating_.cols()
         << (floating_.cols() == 1 ? " rigid-body mode" : " rigid-body modes")
         << "; inertia relief balances the loads on them, with a mean acceleration of [" << std::setprecision(4);
    for (int d = 0; d < 3; ++d)
    {
      const double mass = translations.col(d).squaredNorm();
      text << (d > 0 ? ", " : "") << (mass > 0. ? translations.col(d).dot(acceleration) / mass : 0.);
    }
    notes_.push_back(text.str() + "] m/s^2");
    return floating_ * acceleration;
  }

  const VectorXd           &q() const { return q_; }
  std::vector<std::string> &notes() { return notes_; }

  HeldEquilibrium held()
  {
    solve();
    return {q_, lambda_.head(balance_.n_joints())};
  }

  void solve()
  {
    const VectorXd begin = q_;
    const bool     found = newton_in_parts(begin);
    if (balance_.holds() && found)
      return;
    const Growth growth = found ? fastest_growth(admissible(), M_) : Growth();
    if (found && growth.rate == 0.)
      return;
    if (found && !growth.falls())
    {
      notes_.push_back("the machine starts in an equilibrium that follower forces make unstable by flutter: " +
                       growth.text(machine_) + " unless a damper prevents it");
      return;
    }
    if (found && largest(q_ - begin) <= stays)
    {
      notes_.push_back("the machine starts in an unstable equilibrium: " + growth.text(machine_) +
                       "; disturb it to make it fall, or add a support");
      return;
    }
    const VectorXd unstable = q_;
    if (balance_.holds() || floating_.cols() > 0 || !relax(begin))
      no_equilibrium(found);
    else if (found && largest(q_ - unstable) > stays)
      notes_.push_back("the equilibrium next to the initial position is unstable, " + growth.text(machine_) +
                       " there: the machine starts from the stable equilibrium into which it falls");
  }

  /// K v - A^T lambda' = 0,  A v = -dg/dt  with A = G W^T.
  VectorXd drift()
  {
    MatrixXd saddle;
    VectorXd residual;
    balance_.evaluate(q_, lambda_, 1., saddle, residual);
    const int n_c = balance_.n_joints();
    VectorXd  rate(n_c), bias(n_c), right = VectorXd::Zero(n_ + n_c);
    machine_.joints().rates(balance_.local(), rate, bias);
    right.tail(n_c)  = -rate;
    const VectorXd x = solution(saddle, right);
    if (!x.allFinite())
      no_equilibrium(true);
    return x.head(n_);
  }

private:
  /// Largest entry of a motion or position, relative to the sizes of the coordinates.
  double largest(const VectorXd &x) const { return n_ > 0 ? x.cwiseQuotient(sizes_).cwiseAbs().maxCoeff() : 0.; }

  SmallMotions admissible()
  {
    MatrixXd saddle;
    VectorXd residual;
    balance_.evaluate(q_, lambda_, 1., saddle, residual);
    return small_motions(balance_, saddle.topLeftCorner(n_, n_));
  }

  [[noreturn]] void no_equilibrium(bool unstable) const
  {
    std::ostringstream message;
    if (!loose_.empty())
      message << "there is no static equilibrium: " << loose_
              << ", start from another position, with inertia_relief = true if the whole machine may accelerate, or "
                 "with rule = \"given\"";
    else
      message << "no " << (unstable ? "stable " : "") << "static equilibrium was found near the initial position, "
              << (balance_.holds() ? "even with the loads applied in " + std::to_string(most_parts) + " steps"
                                   : std::string("nor does the machine settle in one after release from there"))
              << "; give a better position, or start with rule = \"given\"";
    throw std::invalid_argument(message.str());
  }

  /// The equations of statics, of a machine that floats with its inertia.
  void evaluate(double share, MatrixXd &saddle, VectorXd &residual)
  {
    balance_.evaluate(q_, lambda_, share, saddle, residual);
    if (floating_.cols() == 0)
      return;
    residual.head(n_) -= inertia_ * (floating_.transpose() * residual.head(n_));
    // Springs for motions without forces: they carry no force, but make the matrix regular.
    const double spring = saddle.topLeftCorner(n_, n_).trace() / M_.trace();
    saddle.topLeftCorner(n_, n_) += spring * inertia_ * inertia_.transpose();
  }

  bool newton_in_parts(const VectorXd &begin)
  {
    lambda_ = balance_.multipliers(q_, 1.);
    if (newton(1.))
      return true;
    for (int parts = 4; parts <= most_parts; parts *= 4)
    {
      q_         = begin;
      lambda_    = balance_.multipliers(q_, 1. / parts);
      bool found = true;
      for (int k = 1; found && k <= parts; ++k)
        found = newton(double(k) / parts);
      if (found)
        return true;
    }
    return false;
  }

  /// Scaling to rows and columns of equal size: energies of large motions are mixed with cosines.
  VectorXd scale_of(const MatrixXd &saddle) const
  {
    const int      size = int(saddle.rows());
    VectorXd       scale(size);
    const MatrixXd energies = sizes_.asDiagonal() * saddle.topLeftCorner(n_, n_).cwiseAbs() * sizes_.asDiagonal();
    const VectorXd stored   = energies.colwise().maxCoeff();
    const double   least    = soft * (n_ > 0 ? stored.maxCoeff() : 0.);
    for (int i = 0; i < n_; ++i)
      scale[i] = least > 0. ? sizes_[i] / std::sqrt(std::max(stored[i], least)) : sizes_[i];
    for (int i = n_; i < size; ++i)
    {
      const double row = saddle.row(i).head(n_).cwiseProduct(scale.head(n_).transpose()).cwiseAbs().maxCoeff();
      scale[i]         = row > 0. ? 1. / row : 1.;
    }
    return scale;
  }

  /// A motion without stiffness along which no force acts stays where it is; with one the solution is nan, and named.
  VectorXd solution(const MatrixXd &saddle, const VectorXd &right)
  {
    const VectorXd             scale  = scale_of(saddle);
    const MatrixXd             scaled = scale.asDiagonal() * saddle * scale.asDiagonal();
    const VectorXd             forces = scale.asDiagonal() * right;
    Eigen::FullPivLU<MatrixXd> lu;
    lu.setThreshold(singular);
    lu.compute(scaled);
    if (lu.isInvertible())
      return scale.asDiagonal() * lu.solve(forces);
    const VectorXd x = LeastSquaresSolver(scaled).solve(forces);
    if ((scaled * x - forces).norm() <= balanced * forces.norm())
      return scale.asDiagonal() * x;
    if (balance_.holds())
    {
      const MatrixXd way = scale.asDiagonal() * balance_.with_closed_chains(q_, saddle) * scale.asDiagonal();
      lu.compute(way);
      if (lu.isInvertible())
        return scale.asDiagonal() * lu.solve(forces);
    }
    loose_ = mechanism_mode_text(machine_,
                                 (scale.asDiagonal() * (scaled * x - forces)).head(n_)); // along which a force acts
    return VectorXd::Constant(saddle.rows(), std::numeric_limits<double>::quiet_NaN());
  }

  bool newton(double share)
  {
    MatrixXd saddle;
    VectorXd residual;
    double   before = std::numeric_limits<double>::infinity();
    for (int k = 0; k < most_iterations; ++k)
    {
      evaluate(share, saddle, residual);
      const VectorXd delta = solution(saddle, -residual);
      if (!delta.allFinite())
        return false;
      const double size = largest(delta.head(n_)), scale = std::max(largest(q_), 1e-6);
      // A large correction is divided: there may be another equilibrium after the next revolution.
      const double part = size > long_way ? long_way / size : 1.;
      q_ += part * delta.head(n_);
      lambda_ += part * delta.tail(lambda_.size());
      if (part == 1. && (size <= converged * scale || (size < 1e-9 * scale && size > 0.3 * before)))
        return true;
      before = size;
    }
    return false;
  }

  /**
   * Releases the machine from a position and removes its velocity after every step: implicit Euler with growing steps,
   * M (q_k+1 - q_k)/h^2 + r(q_k+1, lambda) = 0,  each of which reduces the energy, docs/theory/start.md (12).
   */
  bool relax(const VectorXd &begin)
  {
    q_         = begin;
    lambda_    = balance_.multipliers(q_, 1.);
    int pushes = 0;
    loose_.clear();
    VectorXd moves;
    MatrixXd saddle;
    VectorXd residual;
    balance_.evaluate(q_, lambda_, 1., saddle, residual);
    const double time = time_of_motions();
    double       h    = first_step * time;
    for (int k = 0; k < most_steps && h > shortest_step * time; ++k)
    {
      const VectorXd before = q_, forces = lambda_;
      balance_.evaluate(q_, lambda_, 1., saddle, residual);
      const VectorXd unbalanced = -residual.head(n_);
      const int      iterations = implicit_step(before, h);
      const VectorXd way        = q_ - before;
      const double   part       = way_share(way, before - begin);
      const bool     rests      = largest(way) <= settled * std::max(largest(q_), 1e-3);
      if (iterations > most_of_step || part > 1. || (!rests && way.dot(unbalanced) < 0.))
      {
        q_      = before;
        lambda_ = forces;
        h *= iterations <= most_of_step && part > 1. ? std::max(0.25, 0.8 / std::sqrt(part)) : 0.25;
        continue;
      }
      moves = way;
      if (h >= settled_at * time && rests)
      {
        if (!finish())
          return false;
        const Growth growth = fastest_growth(admissible(), M_);
        if (!growth.falls() || ++pushes > most_pushes)
          return !growth.falls();
        q_ += push / largest(growth.motion) * growth.motion;
        h = first_step * time;
      }
      h = std::min(longest_step * time, h * (iterations <= 4 ? 4. : iterations <= 8 ? 2. : 1.));
    }
    if (h > shortest_step * time)
      loose_ = mechanism_mode_text(machine_, moves); // still on its way
    return false;
  }

  /// [s] sqrt(sum M_ii s_i^2 / sum |F_i| s_i), with the sizes s_i; 1 without mass or forces, as then nothing takes
  /// time.
  double time_of_motions() const
  {
    const double inertia = M_.diagonal().dot(sizes_.cwiseAbs2()), work = balance_.forces().dot(sizes_);
    return inertia > 0. && work > 0. ? std::sqrt(inertia / work) : 1.;
  }

  /// Largest share of what each coordinate may move in a step.
  double way_share(const VectorXd &way, const VectorXd &so_far) const
  {
    if (!way.allFinite())
      return std::numeric_limits<double>::infinity();
    VectorXd most = way_of_step * sizes_;
    for (const Body &body : machine_.model().bodies())
      for (int i = body.coordinate; i < body.coordinate + n_displacements(body.kind); ++i)
        most[i] = std::max(most[i], growing_way * std::abs(so_far[i]));
    return way.cwiseAbs().cwiseQuotient(most).maxCoeff();
  }

  /// @return number of iterations; most_of_step + 1 if they were not sufficient
  int implicit_step(const VectorXd &before, double h)
  {
    MatrixXd saddle;
    VectorXd residual;
    for (int k = 1; k <= most_of_step; ++k)
    {
      balance_.evaluate(q_, lambda_, 1., saddle, residual);
      saddle.topLeftCorner(n_, n_) += M_ / (h * h);
      residual.head(n_) += M_ * (q_ - before) / (h * h);
      const VectorXd scale  = scale_of(saddle);
      const MatrixXd scaled = scale.asDiagonal() * saddle * scale.asDiagonal();
      const VectorXd delta  = scale.asDiagonal() * lu_solution(scaled, VectorXd(scale.asDiagonal() * -residual));
      if (!delta.allFinite())
        break;
      q_ += delta.head(n_);
      lambda_ += delta.tail(lambda_.size());
      if (largest(delta.head(n_)) <= 1e-10 * std::max(largest(q_), 1e-3))
        return k;
    }
    return most_of_step + 1;
  }

  /// Newton's method after the relaxation has come to rest.
  bool finish()
  {
    const VectorXd q = q_, lambda = lambda_;
    if (newton(1.) && largest(q_ - q) <= 1e-3 * std::max(largest(q), 1e-3))
      return true;
    q_      = q;
    lambda_ = lambda;
    MatrixXd saddle;
    VectorXd residual;
    balance_.evaluate(q_, lambda_, 1., saddle, residual);
    return residual.head(n_).cwiseAbs().dot(sizes_) <= balanced * balance_.forces().dot(sizes_);
  }

  Machine                 &machine_;
  StaticBalance            balance_;
  int                      n_;
  VectorXd                 sizes_; ///< of large motions
  VectorXd                 q_, lambda_;
  MatrixXd                 M_;
  MatrixXd                 floating_, inertia_; ///< R [n x k] of the motions that inertia relieves, and M R
  std::string              loose_;              ///< note on a motion with a force and no stiffness
  std::vector<std::string> notes_;
};

} // namespace

InitialState static_equilibrium(Machine &machine, const InitialState &assembled, Drift drift, Floating floating)
{
  if (machine.model().full_frame())
    throw std::invalid_argument(
        "a static initial state needs a reduced frame; give [reduction], or start with rule = \"given\"");
  Equilibrium equilibrium(machine, assembled);
  if (floating == Floating::relieved)
    equilibrium.relieve();
  equilibrium.solve();
  InitialState state = assembled;
  state.acceleration = equilibrium.relief();
  state.q            = equilibrium.q();
  state.v            = drift == Drift::quasistatic ? equilibrium.drift() : Eigen::VectorXd::Zero(machine.size()).eval();
  state.notes        = equilibrium.notes();
  return state;
}

HeldEquilibrium held_equilibrium(Machine &machine, const KnownStart &position, const SteadyMotion *motion,
                                 const InitialState *from)
{
  return Equilibrium(machine, from ? *from : position.state, &position, motion).held();
}

} // namespace gestell::coupling
