#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/machine/machine_model.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace gestell::coupling
{

class LinearBase;
struct MachineParts;
struct ModalCoordinates;
struct MachineSystem;

/**
 * The parts of a machine: a frame (reduced, or unreduced and sparse, or none), bodies with few coordinates, linear
 * couplings in the base system, nonlinear elements, joints, switches, and their shapes for pictures.
 *
 * Coordinates: those of the frame first (q1, then modes), then those of the bodies and the lags in the order they were
 * added.  set_frame() must be called first; a Machine is constructed from the complete model.
 */
class MachineModel
{
public:
  MachineModel();
  ~MachineModel();
  MachineModel(MachineModel &&) noexcept;
  MachineModel &operator=(MachineModel &&) noexcept;

  void set_frame(ReducedFrame frame);       ///< dense
  void set_frame(fem::FrameMatrices frame); ///< unreduced: every DOF of the frame is a coordinate of the machine
  void set_gravity(const Vector3 &g);       ///< [m/s^2], acts on the frame and on all bodies

  /// Adds a rotor of inertia J [kg m^2] about `axis`, carried by `carrier` ("ground", "frame.crown"), with its mass
  /// [kg] at the carrier.
  int add_rotor(const std::string &name, const Vector3 &axis, double inertia, double mass, const std::string &carrier);
  /// Adds a slider of mass m [kg] that moves along `axis`; otherwise it moves with `guide`, which gets its mass.
  int add_slider(const std::string &name, const Vector3 &axis, double mass, const std::string &guide);
  /// Adds a point mass m [kg] that moves freely in space.
  int add_point(const std::string &name, double mass, const Vector3 &position);
  /// Adds a body of mass m [kg] and inertia J [kg m^2] about its centre of mass at `position` that moves in the plane
  /// normal to `normal`, with any rotation.
  int add_planar(const std::string &name, const Vector3 &normal, double mass, double inertia, const Vector3 &position);
  /// Adds a free spatial body of mass m [kg] and inertia tensor J [kg m^2] about its centre of mass at `position`, in
  /// global axes in the reference configuration.  Signals: OrthonormalDirectors::quantities().
  /// @throws std::invalid_argument if no body has such moments, except one with zero thickness in a direction
  int add_rigid(const std::string &name, double mass, const Eigen::Matrix3d &inertia, const Vector3 &position);
  /// Adds a point mass m [kg] with inertia about x, y, z [kg m^2] to a marker, at `offset` [m] from it.
  void add_point_mass(const std::string &name, const std::string &marker, double mass, const Vector3 &inertia,
                      const Vector3 &offset);
  /// The point `at` [m] of a body, an interface or the ground, in the reference configuration.
  PlacedPoint place(const std::string &marker, const Vector3 &at) const;
  Vector3     position(const std::string &marker) const; ///< [m] of a body's reference point or an interface
  void        add_measure(NamedMeasure measure);
  /// Adds signals of a point along x, y and z: position "tip.x", displacement "tip.ux", velocity "tip.vx", acceleration
  /// "tip.ax".
  void add_place(const std::string &name, const PlacedPoint &place);
  /// @throws std::invalid_argument for an unknown signal, element or switch, an acceleration (unavailable during event
  /// location), or a command that the element does not accept
  void add_switch(const Switch &request);
  /// Sets how a body is drawn.
  void draw(const std::string &body, const Vector3 &position, double radius, const Vector3 &size);
  void draw_rod(const DrawnRod &rod);
  void draw_bar(const DrawnBar &bar);
  void draw_pin(const DrawnPin &pin);
  /// Includes the point `at` [m] in the shape of a body; no effect on the frame or the ground.
  void draw_point(const std::string &marker, const Vector3 &at);

  /// Adds a linear spring, damper and constant force on a measure u to the base system: the force on u is -(c (u - u0)
  /// + b u' + F0).  Signal quantities "force", "displacement", "rate".
  void add_linear(const std::string &name, const Measure &u, const LinearLaw &law, const std::string &force_unit);

  /// Adds an external load on a measure u:  f(t) = constant + sum amplitude sin(omega t + phase), with +f on u.  Signal
  /// quantity "force" (and "torque" in N m).  @throws std::invalid_argument if an omega is not positive
  void add_load(const std::string &name, const Measure &u, double constant,
                const std::vector<Oscillation> &oscillations, const std::string &force_unit);

  /**
   * Adds a virtual coordinate x: a state that follows its input p with the time constant T > 0 [s],
   *
   *     T x' + x = p.
   *
   * It has no mass, so that only bdf integrates it.  It is one of the last measures of an element, whose force on it is
   * p; dynamic motor characteristics and controllers consist of such coordinates (Dresig, Vul'fson, section 5.5.3).
   *
   * @return its coordinate
   */
  int add_lag(const std::string &name, double time_constant);

  /// Attaches a nonlinear element to its measures; those of virtual coordinates are last.
  void attach(const std::string &name, std::shared_ptr<mechanism::Element> element,
              const std::vector<Measure> &measures, MeasureKind kind = MeasureKind::displacement);
  /// Adds friction to the ideal joint attached last; the element receives the joint's multipliers and has its name.
  void attach_friction(std::shared_ptr<mechanism::ForceLaw> element, const std::vector<Measure> &measures);

  // --- search by name; all throw std::invalid_argument with the most similar name
  const Marker &marker(const std::string &name) const; ///< "ground", "crank", "frame.crown"
  const Body   &body(const std::string &name) const;
  int           coordinate(const std::string &name) const; ///< of a body, or "frame.crown.uz"
  /// "crank.angle", "crank.speed", "crank.acceleration", "slide.velocity", "frame.crown.uz", "frame.crown.uz_rate",
  /// "frame.crown.uz_acceleration", "frame.cut.columns", "rod.force" ...; a leading minus changes the sign.
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
  int                                  n_frame() const;       ///< coordinates of the frame
  int                                  n_interface() const;
  int                                  n_mechanism() const;          ///< coordinates of the bodies and lags
  int                                  size() const;                 ///< coordinates of frame and mechanism
  std::string                          coordinate_name(int i) const; ///< for messages

private:
  friend class Machine;

  void refuse_far_turning(const std::string &name, const std::array<Measure, 3> &rotation) const;

  std::unique_ptr<MachineParts> parts_;
};

/// A model assembled as base system and W: a SecondOrderSystem.
class Machine : public SecondOrderSystem
{
public:
  explicit Machine(MachineModel model);
  ~Machine() override;
  Machine(Machine &&) noexcept;
  Machine &operator=(Machine &&) noexcept;

  const MachineModel &model() const { return model_; }
  int                 size() const { return model_.size(); }
  std::string         coordinate_name(int i) const { return model_.coordinate_name(i); }
  /// MachineModel::signal()
  Signal signal(const std::string &name, const std::string &path) const { return model_.signal(name, path); }

  /// Announces the signals that will be read: they determine whether forces of ideal joints or accelerations, which
  /// require these forces, are computed.
  void will_read(const std::vector<Signal> &signals);
  /// Load of a unit acceleration of the machine in x, y, z: M R [n x 3], for effective masses.
  Eigen::MatrixXd translation_loads() const;

  /**
   * The same machine in modes p, q = V p: base matrices V^T M V, V^T B V, V^T C V, directions V^T W, loads V^T f_t; its
   * coordinates are the modes (5.5.3/11).  Frame, bodies and pictures remain in this machine; the new one has signals.
   */
  Machine in_modes(const ModalCoordinates &modes) const;
  /// [m] rad/s, for modal coordinates; empty: coordinates are not modal.
  const Eigen::VectorXd &superposed_frequencies() const;
  /// M, B, C as stored.
  const LinearBase &base() const;

  /// Texts on contacts that are closed at a motion, with their penetration.
  std::vector<std::string> closed_contacts(const LocalState &state) const;
  /// @param a  q'' [n]; only used by signals with reads_acceleration()
  double evaluate(const Signal &signal, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a,
                  const LocalState &local) const;
  /// For a signal without accelerations.
  double evaluate(const Signal &signal, const Eigen::VectorXd &q, const Eigen::VectorXd &v,
                  const LocalState &local) const
  {
    return evaluate(signal, q, v, Eigen::VectorXd(), local);
  }
  /// Geometric stiffness [n_u x n_u] of all elements and joints, block diagonal: mechanism::geometric().
  void geometric(const LocalState &state, Eigen::MatrixXd &K) const;
  /// u, v, a of all elements for q, q', q''.
  void gather(double t, const Eigen::VectorXd &q, const Eigen::VectorXd &v, const Eigen::VectorXd &a,
              LocalState &local) const;

  const LinearSystem  &linear() const override;
  const LocalForces   &forces() const override;
  const IdealJoints   &joints() const override;
  const EventSystem   &events() const override;
  EventSystem         &events() override;
  const EnergyAccount &energy() const override;

private:
  struct Assembled
  {
  };
  Machine(MachineModel model, Assembled);

  MachineModel                   model_;
  MachineParts                  *parts_; ///< of the model
  std::unique_ptr<MachineSystem> system_;
};

} // namespace gestell::coupling
