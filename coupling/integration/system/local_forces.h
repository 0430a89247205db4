#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCore>

#include <string>
#include <vector>

namespace gestell::coupling
{

class SecondOrderSystem;

/// Motion of all local measures u = W^T q at one instant, and the forces conjugate to them.
struct LocalState
{
  double          t = 0.;
  Eigen::VectorXd u, v, a; // [n_u]
  Eigen::VectorXd p;       // [n_u]
  Eigen::VectorXd lambda;  // [n_c] multipliers of ideal joints, p = G^T lambda on their measures

  void resize(const SecondOrderSystem &system); ///< to zero
  void resize(Eigen::Index n_u);                ///< for a system without ideal joints
};

/// A measure that sticks: its rate is u' = rate, and its force p is the unknown.
struct HeldMeasure
{
  int    measure;
  double rate;
};

/// The measures of one force element: its block of dp/du.
struct ForceBlock
{
  int    first_measure, n_measures;
  double size = 0.; ///< size of the numbers [m, rad] whose difference determines the force; 0: only u itself
};

/// Total number of entries in all blocks of dp/du.
Eigen::Index tangent_size(const std::vector<ForceBlock> &blocks);

/// W p, the forces of the elements in their measures u = W^T q: p = p(t, u, u', u'', history), nonlinear and block
/// diagonal, a few measures per element.
class LocalForces
{
public:
  virtual ~LocalForces() = default;

  /// W [n x n_u], constant.
  virtual const Eigen::SparseMatrix<double> &directions() const                                       = 0;
  virtual void                               force(const LocalState &state, Eigen::VectorXd &p) const = 0;
  /// p [n_u] and  w_u dp/du + w_v dp/dv + w_a dp/da  [n_u x n_u], block diagonal by element. Rows of sticking measures
  /// are unchanged.
  virtual void tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                       Eigen::MatrixXd &dp) const = 0;
  /// p [n_u], dp/du and dp/dv [n_u x n_u], block diagonal by element: only the blocks are written.
  virtual void derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                           Eigen::MatrixXd &dp_dv) const = 0;
  /// The force elements, without joints, in the order of tangent_blocks().  Default: one with all measures.
  virtual std::vector<ForceBlock> blocks() const;
  /// Like tangent(), but only the blocks of dp, column by column, one after the other; that of a sticking measure is
  /// zero.  The default calls tangent() and allocates.
  virtual void tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                              Eigen::VectorXd &blocks) const;
  /// Sticking measures of the active branches; changed by EventSystem.
  virtual const std::vector<HeldMeasure> &held() const;
  /// Name in the scene of the element that owns a measure, for messages.  Default: "an element".
  virtual std::string element_of(int) const { return "an element"; }
  /// Whether forces depend on the multipliers of joints (friction in them), which depend on forces: a start iterates.
  virtual bool need_multipliers() const { return false; }
};

} // namespace gestell::coupling
