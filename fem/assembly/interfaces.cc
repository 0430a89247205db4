#include "fem/assembly/interfaces.h"

#include "fem/assembly/rigid_motions.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

std::string head(const InterfaceSpecification &interface)
{
  const std::string owner = interface.what + " \"" + interface.name + "\"";
  return interface.place.empty() ? owner : interface.place + ": " + owner;
}

/// Six coordinates need points that span a plane: the second principal moment of the area must not vanish.
void require_plane(const CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
  for (const int node : coupled.patch.nodes)
  {
    const Eigen::Vector3d r = Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data()) - coupled.patch.centroid;
    moment += r * r.transpose();
  }
  const Eigen::Vector3d principal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).eigenvalues();
  if (!(principal[1] > 1e-10 * principal[2]))
    throw std::invalid_argument(head(coupled.specification) +
                                ": the points of its surfaces are on one line, which leaves a rotation undefined; six "
                                "DOFs need a surface that spans a plane.");
}

Eigen::Matrix3Xd points_of(const SurfacePatch &patch, const QuadraticMesh &mesh)
{
  Eigen::Matrix3Xd points(3, patch.nodes.size());
  for (std::size_t k = 0; k < patch.nodes.size(); ++k)
    points.col(Eigen::Index(k)) = Eigen::Map<const Eigen::Vector3d>(mesh.points[patch.nodes[k]].data());
  return points;
}

/// Outward normal of a plane patch; zero if its triangles have different normals.
Eigen::Vector3d plane_normal(const SurfacePatch &patch, const QuadraticMesh &mesh)
{
  constexpr double bent   = 1e-9; // 1 - cos of 0.0026 degrees
  const auto       corner = [&](const auto &face, int k)
  { return Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(mesh.points[face[k]].data())); };
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const std::array<int, 6> &face : patch.faces)
    sum += 0.5 * (corner(face, 1) - corner(face, 0)).cross(corner(face, 2) - corner(face, 0));
  return sum.norm() > (1. - bent) * patch.area ? Eigen::Vector3d(sum.normalized())
                                               : Eigen::Vector3d(Eigen::Vector3d::Zero());
}

/// For faces that are not coplanar: the columns of `axes` are half the sides of their bounding box.
void draw_box(CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  const Eigen::AlignedBox3d box = box_of(coupled, mesh);
  coupled.face.centre           = box.center();
  coupled.face.axes             = (0.5 * box.sizes()).asDiagonal();
}

/// Whether polynomials of the face's degree differ on its nodes.
bool tells_apart(const PlaneFace &face, const Eigen::Matrix3Xd &points)
{
  constexpr double   dependent = 1e-6; // of the largest pivot
  const Eigen::Index n         = polynomials_at(face, face.centre).size();
  Eigen::MatrixXd    values(points.cols(), n);
  for (Eigen::Index k = 0; k < points.cols(); ++k)
    values.row(k) = polynomials_at(face, points.col(k));
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(values);
  return qr.setThreshold(dependent).rank() == n;
}

void make_flexible(CoupledPatch &coupled, const QuadraticMesh &mesh)
{
  PlaneFace &face = coupled.face;
  if (!face.known())
    throw std::invalid_argument(head(coupled.specification) +
                                ": its surfaces are not in one plane, which a flexible face requires; use coupling = "
                                "\"rigid\" or \"average\", or choose a plane face");
  const int  degree = face.degree = coupled.specification.degree;
  const auto points               = points_of(coupled.patch, mesh);
  if (!tells_apart(face, points))
    throw std::invalid_argument(head(coupled.specification) + ": the mesh has " + std::to_string(points.cols()) +
                                " nodes on this face, too few for fields of degree " + std::to_string(degree) +
                                "; mesh it finer (mesh = { \"" + coupled.specification.surfaces.front() +
                                "\" = \"... mm\" }), or lower the degree");
}

void require_apart(const std::vector<CoupledPatch> &interfaces, const QuadraticMesh &mesh,
                   const MultipointConstraints &constraints)
{
  std::vector<int> owner(mesh.n_nodes(), -1);
  for (std::size_t k = 0; k < interfaces.size(); ++k)
    for (const int node : interfaces[k].patch.nodes)
    {
      const auto place = [&]
      {
        std::ostringstream text;
        text << "(" << mesh.points[node][0] << ", " << mesh.points[node][1] << ", " << mesh.points[node][2] << ") m";
        return text.str();
      };
      if (owner[node] >= 0)
        throw std::invalid_argument(head(interfaces[k].specification) + " shares the point " + place() + " with " +
                                    interfaces[owner[node]].specification.what + " \"" +
                                    interfaces[owner[node]].specification.name +
                                    "\"; a point can follow one node only: choose surfaces that do not touch, or join "
                                    "them in one interface.");
      if (const auto support = constraints.holder.find(node); support != constraints.holder.end())
        throw std::invalid_argument(head(interfaces[k].specification) + " shares the point " + place() +
                                    " with the clamped support \"" + support->second +
                                    "\"; choose surfaces that do not touch.");
      owner[node] = static_cast<int>(k);
    }
}

} // namespace

std::vector<CoupledPatch> couple_patches(const Mesh &mesh, const QuadraticMesh &quadratic,
                                         const std::vector<InterfaceSpecification> &interfaces,
                                         MultipointConstraints                     &constraints)
{
  std::vector<CoupledPatch> result;
  for (const InterfaceSpecification &interface : interfaces)
  {
    if (interface.coupling == InterfaceCoupling::node)
    {
      result.push_back(nearest_node(interface, mesh, quadratic));
      continue;
    }
    CoupledPatch coupled{interface,
                         surface_patch(mesh, quadratic, interface.surfaces,
                                       interface.what + " \"" + interface.name + "\"", interface.place),
                         Eigen::Vector3d::Zero()};
    coupled.position = interface.position
                           ? Eigen::Vector3d(Eigen::Map<const Eigen::Vector3d>(interface.position->data()))
                           : coupled.patch.centroid;
    if (interface.coupling == InterfaceCoupling::point)
      shrink_to_point(coupled, quadratic);
    require_plane(coupled, quadratic);
    coupled.face = plane_face(points_of(coupled.patch, quadratic), plane_normal(coupled.patch, quadratic));
    if (!coupled.face.known())
      draw_box(coupled, quadratic);
    if (interface.coupling == InterfaceCoupling::flexible)
      make_flexible(coupled, quadratic);
    result.push_back(std::move(coupled));
  }
  constraints.n_interface_coordinates = 0;
  for (const CoupledPatch &coupled : result)
    constraints.n_interface_coordinates += coupled.n_coordinates();
  constraints.measures.resize(constraints.n_interface_coordinates);
  return result;
}

void tie_rigid(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, MultipointConstraints &constraints)
{
  for (const int node : coupled.patch.nodes)
  {
    const Eigen::Vector3d r = Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data()) - coupled.position;
    constraints.tie(3 * node + 0, {{first + ux, 1.}, {first + ry, r[2]}, {first + rz, -r[1]}});
    constraints.tie(3 * node + 1, {{first + uy, 1.}, {first + rz, r[0]}, {first + rx, -r[2]}});
    constraints.tie(3 * node + 2, {{first + uz, 1.}, {first + rx, r[1]}, {first + ry, -r[0]}});
  }
}

void tie_flexible(const CoupledPatch &coupled, const QuadraticMesh &mesh, int first, MultipointConstraints &constraints)
{
  for (const int node : coupled.patch.nodes)
  {
    const Eigen::Vector3d             x   = Eigen::Map<const Eigen::Vector3d>(mesh.points[node].data());
    const Eigen::Matrix<double, 3, 6> R   = rigid_motions_of_point(mesh.points[node], coupled.position);
    const Eigen::Matrix3Xd            phi = fields_at(coupled.face, x);
    for (int d = 0; d < 3; ++d)
    {
      Combination motion;
      for (int i = 0; i < 6; ++i)
        if (R(d, i) != 0.)
          motion.emplace_back(first + i, R(d, i));
      for (Eigen::Index k = 0; k < phi.cols(); ++k)
        if (phi(d, k) != 0.)
          motion.emplace_back(first + 6 + int(k), phi(d, k));
      constraints.tie(3 * node + d, std::move(motion));
    }
  }
}

void tie_interfaces(const std::vector<CoupledPatch> &interfaces, const QuadraticMesh &mesh,
                    MultipointConstraints &constraints)
{
  require_apart(interfaces, mesh, constraints);
  int first = constraints.first_new();
  for (const CoupledPatch &coupled : interfaces)
  {
    switch (coupled.specification.coupling)
    {
    case InterfaceCoupling::rigid:
      tie_rigid(coupled, mesh, first, constraints);
      break;
    case InterfaceCoupling::flexible:
      tie_flexible(coupled, mesh, first, constraints);
      break;
    case InterfaceCoupling::average:
    case InterfaceCoupling::point:
      tie_average(coupled, mesh, first, constraints);
      break;
    case InterfaceCoupling::node:
      for (int d = 0; d < 3; ++d)
        constraints.tie(3 * coupled.patch.nodes.front() + d, {{first + d, 1.}});
    }
    first += coupled.n_coordinates();
  }
}

} // namespace gestell::fem
