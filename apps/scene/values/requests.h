#pragma once

#include "apps/scene/language/quantity.h"
#include "coupling/machine/machine.h"
#include "coupling/modes/superposition.h"
#include "coupling/plugin/frame_service.h"
#include "coupling/simulation/simulation.h"
#include "coupling/substructures/frame_of_parts.h"
#include "fem/values/cad_body.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/frame_specification.h"
#include "mechanism/functions/user_function.h"
#include "mechanism/joints/motion_law.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

using Vector3 = std::array<double, 3>;

enum class FrameSource
{
  none,
  geometry,    ///< CAD or mesh, made by the FrameService
  parts,       ///< several of them, reduced separately and joined
  matrices,    ///< M, B, C inline or from files
  reduced_file ///< a reduced frame saved by an earlier run
};

struct FrameRequest
{
  FrameSource             source = FrameSource::none;
  fem::FrameSpecification geometry;
  coupling::FrameOfParts  parts;
  fem::FrameMatrices      matrices;
  bool                    has_translations = false; ///< of `matrices`
  std::string             reduced_file;             ///< absolute path
  std::string             place;
};

struct ReductionRequest
{
  std::string                method = "none"; ///< a name of coupling::Reductions
  coupling::ReductionOptions options;         ///< for an unreduced frame those of its companion

  std::optional<coupling::SuperpositionOptions> superposition{}; ///< the machine is integrated in its modes

  bool makes_frame = false; ///< makes a reduced frame
  bool reduces() const { return makes_frame; }
};

/// The shape of a body from CAD, in its position in the scene.
struct CadBodyRequest
{
  fem::CadBody shape;        ///< in the scene's coordinates; its inertia is for density one
  double       density = 0.; ///< [kg/m^3]
  std::string  found;        ///< for people: file, mass, centre of mass, inertia
};

/// For a rotor with its centre of mass off its axis.
struct UnbalanceRequest
{
  double                 amount = 0.; ///< mass times eccentricity [kg m]
  double                 phase  = 0.; ///< [rad] of the centre of mass at zero angle, see attach_unbalance()
  std::optional<Vector3> position{};  ///< [m] on its axis; none: the position of its carrier
};

struct BodyRequest
{
  std::string        name;
  coupling::BodyKind kind = coupling::BodyKind::rotor;
  Vector3            axis{};                           ///< unit vector
  std::string        carrier;                          ///< marker that carries a rotor, or guides a slider
  double             inertia = 0., mass = 0.;          ///< kg m^2, kg
  Eigen::Matrix3d    tensor = Eigen::Matrix3d::Zero(); ///< inertia of a rigid body in global axes [kg m^2]
  Vector3            position{}, size{};               ///< [m], for pictures
  double             radius = 0.;                      ///< [m], for pictures
  std::string        place;

  std::shared_ptr<const CadBodyRequest> part; ///< inertia, mass and position come from it; null if they are given
  std::optional<UnbalanceRequest>       unbalance{};
};

/// A point of a body, an interface or the ground, in the reference configuration.
struct PlaceRequest
{
  std::string            marker;
  std::optional<Vector3> at; ///< [m]; none: the reference point of the body
};

/// A point with a name, for signals.
struct NamedPlace
{
  std::string  name;
  PlaceRequest point;
  std::string  place; ///< location in the scene file
};

/// weight * (motion of a marker along or about an axis).
struct MotionTerm
{
  std::string marker;
  bool        rotation = false;
  Vector3     axis{}; ///< unit vector
  double      weight = 1.;
};
using MotionMeasure = std::vector<MotionTerm>;

struct MeasureRequest;

/// weight * (a motion of markers, or a scalar of two points).
struct TermRequest
{
  double                                weight = 1.;
  MotionMeasure                         motion;
  std::shared_ptr<const MeasureRequest> placed; ///< without terms; null: `motion`
};

/// Two meshing gears with parallel axes.
struct MeshRequest
{
  Vector3 axis{};              ///< of both, unit vector
  double  ratio          = 0.; ///< of the speeds, second gear to first, relative to the line of centres
  double  pressure_angle = 0.; ///< [rad], negative: the other flank is in contact
};

/// A scalar of the relative motion of two points, or a sum of terms, optionally minus a function;
/// docs/reference/scene/joints.md.
struct MeasureRequest
{
  std::string                         name;
  mechanism::RelativeMeasure::Form    form = mechanism::RelativeMeasure::Form::along;
  PlaceRequest                        first, second;
  Vector3                             a{}, b{}; ///< unit vectors
  mechanism::RelativeMeasure::Carrier carrier = mechanism::RelativeMeasure::Carrier::space;
  std::string                         unit;
  std::string                         place;

  std::vector<TermRequest>                           terms; ///< if any, the measure is their sum instead
  std::shared_ptr<const mechanism::PositionFunction> function;
  TermRequest                                        argument; ///< of the function

  std::optional<MeshRequest> mesh; ///< of `form` mesh
};

struct JointFrictionRequest; // apps/scene/joints/joint_friction.h

/// Of a compliant joint.
struct ComplianceRequest
{
  Vector3               stiffness{}, damping{}; ///< [N/m], [N s/m] along the global axes in the reference configuration
  bool                  directed = false;       ///< the three differ and rotate with the first body
  std::optional<double> rotational_stiffness;   ///< [N m/rad]; required if the joint constrains rotations
  std::optional<double> rotational_damping;     ///< [N m s/rad]
};

struct JointRequest
{
  std::string                                 name;
  std::string                                 type; ///< name of a JointType, apps/scene/joints/joint_types.h
  PlaceRequest                                from, to;
  Vector3                                     axis{};        ///< zero for a revolute joint of bodies without a choice
  Vector3                                     axis_to{};     ///< of `universal`, on the second body
  std::optional<double>                       length;        ///< of `distance` [m]; none: in the initial position
  double                                      ratio = 1.;    ///< of `gear`
  std::shared_ptr<const mechanism::MotionLaw> law;           ///< of `distance` and of a scalar
  MeasureRequest                              measure;       ///< a scalar with a prescribed value or motion
  std::optional<double>                       value;         ///< of the scalar; none: in the reference configuration
  std::string                                 reaction_unit; ///< of the reaction on the argument of its function
  std::shared_ptr<const JointFrictionRequest> friction;      ///< for joints that slide, or null
  std::optional<ComplianceRequest>            compliance;    ///< for joints that connect two points
  bool                                        holds_rotations = false;
  std::string                                 place;

  bool is_scalar() const { return !measure.unit.empty(); }
};

struct SwitchRequest
{
  coupling::Switch        request;
  Quantity                level; ///< with its unit
  std::optional<Quantity> hysteresis;
  std::string             place;
};

struct ProfileKeys;

struct LinearRequest
{
  std::string   name;
  MotionMeasure u;
  double        stiffness = 0., damping = 0., preload = 0., rest = 0.;
  std::string   force_unit;
};

/// External load constant + sum amplitude sin(omega t + phase) on u.
struct LoadRequest
{
  std::string                        name;
  MotionMeasure                      u;
  double                             constant = 0.;
  std::vector<coupling::Oscillation> oscillations;
  std::string                        force_unit;
};

/// Lag coordinate T x' + x = p of an element.
struct LagRequest
{
  std::string name; ///< "motor.torque"
  double      time_constant = 0.;
};

/// Both common tangents of two wheels in one plane, and the distance of their centres: mechanism::CommonTangents.
struct TangentsRequest
{
  Vector3 axis{};                  ///< of both wheels, unit vector
  double  first = 0., second = 0.; ///< radii that the tangents touch [m]; of one sign: they touch from the same side
  double  factor      = 1.;        ///< of their lengthening; negative: they are loaded by shortening
  double  advance     = 0.;    ///< of the motion of `to` along the axis, for the left tangent; for the right -advance
  double  pitch_point = 0.;    ///< where that motion counts: its distance from the first centre [m]
  bool    winds       = false; ///< the line of centres may turn any number of times
};

/// Motion of point `to` relative to the body of `from`: displacements along directions fixed to that body, then its
/// rotation about an axis, if any; or the tangents of two wheels.
struct PairRequest
{
  PlaceRequest                           from, to;
  std::vector<Vector3>                   along; ///< unit vectors
  std::optional<Vector3>                 about; ///< unit vector
  std::shared_ptr<const TangentsRequest> tangents{};
};

struct ElementRequest
{
  std::string                          name;
  std::shared_ptr<mechanism::ForceLaw> element;
  std::vector<MotionMeasure>           measures;
  std::string                          on;     ///< MeasureRequest on which the element, a law of one measure, acts
  std::vector<LagRequest>              lags;   ///< the element's last measures
  std::optional<PairRequest>           pair{}; ///< measures of the element's law
  /// A measure without a name on which the element acts, relative to the reference configuration.
  std::shared_ptr<const MeasureRequest> own{};
  bool follows = false; ///< of `own`: the element is a load on its second point and rotates with it

  coupling::MeasureKind              kind = coupling::MeasureKind::displacement;
  std::shared_ptr<const ProfileKeys> levels{};      ///< kinds of the command "set"; null: not accepted
  bool                               fixed = false; ///< cannot be switched off: its state would continue to change
};

struct PointMassRequest
{
  std::string name, marker;
  double      mass = 0.;
  Vector3     inertia{}, offset{};
};

/// Value of a coordinate or of its rate, by the name of the coordinate.
struct NamedValue
{
  std::string name;
  double      value;
  std::string place;
  bool        measure = false; ///< of a MeasureRequest
};

enum class StartRule
{
  given, ///< q and q' as listed, zero for the rest
  rest,  ///< coupling::static_equilibrium near `given`
  steady ///< coupling::steady_start
};

struct StartRequest
{
  StartRule               rule = StartRule::given;
  std::vector<NamedValue> q, v; ///< given
  coupling::SteadyStart   steady;
  bool                    periodic       = false; ///< search the periodic solution from there
  bool                    drift          = false; ///< rest: with the quasi-static velocity
  bool                    inertia_relief = false; ///< rest: inertia balances the loads on unconstrained DOFs
  std::string             place;
};

struct SignalRequest
{
  std::string                                  name, path, place;
  std::string                                  from;   ///< event after which its extremes are evaluated
  std::shared_ptr<const mechanism::UserSignal> user{}; ///< a function of other signals; null: `path`
  std::vector<std::string>                     of{};   ///< paths of its arguments
};

/// An instant of the run at which stresses are computed.
struct StressInstant
{
  enum When
  {
    time,              ///< coupling::StateRequest::at
    extreme_of_signal, ///< coupling::StateRequest::extremes
    largest_stress
  };
  std::string label; ///< for people; empty: the time
  When        when  = largest_stress;
  int         index = 0;
};

struct StressRequest
{
  bool                       given = false; ///< there is an [output.stress]
  std::vector<StressInstant> instants;
  std::string                place;
};

/// Stages of the run between events, and signals whose ringing in the last stage is identified.
struct StageRequest
{
  std::vector<std::string> names, borders; ///< one name more than borders; a border is an event, "NAME" or "NAME.KIND"
  std::vector<std::string> ringing;        ///< names of signals
  int                      modes = 3;      ///< largest number reported
  std::string              place;

  bool given() const { return !names.empty(); }
};

struct LifeRequest; // apps/scene/values/life_request.h

struct ModesRequest
{
  std::vector<NamedValue>  at;   ///< configuration of the bodies; zero for the rest
  std::vector<std::string> open; ///< elements that are not engaged
  int                      number = 20;
};

struct RunRequest
{
  bool                 given      = false; ///< there is a [run]
  bool                 step_given = true;  ///< else it follows from the modes of the superposition
  coupling::RunOptions options;
  bool                 last_period = false; ///< extremes are evaluated over it: options.from follows from the machine
  std::string          place;
};

/// A scene file as a plain value: validated on its own, nothing computed.
struct Scene
{
  std::string                        file, name, description;
  Vector3                            gravity{};
  FrameRequest                       frame;
  ReductionRequest                   reduction;
  std::vector<BodyRequest>           bodies;
  std::vector<LinearRequest>         linear;
  std::vector<LoadRequest>           loads;
  std::vector<ElementRequest>        elements;
  std::vector<NamedPlace>            places;
  std::vector<MeasureRequest>        measures;
  std::vector<JointRequest>          joints;
  std::vector<SwitchRequest>         switches;
  std::vector<PointMassRequest>      point_masses;
  std::vector<coupling::DrawnRod>    rods;
  std::map<std::string, std::string> element_places; ///< locations by the element's name
  StartRequest                       start;
  RunRequest                         run;
  ModesRequest                       modes;
  std::vector<SignalRequest>         signals;
  StressRequest                      stress;
  StageRequest                       stages;
  std::shared_ptr<const LifeRequest> life;     ///< null: there is no [life]
  std::vector<std::string>           warnings; ///< about valid but suspicious input
};

} // namespace gestell::apps
