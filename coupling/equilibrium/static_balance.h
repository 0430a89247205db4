#pragma once

#include "coupling/equilibrium/steady_motion.h"
#include "coupling/machine/configuration/assembly.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * The static equations of a machine with its fixed coordinates,
 *
 *     r = [ C q - s f_t - W p(q, 0) - A^T lambda ],     A = [ G W^T ],     saddle = [ K  -A^T ] = dr/d(q, lambda),
 *         [              open                    ]          [ held  ]               [ A    0  ]
 *
 * with the share s of the loads; p holds the joints' forces, K the geometric stiffness.  Virtual coordinates are kept
 * constant. Laws that depend on u' act as at rest; sticking elements carry no force.
 *
 * For a machine in motion r also contains M (a + S alpha) + B v, with alpha in place of the multipliers of the fixed
 * coordinates; laws are evaluated at v and a + S alpha, and virtual coordinates have their stationary values.
 */
class StaticBalance
{
public:
  /// @param held    fixed coordinates, or null; see held_equilibrium()
  /// @param motion  of a machine in motion, or null
  StaticBalance(Machine &machine, const InitialState &from, const KnownStart *held,
                const SteadyMotion *motion = nullptr);

  int                    n() const { return n_; }               ///< coordinates
  int                    n_joints() const { return n_c_; }      ///< equations of joints
  int                    n_rows() const { return n_c_ + n_g_; } ///< including those of fixed coordinates
  const Machine         &machine() const { return machine_; }
  bool                   holds() const { return held_ != nullptr; }
  const Eigen::VectorXd &forces() const { return forces_; } ///< [n] magnitudes of the terms of the last residual
  LocalState            &local() { return local_; }         ///< of the last evaluation
  Eigen::VectorXd        multipliers(const Eigen::VectorXd &q, double share); ///< closest to equilibrium

  void evaluate(const Eigen::VectorXd &q, const Eigen::VectorXd &lambda, double share, Eigen::MatrixXd &saddle,
                Eigen::VectorXd &residual);
  /// The forces on these measures are switched off.
  void leave_out(int first_measure, int n_measures) { acts_.segment(first_measure, n_measures).setZero(); }
  /// The saddle matrix with the stiffness of engaged elements, because open clearances have none.
  Eigen::MatrixXd with_closed_chains(const Eigen::VectorXd &q, Eigen::MatrixXd saddle) const;

private:
  void hold(const Eigen::VectorXd &q, Eigen::MatrixXd &A, Eigen::VectorXd &open);

  Machine           &machine_;
  const KnownStart  *held_;
  bool               moves_;
  int                n_, n_c_, n_g_ = 0;
  std::vector<int>   given_; ///< held coordinates
  double             t_;
  Eigen::VectorXd    zero_, v_, a_; ///< [n]
  Eigen::MatrixXd    S_, MS_;       ///< [n x n_g] of a machine in motion
  ConstraintJacobian G_;
  Eigen::MatrixXd    C_;
  Eigen::VectorXd    load_, acts_, forces_;
  LocalState         local_;
};

/**
 * Text on a motion [n] that diverges under the loads: "the motion of slide has neither stiffness nor weight to restore
 * it here; add a spring, ...", or the rigid-body modes of the frame and the remedy.
 */
std::string mechanism_mode_text(const Machine &machine, const Eigen::VectorXd &motion);

} // namespace gestell::coupling
