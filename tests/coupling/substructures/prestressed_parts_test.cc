// Geometric stiffness of parts under tie rods and weight: it agrees with that of the rods and of the frame in one
// piece.

#include "coupling/algebra/dense_modes.h"
#include "coupling/plugin/frame/prestressed.h"
#include "coupling/substructures/prestressed_parts.h"
#include "tests/coupling/substructures/pieces.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/test.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace gestell::test
{
namespace
{

using coupling::JointKind;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto clamped_faces = fem::InterfaceCoupling::rigid;

/// A part in its own coordinates, with all its modes.
coupling::ReducedFrame part_of(const Piece &piece, const fem::FrameSpecification &geometry)
{
  const auto frame = coupling::discretised(piece.mesh, geometry, "", {});
  auto       part  = coupling::reduce_frame(frame.matrices, keeping(frame.matrices, all_modes));
  part.C.topLeftCorner(frame.balance.rows(), frame.balance.cols()) -= frame.balance;
  return part;
}

/// The parts and their description about the prestressed state, joined.
struct Stressed
{
  coupling::FrameOfParts frame;
  coupling::JoinedParts  joined;
  double                 bound = 0.; ///< of the buckling factor
};

Stressed stressed(const std::vector<Piece> &pieces, const coupling::FrameOfParts &description)
{
  const auto of = [&](const coupling::FrameOfParts &frame)
  {
    std::vector<coupling::ReducedFrame> parts;
    for (std::size_t i = 0; i < pieces.size(); ++i)
      parts.push_back(part_of(pieces[i], frame.parts[i].geometry));
    return parts;
  };
  const auto parts = of(description);
  Stressed   result{coupling::prestressed(description, parts), {}};
  const auto under_load = of(result.frame);
  result.joined         = coupling::join_parts(coupling::all_placed(under_load, result.frame), result.frame);
  result.bound          = coupling::buckling_bound(description, parts, result.frame, under_load);
  return result;
}

fem::Prestress prestress(const fem::Vector3 &g, bool tie_rods)
{
  return {g, {}, 1., tie_rods, {}, "frame.prestress"};
}

TEST(PrestressedParts, RodsAndPartsCarryEqualAndOppositeForces)
{
  // Three bars, the middle one between rigid faces and pressed by a rod: turned across the rod by theta, the rod adds
  // the energy F L theta^2 / 2, the column takes it away, and the whole, turned anywhere, has none.
  std::vector<Piece> pieces{bar("base", clamped_faces, clamped_faces),
                            bar("column", clamped_faces, clamped_faces, part_length),
                            bar("head", clamped_faces, clamped_faces, 2. * part_length)};
  pieces[1].placement.Q << 0., 1., 0., -1., 0., 0., 0., 0., 1.; // drawn along y
  pieces[1].mesh                = box_mesh({{1, 2, 1}}, {{part_height, part_length, part_height}});
  pieces[1].geometry.interfaces = {interface("rear", {"y0"}, clamped_faces), interface("front", {"y1"}, clamped_faces)};
  pieces[1].placement.at        = {part_length, 0.5 * part_width + 0.5 * part_height, 0.};
  const double F                = 80e3;
  auto         rod              = weld("rod", {"base", "front"}, {"head", "rear"});
  rod.kind                      = JointKind::tie_rod;
  rod.rod                       = {0.03, 210e9, 7850., {}, 0., F, "steel"};
  auto frame                    = described(pieces, {weld("lower", {"base", "front"}, {"column", "rear"}),
                                                     weld("upper", {"column", "front"}, {"head", "rear"}), rod});
  frame.prestress               = prestress({}, true);

  const Stressed result = stressed(pieces, frame);
  EXPECT_EQ(result.frame.joints[2].rod.tension, F);
  const auto    &R      = result.joined.matrices.rigid_motions;
  const VectorXd energy = (R.transpose() * (result.joined.matrices.C * R)).diagonal();
  EXPECT_LT(energy.cwiseAbs().maxCoeff(), 1e-6 * F * part_length);

  // The rod alone, turned across itself: what the parts must take away.
  auto without                  = result.frame;
  without.joints[2].rod.tension = 0.;
  std::vector<coupling::ReducedFrame> parts;
  for (std::size_t i = 0; i < pieces.size(); ++i)
    parts.push_back(part_of(pieces[i], without.parts[i].geometry));
  const auto     alone = coupling::join_parts(coupling::all_placed(parts, without), without);
  const VectorXd of_parts =
      (alone.matrices.rigid_motions.transpose() * (alone.matrices.C * alone.matrices.rigid_motions)).diagonal();
  EXPECT_NEAR(of_parts[4], -F * part_length, 1e-6 * F * part_length);
  EXPECT_NEAR(of_parts[5], -F * part_length, 1e-6 * F * part_length);
}

TEST(PrestressedParts, HangingUnderTheirWeightStiffenLikeTheFrameInOnePiece)
{
  // Two bars along x under 2000 g, welded at rigid faces, and one bar of the same cells: the rigid section in its
  // middle changes omega^2 by some percent, what the weight adds to it by less.
  const fem::Vector3 g{2e4, 0., 0.};
  std::vector<Piece> pieces{bar("upper", clamped_faces, clamped_faces),
                            bar("lower", clamped_faces, clamped_faces, part_length)};
  pieces[0].geometry.interfaces.erase(pieces[0].geometry.interfaces.begin());
  pieces[0].geometry.supports = {clamped("ceiling", {"x0"})};
  auto frame                  = described(pieces, {weld("middle", {"upper", "front"}, {"lower", "rear"})});
  auto whole                  = pieces[0].geometry;
  whole.interfaces.clear();
  const auto mesh    = box_mesh({{4, 1, 1}}, {{2. * part_length, part_width, part_height}});
  const auto squares = [&](const std::optional<fem::Prestress> &weight)
  {
    frame.prestress = whole.prestress = weight;
    const auto   joint                = weight ? stressed(pieces, frame).joined : joined(pieces, frame, all_modes);
    const double of_parts =
        coupling::dense_modes(joint.matrices.C, joint.matrices.M, coupling::cancelled_by_reduction).omega[0];
    const double of_whole =
        2. * M_PI * lowest_modes(coupling::discretised(mesh, whole, "", {}).matrices, 1).frequency_hz[0];
    return Eigen::Array2d(of_parts * of_parts, of_whole * of_whole);
  };
  const Eigen::Array2d more = squares(prestress(g, false)) - squares({});
  EXPECT_GT(more[1], 0.);
  EXPECT_NEAR(more[0], more[1], 0.02 * more[1]);
}

/// Matrices of two bars with a common node, which is the last interface of the first and the first of the second.
struct Glued
{
  MatrixXd         M, C;
  VectorXd         load;   ///< of the weight
  std::vector<int> common; ///< coordinates of the node
};

Glued glued(const fem::Discretisation &first, const fem::Discretisation &second, const Eigen::Vector3d &g)
{
  const auto      &a = first.matrices, &b = second.matrices;
  const auto       node_a = a.interfaces.back().coordinates(), node_b = b.interfaces.front().coordinates();
  const int        n_a = int(a.M.rows());
  int              n   = n_a;
  std::vector<int> of_b(std::size_t(b.M.rows()), -1);
  for (int k = 0; k < 6; ++k)
    of_b[std::size_t(node_b[std::size_t(k)])] = node_a[std::size_t(k)];
  for (int &i : of_b)
    i = i < 0 ? n++ : i;
  Glued      all{MatrixXd::Zero(n, n), MatrixXd::Zero(n, n), VectorXd::Zero(n), node_a};
  const auto unbalanced = [](const fem::Discretisation &part)
  {
    MatrixXd   C  = part.matrices.C;
    const auto q1 = part.matrices.interface_coordinates();
    if (part.balance.size() > 0)
      C(q1, q1) -= part.balance;
    return C;
  };
  all.M.topLeftCorner(n_a, n_a) = a.M;
  all.C.topLeftCorner(n_a, n_a) = unbalanced(first);
  all.load.head(n_a)            = a.acceleration_load * g;
  all.M(of_b, of_b) += MatrixXd(b.M);
  all.C(of_b, of_b) += unbalanced(second);
  all.load(of_b) += b.acceleration_load * g;
  return all;
}

TEST(PrestressedParts, VibrateAsTheFrameInOnePiece)
{
  // Two thirds of the weight that buckles the column: what is of second order in the geometric stiffness counts.
  std::vector<Piece> pieces{bar("foot", clamped_faces, clamped_faces),
                            bar("top", clamped_faces, clamped_faces, part_length)};
  pieces[0].geometry.interfaces.erase(pieces[0].geometry.interfaces.begin());
  pieces[0].geometry.supports = {clamped("floor", {"x0"})};
  auto                  frame = described(pieces, {weld("middle", {"foot", "front"}, {"top", "rear"})});
  const double          l = 2. * part_length, EI = 210e9 * part_width * std::pow(part_height, 3) / 12.;
  const Eigen::Vector3d g(-7.837 * EI / (l * l * l) / (7850. * part_width * part_height) / 1.5, 0., 0.);
  frame.prestress       = prestress({g[0], g[1], g[2]}, false);
  const Stressed result = stressed(pieces, frame);
  const auto     whole  = [&](const coupling::FrameOfParts &of)
  {
    const auto part = [&](std::size_t i)
    { return coupling::discretised(pieces[i].mesh, of.parts[i].geometry, "", {}); };
    return glued(part(0), part(1), g);
  };

  const Glued    unstressed = whole(frame);
  const VectorXd q0         = unstressed.C.ldlt().solve(unstressed.load)(unstressed.common);
  const auto    &motion     = result.frame.parts[0].geometry.prestress->interface_motion;
  EXPECT_LT((VectorXd::Map(motion.data(), 6) - q0).norm(), 1e-8 * q0.norm());

  const Glued    own   = whole(result.frame);
  const VectorXd omega = coupling::dense_modes(own.C, own.M, coupling::cancelled_by_reduction).omega,
                 joint = coupling::dense_modes(result.joined.matrices.C, result.joined.matrices.M,
                                               coupling::cancelled_by_reduction)
                             .omega;
  for (int j = 0; j < 8; ++j)
    EXPECT_NEAR(joint[j], omega[j], 1e-6 * omega[j]) << j;
}

TEST(PrestressedParts, BuckleUnderTheirWeightAtGreenhillsLength)
{
  // A column of two clamped bars under its own weight: q l^3 = 7.837 E I (Greenhill), lowered by shear by about
  // pi^2 E I / (4 l^2 kappa mu A) = 1 %; with the interface rigid and its bound from two load factors higher by some
  // percent.
  std::vector<Piece> pieces{bar("foot", clamped_faces, clamped_faces),
                            bar("top", clamped_faces, clamped_faces, part_length)};
  pieces[0].geometry.interfaces.erase(pieces[0].geometry.interfaces.begin());
  pieces[0].geometry.supports = {clamped("floor", {"x0"})};
  for (Piece &piece : pieces)
    piece.geometry.material.nu = 0.;
  auto         frame = described(pieces, {weld("middle", {"foot", "front"}, {"top", "rear"})});
  const double l = 2. * part_length, EI = 210e9 * part_width * std::pow(part_height, 3) / 12.;
  const double g        = 7.837 * EI / (l * l * l) / (7850. * part_width * part_height);
  frame.prestress       = prestress({-g / 3., 0., 0.}, false);
  const double measured = stressed(pieces, frame).bound;
  EXPECT_GT(measured, 0.97 * 3.);
  EXPECT_LT(measured, 1.15 * 3.);
  frame.prestress->factor = 4.;
  EXPECT_NE(refusal([&] { stressed(pieces, frame); }).find("beyond buckling"), std::string::npos);
}

} // namespace
} // namespace gestell::test
