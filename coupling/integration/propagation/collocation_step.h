#pragma once

#include "coupling/integration/propagation/force_step.h"

#include <Eigen/LU>

#include <algorithm>
#include <vector>

namespace gestell::coupling
{

class StateArchive;

/**
 * Forces as the polynomial through s Gauss points, at which the laws are satisfied:
 *
 *     p_i = phi(u_i, u'_i),   u_i = u_free(c_i) + sum_j S_u(i, j) p_j,   u'_i = u'_free(c_i) + sum_j S_v(i, j) p_j.
 *
 * Order 2 s at the ends of steps, because the error of the polynomial is orthogonal to all polynomials of degree s - 1.
 * Newton solves for all p_i at once and keeps its Jacobian while it contracts well.  It stops when the residual moves
 * no measure by more than the tolerance, relative to its largest excursion.  For order 6 and above the residual must
 * also be small compared with the local error: below newton_share times the square of the relative defect of the
 * polynomial at the end of the previous step.
 *
 * Error.  If the larger defect d of the law at the two ends of the step acted during the whole step, it would move the
 * measures by S d.  A tenth of that is compared with their largest excursions.  An excursion is at least least_part of
 * the distance of the whole motion in the energy norm, so far or predicted from future loads.  Sticking measures
 * constrain others too: S is then the remaining mobility.  A sticking measure does not move: its force is accurate
 * enough if its error is small compared with its largest value, or if the error moves the machine little compared with
 * the whole motion.
 */
class CollocationStep final : public ForceStep
{
public:
  CollocationStep(PropagationContext &context, int stages);

  const ForceBasis &basis() const override { return basis_; }

  void begin(const Eigen::VectorXd &x, const LocalState &at) override;

  bool solve(const StepTable &table, LocalState &end) override;

  void accept() override;

  void   begin_state(Eigen::VectorXd &x) const override { x = x_begin_; }
  void   end_state(Eigen::VectorXd &x) const override { x = x_end_; }
  void   forces(Eigen::VectorXd &p) const override { p = P_; }
  double error() const override { return error_; }
  int    error_order() const override { return s_ + 2; }
  double interpolation_error(double phase) const override { return std::min(1., nodes_.error(phase)); }

  void interpolate(double sigma, LocalState &state) const override;

  void carry_tangents(Eigen::MatrixXd &X) override;
  void exchange(StateArchive &archive, const std::vector<const StepTable *> &tables) override;

private:
  /// Work space of carry_tangents(), for the n measures whose forces change with the motion.
  struct TangentWork
  {
    Eigen::MatrixXd                      all_of_u, all_of_v; ///< dp/du, dp/dv at the points of a step [n_u x s n_u]
    std::vector<int>                     measures;
    Eigen::MatrixXd                      rows, in;   ///< [2 s n x 2 n_p], [2 n_p x s n]
    Eigen::MatrixXd                      S_u, S_v;   ///< [s n x s n]
    Eigen::MatrixXd                      of_u, of_v; ///< at one point [n x n]
    Eigen::MatrixXd                      free, matrix, forces, dP;
    Eigen::PartialPivLU<Eigen::MatrixXd> lu;
    Eigen::ArrayXd                       first; ///< [n_p]
  };
  void linearise_forces();
  void take_measures(const StepTable &table);
  void fill_tangent_rows(const StepTable &table, int i);

  static HermiteNodes hermite_nodes(std::vector<double> points);

  /// u, v at point i from the free motion and P.
  void motion(const StepTable &table, int i, LocalState &state) const;

  /// Extrapolates the polynomial of the last step; after an event uses the force at its beginning.
  void predict(double h);

  /// Rows of point i of I - dp S, from dp_du_ and dp_dv_.
  void fill_rows(const StepTable &table, int i, Eigen::MatrixXd &matrix) const;

  /// Residuals phi(u_i, v_i) - P_i; also their Jacobian if `jacobian` is true.
  bool evaluate(const StepTable &table, bool jacobian);

  bool iterate(const StepTable &table);

  /// Updates the largest defects so far, relative to the largest forces.
  void note_defect();

  /// Relative error of the forces that Newton may leave; up to order 4 the tolerance is small against the local error.
  double part_left() const;

  bool is_expected(double h) const { return begin_at_.t + h <= expected_until_; }

  /// Grows the scale by the excursions of accepted steps, of this iterate, and those predicted.
  void grow_scale(const Eigen::Ref<const Eigen::VectorXd> &u, const Eigen::Ref<const Eigen::VectorXd> &v, double h);

  bool is_held(int measure) const;

  /// Effect of a change of the forces on the measures, relative to their scales; for sticking measures the effect of
  /// their force. Forces that balance each other leave rounding errors of their separate effects, which matters if
  /// iterations do not end.
  /// @param part  receives the change relative to the largest forces
  double size_of(const StepTable &table, const Eigen::VectorXd &change, int iteration, double &part) const;

  /// Sum of the magnitudes by which all forces would move a measure, without cancellation.
  double of_all(const StepTable &table, int row) const;

  /// Whether I - S dp at the beginning of the step, without sticking elements, has no small or negative pivot.
  bool is_sound(const StepTable &table);

  void finish(const StepTable &table, LocalState &end);

  void find_defect(const LocalState &end);

  /// Updates the largest excursions of the measures and of their forces in the step.
  void reach(const LocalState &end);

  /// Computes error_ of the step, and the defect relative to the force.
  void estimate(const StepTable &table);

  /// Largest excursions of the measures, their forces, and the distance of the whole motion.
  struct Reach
  {
    Eigen::VectorXd u, p;
    double          way = 0.;
  };

  PropagationContext &context_;
  int                 s_, n_u_;
  ForceBasis          basis_;
  HermiteNodes        nodes_;
  Eigen::VectorXd     x_begin_, x_end_, free_, P_, P_last_, P_end_, residual_, defect_, defect_begin_;
  Eigen::VectorXd     mobile_; ///< remaining mobility of a measure while others stick [n_u]
  Eigen::VectorXd     scale_;  ///< of the measures in the current step [n_u]
  long                age_of_way_ = 0;
  Reach               reached_, expected_; ///< at the end of the current step; of a rejected one
  double              expected_until_ = 0.;
  int                 doubtful_       = 0;    ///< rejected steps from here with errors as large as their motion
  Eigen::VectorXd     largest_defect_;        ///< of the forces so far [n_u]
  double              defect_part_ = 1.;      ///< the largest of them, relative to the largest force
  const StepTable    *tried_       = nullptr; ///< of a step from the present begin
  Eigen::MatrixXd     U_, V_, dp_du_, dp_dv_, extrapolate_;
  TangentWork         tangent_;
  std::vector<double> at_begin_, at_end_;
  LocalState          begin_at_, node_;
  SmallLu             lu_, sound_;
  const StepTable    *factors_   = nullptr;
  double              factors_h_ = 0.;
  double              h_ = 0., h_last_ = 0., ratio_ = 0., error_ = 0.;
};

} // namespace gestell::coupling
