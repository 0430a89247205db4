#pragma once

#include "fem/values/cad_source.h"
#include "fem/values/modal_ratios.h"
#include "fem/values/vector3.h"

#include <Eigen/Core>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// Surface of the CAD model, selected by visible properties.  All given conditions must be satisfied.
struct SurfaceSelector
{
  struct Cylinder
  {
    Vector3 axis;    ///< direction, any length
    Vector3 through; ///< a point on the axis [m]
    double  radius;  ///< [m]
  };
  struct Plane
  {
    Vector3 normal;  ///< outward, any length
    Vector3 through; ///< a point of the plane [m]
  };
  struct Box
  {
    Vector3 min, max; ///< [m]; the face lies inside
  };
  std::optional<Cylinder>    cylinder;
  std::optional<Plane>       plane;
  std::optional<Box>         box;
  std::optional<std::string> group;     ///< physical group or STEP name
  std::optional<double>      tolerance; ///< [m]; default 1e-4 of the model's diagonal
  int                        faces = 1; ///< number of CAD faces expected; 0 = any number, at least one
  std::string                place;     ///< "press.toml:31: frame.surface.feet", prefix of messages
};

struct Material
{
  double      E   = 0.; ///< Young's modulus [Pa]
  double      nu  = 0.; ///< Poisson's ratio
  double      rho = 0.; ///< density [kg/m^3]; 0: of the STEP file
  std::string place;
  std::string name{}; ///< "steel", for reports
};

enum class SupportKind
{
  clamped,
  foundation
};

/// Stiffness and damping of a foundation are totals over the surface, spread evenly over its area, or given per area;
/// they act along `axes`.
struct Support
{
  std::string              name;
  std::vector<std::string> surfaces;
  SupportKind              kind = SupportKind::clamped;
  std::array<bool, 3>      held{true, true, true}; ///< clamped: fixed displacements (x, y, z)
  Vector3                  stiffness{};            ///< foundation: [N/m], per area [N/m^3]
  Vector3                  damping{};              ///< foundation: [N s/m], per area [N s/m^3]
  std::string              place;
  std::array<bool, 2>      per_area{false, false}; ///< stiffness, damping
  std::array<Vector3, 3>   axes{
      {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}; ///< foundation: orthonormal directions of the three values
};

enum class InterfaceCoupling
{
  rigid,    ///< RBE2: the surface moves as a rigid body with the node
  flexible, ///< like `rigid`, with surface deformations in polynomials of `degree` (face_fields.h); for joints of parts
  average,  ///< RBE3: the node moves as the area-weighted mean of the surface, which remains flexible
  point,    ///< the point of the surface nearest to `position`: average over the triangles around it
  node      ///< the corner of the mesh nearest to `position`, on the surfaces or, without any, on the whole skin
};

/// One node with six coordinates (ux uy uz rx ry rz) tied to surfaces; for `node` only three (ux uy uz).
struct InterfaceSpecification
{
  std::string              name;
  std::vector<std::string> surfaces;
  InterfaceCoupling        coupling = InterfaceCoupling::rigid;
  std::optional<Vector3>   position; ///< [m]; default: centroid of the surfaces
  std::string              place;
  double                   radius = 0.;          ///< of a point [m]: triangles within it; 0: those that share it
  int                      degree = 0;           ///< for `flexible`
  std::string              what   = "interface"; ///< name of its owner in messages
};

/// A rigid body fastened to the frame, such as a motor or a counterweight: to surfaces, or to the node of an interface.
struct AttachedMass
{
  std::string              name;
  double                   mass    = 0.;                      ///< [kg]
  Eigen::Matrix3d          inertia = Eigen::Matrix3d::Zero(); ///< about its centre of mass, global axes [kg m^2]
  std::optional<Vector3>   centre;    ///< of mass [m]; default: the node of the interface, the centroid of the surfaces
  std::string              interface; ///< that carries it; empty: it has its own surfaces
  std::vector<std::string> surfaces;
  InterfaceCoupling        coupling = InterfaceCoupling::rigid; ///< to the surfaces
  std::string              place;
};

/// Plane through the frame; its outputs are the forces and moments across it, see cut_forces().
struct CutSpecification
{
  std::string            name;
  Vector3                through{}; ///< [m]
  Vector3                normal{0., 0., 1.};
  std::string            place;
  std::optional<Vector3> first{}; ///< direction of the first axis in the plane; default: the axis after the nearest one
  std::optional<Vector3> about{}; ///< [m] of the moments; default: centroid of the section
};

/// Endings of the names of section forces, with their units: normal force, shear forces, torsion, bending moments.
constexpr std::array<std::array<const char *, 2>, 6> section_components{
    {{"", "N"}, {".V1", "N"}, {".V2", "N"}, {".T", "N m"}, {".M1", "N m"}, {".M2", "N m"}}};

/// Point of the surface with the stress as outputs.
struct StressPointSpecification
{
  std::string            name;
  Vector3                at{};    ///< [m]
  std::optional<Vector3> along{}; ///< direction n of a normal stress n . sigma n
  std::string            place;
};

/// A static load, spread evenly over surfaces: a total force, and a pressure on the undeformed surface.
struct SurfaceLoad
{
  std::vector<std::string> surfaces;
  Vector3                  force{};       ///< [N]
  double                   pressure = 0.; ///< [Pa], pushes into the solid
  std::string              place;
};

/// Static loads that stress a frame before it vibrates.
struct Prestress
{
  Vector3                  acceleration{}; ///< [m/s^2] of gravity
  std::vector<SurfaceLoad> loads;
  double                   factor   = 1.;    ///< of all loads
  bool                     tie_rods = false; ///< of joints between parts
  std::vector<double> interface_motion; ///< of a part: its given interface coordinates, in the order of q; or empty
  std::string         place;
};

/// Treatment of the common part of overlapping solids.
enum class Overlaps
{
  refused,
  once ///< it belongs to the solid that comes first in the file
};

/// Meshing of solids that consist of plates.
enum class Plates
{
  tetrahedra, ///< like all others
  swept       ///< hexahedra and prisms through the thickness, if the solids can be divided
};

struct MeshOptions
{
  double                        size = 0.;    ///< [m]
  std::map<std::string, double> surface_size; ///< [m] on named surfaces, graded outwards
  double                        max_cells = 2e6;
  double                        gap       = 0.; ///< [m]: solids within this distance are joined
  int                           bodies    = 1;  ///< expected number of unconnected bodies
  double                        defeature = 0.; ///< [m]: faces and edges smaller than this are removed
  Overlaps                      overlaps  = Overlaps::refused;
  bool                          curved    = false; ///< sides follow the geometry
  Plates                        plates    = Plates::tetrahedra;
  int                           layers    = 1; ///< smallest number of cells through a swept plate
  std::string                   place;
};

/// Complete definition of a frame from CAD or from a mesh.
struct FrameSpecification
{
  std::string cad;       ///< .step .stp .brep .geo .msh .inp; absolute path
  double      unit = 0.; ///< length unit of a file without one [m]; 0: from the file
  MeshOptions mesh;
  Material    material; ///< of all solids except those in `materials`
  /// By the name of a solid or a pattern of names ('*', '?'); the last match is used.
  std::vector<std::pair<std::string, Material>> materials;
  ModalRatios                                   modal_damping_ratio;
  double                                 rayleigh_mass = 0.; ///< alpha [1/s] of B = alpha M + beta C of the material
  double                                 rayleigh_stiffness = 0.; ///< beta [s]
  std::map<std::string, SurfaceSelector> surfaces;
  std::vector<Support>                   supports;
  std::vector<InterfaceSpecification>    interfaces;
  std::vector<AttachedMass>              masses;
  std::vector<CutSpecification>          cuts;
  std::vector<StressPointSpecification>  stress_points;
  bool                                   stress  = false; ///< stress recovery is requested
  int                                    parts   = 1;     ///< that the mesh is cut into; 0: chosen by their memory
  Scripts                                scripts = Scripts::harmless;
  double                                 sew     = 0.; ///< [m], as in CadSource
  std::string                            place;        ///< "press.toml:12: frame"
  std::optional<Prestress>               prestress{};
};

} // namespace gestell::fem
