#pragma once

#include "coupling/frame/reduced_frame.h"

#include <array>
#include <vector>

namespace gestell::coupling
{

/// Derivatives of a reduced frame by a scene parameter x, in the coordinates p of one frame: dM/dx and so on.
struct FrameDerivative
{
  Eigen::MatrixXd                    M, B, C, translations_load;
  std::vector<fem::FrameOutput>      outputs;   ///< their rows by x
  std::vector<std::array<double, 3>> positions; ///< of the interfaces by x

  /// |F+ - 2 F + F-| / |F+ - F-| of the matrices F, each entry relative to its diagonal: error estimate of the
  /// quotient. For a smooth F a share of the distance of the two frames; for remeshed frames the scatter of their
  /// meshes.
  double curvature = 0.;
};

/**
 * Central quotient of two reduced frames, (F+ - F-)/2 step.  Each frame has its own coordinates: after the interface
 * its modes, with arbitrary sign and, for close frequencies, arbitrary order and combination. They are rotated by the
 * orthogonal matrix R that brings their shapes closest to those of `at`,
 *
 *     p± = diag(E, R) p,   R = U V^T of  X = U S V^T,   D± X = D in the mean square,
 *
 * D the shapes at points of the skin.  A reduced model does not depend on the basis of the space it is projected on, so
 * that any R near E gives derivatives of the same motions.
 *
 * @param minus, plus  at x -+ step, with the interfaces of `at` and as many modes
 * @throws std::invalid_argument if they have another structure, or other modes are retained (a singular value of X
 * below one half)
 */
FrameDerivative frame_derivative(const ReducedFrame &at, const ReducedFrame &minus, const ReducedFrame &plus,
                                 double step);

/// The frame at x + by; its modes are then ordinary coordinates (ReducedFrame::modal).
ReducedFrame moved(const ReducedFrame &frame, const FrameDerivative &derivative, double by);

} // namespace gestell::coupling
