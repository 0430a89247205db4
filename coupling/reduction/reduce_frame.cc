#include "coupling/reduction/reduce_frame.h"

#include "coupling/reduction/estimate.h"
#include "coupling/reduction/mode_ratios.h"
#include "coupling/reduction/projection.h"
#include "coupling/reduction/reductions.h"
#include "coupling/reduction/shapes/attachment_modes.h"
#include "coupling/reduction/shapes/interface_statics.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;

void require(bool condition, const ReductionOptions &options, const std::string &message)
{
  if (!condition)
    throw std::invalid_argument((options.place.empty() ? std::string("reduction") : options.place) + ": " + message);
}

void require_valid(const fem::FrameMatrices &frame, const std::vector<int> &q1, const ReductionOptions &options)
{
  const int n = int(frame.M.rows()), n2 = n - int(q1.size());
  require(n > 0, options, "the frame has no DOFs");
  for (const auto *A : {&frame.M, &frame.B, &frame.C})
    require(A->rows() == n && A->cols() == n, options,
            "M, B and C must be square and of equal size; found " + std::to_string(A->rows()) + " x " +
                std::to_string(A->cols()) + " and " + std::to_string(n) + " x " + std::to_string(n));
  require(frame.M.isCompressed() && frame.C.isCompressed() && frame.B.isCompressed(), options,
          "M, B and C must be compressed");
  require(q1.empty() || (q1.front() >= 0 && q1.back() < n), options, "an interface DOF is not in the frame");
  require(std::adjacent_find(q1.begin(), q1.end()) == q1.end(), options,
          "two interfaces share a DOF; give each its own node");
  require(options.n_modes <= n2, options,
          std::to_string(options.n_modes) + " modes requested, but only " + std::to_string(n2) +
              " internal DOFs remain with the interface fixed; request fewer modes or fewer interfaces");
  require(options.n_modes >= 0 || options.tolerance > 0., options,
          "tolerance is " + std::to_string(options.tolerance) +
              "; the automatic number of modes needs a tolerance above zero");
  require(std::isfinite(options.frequency) && options.frequency >= 0., options,
          "frequency is " + std::to_string(options.frequency) + " Hz; it must be zero (automatic) or positive");
}

BasisFunction &basis_function(const ReductionOptions &options)
{
  BasisFunction *const function = Reductions::basis(options.method);
  require(function, options, "'" + options.method + "' is not a reduction method");
  return *function;
}

MatrixXd side_by_side(const MatrixXd &A, const MatrixXd &B)
{
  MatrixXd both(B.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}

/// Attachment modes join the basis.
/// @return whether there are any.
bool complete(ReductionSpace &space, const InterfaceStatics &statics)
{
  if (space.attachment.size() == 0)
    space.attachment.resize(statics.relief.rows(), 0);
  return append_attachment_modes(space.basis, statics.held,
                                 side_by_side(std::exchange(space.attachment, {}), statics.relief)) > 0;
}

/// Flexibility of modes left out; the first n_modes coordinates after the interface are retained modes.
MatrixXd modes_left_out(const ResidualFlexibility &response, const ReducedFrame &reduced, int n_modes)
{
  const auto     n1   = reduced.n_interface;
  const MatrixXd M_1V = reduced.M.block(0, n1, n1, n_modes);
  return response.Psi_M_X -
         M_1V * reduced.omega0.head(n_modes).cwiseAbs2().cwiseInverse().asDiagonal() * M_1V.transpose();
}

void add_texts(ReducedFrame &reduced, const fem::FrameMatrices &frame, const ReductionSpace &space)
{
  reduced.notes      = frame.notes;
  reduced.statements = frame.statements;
  reduced.notes.insert(reduced.notes.end(), space.notes.begin(), space.notes.end());
  reduced.statements.insert(reduced.statements.end(), space.statements.begin(), space.statements.end());
}

} // namespace

ReducedModel reduce_with_basis(const fem::FrameMatrices &frame, const ReductionOptions &options,
                               const Progress &progress, fem::FrameMatrices *given)
{
  require_valid(frame, frame.interface_coordinates(), options);
  BasisFunction   &basis_of = basis_function(options);
  InterfaceStatics statics(frame, options, progress, given);
  ReductionSpace   space   = basis_of(frame, options, statics);
  const int        n_fixed = space.basis.m();
  if (complete(space, statics) || space.star.M.size() == 0)
  {
    statics.begin("reduced matrices");
    space.star = reduced_matrices(space.basis, frame.B);
  }
  auto [frequencies, limit] = estimate(space, space.star, options);
  StaticRemainder remainder = static_remainder(statics.response.loads, space.basis, statics.load);

  ReducedFrame reduced = project(frame, space.basis, std::move(space.star), statics.load, remainder.deflection);
  balance_forces(reduced, frame, statics.held, space.basis, statics.forces);
  reduced.n_fixed_modes      = n_fixed;
  reduced.left_out           = modes_left_out(statics.response, reduced, n_fixed);
  reduced.frequencies_hz     = frequencies.omega / two_pi;
  reduced.frequency_error    = frequencies.error;
  reduced.frequency_limit_hz = limit / two_pi;
  reduced.static_residual    = remainder.relative;
  name_free_motions(reduced, frame, statics.held, space.basis.q1);
  add_texts(reduced, frame, space);
  add_modal_damping(reduced, frame.modal_damping_ratio);
  return {std::move(reduced), std::move(space.basis), std::move(remainder.deflection), options.factor};
}

ReducedFrame reduce_frame(const fem::FrameMatrices &frame, const ReductionOptions &options, const Progress &progress)
{
  return reduce_with_basis(frame, options, progress).frame;
}

} // namespace gestell::coupling
