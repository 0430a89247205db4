#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/machine/configuration/dense_matrices.h"

#include <complex>
#include <limits>
#include <optional>
#include <string>

namespace gestell::coupling
{

struct Mode
{
  double          frequency_hz = 0., damped_frequency_hz = 0.;
  double          damping_ratio = 0.; ///< nan if the mode does not vibrate
  Vector3         effective_mass{};   ///< [kg] x, y, z
  double          growth = 0.;        ///< [1/s] of exp(growth t), undamped: an unstable configuration
  Eigen::VectorXd shape;              ///< undamped, mass normalised, in the coordinates of its machine or frame
  double          refined_hz = std::numeric_limits<double>::quiet_NaN(); ///< for a reduced frame, see refined_hz()
};

/// A motion exp(s t) of the machine with its dampers, drives and lags: one of each conjugate pair.
struct Pole
{
  std::complex<double> s;     ///< [1/s], imaginary part >= 0
  std::string          moves; ///< the coordinate with most of the kinetic energy, or the lag

  bool   vibrates() const { return s.imag() > 0.; }
  double frequency_hz() const;  ///< damped
  double damping_ratio() const; ///< -Re s / |s|; negative: it grows
};

/// Frequency j [Hz] of a reduced frame after one more step of inverse iteration, between that of the full frame and
/// that of the model; nan if none is known or nothing is reduced.  docs/theory/reduction.md (14).
double refined_hz(const ReducedFrame &frame, Eigen::Index j);

/// Modes of the supported frame alone, with free interface; shapes in the frame's coordinates.  For an unreduced frame
/// the lowest n_modes.
std::vector<Mode> frame_modes(const Machine &machine, int n_modes);

enum class GeometricStiffness
{
  included, ///< of forces that rotate with the motion, for example a load that swings on a rope
  left_out
};

/// Options of a linearisation of the machine.
struct Linearisation
{
  std::vector<std::string>       open{}; ///< elements that are not engaged
  GeometricStiffness             geometric = GeometricStiffness::included;
  std::vector<int>               fixed{};                     ///< fixed coordinates
  Acting                         acting = Acting::everything; ///< forces included in the geometric stiffness
  std::optional<Eigen::VectorXd> multipliers{};               ///< [n_c] of joints; none: of a start from rest
  bool                           damping = true;              ///< false: undamped frequencies and shapes only
};

/// Multipliers [n_c] of the joints when the machine starts from rest at q; `local` contains its motion there.
/// @throws ConvergenceFailure
Eigen::VectorXd multipliers_at_rest(const Machine &machine, const Eigen::VectorXd &q, LocalState &local);

/**
 * Modes of the coupled machine linearised at q, shapes in the machine's coordinates:
 *
 *     (Z^T K Z - omega^2 Z^T M Z) y = 0,     v = Z y,     v^T M v = 1,     K = C + K_engaged + K_geometric,
 *
 * where Z spans the motions that joints and fixed coordinates allow.  Joints must be satisfied at q.
 *
 * Source: docs/theory/joints.md (6).
 * @throws std::invalid_argument for a name in `open` that no element has, and for an unreduced frame
 */
std::vector<Mode> linearised_modes(const Machine &machine, const Eigen::VectorXd &q, const Linearisation &linearisation,
                                   int n_modes);
/**
 * Poles of the same machine at an operating point, the configuration q with the speeds v at the time t,
 *
 *     y'' + V^T B_o V y' + V^T K_o V y = ...,     T x' + x = p(y, y', x),
 *
 * in its undamped modes V and the virtual coordinates x of drives and controllers.  Structural elements are engaged as
 * in K; drives (elements whose work is input, and that are not structure) enter with dp/du and dp/dv at that motion;
 * tools and friction, and their virtual coordinates, are switched off.  Joints are in their present state.  Poles s = 0
 * are omitted; the slowest is first.  Empty if the machine has no drives: its modes are complete.
 *
 * Source: docs/theory/modes_along.md (6).
 */
std::vector<Pole> operating_poles(const Machine &machine, const Eigen::VectorXd &q, const Eigen::VectorXd &v, double t,
                                  const Linearisation &linearisation);

/// The same with the elements named in `open` not engaged, and geometric stiffness.
inline std::vector<Mode> coupled_modes(const Machine &machine, const Eigen::VectorXd &q,
                                       const std::vector<std::string> &open, int n_modes)
{
  return linearised_modes(machine, q, Linearisation{open}, n_modes);
}

} // namespace gestell::coupling
