#pragma once

#include "coupling/integration/propagation/propagation_tables.h"
#include "coupling/periodic/periodic_method.h"

#include <Eigen/Core>

#include <vector>

namespace gestell::coupling
{

/**
 * Orthogonal collocation of a periodic motion, condensed to the forces of the elements.
 *
 * On each interval of a mesh of the period forces are the polynomial through s = 4 Gauss points.  Between them the base
 * is propagated exactly in its modes, and it is periodic by construction: x(t_0 + T) = x(t_0) gives x(t_0) for any
 * forces,
 *
 *     x_0 = (E - e^(Lambda T))^-1 sum_i e^(Lambda (T - t_i+1)) (in_i P_i + c_i),
 *
 * so that the measures at all Gauss points are an affine function of the forces there,
 *
 *     u = u_0 + G_u P,   u' = v_0 + G_v P     [N s n_u],       P = p(t, u, u'),
 *
 * and only P is unknown, however many modes there are.  For a free motion of the base, such as a mass between stops,
 * its two states at t_0 are also unknowns, and its periodicity is an equation.  Order 2 s at the mesh points.
 *
 * Along free shifts of the problem there is no periodicity condition, and the start is kept. For autonomous systems T
 * is also unknown, and q_phase(t_0) = phase_value an equation.  At given forces over theta = (t - t_0)/T the motion
 * changes with T by
 *
 *     dx/dT = eta + theta x',     eta' = Lambda eta - theta/T put P_theta,
 *
 * and eta jumps by -theta put [P] where the polynomials of two intervals do not meet.
 *
 * Source of the method: Ascher, Mattheij, Russell, Numerical Solution of Boundary Value Problems, 1995, chapter 5.
 */
class PeriodicCollocation
{
public:
  static constexpr int stages = 4;

  /// @throws std::invalid_argument as modal_blocks()
  /// @param free  blocks whose states are unknowns, as of another collocation; null: those that repeat by themselves
  /// @param period_changes  along a branch: those that would after a period near it, too
  explicit PeriodicCollocation(const PeriodicProblem &problem, SharedModes *shared = nullptr,
                               const std::vector<Eigen::Index> *free = nullptr, bool period_changes = false);

  /// Mesh points as shares of the period, 0 and 1 the ends, ascending.
  void                       set_mesh(const std::vector<double> &mesh);
  const std::vector<double> &mesh() const { return mesh_; }
  /// States of the modes of the base that are unknowns.
  const std::vector<Eigen::Index> &free() const { return free_; }
  /// T [s]: that of the problem, or of the unknowns looked at last.
  double period() const { return period_; }

  /// Unknowns of forces at the Gauss points, a start q, q' [n] and a period [s] where it is unknown.
  Eigen::VectorXd unknowns(const Eigen::VectorXd &forces, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                           double period) const;
  /// r = p(t, u, u') - P, then the residuals of the free states and of the phase; J = -dr/dy.
  void linearise(const Eigen::VectorXd &y, Eigen::VectorXd &r, Eigen::MatrixXd &J) { evaluate(y, r, &J); }
  void residual(const Eigen::VectorXd &y, Eigen::VectorXd &r) { evaluate(y, r, nullptr); }
  /// Newton's method from P, then free states and unknown period, which become the solution; the number of
  /// its iterations.
  /// @throws NoPeriodicMotion if it does not converge
  int solve(Eigen::VectorXd &P, const PeriodicOptions &options);
  /// Forces of another mesh at the Gauss points of this one.
  Eigen::VectorXd carried_over(const std::vector<double> &mesh, const Eigen::VectorXd &P) const;
  /// Lengths of unknowns y are those of diag(weights) y: forces by the time for which they stand, so that they are
  /// comparable from mesh to mesh.
  Eigen::VectorXd weights() const;
  /// By interval: change of the measures by the defect of the forces at its ends, relative to their ranges.
  Eigen::VectorXd errors(const Eigen::VectorXd &P);
  /// q, q' [n] at t_0.
  void state_at_begin(const Eigen::VectorXd &P, Eigen::VectorXd &q, Eigen::VectorXd &v) const;

  int n_unknowns() const { return int(G_u_.cols()) + (problem_.period_is_unknown() ? 1 : 0); }

private:
  /// How a motion of given forces and free states changes with T.
  struct PeriodSlope
  {
    Eigen::VectorXd start;   ///< x_0 [2 n_p]
    Eigen::VectorXd closing; ///< what the equations of the free states leave
    Eigen::VectorXd u, v;    ///< measures at the Gauss points [N s n_u]
  };

  void            use_period(double period);
  void            condense();
  void            close(Eigen::MatrixXd &X);
  void            find_shifts();
  bool            may_repeat_by_itself(Eigen::Index block) const;
  double          closing_determinant(Eigen::Index block) const;
  Eigen::Vector2d closed(Eigen::Index block, double x_1, double x_2) const;
  void            read_measures();
  void            read_phase();
  void            evaluate(const Eigen::VectorXd &y, Eigen::VectorXd &r, Eigen::MatrixXd *J);
  void            add_forces(const Eigen::VectorXd &y, Eigen::VectorXd &r, Eigen::MatrixXd *J);
  Eigen::VectorXd rate(const Eigen::VectorXd &x, const Eigen::VectorXd &p) const;
  Eigen::VectorXd slopes_of_forces(const Eigen::VectorXd &y, int interval) const;
  PeriodSlope     period_slope(const Eigen::VectorXd &y) const;
  Eigen::VectorXd carry_slope(const Eigen::VectorXd &y, Eigen::VectorXd eta, PeriodSlope *slope) const;
  void read_slope(int interval, const Eigen::VectorXd &P_i, const Eigen::VectorXd &pi, const Eigen::VectorXd &x,
                  const Eigen::VectorXd &eta, PeriodSlope &slope) const;
  Eigen::VectorXd force_at(const Eigen::VectorXd &P_i, double sigma) const;
  Eigen::VectorXd begin_of(const Eigen::VectorXd &y) const;
  int             n_intervals() const { return int(tables_.size()); }
  bool            is_free(Eigen::Index block, Eigen::Index unknown) const
  {
    return unknown < Eigen::Index(free_.size()) && free_[std::size_t(unknown)] == block;
  }

  const PeriodicProblem    &problem_;
  ModalBlocks               modes_;
  ModalMeasures             measures_;
  ForceBasis                basis_;
  int                       n_u_;
  double                    period_;
  bool                      period_changes_;
  std::vector<double>       mesh_;
  std::vector<StepTable>    tables_;
  StepTable                 whole_;   ///< of the period
  std::vector<Eigen::Index> free_;    ///< states of x that are unknowns
  Eigen::MatrixXd           closing_; ///< their equations closing_ (P; x_free; 1) = 0
  Eigen::VectorXd           scale_;   ///< of these, kept while the mesh is
  Eigen::MatrixXd           shifts_;  ///< of the free states that change no equation [states x k], orthonormal
  double                    phase_scale_ = 0.;
  Eigen::RowVectorXd        phase_; ///< q_phase(t_0) - phase_value = phase_ (P; x_free; 1), scaled
  Eigen::RowVectorXd        phase_of_x_;
  Eigen::MatrixXd           start_;     ///< x_0 = start_ (P; x_free; 1)
  Eigen::MatrixXd           G_u_, G_v_; ///< [N s n_u x unknowns]
  Eigen::VectorXd           u_0_, v_0_;
  LocalState                node_;
};

} // namespace gestell::coupling
