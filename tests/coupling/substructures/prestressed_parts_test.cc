// Geometric stiffness of parts under tie rods and weight: it agrees with that of the rods and of the frame in one
// piece.

#include "coupling/algebra/dense_modes.h"
#include "coupling/plugin/frame/prestressed.h"
#include "coupling/substructures/prestressed_parts.h"
#include "tests/coupling/substructures/pieces.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using coupling::JointKind;
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
