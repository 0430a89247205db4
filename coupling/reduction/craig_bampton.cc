#include "coupling/reduction/craig_bampton.h"

#include "coupling/integration/system/second_order_system.h"
#include "coupling/reduction/estimates/mode_selection.h"
#include "coupling/reduction/shapes/attachment_modes.h"
#include "coupling/reduction/shapes/fixed_interface_modes.h"
#include "coupling/reduction/shapes/free_interface_modes.h"
#include "coupling/reduction/shapes/residual_flexibility.h"
#include "fem/assembly/rigid_body_modes.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double suspiciously_low = 1e-5; // of the highest frequency: may be rounding
constexpr int    most_rounds      = 4;    // of finding modes that were missing

void require(bool condition, const ReductionOptions &options, const std::string &message)
{
  if (!condition)
    throw std::invalid_argument((options.place.empty() ? std::string("reduction") : options.place) + ": " + message);
}

void require_valid(const fem::FrameMatrices &frame, const std::vector<int> &q1, const ReductionOptions &options)
{
  const int n = int(frame.M.rows()), n2 = n - int(q1.size());
  require(n > 0, options, "the frame has no coordinates");
  for (const auto *A : {&frame.M, &frame.B, &frame.C})
    require(A->rows() == n && A->cols() == n, options,
            "M, B and C must be square and of one size; found " + std::to_string(A->rows()) + " x " +
                std::to_string(A->cols()) + " beside " + std::to_string(n) + " x " + std::to_string(n));
  require(frame.M.isCompressed() && frame.C.isCompressed() && frame.B.isCompressed(), options,
          "M, B and C must be compressed");
  require(q1.empty() || (q1.front() >= 0 && q1.back() < n), options, "an interface coordinate lies outside the frame");
  require(std::adjacent_find(q1.begin(), q1.end()) == q1.end(), options,
          "two interfaces share a coordinate; give each its own node");
  require(options.n_modes <= n2, options,
          std::to_string(options.n_modes) + " modes requested, but only " + std::to_string(n2) +
              " internal coordinates remain once the interface is held; ask for fewer modes or keep fewer interface "
              "points");
  require(options.n_modes >= 0 || options.tolerance > 0., options,
          "tolerance is " + std::to_string(options.tolerance) + "; the automatic number of modes needs one above zero");
  require(std::isfinite(options.frequency) && options.frequency >= 0., options,
          "frequency is " + std::to_string(options.frequency) + " Hz; it must be zero (automatic) or positive");
}

void tell(const Progress &progress, const char *phase)
{
  if (progress)
    progress(phase, -1.);
}

ReductionBasis basis_without_modes(const FixedInterfaceFrame &held, const fem::FrameMatrices &frame,
                                   const std::vector<int> &q1)
{
  ReductionBasis basis;
  basis.q1 = q1;
  basis.T  = held.constraint_modes();
  symmetric_product(frame.M, basis.T, basis.M_Psi);
  return basis;
}

/// Load of a unit acceleration field in x, y, z.
MatrixXd acceleration_load(const fem::FrameMatrices &frame)
{
  return frame.acceleration_load.rows() > 0 ? frame.acceleration_load : symmetric_product(frame.M, frame.translations);
}

/// Interfaces with their coordinates counted in p.
std::vector<fem::Interface> renumbered(std::vector<fem::Interface> interfaces, const std::vector<int> &q1)
{
  for (auto &interface : interfaces)
    for (int &i : interface.coordinate)
      if (i >= 0)
        i = int(std::lower_bound(q1.begin(), q1.end(), i) - q1.begin());
  return interfaces;
}

/// What the modes leave out of the static deflection of q2 under loads f [n x k]:  C22^-1 f2 - V22 diag(1/omega_0^2)
/// V22^T f2.
struct StaticRemainder
{
  MatrixXd deflection;    // [n x k], zero in q1
  double   relative = 0.; ///< of the energy norm of C22^-1 f2; the worst load
};

StaticRemainder static_remainder(const MatrixXd &deflection, const ReductionBasis &basis, const MatrixXd &load)
{
  MatrixXd f2 = load;
  for (const int i : basis.q1)
    f2.row(i).setZero();
  StaticRemainder remainder{deflection};
  const VectorXd  energy    = (f2.array() * remainder.deflection.array()).colwise().sum();
  const auto      stiffness = basis.omega0.array().square().matrix();
  const MatrixXd  modal     = stiffness.asDiagonal().inverse() * (basis.fixed_modes().transpose() * f2);
  remainder.deflection -= basis.fixed_modes() * modal;
  const VectorXd left = (f2.array() * remainder.deflection.array()).colwise().sum();
  for (int d = 0; d < load.cols(); ++d)
    if (energy(d) > 0.)
      remainder.relative = std::max(remainder.relative, std::sqrt(std::max(0., left(d) / energy(d))));
  return remainder;
}

/// One column at a time: the stresses of the whole basis in double precision would be the largest thing in memory.
void add_stress(ReducedStress &reduced, const fem::StressRecovery &stress, const MatrixXd &T, const MatrixXd &remainder)
{
  if (stress.empty())
    return;
  reduced.point     = stress.point;
  reduced.triangles = stress.triangles;
  reduced.rigid     = stress.rigid;
  reduced.beside    = stress.beside;
  const auto add    = [&](fem::StressOf which, Eigen::MatrixXf &to)
  {
    to.setZero(fem::stress_components * Eigen::Index(stress.point.size()), T.cols() + 3);
    for (Eigen::Index j = 0; j < T.cols(); ++j)
      to.col(j) = fem::stresses(stress, T.col(j), which).cast<float>();
    for (Eigen::Index j = 0; j < remainder.cols(); ++j)
      to.col(T.cols() + j) = fem::stresses(stress, remainder.col(j), which).cast<float>();
  };
  add(fem::StressOf::mean, reduced.mean);
  add(fem::StressOf::deviation, reduced.deviation);
}

/// B* += P diag(2 zeta omega) P^T for as many refined modes as the model has coordinates.
void add_modal_damping(MatrixXd &B, const RefinedModes &refined, const fem::ModalRatios &zeta)
{
  const auto n = B.rows(), p = std::min<Eigen::Index>(refined.omega.size(), n);
  const auto P = refined.P.topLeftCorner(n, p);
  B += P * zeta.modal_dampers(refined.omega.head(p)).asDiagonal() * P.transpose();
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
  Q.topRows(n1) = Eigen::HouseholderQR<MatrixXd>(R1).householderQ() * MatrixXd::Identity(n1, k);
  C             = (C - Q * (Q.transpose() * C)).eval();
  C             = (C - (C * Q) * Q.transpose()).eval();
  C             = (0.5 * (C + C.transpose())).eval();
  if (k < n1)
    return;
  C.topRows(n1).setZero(); // every motion of the interface is rigid
  C.leftCols(n1).setZero();
}

/// The full frame knows how many motions are free: where one interface alone would hold it, all of C*_11 is rounding.
void name_free_motions(ReducedFrame &reduced, const fem::FrameMatrices &frame, const std::vector<int> &q1)
{
  VectorXd &frequencies = reduced.frequencies_hz;
  if (frequencies.size() == 0 || frequencies(0) > suspiciously_low * frequencies.maxCoeff())
    return;
  reduced.facts.free_motions = fem::free_motions(frame, {});
  free_rigid_motions(reduced.C, frame, q1);
  frequencies.head(std::min(frequencies.size(), Eigen::Index(reduced.facts.free_motions.size()))).setZero();
}

/// @param static_beyond_modes  [n x 3] deflection per unit acceleration that the basis lacks, or empty.
void describe(ReducedFrame &reduced, const fem::FrameMatrices &frame, const ReductionBasis &basis,
              const MatrixXd &static_beyond_modes)
{
  reduced.interfaces  = renumbered(frame.interfaces, basis.q1);
  reduced.n_interface = basis.n1();
  reduced.omega0      = basis.omega0;
  for (const auto &output : frame.outputs)
  {
    auto row = output;
    row.on_q = basis.T.transpose() * output.on_q;
    row.on_v = basis.T.transpose() * output.on_v;
    if (static_beyond_modes.cols() > 0)
      row.under_acceleration += static_beyond_modes.transpose() * output.on_q;
    reduced.outputs.push_back(row);
  }
  reduced.points    = frame.picture.points;
  reduced.triangles = frame.picture.triangles;
  if (frame.picture.displacement.rows() > 0)
    reduced.displacement = (frame.picture.displacement * basis.T).cast<float>();
  reduced.facts = frame.facts;
  name_free_motions(reduced, frame, basis.q1);
  reduced.n_full  = int(frame.M.rows());
  reduced.n_cells = frame.n_cells;
  reduced.mass    = frame.mass;
}

} // namespace

ReductionBasis craig_bampton_basis(const fem::FrameMatrices &frame, int n_modes)
{
  ReductionOptions options;
  options.n_modes = std::max(0, n_modes);
  const auto q1   = frame.interface_coordinates();
  require_valid(frame, q1, options);
  FixedInterfaceFrame held(frame, q1);
  ReductionBasis      basis = basis_without_modes(held, frame, q1);
  FixedInterfaceModes fixed(held, frame, q1);
  const LowestModes   modes = fixed.find_all(options.n_modes);
  basis.set_modes(modes.V, modes.omega);
  return basis;
}

ReducedFrame craig_bampton(const fem::FrameMatrices &frame, const ReductionOptions &options, const Progress &progress)
{
  return craig_bampton_with_basis(frame, options, progress).frame;
}

namespace
{

/// What of the reduction does not depend on the modes.
struct Statics
{
  MatrixXd            load; // [n x 3] of a unit acceleration, or [n x 0]
  ResidualFlexibility response;
  FreeModes           free;   // if they are asked for
  MatrixXd            relief; // shapes [n x 6, 3 or 0]
};

/// A basis with all its shapes, and what is known of the modes of the supported frame.
struct Shapes
{
  ReductionBasis  basis;
  ReducedMatrices star;
  RefinedModes    refined, damped; // for the estimate of the error, and for modal damping
  double          limit;           // [rad/s] highest frequency the model is meant for
  std::string statement{}; // that the modes do what is asked; empty: nothing is known, or a note tells what they leave
};

/// Of modes that end below the highest frequency of interest.
void warn_of_few_modes(const ReductionBasis &basis, int n, const ReductionOptions &options,
                       std::vector<std::string> &notes)
{
  const int    m       = basis.m();
  const double highest = m > 0 ? basis.omega0(m - 1) / two_pi : 0.;
  if (options.frequency <= highest || m == n - basis.n1())
    return;
  notes.push_back("reduction: " +
                  (m == 0 ? std::string("no fixed-interface modes are kept")
                          : "the highest of the " + std::to_string(m) + " fixed-interface modes kept has " +
                                rounded(highest) + " Hz") +
                  ", but frequency = " + rounded(options.frequency) +
                  " Hz: near and above the highest the model does not hold, and its error there is not known; ask for "
                  "more modes, or leave modes out, so that the tolerance chooses their number");
}

/// @param basis with its constraint modes.
Shapes held_shapes(ReductionBasis basis, const Statics &statics, const FixedInterfaceFrame &held,
                   FixedInterfaceModes &fixed, const fem::FrameMatrices &frame, const ReductionOptions &options,
                   const Progress &progress, std::vector<std::string> &notes)
{
  Shapes   shapes{std::move(basis), {}, {}, {}, 0.};
  MatrixXd more = statics.relief;
  if (options.n_modes < 0)
  {
    auto enough      = select_modes(shapes.basis, held, fixed, statics.response, frame, options, progress, notes);
    shapes.refined   = std::move(enough.refined);
    shapes.statement = std::move(enough.statement);
    more.resize(frame.M.rows(), enough.shapes.cols() + statics.relief.cols());
    more << enough.shapes, statics.relief;
  }
  else
  {
    tell(progress, "fixed-interface modes");
    fixed.find(options.n_modes);
    fixed.finish();
    shapes.basis.set_modes(fixed.found().V.leftCols(options.n_modes), fixed.found().omega.head(options.n_modes));
  }
  tell(progress, "reduced matrices");
  shapes.star = reduced_matrices(shapes.basis, frame.B, frame.C);
  if (options.n_modes >= 0)
    shapes.refined = refined_modes(shapes.basis, shapes.star, statics.response, frame);
  const int m = shapes.basis.m();
  if (options.n_modes >= 0 && options.frequency > 0. && shapes.basis.n1() > 0 && m > 0 &&
      two_pi * options.frequency < shapes.basis.omega0(m - 1))
  {
    const InterfaceReceptance receptance(shapes.basis, shapes.star, statics.response, shapes.refined,
                                         frame.modal_damping_ratio, two_pi * options.frequency);
    shapes.statement = receptance_statement(receptance, shapes.basis, frame.interfaces, {m}, options.frequency);
    if (has_inner_dampers(shapes.basis, frame.B))
      notes.push_back(std::exchange(shapes.statement, "") +
                      "; dampers inside the frame are left out of this: leave modes out, and shapes for them join");
  }
  if (options.n_modes >= 0)
    warn_of_few_modes(shapes.basis, int(frame.M.rows()), options, notes);
  shapes.damped = shapes.refined;
  shapes.limit  = highest_of_interest(options, shapes.refined);
  if (append_attachment_modes(shapes.basis, frame, std::move(more)) > 0)
  {
    shapes.star   = reduced_matrices(shapes.basis, frame.B, frame.C);
    shapes.damped = ritz_modes(shapes.star, shapes.refined.n_rigid);
  }
  return shapes;
}

Shapes free_shapes(ReductionBasis basis, const Statics &statics, const fem::FrameMatrices &frame,
                   const ReductionOptions &options)
{
  Shapes   shapes{std::move(basis), {}, {}, {}, 0.};
  MatrixXd W(frame.M.rows(), statics.free.W.cols() + statics.relief.cols());
  W << statics.free.W, statics.relief;
  append_attachment_modes(shapes.basis, frame, std::move(W));
  shapes.star          = reduced_matrices(shapes.basis, frame.B, frame.C);
  shapes.damped        = ritz_modes(shapes.star, statics.free.n_rigid);
  const auto   kept    = std::min(statics.free.omega.size(), shapes.damped.omega.size());
  const double highest = kept > 0 ? statics.free.omega[kept - 1] : 0.;
  shapes.limit         = std::min(highest, highest_of_interest(options, shapes.damped));
  shapes.refined = {shapes.damped.n_rigid, shapes.damped.omega.head(kept), shapes.damped.P.leftCols(kept)}; // exact
  return shapes;
}

Reduction reduce(Shapes shapes, const std::vector<std::string> &notes, const Statics &statics,
                 const fem::FrameMatrices &frame)
{
  const ReductionBasis &basis = shapes.basis;
  ReducedMatrices      &star  = shapes.star;
  ReducedFrame          reduced;
  reduced.notes      = frame.notes;
  reduced.statements = frame.statements;
  reduced.notes.insert(reduced.notes.end(), notes.begin(), notes.end());
  if (!shapes.statement.empty())
    reduced.statements.push_back(shapes.statement);
  const auto estimate        = frequency_estimate(star, basis.n1(), basis.m(), shapes.refined);
  reduced.frequencies_hz     = estimate.omega / two_pi;
  reduced.frequency_error    = estimate.error;
  reduced.frequency_limit_hz = shapes.limit / two_pi;
  if (frame.modal_damping_ratio.any())
    add_modal_damping(star.B, shapes.damped, frame.modal_damping_ratio);

  reduced.M = star.M;
  reduced.B = star.B;
  reduced.C = star.C;
  MatrixXd static_beyond_modes;
  if (statics.load.cols() > 0)
  {
    reduced.translations_load = basis.T.transpose() * statics.load;
    const auto remainder      = static_remainder(statics.response.loads, basis, statics.load);
    reduced.static_residual   = remainder.relative;
    static_beyond_modes       = remainder.deflection;
  }
  else
    reduced.translations_load = MatrixXd::Zero(basis.T.cols(), 3);
  describe(reduced, frame, basis, static_beyond_modes);
  add_stress(reduced.stress, frame.stress, basis.T, static_beyond_modes);
  return {std::move(reduced), std::move(shapes.basis)};
}

} // namespace

Reduction craig_bampton_with_basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                                   const Progress &progress)
{
  const auto q1 = frame.interface_coordinates();
  require_valid(frame, q1, options);
  tell(progress, "factorisation");
  FixedInterfaceFrame held(frame, q1, options.eigensolver);
  tell(progress, "constraint modes");
  ReductionBasis basis = basis_without_modes(held, frame, q1);
  Statics        statics{frame.translations.rows() > 0 ? acceleration_load(frame) : MatrixXd(frame.M.rows(), 0),
                  {},
                  {VectorXd(0), MatrixXd(frame.M.rows(), 0), {}},
                  MatrixXd(frame.M.rows(), 0)};
  statics.response = residual_flexibility(held, basis, frame.M, statics.load);
  if (options.inertia_relief)
    statics.relief = inertia_relief_shapes(held, frame, q1);
  if (options.inner == InnerModes::interface_free)
  {
    tell(progress, "modes with the interface free");
    statics.free = free_modes(basis, held, frame, options);
    tell(progress, "reduced matrices");
    Reduction reduced = reduce(free_shapes(std::move(basis), statics, frame, options), {}, statics, frame);
    if (!statics.free.statement.empty())
      reduced.frame.statements.push_back(statics.free.statement);
    return reduced;
  }
  FixedInterfaceModes fixed(held, frame, q1);
  for (int round = 0; round < most_rounds; ++round)
  {
    std::vector<std::string> notes;
    Shapes    shapes  = held_shapes(std::move(basis), statics, held, fixed, frame, options, progress, notes);
    Reduction reduced = reduce(std::move(shapes), std::move(notes), statics, frame);
    tell(progress, "count of the modes");
    if (!fixed.confirm())
    {
      basis = std::move(reduced.basis);
      continue;
    }
    if (!fixed.statement().empty())
      reduced.frame.statements.push_back(fixed.statement());
    return reduced;
  }
  throw ConvergenceFailure(
      "reduction: in " + std::to_string(most_rounds) +
      " rounds some fixed-interface modes were missing each time; ask for another number of modes");
}

void add_modal_damping(fem::FrameMatrices &frame, int n_modes, const Progress &progress)
{
  const int n = int(frame.M.rows());
  if (n_modes < 0 || n_modes > n)
    throw std::invalid_argument("add_modal_damping: " + std::to_string(n_modes) + " modes requested of a frame with " +
                                std::to_string(n) + " coordinates; ask for 0 to " + std::to_string(n));
  if (const auto motions = fem::free_motions(frame, {}); !motions.empty())
    throw std::invalid_argument(
        "modal damping: the frame floats (" + std::to_string(motions.size()) + " motions are free, one of them " +
        motions[0] +
        "), and an unreduced frame is damped by the modes of a supported one; support it, reduce it "
        "(reduction.method = \"craig-bampton\"), or damp it by rayleigh");
  tell(progress, "factorisation");
  FixedInterfaceFrame free_frame(frame, {});
  tell(progress, "modes of the supported frame");
  FixedInterfaceModes fixed(free_frame, frame, {});
  const LowestModes   modes = fixed.find_all(n_modes);
  frame.modal_damping.Z     = symmetric_product(frame.M, modes.V);
  frame.modal_damping.d     = frame.modal_damping_ratio.modal_dampers(modes.omega);
}

} // namespace gestell::coupling
