#include "fem/discretisation.h"

#include "fem/attached_masses.h"
#include "fem/cell_materials.h"
#include "fem/cut_force.h"
#include "fem/elasticity.h"
#include "fem/hexahedral_mesh.h"
#include "fem/interfaces.h"
#include "fem/rigid_motions.h"
#include "fem/skin.h"
#include "fem/skin_stress.h"
#include "fem/supports.h"
#include "fem/weighing.h"

#include <algorithm>

namespace gestell::fem
{

namespace
{

std::vector<Interface> make_interfaces(const std::vector<CoupledPatch> &coupled, const Constraints &constraints,
                                       const Kinematics &kinematics)
{
  std::vector<Interface> result;
  int                    value = constraints.first_new();
  for (const CoupledPatch &patch : coupled)
  {
    Interface interface;
    interface.name     = patch.specification.name;
    interface.position = {patch.position[0], patch.position[1], patch.position[2]};
    for (int &coordinate : interface.coordinate)
      coordinate = kinematics.coordinate(value++);
    result.push_back(std::move(interface));
  }
  return result;
}

/// Nodes with six coordinates: of masses with surfaces of their own, then of interfaces, which thus stand last in q.
std::vector<InterfaceSpecification> coupled_nodes(const FrameSpecification &specification)
{
  require_valid(specification.masses, specification.interfaces);
  std::vector<InterfaceSpecification> nodes = nodes_of_masses(specification.masses);
  nodes.insert(nodes.end(), specification.interfaces.begin(), specification.interfaces.end());
  return nodes;
}

/// Mass, centre and the load of a unit acceleration, with all that is attached; M gets the attached masses.
void weigh(const QuadraticMesh &mesh, const BlockMatrix &M, const Kinematics &kinematics,
           const std::vector<AttachedMass> &masses, const std::vector<Interface> &nodes, FrameMatrices &frame)
{
  frame.acceleration_load = acceleration_load(nodal_mass(M), kinematics);
  frame.facts.whole       = weigh(mesh, M);
  for (const AttachedMass &mass : masses)
  {
    frame.facts.whole.add(properties_of(mass, node_of(mass, nodes)));
    frame.facts.parts.push_back({mass.name, "", mass.mass});
  }
  if (!masses.empty())
    add_masses(masses, nodes, frame);
  frame.mass                                       = frame.facts.whole.mass;
  Eigen::Map<Eigen::Vector3d>(frame.centre.data()) = frame.facts.whole.centre;
}

Constraints constrain(const QuadraticMesh &mesh, const std::vector<SupportedPatch> &supports,
                      const std::vector<CoupledPatch> &coupled, Constraints constraints)
{
  hold(supports, constraints);
  tie_interfaces(coupled, mesh, constraints);
  return constraints;
}

/// Surfaces that cannot deform, and points that take forces.
RigidNodes rigid_nodes(const std::vector<SupportedPatch> &supports, const std::vector<CoupledPatch> &coupled)
{
  RigidNodes rigid;
  for (const SupportedPatch &support : supports)
    if (support.support.kind == SupportKind::clamped)
      rigid.emplace_back("support " + support.support.name, support.patch.nodes);
  for (const CoupledPatch &interface : coupled)
    if (interface.specification.coupling != InterfaceCoupling::average)
      rigid.emplace_back("interface " + interface.specification.name, interface.patch.nodes);
  return rigid;
}

} // namespace

FrameMatrices discretise(const Mesh &mesh, const FrameSpecification &specification)
{
  return discretise_with_mesh_error(mesh, specification).matrices;
}

Discretisation discretise_with_mesh_error(const Mesh &mesh, const FrameSpecification &specification)
{
  const CellMaterials               materials = cell_materials(mesh, specification);
  const QuadraticMesh               quadratic = number_nodes(mesh);
  const std::vector<SupportedPatch> supports  = find_supports(mesh, quadratic, specification.supports);
  Constraints                       constraints(quadratic.n_nodes());
  const std::vector<CoupledPatch> coupled = couple_patches(mesh, quadratic, coupled_nodes(specification), constraints);
  constraints                             = constrain(quadratic, supports, coupled, std::move(constraints));
  const Kinematics kinematics(constraints);

  FrameMatrices frame;
  frame.n_cells                      = mesh.n_cells();
  frame.modal_damping_ratio          = specification.modal_damping_ratio;
  frame.facts.parts                  = solid_masses(mesh, quadratic, materials);
  const std::vector<Interface> nodes = make_interfaces(coupled, constraints, kinematics);
  frame.interfaces.assign(nodes.end() - specification.interfaces.size(), nodes.end());
  for (const CutSpecification &cut : specification.cuts)
    frame.outputs.push_back(cut_force(cut, quadratic, materials, kinematics));

  Eigen::SparseMatrix<double> rayleigh(kinematics.n_coordinates(), kinematics.n_coordinates());
  // Each full matrix goes as soon as it is projected: two of them at once would set the peak of the memory.
  {
    BlockMatrix C            = assemble_stiffness(quadratic, materials);
    frame.facts.rigid_energy = rigid_energy(quadratic, C);
    for (FrameOutput &output : support_forces(supports, C, kinematics))
      frame.outputs.push_back(std::move(output));
    if (specification.rayleigh_stiffness > 0.)
      rayleigh += specification.rayleigh_stiffness * kinematics.project(C);
    add_foundations(supports, &Support::stiffness, C);
    frame.C = kinematics.project(C);
  }
  {
    const BlockMatrix M = assemble_mass(quadratic, materials);
    frame.M             = kinematics.project(M);
    if (specification.rayleigh_mass > 0.)
      rayleigh += specification.rayleigh_mass * frame.M;
    weigh(quadratic, M, kinematics, specification.masses, nodes, frame);
  }
  frame.B = kinematics.project(assemble_damping(supports, quadratic.n_nodes()));
  if (rayleigh.nonZeros() > 0)
    frame.B += rayleigh;

  frame.rigid_motions = rigid_coordinates(quadratic, frame.facts.whole.centre, constraints, kinematics, nodes);
  frame.translations  = frame.rigid_motions.leftCols(3);
  frame.picture       = skin_picture(quadratic, kinematics);
  if (specification.stress)
    frame.stress = skin_stress(
        quadratic, [&](int cell) -> const Material & { return materials[cell]; }, kinematics,
        rigid_nodes(supports, coupled));
  return {std::move(frame), std::make_shared<const MeshError>(quadratic, materials, kinematics)};
}

} // namespace gestell::fem
