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
 * is carried exactly in its modes, and it closes by itself: x(t_0 + T) = x(t_0) gives x(t_0) for any forces,
 *
 *     x_0 = (E - e^(Lambda T))^-1 sum_i e^(Lambda (T - t_i+1)) (in_i P_i + c_i),
 *
 * so that the measures at all Gauss points are an affine function of the forces there,
 *
 *     u = u_0 + G_u P,   u' = v_0 + G_v P     [N s n_u],       P = p(t, u, u'),
 *
 * and only P is unknown, however many modes there are.  Where a motion of the base repeats by itself, as that of a mass
 * between stops, its two states at t_0 are unknown too, and its closing is an equation.  Order 2 s at the mesh points.
 *
 * Source of the method: Ascher, Mattheij, Russell, Numerical Solution of Boundary Value Problems, 1995, chapter 5.
 */
class PeriodicCollocation
{
public:
  static constexpr int stages = 4;

  /// @throws std::invalid_argument as modal_blocks()
  explicit PeriodicCollocation(const PeriodicProblem &problem);

  /// Mesh points as shares of the period, 0 and 1 the ends, ascending.
  void                       set_mesh(const std::vector<double> &mesh);
  const std::vector<double> &mesh() const { return mesh_; }

  /// Unknowns of forces at the Gauss points and a start q, q' [n].
  Eigen::VectorXd unknowns(const Eigen::VectorXd &forces, const Eigen::VectorXd &q, const Eigen::VectorXd &v) const;
  /// Newton's method from P, and free states behind them, which become the solution; the number of its iterations.
  /// @throws NoPeriodicMotion if it does not converge
  int solve(Eigen::VectorXd &P, const PeriodicOptions &options);
  /// Forces of another mesh at the Gauss points of this one.
  Eigen::VectorXd carried_over(const std::vector<double> &mesh, const Eigen::VectorXd &P) const;
  /// By interval: what the defect of the forces at its ends would move the measures, of their largest excursions.
  Eigen::VectorXd errors(const Eigen::VectorXd &P);
  /// q, q' [n] at t_0.
  void state_at_begin(const Eigen::VectorXd &P, Eigen::VectorXd &q, Eigen::VectorXd &v) const;

  int n_unknowns() const { return int(G_u_.cols()); }

private:
  void   close(Eigen::MatrixXd &X);
  double closing_determinant(Eigen::Index block) const;
  void   read_measures();
  void   evaluate(const Eigen::VectorXd &y, Eigen::VectorXd &r, Eigen::MatrixXd *J);
  int    n_intervals() const { return int(tables_.size()); }

  const PeriodicProblem    &problem_;
  ModalBlocks               modes_;
  ModalMeasures             measures_;
  ForceBasis                basis_;
  int                       n_u_;
  std::vector<double>       mesh_;
  std::vector<StepTable>    tables_;
  StepTable                 whole_;     ///< of the period
  std::vector<Eigen::Index> free_;      ///< states of x that are unknowns
  Eigen::MatrixXd           closing_;   ///< their equations closing_ (P; x_free; 1) = 0
  Eigen::MatrixXd           start_;     ///< x_0 = start_ (P; x_free; 1)
  Eigen::MatrixXd           G_u_, G_v_; ///< [N s n_u x unknowns]
  Eigen::VectorXd           u_0_, v_0_;
  LocalState                node_;
};

} // namespace gestell::coupling
