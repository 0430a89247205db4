#include "fem/assembly/attached_masses.h"

#include "fem/assembly/rigid_motions.h"
#include "fem/values/message_text.h"
#include "fem/values/nearest_name.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

using Matrix6 = Eigen::Matrix<double, 6, 6>;

std::string head(const AttachedMass &mass)
{
  const std::string owner = "mass \"" + mass.name + "\"";
  return mass.place.empty() ? owner : mass.place + ": " + owner;
}

/// Requires moments of a rigid body: J >= 0, none larger than the sum of the two others.
void require_inertia(const AttachedMass &mass)
{
  const Eigen::Matrix3d &J        = mass.inertia;
  constexpr double       rounding = 1e-9; // of the trace, in tensors typed by hand
  if (!J.allFinite() || (J - J.transpose()).cwiseAbs().maxCoeff() > rounding * std::abs(J.trace()))
    throw std::invalid_argument(head(mass) + ": its tensor of inertia must be finite and symmetric.");
  const Eigen::Vector3d moments = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(J).eigenvalues();
  if (moments[0] < -rounding * J.trace() || moments[2] > moments[0] + moments[1] + rounding * J.trace())
  {
    std::ostringstream message;
    message << head(mass) << ": its principal moments of inertia are " << moments.transpose()
            << " kg m^2, but each must be at least 0 and at most the sum of the two others; check units and signs of "
               "the products (Jxy = -int x y dm).";
    throw std::invalid_argument(message.str());
  }
}

} // namespace

void require_valid(const std::vector<AttachedMass> &masses, const std::vector<InterfaceSpecification> &interfaces)
{
  std::vector<std::string> known;
  for (const InterfaceSpecification &interface : interfaces)
    known.push_back(interface.name);
  for (const AttachedMass &mass : masses)
  {
    if (!std::isfinite(mass.mass) || !(mass.mass > 0.))
      throw std::invalid_argument(head(mass) + " has " + text(mass.mass) + " kg; its mass must be above 0.");
    require_inertia(mass);
    if (mass.interface.empty())
      continue;
    const auto on = std::find(known.begin(), known.end(), mass.interface);
    if (on == known.end())
      throw std::invalid_argument(head(mass) + ": there is no interface \"" + mass.interface + "\"; " +
                                  nearest_names(mass.interface, known, "interface") + ".");
    if (interfaces[on - known.begin()].coupling == InterfaceCoupling::node && (mass.centre || !mass.inertia.isZero(0.)))
      throw std::invalid_argument(head(mass) + ": interface \"" + mass.interface +
                                  "\" is a single node without rotations and can carry a point mass only; remove "
                                  "inertia and position, or give the interface surfaces and coupling = "
                                  "\"average\".");
  }
}

std::vector<InterfaceSpecification> nodes_of_masses(const std::vector<AttachedMass> &masses)
{
  std::vector<InterfaceSpecification> nodes;
  for (const AttachedMass &mass : masses)
    if (mass.interface.empty())
    {
      InterfaceSpecification node;
      node.name     = mass.name;
      node.surfaces = mass.surfaces;
      node.coupling = mass.coupling;
      node.position = mass.centre;
      node.place    = mass.place;
      node.what     = "mass";
      nodes.push_back(std::move(node));
    }
  return nodes;
}

const Interface &node_of(const AttachedMass &mass, const std::vector<Interface> &nodes)
{
  // Nodes of masses precede nodes of interfaces, which may have the same names.
  const bool own    = mass.interface.empty();
  const auto called = [&](const Interface &node) { return node.name == (own ? mass.name : mass.interface); };
  return own ? *std::find_if(nodes.begin(), nodes.end(), called) : *std::find_if(nodes.rbegin(), nodes.rend(), called);
}

MassProperties properties_of(const AttachedMass &mass, const Interface &node)
{
  const Vector3 centre = mass.centre.value_or(node.position);
  return {mass.mass, Eigen::Map<const Eigen::Vector3d>(centre.data()), mass.inertia};
}

namespace
{

/// Motions of the centre of the mass as a function of the motions of its node.
Eigen::Matrix<double, 3, 6> motions_of_centre(const AttachedMass &mass, const Interface &node)
{
  return rigid_motions_of_point(mass.centre.value_or(node.position), node.position);
}

/// Three of a node of the mesh, which carries a point of mass; see require_valid().
int motions_of(const Interface &node)
{
  return node.coordinate[rx] < 0 ? 3 : 6;
}

} // namespace

Eigen::SparseMatrix<double> mass_matrix(const std::vector<AttachedMass> &masses, const std::vector<Interface> &nodes,
                                        int n)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (const AttachedMass &mass : masses)
  {
    const Interface                  &node   = node_of(mass, nodes);
    const Eigen::Matrix<double, 3, 6> R      = motions_of_centre(mass, node);
    Matrix6                           M_node = mass.mass * R.transpose() * R;
    M_node.bottomRightCorner<3, 3>() += mass.inertia;
    const int n_motions = motions_of(node);
    for (int i = 0; i < n_motions; ++i)
      for (int j = 0; j < n_motions; ++j)
        entries.emplace_back(node.coordinate[i], node.coordinate[j], 0.5 * (M_node(i, j) + M_node(j, i)));
  }
  Eigen::SparseMatrix<double> M(n, n);
  M.setFromTriplets(entries.begin(), entries.end());
  return M;
}

void add_loads(const std::vector<AttachedMass> &masses, const std::vector<Interface> &nodes, Eigen::MatrixXd &load)
{
  for (const AttachedMass &mass : masses)
  {
    const Interface                  &node = node_of(mass, nodes);
    const Eigen::Matrix<double, 3, 6> R    = motions_of_centre(mass, node);
    for (int i = 0; i < motions_of(node); ++i)
      load.row(node.coordinate[i]) += mass.mass * R.col(i).transpose();
  }
}

} // namespace gestell::fem
