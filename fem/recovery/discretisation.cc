#include "fem/recovery/discretisation.h"

#include "fem/assembly/affine_constraints.h"
#include "fem/assembly/attached_masses.h"
#include "fem/assembly/cell_materials.h"
#include "fem/assembly/cut_force.h"
#include "fem/assembly/elasticity.h"
#include "fem/assembly/interfaces.h"
#include "fem/assembly/mass_integrals.h"
#include "fem/assembly/mesh_ties.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/assembly/sparse_sum.h"
#include "fem/assembly/supports.h"
#include "fem/recovery/prestress.h"
#include "fem/recovery/skin_stress.h"
#include "fem/recovery/stress_points.h"
#include "fem/values/frame_matrices.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace gestell::fem
{

namespace
{

/// Whose sums over cells are made.
enum class CellSums
{
  of_frame,
  of_parts ///< C and M remain zero: CellParts makes them part by part
};

MatrixSums sum_cells(const QuadraticMesh &mesh, const CellMaterials &materials, const AffineConstraints &affine,
                     CellSums of)
{
  if (of == CellSums::of_frame)
    return assemble(mesh, materials, affine, whole(mesh, affine));
  const SparseMatrix zero(affine.n_coordinates(), affine.n_coordinates());
  return {zero, zero};
}

/// Skin of the frame with its corners as points; tied corners move with their interfaces, fixed corners do not move.
Picture skin_picture(const QuadraticMesh &mesh, const AffineConstraints &affine)
{
  Picture          picture;
  std::vector<int> point_of(mesh.n_nodes(), -1), nodes;
  for (const auto &face : mesh.skin)
  {
    std::array<int, 3> triangle{};
    for (int k = 0; k < 3; ++k)
    {
      int &point = point_of[face[k]];
      if (point < 0)
      {
        point = static_cast<int>(nodes.size());
        nodes.push_back(face[k]);
        picture.points.push_back(mesh.points[face[k]]);
      }
      triangle[k] = point;
    }
    picture.triangles.push_back(triangle);
  }

  std::vector<Eigen::Triplet<double>> entries;
  for (std::size_t point = 0; point < nodes.size(); ++point)
    for (int d = 0; d < 3; ++d)
      for (const auto &[coordinate, weight] : affine.row(3 * nodes[point] + d))
        entries.emplace_back(3 * point + d, coordinate, weight);
  picture.displacement.resize(3 * nodes.size(), affine.n_coordinates());
  picture.displacement.setFromTriplets(entries.begin(), entries.end());
  return picture;
}

double diagonal(const Mesh &mesh)
{
  Eigen::AlignedBox3d box;
  for (const Point3 &point : mesh.points)
    box.extend(Eigen::Map<const Eigen::Vector3d>(point.data()));
  return box.diagonal().norm();
}

std::vector<Interface> make_interfaces(const std::vector<CoupledPatch> &coupled,
                                       const MultipointConstraints &constraints, const AffineConstraints &affine)
{
  std::vector<Interface> result;
  int                    value = constraints.first_new();
  for (const CoupledPatch &patch : coupled)
  {
    Interface interface;
    interface.name     = patch.specification.name;
    interface.position = {patch.position[0], patch.position[1], patch.position[2]};
    interface.face     = patch.face;
    for (int i = 0; i < patch.n_motions(); ++i)
      interface.coordinate[i] = affine.coordinate(value++);
    for (int i = patch.n_motions(); i < patch.n_coordinates(); ++i)
      interface.face.coordinate.push_back(affine.coordinate(value++));
    result.push_back(std::move(interface));
  }
  return result;
}

/// Nodes with coordinates: those of masses with surfaces of their own, then those of interfaces, which are last in q.
std::vector<InterfaceSpecification> coupled_nodes(const FrameSpecification &specification)
{
  require_valid(specification.masses, specification.interfaces);
  std::vector<InterfaceSpecification> nodes = nodes_of_masses(specification.masses);
  nodes.insert(nodes.end(), specification.interfaces.begin(), specification.interfaces.end());
  return nodes;
}

/// The inputs of the matrices of a frame.
struct Ingredients
{
  const FrameSpecification          &specification;
  const QuadraticMesh               &mesh;
  const CellMaterials               &materials;
  const std::vector<SupportedPatch> &supports;
  const AffineConstraints           &affine;
  const std::vector<Interface>      &nodes;
  const SparseMatrix                &geometric; ///< stiffness [n x n], or without entries
};

/// Mass, centre and the load of a unit acceleration: of the cells, and with all that is attached.
void weigh(const Ingredients &of, const NodalMasses &cells, const Eigen::Vector3d &origin, FrameMatrices &frame)
{
  frame.acceleration_load = acceleration_load(cells.mass, of.affine);
  frame.facts.whole       = mass_integrals(of.mesh, cells, origin);
  for (const AttachedMass &mass : of.specification.masses)
  {
    frame.facts.whole.add(properties_of(mass, node_of(mass, of.nodes)));
    frame.facts.parts.push_back({mass.name, "", mass.mass});
  }
  add_loads(of.specification.masses, of.nodes, frame.acceleration_load);
  frame.mass                                       = frame.facts.whole.mass;
  Eigen::Map<Eigen::Vector3d>(frame.centre.data()) = frame.facts.whole.centre;
}

/// M, B, C and what is read off them.
void add_matrices(const Ingredients &of, CellSums cells, FrameMatrices &frame)
{
  const auto &[specification, mesh, materials, supports, affine, nodes, geometric] = of;
  const Eigen::Vector3d middle                                                     = middle_of_nodes(mesh);
  const NodalMasses     masses = nodal_masses(mesh, materials, middle);
  weigh(of, masses, middle, frame);
  for (FrameOutput &output : support_forces(supports, mesh, materials, affine, masses.mass,
                                            {specification.rayleigh_mass, specification.rayleigh_stiffness}))
    frame.outputs.push_back(std::move(output));
  frame.rigid_motions = rigid_coordinates(mesh, frame.facts.whole.centre, affine, nodes);
  frame.translations  = frame.rigid_motions.leftCols(3);

  MatrixSums sums = sum_cells(mesh, materials, affine, cells);
  frame.C         = std::move(sums.C);
  frame.M         = std::move(sums.M);
  if (cells == CellSums::of_frame)
    frame.facts.rigid_energy = rigid_energy_share(frame.C, frame.rigid_motions, mesh, affine);
  if (geometric.nonZeros() > 0)
    add(frame.C, geometric);
  frame.B = foundations(supports, &Support::damping, affine);
  if (specification.rayleigh_stiffness > 0.)
    add(frame.B, specification.rayleigh_stiffness * frame.C);
  if (specification.rayleigh_mass > 0.)
    add(frame.B, specification.rayleigh_mass * frame.M);
  add(frame.C, foundations(supports, &Support::stiffness, affine));
  add(frame.M, mass_matrix(specification.masses, nodes, affine.n_coordinates()));
}

MultipointConstraints constrain(const QuadraticMesh &mesh, const std::vector<SupportedPatch> &supports,
                                const std::vector<CoupledPatch> &coupled, MultipointConstraints constraints)
{
  hold(supports, constraints);
  tie_interfaces(coupled, mesh, constraints);
  std::set<int> of_interfaces;
  for (const CoupledPatch &patch : coupled)
    of_interfaces.insert(patch.patch.nodes.begin(), patch.patch.nodes.end());
  tie_meshes(mesh, of_interfaces, constraints);
  return constraints;
}

/// States the effect of alpha M on rigid-body motions of an unsupported frame; none if there is no effect.
std::vector<std::string> rayleigh_at_large(const FrameSpecification &specification)
{
  if (!(specification.rayleigh_mass > 0.) || !specification.supports.empty())
    return {};
  std::ostringstream text;
  text.precision(3);
  text << "damping: the term alpha M of Rayleigh damping also brakes rigid-body modes of the unsupported frame: their "
          "speed halves in "
       << std::log(2.) / specification.rayleigh_mass << " s; damping = { ratio = ... } does not affect them";
  return {text.str()};
}

/// Surfaces that cannot deform, and points that take forces.
RigidNodes rigid_nodes(const std::vector<SupportedPatch> &supports, const std::vector<CoupledPatch> &coupled)
{
  RigidNodes rigid;
  for (const SupportedPatch &support : supports)
    if (support.support.kind == SupportKind::clamped)
      rigid.emplace_back("support " + support.support.name, support.patch.nodes);
  for (const CoupledPatch &interface : coupled)
    if (const auto coupling = interface.specification.coupling;
        coupling != InterfaceCoupling::average && coupling != InterfaceCoupling::flexible)
      rigid.emplace_back(interface.specification.what + " " + interface.specification.name, interface.patch.nodes);
  return rigid;
}

/// Cuts through surfaces that carry force outside of the cells.
std::vector<std::string> cuts_of_rigid_surfaces(const std::vector<CutSpecification> &cuts,
                                                const std::vector<CoupledPatch> &coupled, const QuadraticMesh &mesh,
                                                double tolerance)
{
  std::vector<std::string> notes;
  for (const CutSpecification &cut : cuts)
    for (const CoupledPatch &one : coupled)
    {
      if (const auto coupling = one.specification.coupling;
          coupling != InterfaceCoupling::rigid && coupling != InterfaceCoupling::flexible)
        continue;
      const Eigen::Map<const Eigen::Vector3d> normal(cut.normal.data()), through(cut.through.data());
      double                                  low = 0., high = 0.;
      for (const int node : one.patch.nodes)
      {
        const Eigen::Map<const Eigen::Vector3d> x(mesh.points[node].data());
        const double                            height = normal.normalized().dot(x - through);
        low = std::min(low, height), high = std::max(high, height);
      }
      if (low < -tolerance && high > tolerance)
        notes.push_back("cut \"" + cut.name + "\" divides the surface of the " + one.specification.what + " \"" +
                        one.specification.name +
                        "\", which carries force past the section: its forces "
                        "are those of the cells only; move the plane, or use coupling = \"average\"");
    }
  return notes;
}

Discretisation discretise(const Mesh &mesh, const FrameSpecification &specification, CellSums cells,
                          const Eigen::VectorXd &q0 = {})
{
  CellMaterials                     materials = cell_materials(mesh, specification);
  const QuadraticMesh               quadratic = quadratic_mesh(mesh);
  const std::vector<SupportedPatch> supports  = find_supports(mesh, quadratic, specification.supports);
  MultipointConstraints             constraints(quadratic.n_nodes());
  const std::vector<CoupledPatch> coupled = couple_patches(mesh, quadratic, coupled_nodes(specification), constraints);
  constraints                             = constrain(quadratic, supports, coupled, std::move(constraints));
  const AffineConstraints affine(constraints);
  if (q0.size() > 0)
    materials.u0 = affine.expand(q0).reshaped(3, quadratic.n_nodes());

  FrameMatrices frame;
  frame.n_cells                      = mesh.n_cells();
  frame.notes                        = mesh.notes;
  frame.statements                   = mesh.statements;
  frame.modal_damping_ratio          = specification.modal_damping_ratio;
  frame.facts.parts                  = solid_masses(mesh, quadratic, materials);
  const std::vector<Interface> nodes = make_interfaces(coupled, constraints, affine);
  frame.interfaces.assign(nodes.end() - specification.interfaces.size(), nodes.end());
  constexpr double node_tolerance = 1e-4; // of the diagonal, as of selectors
  for (std::string &note : nodes_beside(coupled, node_tolerance * diagonal(mesh)))
    frame.notes.push_back(std::move(note));
  for (std::string &note : masses_far_off(coupled, diagonal(mesh)))
    frame.notes.push_back(std::move(note));
  for (std::string &note : rayleigh_at_large(specification))
    frame.notes.push_back(std::move(note));
  for (std::string &note :
       cuts_of_rigid_surfaces(specification.cuts, coupled, quadratic, node_tolerance * diagonal(mesh)))
    frame.notes.push_back(std::move(note));
  std::vector<int> supported;
  for (const SupportedPatch &one : supports)
    supported.insert(supported.end(), one.patch.nodes.begin(), one.patch.nodes.end());
  for (const CutSpecification &cut : specification.cuts)
    for (FrameOutput &output : cut_forces(cut, quadratic, materials, affine, supported,
                                          {specification.rayleigh_mass, specification.rayleigh_stiffness}))
      frame.outputs.push_back(std::move(output));

  Eigen::VectorXd load;
  SparseMatrix    geometric;
  if (const auto &prestress = specification.prestress)
  {
    const PrestressLoads loads = prestress_loads(*prestress, specification.masses, mesh, quadratic, materials, nodes);
    load                       = affine.gather(loads.on_nodes) + loads.on_masses(affine.n_coordinates());
    if (q0.size() > 0)
    {
      const int n = affine.n_coordinates();
      geometric   = cells == CellSums::of_frame
                        ? assemble_geometric(quadratic, materials, affine, whole(quadratic, affine))
                        : SparseMatrix(n, n);
      add(geometric, stiffness_of_turns(quadratic, materials, n, coupled, nodes, loads));
    }
  }
  add_matrices({specification, quadratic, materials, supports, affine, nodes, geometric}, cells, frame);

  frame.picture = skin_picture(quadratic, affine);
  if (specification.stress || !specification.stress_points.empty())
  {
    StressRecovery recovery = skin_stress(
        quadratic, [&](int cell) -> const Material & { return materials[cell]; }, affine,
        rigid_nodes(supports, coupled));
    add_stress_points(specification.stress_points, recovery, frame);
    if (specification.stress)
      frame.stress = std::move(recovery);
  }
  return {std::move(frame),
          std::make_shared<const MeshError>(quadratic, materials, affine),
          std::move(load),
          std::move(geometric),
          {}};
}

} // namespace

FrameMatrices discretise(const Mesh &mesh, const FrameSpecification &specification)
{
  return discretise_with_mesh_error(mesh, specification).matrices;
}

Discretisation discretise_with_mesh_error(const Mesh &mesh, const FrameSpecification &specification,
                                          const Eigen::VectorXd &q0)
{
  return discretise(mesh, specification, CellSums::of_frame, q0);
}

Discretisation discretise_for_parts(const Mesh &mesh, const FrameSpecification &specification,
                                    const Eigen::VectorXd &q0)
{
  return discretise(mesh, specification, CellSums::of_parts, q0);
}

} // namespace gestell::fem
