#include "coupling/substructures/prestressed_parts.h"

#include "coupling/integration/system/dense_solvers.h"
#include "coupling/substructures/joint_forces.h"
#include "coupling/substructures/placed_part.h"
#include "coupling/substructures/prestress_statement.h"
#include "coupling/substructures/welded_coordinates.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

/// Deflection of all parts under their weight.
VectorXd under_weight(const fem::Prestress &prestress, const SprungUnion &sprung, const MatrixXd &G,
                      const MatrixXd &rigid)
{
  const VectorXd   f = G.transpose() * sprung.load * Eigen::Map<const Eigen::Vector3d>(prestress.acceleration.data());
  const MatrixXd   C = G.transpose() * sprung.C * G;
  const VectorXd   q = held(C, rigid).ldlt().solve(f);
  constexpr double carried_share = 1e-6; // of the weight: what no support carries is far more, rounding far less
  if ((C * q - f).norm() > carried_share * f.norm())
    throw std::invalid_argument(prestress.place + ": 'gravity' has no static equilibrium, because the supports leave "
                                                  "the frame free to move; add a support");
  return G * q;
}

/// Stiffness S of the interfaces of the joined frame, and its rigid motions there.
struct OnInterfaces
{
  MatrixXd S, rigid;
};

OnInterfaces on_interfaces(const FrameOfParts &frame, const std::vector<ReducedFrame> &parts)
{
  const std::vector<ReducedFrame> placed = all_placed(parts, frame);
  const PartUnion                 all    = beside_each_other(placed);
  const WeldedCoordinates         welded = weld(frame, all, placed);
  std::vector<int>                columns;
  for (std::size_t i = 0; i < placed.size(); ++i)
    for (int k = 0; k < placed[i].n_interface; ++k)
      if (const int column = welded.kept[std::size_t(all.first[i]) + std::size_t(k)]; column >= 0)
        columns.push_back(column);
  const MatrixXd G     = welded.G(Eigen::all, columns); // modes and constraint modes are orthogonal in C
  const MatrixXd rigid = stayed(rigid_motions_of(all, Eigen::Vector3d::Zero()), welded);
  return {G.transpose() * sprung(frame, all).C * G, rigid(columns, Eigen::all)};
}

} // namespace

FrameOfParts prestressed(FrameOfParts frame, const std::vector<ReducedFrame> &parts)
{
  const fem::Prestress            given        = *frame.prestress;
  const std::vector<ReducedFrame> placed       = all_placed(parts, frame);
  const PartUnion                 all          = beside_each_other(placed);
  const SprungUnion               with_springs = sprung(frame, all);
  const WeldedCoordinates         welded       = weld(frame, all, placed);
  const MatrixXd                  rigid        = stayed(rigid_motions_of(all, Eigen::Vector3d::Zero()), welded);
  const Eigen::Vector3d           g(given.acceleration.data());

  const VectorXd heavy =
      g.isZero(0.) ? VectorXd(VectorXd::Zero(all.size())) : under_weight(given, with_springs, welded.G, rigid);
  VectorXd q0 = heavy;
  if (given.tie_rods)
    q0 += tightened(frame, with_springs, welded.G, rigid);
  if (q0.isZero(0.))
    throw std::invalid_argument(given.place + ": its loads are zero; give the scene a 'gravity', or tie rods a "
                                              "'prestress'");
  for (std::size_t i = 0; i < parts.size(); ++i)
  {
    FramePart     &part = frame.parts[i];
    fem::Prestress own  = given;
    const auto     n    = parts[i].M.rows();
    const VectorXd q    = given.factor * turned_coordinates(parts[i], part.placement.Q) * q0.segment(all.first[i], n);
    Eigen::Map<Eigen::Vector3d>(own.acceleration.data()) = part.placement.Q.transpose() * g;
    own.interface_motion.assign(q.data(), q.data() + parts[i].n_interface);
    part.geometry.prestress = own;
  }
  for (std::size_t j = 0; j < frame.joints.size(); ++j)
    if (FrameJoint &joint = frame.joints[j]; joint.kind == JointKind::tie_rod)
    {
      const JointSpring &spring = with_springs.springs[j];
      joint.rod.tension =
          given.factor * ((given.tie_rods ? joint.rod.prestress : 0.) + spring.K(0, 0) * spring.R.row(0).dot(heavy));
    }
  return frame;
}

double buckling_bound(const FrameOfParts &frame, const std::vector<ReducedFrame> &parts, const FrameOfParts &stressed,
                      const std::vector<ReducedFrame> &stressed_parts)
{
  const auto [S, rigid] = on_interfaces(frame, parts);
  const double lambda   = dense_buckling_factor(held(S, rigid), on_interfaces(stressed, stressed_parts).S - S);
  require_below_buckling(lambda, frame.prestress->place);
  return lambda;
}

double dense_buckling_factor(const MatrixXd &S, const MatrixXd &K)
{
  const Eigen::LLT<MatrixXd> L       = S.llt();
  const MatrixXd             half    = L.matrixL().solve(K);
  const MatrixXd             both    = L.matrixL().solve(MatrixXd(half.transpose()));
  const double               kappa   = SymmetricEigenSolver(both, WithVectors::no).eigenvalues()[0];
  constexpr double           nothing = 1e-12; // rounding of the difference of two stiffnesses
  return kappa < -nothing ? -1. / kappa : INFINITY;
}

} // namespace gestell::coupling
