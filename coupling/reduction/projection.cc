#include "coupling/reduction/projection.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/reduction/shapes/interface_statics.h"
#include "fem/assembly/rigid_body_modes.h"
#include "fem/assembly/rigid_motions.h"

#include <algorithm>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Interfaces with their coordinates counted in p.
std::vector<fem::Interface> renumbered(std::vector<fem::Interface> interfaces, const std::vector<int> &q1)
{
  for (auto &interface : interfaces)
    interface.renumber([&](int i) { return int(std::lower_bound(q1.begin(), q1.end(), i) - q1.begin()); });
  return interfaces;
}

/// One column at a time: the stresses of the whole basis in double precision would be the largest thing in memory.
void add_stress(ReducedStress &reduced, const fem::StressRecovery &stress, const MatrixXd &T, const MatrixXd &remainder)
{
  if (stress.empty())
    return;
  reduced.point     = stress.point;
  reduced.triangles = stress.triangles;
  reduced.rigid     = stress.rigid;
  reduced.nearby    = stress.nearby;
  const auto add    = [&](fem::StressOf which, Eigen::MatrixXf &to)
  {
    to.setZero(fem::stress_components * Eigen::Index(stress.point.size()), T.cols() + 3);
    for (Eigen::Index j = 0; j < T.cols(); ++j)
      to.col(j) = fem::stresses(stress, T.col(j), which).cast<float>();
    MatrixXd under_g = fem::stresses(stress, remainder, which);
    if (const MatrixXd direct = fem::stresses_under_acceleration(stress, which); direct.size() > 0)
      under_g = under_g.cols() > 0 ? MatrixXd(under_g + direct) : direct;
    to.middleCols(T.cols(), under_g.cols()) = under_g.cast<float>();
  };
  add(fem::StressOf::mean, reduced.mean);
  add(fem::StressOf::deviation, reduced.deviation);
}

void project_outputs(ReducedFrame &reduced, const fem::FrameMatrices &frame, const MatrixXd &T, const MatrixXd &beyond)
{
  for (const auto &output : frame.outputs)
  {
    auto row = output;
    row.on_q = T.transpose() * output.on_q;
    row.on_v = T.transpose() * output.on_v;
    if (output.on_a.size() > 0)
      row.on_a = T.transpose() * output.on_a;
    if (beyond.cols() > 0)
      row.under_acceleration += beyond.transpose() * output.on_q;
    reduced.outputs.push_back(row);
  }
}

void project_picture(ReducedFrame &reduced, const fem::Picture &picture, const MatrixXd &T)
{
  reduced.points    = picture.points;
  reduced.triangles = picture.triangles;
  if (picture.displacement.rows() > 0)
    reduced.displacement = (picture.displacement * T).cast<float>();
}

/// Takes out of C* what rounding left along the rigid motions [R_1; 0] of the frame: C* <- (E - Q Q^T) C* (E - Q Q^T).
/// Without it a machine that floats would swing or drift on it.
void free_rigid_motions(MatrixXd &C, const fem::FrameMatrices &frame, const std::vector<int> &q1)
{
  const MatrixXd R1 = fem::free_displacements(frame)(q1, Eigen::all);
  const auto     n1 = R1.rows(), k = R1.cols();
  if (k == 0 || k > n1)
    return;
  MatrixXd Q    = MatrixXd::Zero(C.rows(), k);
  Q.topRows(n1) = orthonormal_columns(R1, k);
  C             = (C - Q * (Q.transpose() * C)).eval();
  C             = (C - (C * Q) * Q.transpose()).eval();
  C             = (0.5 * (C + C.transpose())).eval();
  if (k < n1)
    return;
  C.topRows(n1).setZero(); // every motion of the interface is rigid
  C.leftCols(n1).setZero();
}

} // namespace

ReducedFrame project(const fem::FrameMatrices &frame, const ReductionBasis &basis, ReducedMatrices star,
                     const MatrixXd &load, const MatrixXd &beyond)
{
  ReducedFrame reduced;
  reduced.M                 = std::move(star.M);
  reduced.B                 = std::move(star.B);
  reduced.C                 = std::move(star.C);
  reduced.translations_load = MatrixXd::Zero(basis.T.cols(), 3);
  if (load.cols() > 0)
    reduced.translations_load = basis.T.transpose() * load;
  reduced.interfaces  = renumbered(frame.interfaces, basis.q1);
  reduced.n_interface = basis.n1();
  reduced.omega0      = basis.omega0;
  project_outputs(reduced, frame, basis.T, beyond);
  project_picture(reduced, frame.picture, basis.T);
  add_stress(reduced.stress, frame.stress, basis.T, beyond);
  reduced.facts   = frame.facts;
  reduced.n_full  = int(frame.M.rows());
  reduced.n_cells = frame.n_cells;
  reduced.mass    = frame.mass;
  return reduced;
}

void balance_forces(ReducedFrame &reduced, const fem::FrameMatrices &frame, const FixedInterfaceFrame &held,
                    const ReductionBasis &basis, const MatrixXd &answers)
{
  const std::vector<std::size_t> which = force_outputs(frame.outputs);
  if (which.empty())
    return;
  MatrixXd modal(basis.m(), answers.cols()); // V22^T r_2
  for (std::size_t k = 0; k < which.size(); ++k)
    modal.col(Eigen::Index(k)) = basis.fixed_modes().transpose() * frame.outputs[which[k]].on_q;
  const MatrixXd z    = answers - basis.fixed_modes() * basis.omega0.cwiseAbs2().cwiseInverse().asDiagonal() * modal;
  const MatrixXd on_a = basis.T.transpose() * held.mass_times(z),
                 on_v = basis.T.transpose() * symmetric_product(frame.B, z);
  for (std::size_t k = 0; k < which.size(); ++k)
  {
    fem::FrameOutput &row = reduced.outputs[which[k]];
    if (row.on_a.size() == 0)
      row.on_a.setZero(on_a.rows());
    row.on_a -= on_a.col(Eigen::Index(k));
    row.on_v -= on_v.col(Eigen::Index(k));
  }
}

void name_free_motions(ReducedFrame &reduced, const fem::FrameMatrices &frame, const FixedInterfaceFrame &held,
                       const std::vector<int> &q1)
{
  VectorXd        &frequencies      = reduced.frequencies_hz;
  constexpr double suspiciously_low = 1e-5; // of the highest frequency: below, its square may be rounding
  if (frequencies.size() == 0 || frequencies(0) > suspiciously_low * frequencies.maxCoeff())
    return;
  held.take_back();
  reduced.facts.free_motions = fem::free_motions(frame, {});
  free_rigid_motions(reduced.C, frame, q1);
  frequencies.head(std::min(frequencies.size(), Eigen::Index(reduced.facts.free_motions.size()))).setZero();
}

} // namespace gestell::coupling
