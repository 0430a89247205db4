#include "fem/discretisation.h"

#include "fem/cut_force.h"
#include "fem/elasticity.h"
#include "fem/interfaces.h"
#include "fem/rigid_motions.h"
#include "fem/skin.h"
#include "fem/supports.h"

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

/// Mass of every node, int rho N_a dV [kg]: the row sums of M.
Eigen::VectorXd nodal_mass(const BlockMatrix &M)
{
  const BlockMatrix::Rows rows = M.rows();
  Eigen::VectorXd         mass = Eigen::VectorXd::Zero(M.n_nodes());
  for (int i = 0; i < M.n_nodes(); ++i)
    for (int k = rows.begin[i]; k < rows.begin[i + 1]; ++k)
      mass[i] += rows.values[k];
  return mass;
}

/// Mass, centre of mass and the load of a unit acceleration.
void weigh(const QuadraticMesh &mesh, const BlockMatrix &M, const Kinematics &kinematics, FrameMatrices &frame)
{
  const Eigen::VectorXd nodal  = nodal_mass(M);
  Eigen::Vector3d       moment = Eigen::Vector3d::Zero();
  for (int i = 0; i < mesh.n_nodes(); ++i)
    moment += nodal[i] * Eigen::Map<const Eigen::Vector3d>(mesh.points[i].data());
  frame.mass = nodal.sum();
  moment /= frame.mass;
  frame.centre = {moment[0], moment[1], moment[2]};

  frame.acceleration_load.resize(kinematics.n_coordinates(), 3);
  for (int d = 0; d < 3; ++d)
  {
    Eigen::VectorXd load                    = Eigen::VectorXd::Zero(3 * mesh.n_nodes());
    load(Eigen::seqN(d, mesh.n_nodes(), 3)) = nodal;
    frame.acceleration_load.col(d)          = kinematics.gather(load);
  }
}

Constraints constrain(const QuadraticMesh &mesh, const std::vector<SupportedPatch> &supports,
                      const std::vector<CoupledPatch> &coupled, Constraints constraints)
{
  hold(supports, constraints);
  tie_interfaces(coupled, mesh, constraints);
  return constraints;
}

} // namespace

FrameMatrices discretise(const Mesh &mesh, const FrameSpecification &specification)
{
  require_valid(specification.material);
  const QuadraticMesh               quadratic = quadratic_mesh(mesh);
  const std::vector<SupportedPatch> supports  = find_supports(mesh, quadratic, specification.supports);
  Constraints                       constraints(quadratic.n_nodes());
  const std::vector<CoupledPatch>   coupled = couple_patches(mesh, quadratic, specification.interfaces, constraints);
  constraints                               = constrain(quadratic, supports, coupled, std::move(constraints));
  const Kinematics kinematics(constraints);

  FrameMatrices frame;
  frame.n_cells             = static_cast<int>(mesh.cells.size());
  frame.modal_damping_ratio = specification.modal_damping_ratio;
  frame.interfaces          = make_interfaces(coupled, constraints, kinematics);
  for (const CutSpecification &cut : specification.cuts)
    frame.outputs.push_back(cut_force(cut, quadratic, specification.material, kinematics));

  Eigen::SparseMatrix<double> rayleigh(kinematics.n_coordinates(), kinematics.n_coordinates());
  // Each full matrix goes as soon as it is projected: two of them at once would set the peak of the memory.
  {
    BlockMatrix C = assemble_stiffness(quadratic, specification.material);
    for (FrameOutput &output : support_forces(supports, C, kinematics))
      frame.outputs.push_back(std::move(output));
    if (specification.rayleigh_stiffness > 0.)
      rayleigh += specification.rayleigh_stiffness * kinematics.project(C);
    add_foundations(supports, &Support::stiffness, C);
    frame.C = kinematics.project(C);
  }
  {
    const BlockMatrix M = assemble_mass(quadratic, specification.material);
    frame.M             = kinematics.project(M);
    if (specification.rayleigh_mass > 0.)
      rayleigh += specification.rayleigh_mass * frame.M;
    weigh(quadratic, M, kinematics, frame);
  }
  frame.B = kinematics.project(assemble_damping(supports, quadratic.n_nodes()));
  if (rayleigh.nonZeros() > 0)
    frame.B += rayleigh;

  const Eigen::Vector3d centre(frame.centre[0], frame.centre[1], frame.centre[2]);
  frame.rigid_motions = rigid_coordinates(quadratic, centre, constraints, kinematics, frame.interfaces);
  frame.translations  = frame.rigid_motions.leftCols(3);
  frame.picture       = skin_picture(quadratic, kinematics);
  return frame;
}

} // namespace gestell::fem
