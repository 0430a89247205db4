#pragma once

#include <array>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace gestell::fem
{

using Vector3 = std::array<double, 3>;

/// Surface of the CAD model, by what a user can see of it.  All given conditions must hold.
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
  int                        faces = 1; ///< number of CAD faces expected; 0 = any number but none
  std::string                place;     ///< "press.toml:31: frame.surface.feet", heads messages
};

struct Material
{
  double      E   = 0.; ///< Young's modulus [Pa]
  double      nu  = 0.; ///< Poisson's ratio
  double      rho = 0.; ///< density [kg/m^3]
  std::string place;
};

enum class SupportKind
{
  clamped,
  foundation
};

/// Stiffness and damping are totals over the surface, spread evenly over its area, per global direction.
struct Support
{
  std::string              name;
  std::vector<std::string> surfaces;
  SupportKind              kind = SupportKind::clamped;
  std::array<bool, 3>      held{true, true, true}; ///< clamped: which displacements (x, y, z)
  Vector3                  stiffness{};            ///< foundation: [N/m]
  Vector3                  damping{};              ///< foundation: [N s/m]
  std::string              place;
};

enum class InterfaceCoupling
{
  rigid,  ///< RBE2: the surface moves as a rigid body with the node
  average ///< RBE3: the node moves as the area-weighted mean of the surface, the surface stays flexible
};

/// One node with six coordinates (ux uy uz rx ry rz) tied to surfaces.
struct InterfaceSpecification
{
  std::string              name;
  std::vector<std::string> surfaces;
  InterfaceCoupling        coupling = InterfaceCoupling::rigid;
  std::optional<Vector3>   position; ///< [m]; default: centroid of the surfaces
  std::string              place;
};

/// Plane through the frame; its output is the force across it in direction of `normal`, tension positive.
struct CutSpecification
{
  std::string name;
  Vector3     through{}; ///< [m]
  Vector3     normal{0., 0., 1.};
  std::string place;
};

struct MeshOptions
{
  double                        size = 0.;    ///< [m]
  std::map<std::string, double> surface_size; ///< [m] on named surfaces, graded outwards
  double                        max_cells = 2e6;
  std::string                   place;
};

/// All that defines a frame made from CAD or from a mesh.
struct FrameSpecification
{
  std::string                            cad;       ///< .step .stp .brep .geo .msh; absolute path
  double                                 unit = 0.; ///< length unit of a file without one [m]; 0: the file knows
  MeshOptions                            mesh;
  Material                               material;
  double                                 modal_damping_ratio = 0.;
  double                                 rayleigh_mass = 0.; ///< alpha [1/s] of B = alpha M + beta C of the material
  double                                 rayleigh_stiffness = 0.; ///< beta [s]
  std::map<std::string, SurfaceSelector> surfaces;
  std::vector<Support>                   supports;
  std::vector<InterfaceSpecification>    interfaces;
  std::vector<CutSpecification>          cuts;
  std::string                            place; ///< "press.toml:12: frame"
};

} // namespace gestell::fem
