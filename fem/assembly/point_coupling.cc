#include "fem/assembly/interfaces.h"
#include "fem/values/triangle_surface.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

using Eigen::Vector3d;

Vector3d corner(const QuadraticMesh &mesh, const std::array<int, 6> &face, int k)
{
  return Eigen::Map<const Vector3d>(mesh.points[face[k]].data());
}

struct NearestPoint
{
  Vector3d position;
  int      node; ///< nearest corner of the triangle that contains the position
};

NearestPoint nearest_point(const SurfacePatch &patch, const QuadraticMesh &mesh, const Vector3d &x)
{
  NearestPoint result{Vector3d::Constant(std::numeric_limits<double>::max()), -1};
  double       least = std::numeric_limits<double>::max();
  for (const auto &face : patch.faces)
  {
    const std::array<Vector3d, 3> corners{corner(mesh, face, 0), corner(mesh, face, 1), corner(mesh, face, 2)};
    const Vector3d                point = nearest_on_triangle(x, corners);
    if (!((point - x).squaredNorm() < least))
      continue;
    least           = (point - x).squaredNorm();
    const auto near = std::min_element(corners.begin(), corners.end(),
                                       [&](const Vector3d &a, const Vector3d &b)
                                       { return (a - point).squaredNorm() < (b - point).squaredNorm(); });
    result          = {point, face[near - corners.begin()]};
  }
  return result;
}

using Triangles = std::vector<std::array<int, 6>>;

Triangles triangles_of(const InterfaceSpecification &interface, const Mesh &mesh, const QuadraticMesh &quadratic)
{
  if (!interface.surfaces.empty())
    return surface_patch(mesh, quadratic, interface.surfaces, interface.what + " \"" + interface.name + "\"",
                         interface.place)
        .faces;
  return quadratic.skin;
}

std::string metres(const Vector3d &x)
{
  std::ostringstream text;
  text << "(" << x[0] << ", " << x[1] << ", " << x[2] << ") m";
  return text.str();
}

} // namespace

CoupledPatch nearest_node(const InterfaceSpecification &interface, const Mesh &mesh, const QuadraticMesh &quadratic)
{
  if (!interface.position)
    throw std::invalid_argument((interface.place.empty() ? "" : interface.place + ": ") + interface.what + " \"" +
                                interface.name +
                                "\" is a single node, which is selected by position; give a position near a node.");
  const Eigen::Map<const Vector3d> wanted(interface.position->data());
  int                              nearest = -1;
  double                           least   = std::numeric_limits<double>::max();
  for (const auto &face : triangles_of(interface, mesh, quadratic))
    for (int k = 0; k < 3; ++k)
      if (const double squared = (corner(quadratic, face, k) - wanted).squaredNorm(); squared < least)
      {
        least   = squared;
        nearest = face[k];
      }
  CoupledPatch coupled{interface, {}, Vector3d(quadratic.points[nearest].data())};
  coupled.patch.nodes    = {nearest};
  coupled.patch.centroid = coupled.position;
  return coupled;
}

std::vector<std::string> nodes_beside(const std::vector<CoupledPatch> &interfaces, double tolerance)
{
  std::vector<std::string> notes;
  for (const CoupledPatch &coupled : interfaces)
  {
    const InterfaceSpecification &own     = coupled.specification;
    const bool                    is_node = own.coupling == InterfaceCoupling::node;
    if (!is_node && (own.coupling != InterfaceCoupling::point || !own.position))
      continue;
    const Eigen::Map<const Vector3d> wanted(own.position->data());
    const double                     distance = (coupled.position - wanted).norm();
    // Share of the width of the triangles around a point of a curved surface. The distance of its facets is smaller: an
    // edge h of a circle of radius r >= h is off by h^2 / (8 r), and one triangle has an area of 0.43 h^2.
    constexpr double facets_off = 0.25;
    if (distance <= (is_node ? tolerance : std::max(tolerance, facets_off * std::sqrt(coupled.patch.area))))
      continue;
    std::ostringstream text;
    text << own.what << " \"" << own.name << "\" is the " << (is_node ? "node" : "point of its surface") << " at "
         << metres(coupled.position) << ", " << 1e3 * distance << " mm from its position " << metres(wanted)
         << (is_node ? ": the mesh has no node there; every vertex of the geometry is a node"
                     : ": give a position on the surface, or use coupling = \"average\" for a point off the surface");
    notes.push_back(text.str());
  }
  return notes;
}

Eigen::AlignedBox3d box_of(const CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  Eigen::AlignedBox3d box;
  for (const int node : coupled.patch.nodes)
    box.extend(Eigen::Map<const Vector3d>(mesh.points[node].data()));
  return box;
}

std::vector<std::string> masses_far_off(const std::vector<CoupledPatch> &coupled, double distance)
{
  std::vector<std::string> notes;
  for (const CoupledPatch &mass : coupled)
  {
    const InterfaceSpecification &own = mass.specification;
    const double                  off = (mass.position - mass.patch.centroid).norm();
    if (own.what == InterfaceSpecification().what || off <= distance)
      continue;
    std::ostringstream text;
    text << own.what << " \"" << own.name << "\" is at " << metres(mass.position) << ", " << off
         << " m from the centre of its surface, farther than the size of the frame: a position without unit is in "
            "metres, as in [10, 60, 140]; write \"10 mm\" for millimetres";
    notes.push_back(text.str());
  }
  return notes;
}

void shrink_to_point(CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  const InterfaceSpecification &own     = coupled.specification;
  const NearestPoint            nearest = nearest_point(coupled.patch, mesh, coupled.position);

  std::vector<std::array<int, 6>> faces;
  for (const auto &face : coupled.patch.faces)
  {
    const Vector3d centroid = (corner(mesh, face, 0) + corner(mesh, face, 1) + corner(mesh, face, 2)) / 3.;
    const bool     belongs  = own.radius > 0. ? (centroid - nearest.position).norm() <= own.radius
                                              : std::find(face.begin(), face.begin() + 3, nearest.node) != face.begin() + 3;
    if (belongs)
      faces.push_back(face);
  }
  if (faces.empty())
  {
    std::ostringstream message;
    message << (own.place.empty() ? "" : own.place + ": ") << own.what << " \"" << own.name
            << "\": no triangle of its surface has its centroid within the radius of " << own.radius << " m about ("
            << nearest.position.transpose() << ") m; use a larger radius or mesh the surface finer.";
    throw std::invalid_argument(message.str());
  }
  coupled.position = nearest.position;
  coupled.patch    = surface_patch(mesh, std::move(faces));
}

} // namespace gestell::fem
