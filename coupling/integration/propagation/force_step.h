#pragma once

#include "coupling/integration/propagation/force_rule.h"
#include "coupling/integration/propagation/propagation_tables.h"
#include "coupling/integration/step/implicit_step.h"
#include "coupling/integration/system/motion_tangents.h"
#include "coupling/integration/system/small_lu.h"

#include <memory>

namespace gestell::coupling
{

class StateArchive;

/// Common data of the steps of exact propagation: the system, its measures in modes, scales and counters.
struct PropagationContext
{
  const SecondOrderSystem *system = nullptr;
  ModalMeasures            measures;
  NewtonOptions            newton{};
  Eigen::VectorXd          u_begin, scale;       ///< [n_u] largest excursion of every measure so far
  Eigen::VectorXd          force;                ///< [n_u] largest force so far
  double                   error_tolerance = 0.; ///< 0: steps are fixed
  double                   farthest        = 0.; ///< largest way() so far, for methods with error control
  double                   loads_way       = 0.; ///< way() predicted from future loads
  IntegrationWork          work;

  Eigen::MatrixXd mobility;      ///< u'' of a force p: read_v^T put = W^T M^-1 W [n_u x n_u]
  Eigen::VectorXd root_mobility; ///< sqrt of its diagonal: u_j is at most that times the energy norm of a motion [n_u]

  PropagationContext(const SecondOrderSystem &system, const ModalBlocks &modes, const NewtonOptions &newton);

  /// Starts a motion at x, u.
  void begin(const Eigen::VectorXd &x, const Eigen::VectorXd &u);
  /// Distance of the motion at x: min(|q - q_begin|, |q' - q'_begin|/omega_1), where |q|^2 sums q^T M q of all states.
  double way(const Eigen::VectorXd &x) const;

  /// Updates the largest excursion; lower bounds: the distance in one step, and the rounding of u.
  void grow_scale(Eigen::VectorXd &grown, const Eigen::Ref<const Eigen::VectorXd> &u,
                  const Eigen::Ref<const Eigen::VectorXd> &v, double h) const;

  /// u'' = read_v^T (Lambda x + constant) + W^T M^-1 W p into local.a; local.p of sticking measures becomes the force
  /// that makes their u'' zero.
  void accelerate(const Eigen::VectorXd &x, LocalState &local);
  /// Remaining mobility of each measure while others stick, relative to its own: 0 for a sticking measure.
  void mobile_parts(double t, Eigen::VectorXd &part);
  /// Lambda x [2 n_p].
  void free_rates(const double *x, double *rate) const;
  /// Derivatives of the results of accelerate(): u'' and p into `local`, whose p contains those of laws.
  void accelerate_tangents(const Eigen::MatrixXd &X, double t, LocalTangents &local);
  /// Derivative of project_held(): sticking measures have no variation.
  void project_held_tangents(double t, Eigen::MatrixXd &X);
  /// Applies to x and local.v the impulse that gives sticking measures exactly their rate: collocation satisfies it
  /// only at its nodes.
  void project_held(Eigen::VectorXd &x, LocalState &local);

  void exchange(StateArchive &archive); ///< data collected from the motion

private:
  void factorise_delassus(double t);

  Eigen::VectorXd rate_, rest_;
  SmallLu         delassus_;
  Eigen::VectorXd x_begin_, mass_of_q_, mass_of_v_; ///< q^T M q and q'^T M q' of unit states [2 n_p]
  double          time_;                            ///< 1/omega_1 of the slowest mode [s]; infinite if none oscillates
};

/**
 * One step of exact propagation: x(t_k + h) and the forces over the step, which are unknown.
 *
 *     begin(x, local)      a piece starts at x with the motion and forces of `local`
 *     solve(table, end)    tries a step from there; may be repeated with another table
 *     accept()             the next step starts at the end of the last one tried
 */
class ForceStep
{
public:
  virtual ~ForceStep() = default;

  virtual const ForceBasis &basis() const                                         = 0;
  virtual void              begin(const Eigen::VectorXd &x, const LocalState &at) = 0;
  /// u, v, p at the end of the step; false: Newton did not converge.
  virtual bool solve(const StepTable &table, LocalState &end) = 0;
  virtual void accept()                                       = 0;
  virtual void begin_state(Eigen::VectorXd &x) const          = 0;
  virtual void end_state(Eigen::VectorXd &x) const            = 0;
  /// Largest local error of a measure in the step solved last, relative to its scale.
  virtual double error() const { return 0.; }
  /// Order of error() in h.
  virtual int error_order() const { return 1; }
  /// u, v, p inside the step solved last, sigma in [0, 1].
  virtual void interpolate(double sigma, LocalState &state) const = 0;
  /// Relative error of interpolate() for a free motion whose phase advances by `phase` [rad] in the step; at most 1.
  virtual double interpolation_error(double /*phase*/) const { return 0.; }
  /// p_j of the basis in the step solved last [n_basis n_u].
  virtual void forces(Eigen::VectorXd &p) const = 0;
  /// dx/ds [2 n_p x k] at the beginning of the last step becomes that at its end.
  /// @throws std::invalid_argument for a rule without tangents
  virtual void carry_tangents(Eigen::MatrixXd &X) = 0;
  /// The complete state for later steps.
  /// @param tables  all tables that steps may have used, in a fixed order
  virtual void exchange(StateArchive &archive, const std::vector<const StepTable *> &tables) = 0;
};

/// Stores a table as its index in the list; null as the end of the list.
void exchange_table(StateArchive &archive, const std::vector<const StepTable *> &tables, const StepTable *&table);

std::unique_ptr<ForceStep> make_collocation_step(PropagationContext &context, int stages);
/// Linear force or step-averaged force.
std::unique_ptr<ForceStep> make_fused_step(PropagationContext &context, ForceRule rule);

/// Hermite's interpolation of u, v through nodes sigma_i of a step, at which both are known.
class HermiteNodes
{
public:
  explicit HermiteNodes(std::vector<double> sigma = {});
  /// Weights of values and slopes (in sigma) for the value and its slope at sigma; each [n nodes].
  void weights(double sigma, double *value, double *slope, double *rate_value, double *rate_slope) const;
  int  size() const { return static_cast<int>(sigma_.size()); }
  /// Largest error of the slope of a sine whose phase advances by `phase` [rad] from sigma 0 to 1, relative to its own;
  /// that of the value is smaller:  phase^(2 n - 1)/(2 n)! max |d/dsigma prod (sigma - sigma_i)^2|.
  double error(double phase) const;

  static constexpr int max_nodes = 8;

private:
  std::vector<double> sigma_, inverse_, own_slope_; ///< 1/prod (sigma_i - sigma_j), L_i'(sigma_i)
  double              error_ = 0.;                  ///< of error(1)
};

} // namespace gestell::coupling
