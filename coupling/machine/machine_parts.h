#pragma once

#include "coupling/frame/reduced_frame.h"
#include "coupling/integration/system/second_order_system.h"
#include "coupling/machine/linear_base.h"
#include "coupling/machine/machine_model.h"
#include "coupling/machine/modal_coordinates.h"
#include "coupling/machine/own_modes.h"
#include "mechanism/transmitted_element.h"

#include <map>

namespace gestell::coupling
{

/// The parts of a Machine, while it is built and afterwards.
struct MachineParts
{
  using Triplets                    = std::vector<Eigen::Triplet<double>>;
  static constexpr int max_measures = ///< per element
      mechanism::CombinedMeasure::max_measures + mechanism::TransmittedElement::max_virtual;
  static constexpr int max_constraints = 6; ///< per joint: DOFs of two bodies in space relative to each other

  /// Spring, damper and constant force on one measure, part of the base system.
  struct LinearElement
  {
    std::string name;
    Measure     u;
    double      stiffness, damping, offset;
    std::string unit;
  };

  /// An element with its position in u and in the history; a contiguous copy of the data for the hot loop.
  struct PlacedElement
  {
    const mechanism::Element *element;
    int                       first_measure, n_measures, first_history;
    int         n_motions; ///< measures that do work, the first ones; first-order states after them do not
    bool        holds            = false; ///< it sticks: its force is an unknown of the step
    int         came             = 0;     ///< during its transition the sign of the motion that comes to rest; else 0
    int         first_constraint = -1;    ///< of an ideal joint: the first row of its equations
    int         first_multiplier = -1;    ///< of a joint or its friction: the first one that it reads
    std::string name{};                   ///< in the scene

    // Whether it is a law or a joint, with its interfaces; null if it has none.
    const mechanism::ForceLaw   *law       = element->force_law();
    const mechanism::Constraint *joint     = element->ideal_joint();
    const mechanism::Branches   *branches  = element->branches();
    const mechanism::Structure  *structure = element->structure();
    const mechanism::Commands   *commands  = element->commands();
    bool                         drives    = element->work() == mechanism::Work::input;

    int angles[2]       = {0, 0}; ///< of an ideal joint: of its bodies in MachineParts::angles, counted from 1; 0: none
    int angles_of_it[2] = {0, 0}; ///< the same as measures of the joint

    /// For dry friction in a joint, in the history of the machine: 1 if others stop its motion; then the sign of
    /// sliding before it stuck.
    int stop = -1;

    /// Its force is not the value of a law but follows from the equations of the step.
    bool implied() const { return holds || first_constraint >= 0; }
    /// Whether the quantity follows from multipliers, its own or (friction in a joint) those of another element.
    bool tells_multipliers(int quantity) const
    {
      return first_multiplier >= 0 && (!joint || joint->needs_multipliers(quantity));
    }

    /// Whether the present branch of its law prescribes u' = rate.
    bool sticks(const double *history, double &rate) const { return branches && branches->holds(history, rate); }

    mechanism::LocalMotion motion(const LocalState &state, bool by_history) const
    {
      return {state.t,
              state.u.data() + first_measure,
              state.v.data() + first_measure,
              state.a.data() + first_measure,
              state.p.data() + first_measure,
              by_history,
              first_multiplier >= 0 && state.lambda.size() > 0 ? state.lambda.data() + first_multiplier : nullptr};
    }
  };

  /// External load constant + sum amplitude sin(omega t + phase) on a measure.
  struct Load
  {
    std::string              name, unit;
    Measure                  u;
    double                   constant;
    std::vector<Oscillation> oscillations;

    double at(double t) const;
  };

  /// State of a switch.
  enum class SwitchPhase
  {
    watches,
    waits,   ///< for another switch
    delays,  ///< of its commands
    returns, ///< its signal must return before it is armed again
    rests    ///< finished
  };

  /// A switch: its signal is in u (of a placed element, or of its own).
  struct PlacedSwitch
  {
    Switch           request;
    Signal           signal;
    int              watched = -1; ///< element whose measures contain the signal; none for the time
    std::vector<int> targets;      ///< elements that receive the commands
    int              after   = -1; ///< index of the switch it waits for
    int              history = -1; ///< its phase; time [s] at which delayed commands are due; see watch()
  };

  struct PlacedGuard
  {
    int           element, index; ///< for a switch: element -1, index of the switch
    GuardCrossing crossing;
    ActiveGuard   guard;
  };

  /// A point with signals: its measures along x, y, z are three of `measures`.
  struct NamedPlace
  {
    std::string name;
    int         first_measure;
    Vector3     start; ///< [m] at zero displacement
  };

  // building
  std::unique_ptr<ReducedFrame>       reduced;
  std::optional<OwnModes>             own_modes; ///< of the reduced frame, if it is in their coordinates
  std::unique_ptr<fem::FrameMatrices> full;
  int                                 n_frame = 0, n_interface = 0;
  Vector3                             gravity{};
  std::map<std::string, Marker>       markers;
  std::map<std::string, Vector3>      positions; ///< of interfaces [m]
  std::vector<Body>                   bodies;
  std::vector<DrawnRod>               rods;
  std::vector<DrawnBar>               bars;
  std::vector<DrawnPin>               pins;
  std::vector<LinearElement>          linear;
  std::vector<ElementPlacement>       elements;
  std::vector<NamedMeasure>           measures;
  std::vector<NamedPlace>             places;
  std::vector<Switch>                 switch_requests;
  std::vector<std::string>            coordinate_names; ///< of the bodies and lags
  std::vector<int>                    lag_coordinates;
  Triplets                            M, B, C;
  std::vector<std::pair<int, double>> constant_load;
  std::vector<Load>                   loads;
  std::array<Measure, 3>              acceleration_load; ///< of the bodies for a unit acceleration in x, y, z

  std::map<std::string, Signal> known_signals;          ///< of an assembled machine: all signals, by path
  Eigen::VectorXd               superposed_frequencies; ///< [m] rad/s; empty: it is not in modes

  // finished
  std::unique_ptr<LinearBase>  base;
  Eigen::SparseMatrix<double>  W;
  Excitation                   excitation; // f_t
  Eigen::MatrixXd              translation_loads;
  std::vector<PlacedElement>   placed;
  std::vector<int>             joints; ///< ideal ones, as indices of `placed`
  std::vector<ConstraintBlock> joint_blocks;
  std::vector<int>             angles; ///< measures that are angles of bodies in joints, each once
  std::vector<ForceBlock>      force_blocks;
  Eigen::VectorXd              history;
  std::vector<PlacedGuard>     guards; ///< of elements, then of switches
  std::vector<PlacedSwitch>    switches;
  std::vector<HeldMeasure>     held;
  std::vector<HeldMeasure>     held_too;      ///< measures whose rate follows from those of sticking ones
  LocalState                   watched_state; ///< for guards: with these rates
  bool                         by_history = false, reads_joints = false;

  int  size() const { return n_frame + static_cast<int>(coordinate_names.size()); }
  int  add_coordinates(const std::string &body, const std::vector<std::string> &names);
  bool is_lag(const Measure &u) const; ///< whether the measure is a virtual coordinate
  void add_body(const Body &body);
  void add_interfaces(const std::vector<fem::Interface> &interfaces);
  void add_dyad(Triplets &matrix, double factor, const Measure &w); ///< matrix += factor w w^T
  void add_loads(double mass, const std::array<Measure, 3> &translation);
  void add_mass(double mass, const std::array<Measure, 3> &translation);
  /// Inertia of a rigid body at its directors, the first coordinate of which is `first`.
  void add_inertia(const std::string &what, const Eigen::Matrix3d &inertia, int first, bool is_whole_body);
  /// Rejects a rigid body as a carrier.
  void refuse_free_carrier(const Marker &carrier, const std::string &what) const;
  /// Motion of the point of a body at the arm [m] from its reference point.
  std::array<Measure, 3> moved_point(const Marker &marker, const Vector3 &arm) const;
  Vector3                position_of(const std::string &marker) const;
  bool                   moves_with_frame(const Marker &marker) const;

  void finish();
  /// Machine::in_modes(), assembled.
  std::unique_ptr<MachineParts> in_modes(const ModalCoordinates &modes) const;
  void                          assemble_dense(int n);
  void                          assemble_sparse(int n);
  void                          assemble_mechanism(int n);
  bool                          has_joints() const;
  void                          place_elements(int n);
  void                          refresh_guards();
  void                          find_stopped(const LocalState &state);
  void                          find_held_too();
  double                        held_rate(int measure) const; ///< prescribed rate of a sticking measure
  /// lambda . G u' with G u' = -rate, the motion prescribed by the joint: power of its drive.
  double prescribed_power(const PlacedElement &joint, const LocalState &state) const;
  /// -p . u' - dE/dt of its law; forces of the state include the residual of an iteration.
  double        taken_power(const PlacedElement &part, const LocalState &state) const;
  bool          is_stopped(const PlacedElement &part) const { return part.stop >= 0 && history[part.stop] != 0.; }
  Signal        watched_signal(const Switch &request) const;
  void          add_watches();
  void          place_switches();
  void          start_switches(const LocalState *state);
  void          watch(const PlacedSwitch &s, const LocalState *state);
  void          find_sides(const LocalState &state);
  bool          tells_found_force(const PlacedSwitch &s) const;
  SwitchPhase   phase(const PlacedSwitch &s) const;
  bool          is_active(const PlacedSwitch &s) const; ///< whether it has a guard
  GuardCrossing switch_crossing(const PlacedSwitch &s) const;
  std::string   switch_event(const PlacedSwitch &s) const;
  double        switch_guard(const PlacedSwitch &s, const LocalState &state) const;
  double        watched_value(const PlacedSwitch &s, const LocalState &state) const;
  void          throw_switch(int index, const LocalState &state);
  void          give_orders(int index, const LocalState &state);
  std::string   coordinate_name(int i) const;
  std::map<std::string, Signal> signals() const; ///< all signals, by path
  Signal                        signal(const std::string &path) const;
  bool                          has_motion(const std::string &name) const; ///< of a body or a measure

  double       *history_of(const PlacedElement &part) { return history.data() + part.first_history; }
  const double *history_of(const PlacedElement &part) const { return history.data() + part.first_history; }
};

} // namespace gestell::coupling
