#include "fem/assembly/interfaces.h"

#include <Eigen/Eigenvalues>

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
                                ": the points of its surfaces lie on one line, which leaves a rotation undefined; six "
                                "coordinates need a surface that spans a plane.");
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
