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

/// What is known of a start: values of coordinates, of measures, and of their rates.
struct KnownStart
{
  InitialState                                state;            ///< with the given values; first guesses of the others
  std::vector<char>                           q_given, v_given; ///< [n] coordinates that keep their value
  std::vector<std::pair<std::string, double>> measures, rates;  ///< by the name of a NamedMeasure
  std::vector<std::pair<int, double>> shifts; ///< row of a driven joint, and by how much s - f(t) is not zero there
  std::vector<KnownSpin>              spins;  ///< those not given of a body are zero, if joints let
};

/// What becomes of bodies behind a play.
enum class BehindPlay
{
  left,    ///< they are where and as fast as least motion has them
  followed ///< what given values tear out of a play goes back to its middle, and both sides of plays move together
};

/**
 * Closes the joints of a machine and gives measures their values, g(t, q) = 0 and s(q) = s_0, by moving coordinates of
 * bodies that are not given as little as possible, measured by their masses; then the velocities likewise,
 * G q' + rate = 0.  Coordinates of the frame stay as they are.  Compliant joints are closed likewise, unless the given
 * values leave them no way to: then they stay open and act with their force.
 *
 * @throws std::invalid_argument if it cannot be done: the joint that stays open most, and by how much; or if equations
 * of joints depend on each other there: the one that does
 */
InitialState assemble(Machine &machine, const KnownStart &known, BehindPlay bodies = BehindPlay::left);

/// e . omega = s . q' of a rigid body turning about the global axis e, s [n] at q.
Eigen::VectorXd spin_gradient(const Machine &machine, const KnownSpin &spin, const Eigen::VectorXd &q);

/// A compliant joint and where its measures begin.
struct CompliantPlace
{
  const mechanism::CompliantJoint *joint;
  int                              first_measure;
};
std::vector<CompliantPlace> compliant_joints(const Machine &machine);

/// Whether there are joints to close, ideal or compliant ones.
bool has_joints(const Machine &machine);

} // namespace gestell::coupling
