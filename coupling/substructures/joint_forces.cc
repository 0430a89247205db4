#include "coupling/substructures/joint_forces.h"

#include "coupling/integration/system/dense_solvers.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;
using Vector6 = Eigen::Matrix<double, 6, 1>;

bool has_springs(const FrameJoint &joint)
{
  return joint.kind == JointKind::bolts || joint.kind == JointKind::tie_rod;
}

/// Half of a rod's mass moves with each end.
void add_mass(SprungUnion &all, const FrameJoint &joint, const PartUnion &parts)
{
  const double half = 0.5 * mass_of_rod(joint, parts);
  for (const JointEnd &end : joint.between)
  {
    const MatrixXd H = motions_of(parts.at(end), parts.size()).topRows(3);
    all.M += half * H.transpose() * H;
    all.load += half * H.transpose();
  }
}

/// A force on the second interface as rows, before a preload.
struct ForceRows
{
  MatrixXd on_q, on_v, on_a;   // [6 x n_j]
  MatrixXd under_acceleration; // [6 x 3]
};

/// Rows of the force on the second interface: from the matrices, or from the bolts.
ForceRows rows_of(const FrameJoint &joint, const PartUnion &parts, const SprungUnion &all, const JointSpring &spring,
                  const MatrixXd &G)
{
  const MatrixXd H = motions_of(parts.at(joint.between[1]), parts.size());
  if (joint.kind == JointKind::bolts)
  {
    const MatrixXd to_second = H * spring.R.transpose(); // [6 x 6]
    return {-to_second * spring.K * spring.R * G, -to_second * spring.D * spring.R * G, MatrixXd(6, 0),
            MatrixXd::Zero(6, 3)};
  }
  return {H * all.C * G, H * all.B * G, H * all.M * G, -H * all.load};
}

/// weights [6] of the forces.
fem::FrameOutput combined(const std::string &name, const std::string &unit, const ForceRows &rows,
                          const Vector6 &weights, double constant)
{
  fem::FrameOutput output{name, unit, rows.on_q.transpose() * weights, rows.on_v.transpose() * weights,
                          rows.under_acceleration.transpose() * weights};
  if (rows.on_a.cols() > 0)
    output.on_a = rows.on_a.transpose() * weights;
  output.constant = constant;
  return output;
}

fem::FrameOutput rod_force(const FrameJoint &joint, const JointSpring &spring, const MatrixXd &G)
{
  fem::FrameOutput output;
  output.name     = joint_outputs(joint).front().first;
  output.unit     = "N";
  output.on_q     = spring.K(0, 0) * (spring.R * G).transpose();
  output.on_v     = spring.D(0, 0) * (spring.R * G).transpose();
  output.constant = joint.rod.prestress;
  return output;
}

/// Weights of the force that presses the joint: the component that pushes the second part away from the first.
Vector6 pressing(const FrameJoint &joint)
{
  Vector6 weights   = Vector6::Zero();
  weights.head<3>() = joint.normal;
  return weights;
}

/// C without the elasticity of rods.
MatrixXd of_tightening(const FrameOfParts &frame, const SprungUnion &all)
{
  MatrixXd C = all.C;
  for (std::size_t j = 0; j < frame.joints.size(); ++j)
    if (frame.joints[j].kind == JointKind::tie_rod)
      C -= all.springs[j].R.transpose() * all.springs[j].K * all.springs[j].R;
  return C;
}

} // namespace

SprungUnion sprung(const FrameOfParts &frame, const PartUnion &parts)
{
  SprungUnion all{parts.M, parts.B, parts.C, parts.translations_load, {}, VectorXd::Zero(parts.size())};
  for (const FrameJoint &joint : frame.joints)
  {
    all.springs.emplace_back();
    if (!has_springs(joint))
      continue;
    const JointSpring &spring = all.springs.back() = spring_of(joint, parts);
    all.C += spring.R.transpose() * spring.K * spring.R;
    all.B += spring.R.transpose() * spring.D * spring.R;
    if (joint.kind == JointKind::tie_rod)
    {
      add_mass(all, joint, parts);
      all.tightening -= joint.rod.prestress * spring.R.transpose();
      if (joint.rod.tension != 0.)
        all.C += transverse_stiffness(joint, parts);
    }
  }
  return all;
}

MatrixXd held(const MatrixXd &C, const MatrixXd &rigid)
{
  const double               size = C.diagonal().mean();
  const MatrixXd             R    = rigid * rigid.colwise().norm().cwiseInverse().asDiagonal();
  const SymmetricEigenSolver energy(R.transpose() * C * R);
  constexpr double           free_energy = 1e-12; // of a rigid motion, against a spring of the size of others
  const auto                 n_free      = (energy.eigenvalues().array() <= free_energy * size).count();
  const MatrixXd             free        = R * energy.eigenvectors().leftCols(n_free);
  return C + size * free * free.transpose();
}

VectorXd tightened(const FrameOfParts &frame, const SprungUnion &all, const MatrixXd &G, const MatrixXd &rigid)
{
  if (all.tightening.isZero(0.))
    return VectorXd::Zero(all.C.rows());
  const MatrixXd C = of_tightening(frame, all);
  return G * held(G.transpose() * C * G, rigid).ldlt().solve(G.transpose() * all.tightening);
}

std::vector<JointPreload> preloads_of(const FrameOfParts &frame, const PartUnion &parts, const SprungUnion &all,
                                      const MatrixXd &G, const MatrixXd &rigid)
{
  const VectorXd            q_0    = tightened(frame, all, G, rigid);
  const VectorXd            needed = of_tightening(frame, all) * q_0 - all.tightening;
  std::vector<JointPreload> preloads;
  for (std::size_t j = 0; j < frame.joints.size(); ++j)
  {
    const FrameJoint &joint = frame.joints[j];
    JointPreload      preload{joint.name};
    const MatrixXd    H = motions_of(parts.at(joint.between[1]), parts.size());
    if (joint.kind == JointKind::bolts)
      preload.on_second = -H * all.springs[j].R.transpose() * (all.springs[j].K * (all.springs[j].R * q_0));
    else if (joint.kind != JointKind::tie_rod)
      preload.on_second = H * needed;
    preload.pressed = pressing(joint).dot(preload.on_second) + joint.bolts.preload;
    preloads.push_back(preload);
  }
  return preloads;
}

std::vector<fem::FrameOutput> forces_of(const FrameJoint &joint, const PartUnion &parts, const SprungUnion &all,
                                        const JointSpring &spring, const MatrixXd &G, const JointPreload &preload)
{
  if (joint.kind == JointKind::tie_rod)
    return {rod_force(joint, spring, G)};
  const ForceRows               rows  = rows_of(joint, parts, all, spring, G);
  const auto                    names = joint_outputs(joint);
  std::vector<fem::FrameOutput> forces;
  for (int i = 0; i < 6; ++i)
    forces.push_back(combined(names[std::size_t(i)].first, names[std::size_t(i)].second, rows, Vector6::Unit(i),
                              preload.on_second[i]));
  if (joint.closes())
    forces.push_back(combined(names.back().first, names.back().second, rows, pressing(joint), preload.pressed));
  return forces;
}

} // namespace gestell::coupling
