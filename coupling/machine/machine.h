#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/machine/marker.h"
#include "mechanism/force_element.h"
#include "mechanism/measures/combined_measure.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

class LinearBase;

/// A scalar the user asks for: scale * (on_q . q + on_v . q' + on_a . q'' + quantity of an element + load at the time +
/// offset).
struct Signal
{
  std::string name; ///< the user's, e.g. "F_P"
  std::string unit; ///< "N"
  Measure     on_q, on_v;
  int         element  = -1;
  int         quantity = -1;
  double      scale    = 1.;
  double      offset   = 0.;
  int         load     = -1; ///< external load
  std::string from{};        ///< an event, by the name of its object: extremes count from there on; empty: always
  int         measure = -1;  ///< of add_measure(), whose value (quantity 0), rate (1) or acceleration (2) it is
  double      on_t    = 0.;  ///< weight of the time
  Measure     on_a{};

  bool reads_acceleration() const { return !on_a.empty() || (measure >= 0 && quantity == 2); }
};

enum class BodyKind
{
  rotor,  ///< one angle [rad] about `axis`
  slider, ///< one displacement [m] along `axis`
  point,  ///< three displacements [m]
  planar, ///< two displacements [m] across `axis` and the angle [rad] about it
  rigid   ///< three displacements [m] and those of the three directors [1]: turns freely in space
};

/// A body of the mechanism.  Drawn at `position`: a rotor as a disc of `radius`, a slider as a box of `size`; a point,
/// planar or rigid body as such a box too, else as a sphere, a plate through its `points`, bars to them.  Its
/// coordinates are zero in the position the scene describes.
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
  Vector3     centre{};     ///< [m] about which it turns: that of a rotor, the centre of mass of the others
  Vector3     e_1{}, e_2{}; ///< of `planar`: unit vectors of its displacements

  std::vector<Vector3> points{}; ///< [m] at zero displacement: where joints and measures take hold of it
};

/// Two unit vectors across the unit vector n: global axes if n is one, in their order.
std::pair<Vector3, Vector3> plane_across(const Vector3 &n);

/// Names of the coordinates of a planar body: "rod.ux", "rod.uz", "rod.angle" across a global axis, else "rod.s1" ...
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

/// Bar drawn between two places whose distance matters: a rod, a rope, a cylinder, a spring.
struct DrawnBar
{
  std::string name;
  PlacedPoint from, to;
};

/// Pin drawn where two bodies turn against each other.
struct DrawnPin
{
  PlacedPoint at;
  Vector3     axis{}; ///< unit vector
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

/// What is told to which element or joint.
struct SwitchOrder
{
  std::string              element;
  mechanism::SwitchCommand order;
};

enum class SwitchCrossing
{
  rising,
  falling,
  either ///< from the side on which the signal is when it begins to watch
};

/// When a signal crosses a level, elements are given orders: once, or every time.
struct Switch
{
  std::string              name, signal; ///< path of the signal; "t": the time
  double                   level    = 0.;
  SwitchCrossing           crossing = SwitchCrossing::rising;
  std::vector<SwitchOrder> orders;
  double                   delay      = 0.; ///< [s] from the crossing to the orders
  std::string              after      = ""; ///< name of a switch; watches from its orders on. Empty: always
  bool                     repeat     = false;
  double                   hysteresis = 0.; ///< of `repeat`: how far the signal must have come back (either: gone away)
};

/// What the measures of an element are.
enum class MeasureKind
{
  displacement, ///< or several of all kinds, which the element itself tells apart
  angle         ///< of an element that could act on a displacement, too: its forces are torques
};

struct ElementPlacement
{
  std::string                              name;
  std::shared_ptr<mechanism::ForceElement> element;
  std::vector<Measure>                     measures;   ///< one per measure of the element
  int                                      joint = -1; ///< of friction in an ideal joint: which element that is
  MeasureKind                              kind  = MeasureKind::displacement;
};

/**
 * The coupled machine: a frame (reduced, or unreduced and sparse, or none), bodies with few coordinates, linear
 * couplings that join the base system, and nonlinear elements.
 *
 * Coordinates: those of the frame first (q1, then modes), then those of the bodies and the lags in the order they were
 * added.  Call set_frame() first, finish() last; then it is a SecondOrderSystem.
 */
class Machine : public SecondOrderSystem
{
public:
  Machine();
  ~Machine() override;
  Machine(Machine &&) noexcept;
  Machine &operator=(Machine &&) noexcept;

  // --- building
  void set_frame(ReducedFrame frame);       ///< dense
  void set_frame(fem::FrameMatrices frame); ///< unreduced: every coordinate of the frame is one of the machine's
  void set_gravity(const Vector3 &g);       ///< [m/s^2], acts on the frame and on all bodies

  /// A rotor of inertia J [kg m^2] about `axis`, carried by `carrier` ("ground", "frame.crown"), with mass [kg] at the
  /// carrier.
  int add_rotor(const std::string &name, const Vector3 &axis, double inertia, double mass, const std::string &carrier);
  /// A slider of mass m [kg] that moves along `axis`; sideways it moves with `guide`, where its mass counts.
  int add_slider(const std::string &name, const Vector3 &axis, double mass, const std::string &guide);
  /// A point mass m [kg] that moves freely in space.
  int add_point(const std::string &name, double mass, const Vector3 &position);
  /// A body of mass m [kg] and inertia J [kg m^2] about its centre of mass at `position`, that moves in the plane
  /// across `normal` and turns about it by any angle.
  int add_planar(const std::string &name, const Vector3 &normal, double mass, double inertia, const Vector3 &position);
  /// A body of mass m [kg] and inertia tensor J [kg m^2] about its centre of mass at `position`, in global axes in the
  /// position described, that moves and turns freely in space.  Signals: OrthonormalDirectors::quantities().
  /// @throws std::invalid_argument if no body without a direction of thickness zero has such moments
  int add_rigid(const std::string &name, double mass, const Eigen::Matrix3d &inertia, const Vector3 &position);
  /// Point mass m [kg] with inertia about x, y, z [kg m^2] on a marker, at `offset` [m] from it.
  void add_point_mass(const std::string &name, const std::string &marker, double mass, const Vector3 &inertia,
                      const Vector3 &offset);
  /// The point `at` [m] of a body, an interface or the ground, in the position the scene describes.
  PlacedPoint place(const std::string &marker, const Vector3 &at) const;
  Vector3     position(const std::string &marker) const; ///< [m] of a body's reference point or an interface
  void        add_measure(NamedMeasure measure);
  /// Signals of a point along x, y and z: "tip.x" where it is, "tip.ux" its displacement, "tip.vx" its velocity,
  /// "tip.ax" its acceleration.
  void add_place(const std::string &name, const PlacedPoint &place);
  /// @throws std::invalid_argument for an unknown signal, element or switch, an acceleration, which is not known where
  /// events are looked for, or an order that the element does not know
  void add_switch(const Switch &request);
  /// How a body is drawn.
  void draw(const std::string &body, const Vector3 &position, double radius, const Vector3 &size);
  void draw_rod(const DrawnRod &rod);
  void draw_bar(const DrawnBar &bar);
  void draw_pin(const DrawnPin &pin);
  /// The point `at` [m] belongs to what is drawn of a body; on the frame or the ground it is not drawn.
  void draw_point(const std::string &marker, const Vector3 &at);

  /// Linear spring, damper and constant force on a measure u, joining the base system: acts with
  /// -(c (u - u0) + b u' + F0) on u.  Signal quantities "force", "displacement", "rate".
  void add_linear(const std::string &name, const Measure &u, double stiffness, double damping, double preload,
                  double rest, const std::string &force_unit);

  /// External load on a measure u:  f(t) = constant + sum amplitude sin(omega t + phase), with +f on u.  Signal
  /// quantity "force" (and "torque" in N m).  @throws std::invalid_argument if an omega is not positive
  void add_load(const std::string &name, const Measure &u, double constant,
                const std::vector<Oscillation> &oscillations, const std::string &force_unit);

  /**
   * A virtual coordinate x: a state that follows its input p with the time constant T > 0 [s],
   *
   *     T x' + x = p.
   *
   * It has no mass, so that only bdf integrates it.  An element takes it as one of its last measures and gives p, the
   * force on it; dynamic motor characteristics and controllers are made of it (Dresig, Vul'fson, section 5.5.3).
   *
   * @return its coordinate
   */
  int add_lag(const std::string &name, double time_constant);

  /// Nonlinear element acting on its measures; those of virtual coordinates come last.
  void attach(const std::string &name, std::shared_ptr<mechanism::ForceElement> element,
              const std::vector<Measure> &measures, MeasureKind kind = MeasureKind::displacement);
  /// Friction of the ideal joint that was attached last, whose multipliers the element sees; it goes by the joint's
  /// name.
  void attach_friction(std::shared_ptr<mechanism::ForceElement> element, const std::vector<Measure> &measures);

  /// Signals that will be read: whether any tells the force of an ideal joint, or an acceleration, which follows from
  /// these forces.
  void will_read(const std::vector<Signal> &signals);

  /// Ends building: assembles the base system and W.
  void finish();

  // --- looking up, valid while building; all throw std::invalid_argument with the nearest name
  const Marker &marker(const std::string &name) const; ///< "ground", "crank", "frame.crown"
  const Body   &body(const std::string &name) const;
  int           coordinate(const std::string &name) const; ///< of a body, or "frame.crown.uz"
  /// "crank.angle", "crank.speed", "crank.acceleration", "slide.velocity", "frame.crown.uz", "frame.crown.uz_rate",
  /// "frame.crown.uz_acceleration", "frame.cut.columns", "rod.force" ...; a leading minus turns the sign.
  Signal                               signal(const std::string &name, const std::string &path) const;
  std::vector<std::string>             signal_paths() const;
  const std::vector<Body>             &bodies() const;
  const std::vector<DrawnRod>         &rods() const;
  const std::vector<DrawnBar>         &bars() const;
  const std::vector<DrawnPin>         &pins() const;
  const std::vector<ElementPlacement> &elements() const;
  const std::vector<Switch>           &switches() const;
  const NamedMeasure                  &measure(const std::string &name) const;
  const ReducedFrame                  *reduced_frame() const; ///< null if there is none
  const fem::FrameMatrices            *full_frame() const;    ///< null if there is none
  const LinearBase                    &base() const;
  int                                  n_frame() const; ///< coordinates of the frame
  int                                  n_interface() const;
  int                                  n_mechanism() const; ///< coordinates of the bodies and lags
  /// Load of a unit acceleration of the machine in x, y, z: M R [n x 3], for effective masses.
  Eigen::MatrixXd translation_loads() const;

  /// Contacts that are closed at a motion, in words: by how much they lie inside.
  std::vector<std::string> closed_contacts(const LocalState &state) const;
  /// @param a  q'' [n]; only signals that reads_acceleration() look at it
  double evaluate(const Signal &signal, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a,
                  const LocalState &local) const;
  /// Of a signal that reads no acceleration.
  double evaluate(const Signal &signal, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                  const LocalState &local) const
  {
    return evaluate(signal, q, v, Eigen::VectorXd(), local);
  }
  /// Geometric stiffness [n_u x n_u] of all elements and joints, block diagonal: mechanism::ForceElement::geometric().
  void geometric(const LocalState &state, Eigen::MatrixXd &K) const;
  /// u, v, a of all elements for q, q', q''.
  void gather(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a,
              LocalState &local) const;

  // --- SecondOrderSystem
  int                           size() const override;
  void                          mass_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          damping_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  void                          stiffness_times(const Eigen::VectorXd &x, Eigen::VectorXd &y) const override;
  std::unique_ptr<LinearSolver> factorise(double w_M, double w_B, double w_C) const override;
  std::vector<SpectrumLine>     spectrum() const override;
  const Excitation             &excitation() const override;
  bool dense_matrices(Eigen::MatrixXd &M, Eigen::MatrixXd &B, Eigen::MatrixXd &C) const override;
  bool sparse_matrices(Eigen::SparseMatrix<double> &M, Eigen::SparseMatrix<double> &B,
                       Eigen::SparseMatrix<double> &C) const override;
  const Eigen::SparseMatrix<double> &directions() const override;
  void                               local_force(const LocalState &state, Eigen::VectorXd &p) const override;
  void                    local_tangent(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                                        Eigen::MatrixXd &dp) const override;
  void                    local_derivatives(const LocalState &state, Eigen::VectorXd &p, Eigen::MatrixXd &dp_du,
                                            Eigen::MatrixXd &dp_dv) const override;
  std::vector<ForceBlock> force_blocks() const override;
  void local_tangent_blocks(const LocalState &state, double w_u, double w_v, double w_a, Eigen::VectorXd &p,
                            Eigen::VectorXd &blocks) const override;
  const std::vector<HeldMeasure>     &held() const override;
  const std::vector<ConstraintBlock> &constraint_blocks() const override;
  void        constraints(const LocalState &state, Eigen::VectorXd &g, ConstraintJacobian &G) const override;
  void        constraint_rates(const LocalState &state, Eigen::VectorXd &rate, Eigen::VectorXd &bias) const override;
  bool        wants_multipliers() const override;
  bool        forces_need_multipliers() const override;
  std::string constraint_name(int i) const override;
  void        follow_history(bool follow) override;
  Eigen::VectorXd         save_history() const override;
  void                    restore_history(const Eigen::VectorXd &saved) override;
  void                    start(const LocalState &state) override;
  void                    accept(const LocalState &state) override;
  int                     n_guards() const override;
  void                    guard_values(const LocalState &state, Eigen::VectorXd &g) const override;
  GuardCrossing           crossing(int i) const override;
  ActiveGuard             guard(int i) const override;
  void                    transition(int i, const LocalState &state) override;
  const std::vector<int> &virtual_coordinates() const override;
  double                  local_stored_energy(const LocalState &state) const override;
  void local_power(const LocalState &state, const Eigen::VectorXd &p, double &input, double &dissipated) const override;
  std::string coordinate_name(int i) const override;

private:
  void refuse_far_turning(const std::string &name, const std::array<Measure, 3> &rotation) const;

  struct Parts;
  std::unique_ptr<Parts> parts_;
};

} // namespace gestell::coupling
