#pragma once

#include "coupling/machine/initial_state.h"
#include "coupling/machine/machine.h"
#include "mechanism/joints/compliant_joint.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

/// Angular velocity [rad/s] of a rigid body about a global axis, 0 to 2.
struct KnownSpin
{
  std::string body;
  int         axis;
  double      value;
};

/// Known values of an initial state: coordinates, measures, and their rates.
struct KnownStart
{
  InitialState                                state;            ///< given values, and initial guesses for the others
  std::vector<char>                           q_given, v_given; ///< [n] coordinates that keep their value
  std::vector<std::pair<std::string, double>> measures, rates;  ///< by the name of a NamedMeasure
  std::vector<std::pair<int, double>>         shifts;           ///< row of a driven joint, and its offset s - f(t)
  std::vector<KnownSpin>                      spins; ///< those not given for a body are zero, if joints allow it
};

/// Treatment of bodies driven through a clearance.
enum class BehindPlay
{
  left,    ///< they have the position and velocity of least motion
  followed ///< two-sided clearances that given values would close are centred, and both sides move together
};

/**
 * Assembles the joints of a machine and sets measures to their values, g(t, q) = 0 and s(q) = s_0, by the smallest
 * change of the body coordinates that are not given, weighted with their masses.  Then the velocities are computed in
 * the same way, G q' + rate = 0.  Coordinates of the frame are unchanged.  Compliant joints are also closed, unless the
 * given values prevent it: then they remain open and act with their force.
 *
 * @throws std::invalid_argument if this is impossible, with the joint with the largest gap and the gap; or if joint
 * equations are redundant there, with the redundant one
 */
InitialState assemble(Machine &machine, const KnownStart &known, BehindPlay bodies = BehindPlay::left);

/// e . omega = s . q' of a rigid body turning about the global axis e, s [n] at q.
Eigen::VectorXd spin_gradient(const Machine &machine, const KnownSpin &spin, const Eigen::VectorXd &q);

/// A compliant joint and its first measure.
struct CompliantPlace
{
  const mechanism::CompliantJoint *joint;
  int                              first_measure;
};
std::vector<CompliantPlace> compliant_joints(const Machine &machine);

/// Whether there are joints to assemble, ideal or compliant ones.
bool has_joints(const Machine &machine);

} // namespace gestell::coupling
