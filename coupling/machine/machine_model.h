#pragma once

#include "coupling/machine/marker.h"
#include "mechanism/facets.h"
#include "mechanism/functions/user_function.h"
#include "mechanism/measures/combined_measure.h"

#include <atomic>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace gestell::coupling
{

struct ComputedSignal;

/// A scalar requested by the user: scale * (on_q . q + on_v . q' + on_a . q'' + quantity of an element + load at the
/// time + offset).
struct Signal
{
  std::string name; ///< given by the user, e.g. "F_P"
  std::string unit; ///< "N"
  Measure     on_q, on_v;
  int         element  = -1;
  int         quantity = -1;
  double      scale    = 1.;
  double      offset   = 0.;
  int         load     = -1; ///< external load
  std::string from{};        ///< event, by the name of its object, after which extremes are evaluated; empty: always
  int         measure = -1;  ///< of add_measure(): value (quantity 0), rate (1) or acceleration (2)
  double      on_t    = 0.;  ///< weight of the time
  Measure     on_a{};
  std::shared_ptr<const ComputedSignal> computed{}; ///< not null: the value, times `scale`

  bool reads_acceleration() const;
};

/// A function of the calling program of other signals.  Once it fails, which ends a run, it has no value any more.
struct ComputedSignal
{
  mechanism::UserFunction   function;
  std::vector<Signal>       of; ///< its arguments
  mutable std::atomic<bool> failed{false};
};

/// The signal of such a function, which reads the coordinates of its arguments.
Signal computed_signal(const std::string &name, const std::string &unit, const mechanism::UserFunction &function,
                       const std::vector<Signal> &of);

enum class BodyKind
{
  rotor,  ///< one angle [rad] about `axis`
  slider, ///< one displacement [m] along `axis`
  point,  ///< three displacements [m]
  planar, ///< two displacements [m] across `axis` and the angle [rad] about it
  rigid   ///< three displacements [m] and those of the three directors [1]: a free spatial body
};

/// A body of the mechanism.  It is drawn at `position`: a rotor as a disc of `radius`, a slider as a box of `size`; a
/// point, planar or rigid body also as a box, or without a size as a sphere, a plate through its `points`, bars to
/// them.  Its coordinates are zero in the reference configuration.
struct Body
{
  std::string name;
  BodyKind    kind       = BodyKind::rotor;
  int         coordinate = -1; ///< the first one
  Vector3     axis{};
  Vector3     position{}; ///< [m] at zero displacement
  double      radius = 0.;
  Vector3     size{};
  Marker      marker;
  Vector3     centre{};     ///< [m] centre of rotation: that of a rotor, the centre of mass of the others
  Vector3     e_1{}, e_2{}; ///< of `planar`: unit vectors of its displacements

  std::vector<Vector3> points{}; ///< [m] at zero displacement: where joints and measures are attached
};

/// Two unit vectors normal to the unit vector n: if n is a global axis the other two, in their order.
std::pair<Vector3, Vector3> plane_across(const Vector3 &n);

/// Names of the coordinates of a planar body: "rod.ux", "rod.uz", "rod.angle" for a global normal, else "rod.s1" ...
/// @param normal  unit vector
std::array<std::string, 3> planar_coordinates(const std::string &name, const Vector3 &normal);

/// A point on a body, the frame or the ground, and the measures its motion depends on.
struct PlacedPoint
{
  mechanism::Placement placement;
  std::vector<Measure> measures;
};

/// Bar drawn between the pin of a rotor and a slider.
struct DrawnRod
{
  std::string name, crank, slider;
  double      crank_radius = 0., length = 0.;
};

/// Bar drawn between two points with a relevant distance: a rod, a rope, a cylinder, a spring.
struct DrawnBar
{
  std::string name;
  PlacedPoint from, to;
};

/// Pin drawn where two bodies rotate relative to each other.
struct DrawnPin
{
  PlacedPoint at;
  Vector3     axis{}; ///< unit vector
};

/// Spring, damper and constant force on a measure u:  -(stiffness (u - rest) + damping u' + preload).
struct LinearLaw
{
  double stiffness, damping, preload, rest;
};

/// amplitude sin(omega t + phase), omega > 0 [rad/s].
struct Oscillation
{
  double omega, amplitude, phase;
};

/// A scalar of the motion of two points: signals "value", "rate" and "acceleration".
struct NamedMeasure
{
  std::string                name, unit; ///< of the value: "m", "rad"
  mechanism::CombinedMeasure measure;
  std::vector<Measure>       measures;

  mechanism::RelativeMeasure::Value evaluate(const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                                             Eigen::VectorXd *gradient = nullptr) const; ///< gradient ds/dq [n]
  /// s'' = ds/dq . q'' + d(ds/dq)/dt . q'
  double acceleration(const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a) const;
};

/// A command of a switch, and its target, an element or joint.
struct SwitchOrder
{
  std::string              element;
  mechanism::SwitchCommand order;
};

enum class SwitchCrossing
{
  rising,
  falling,
  either ///< from the side of the signal when the switch is armed
};

/// Sends commands to elements when a signal crosses a level: once, or every time.
struct Switch
{
  std::string              name, signal; ///< path of the signal; "t": the time
  double                   level    = 0.;
  SwitchCrossing           crossing = SwitchCrossing::rising;
  std::vector<SwitchOrder> orders;
  double                   delay      = 0.; ///< [s] from the crossing to the commands
  std::string              after      = ""; ///< name of a switch whose commands arm this one. Empty: always armed
  bool                     repeat     = false;
  double                   hysteresis = 0.; ///< for `repeat`: how far the signal must return (either: move away)
  std::string              ends       = ""; ///< not empty: its commands end the run with this statement
};

/// Kind of the measures of an element.
enum class MeasureKind
{
  displacement, ///< also several kinds that the element distinguishes
  angle         ///< for an element that could also act on a displacement: its forces are torques
};

struct ElementPlacement
{
  std::string                         name;
  std::shared_ptr<mechanism::Element> element;
  std::vector<Measure>                measures;   ///< one per measure of the element
  int                                 joint = -1; ///< of friction in an ideal joint: which element that is
  MeasureKind                         kind  = MeasureKind::displacement;
};

} // namespace gestell::coupling
