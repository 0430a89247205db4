#include "coupling/algebra/dense_modes.h"
#include "tests/coupling/substructures/pieces.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::test
{
namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto smeared = fem::InterfaceCoupling::average;

/// A bar of twice the length in one piece, and its halves welded in the middle by faces of a degree; `cells` of the
/// second half along the joint.
std::vector<Piece> halves(int degree, int cells = 2, int along = 1)
{
  std::vector<Piece>          bars{bar("first", smeared, smeared), bar("second", smeared, smeared, part_length)};
  const std::array<double, 3> size{{part_length, part_width, part_height}};
  bars[0].mesh = box_mesh({{along, 2, 2}}, size);
  bars[1].mesh = box_mesh({{along, cells, cells}}, size);
  make_flexible(bars[0], "front", degree);
  make_flexible(bars[1], "rear", degree);
  return bars;
}

VectorXd frequencies_of(const fem::FrameMatrices &frame)
{
  return coupling::dense_modes(MatrixXd(frame.C), MatrixXd(frame.M), coupling::cancelled_by_reduction).omega;
}

VectorXd welded(const std::vector<Piece> &bars)
{
  const auto frame = described(bars, {weld("middle", {"first", "front"}, {"second", "rear"})});
  return frequencies_of(joined(bars, frame, all_modes).matrices);
}

VectorXd in_one_piece(int cells = 2, int along = 1)
{
  auto geometry       = free_steel();
  geometry.interfaces = {interface("rear", {"x0"}, smeared), interface("front", {"x1"}, smeared)};
  return frequencies_of(
      fem::discretise(box_mesh({{2 * along, cells, cells}}, {{2. * part_length, part_width, part_height}}), geometry));
}

/// Ritz: fields of a higher degree contain those of a lower one, and the frame in one piece contains them all.
TEST(FlexibleFaces, FrequenciesFallWithTheDegreeToThoseInOnePiece)
{
  const VectorXd whole = in_one_piece();
  VectorXd       above = VectorXd::Constant(20, INFINITY);
  for (const int degree : {1, 2, 3, 4})
  {
    const VectorXd omega = welded(halves(degree)).head(20);
    for (int j = 6; j < 20; ++j)
    {
      EXPECT_LE(omega[j], above[j] * (1. + 1e-9)) << degree << " " << j;
      EXPECT_GE(omega[j], whole[j] * (1. - 1e-9)) << degree << " " << j;
    }
    above = omega;
  }
}

/// Sections in torsion warp like x y (x^2 - y^2) and x y, which are of degree 4.
TEST(FlexibleFaces, OfDegreeFourAreWithinATenthOfAPercentOfOnePiece)
{
  const VectorXd whole = in_one_piece(2, 2), omega = welded(halves(4, 2, 2));
  for (int j = 6; j < 14; ++j)
    EXPECT_NEAR(omega[j], whole[j], 1e-3 * whole[j]) << j;
}

/// A section that stays plane is stiffer: what the fields are for.
TEST(FlexibleFaces, ErrLessThanRigidOnes)
{
  auto rigid = halves(1);
  for (Piece &piece : rigid)
    for (fem::InterfaceSpecification &own : piece.geometry.interfaces)
      if (own.degree > 0)
        own.coupling = fem::InterfaceCoupling::rigid, own.degree = 0;
  const VectorXd whole = in_one_piece(), with_fields = welded(halves(4)), stiff = welded(rigid);
  double         worst = 0., of_rigid = 0.;
  for (int j = 6; j < 14; ++j)
  {
    worst    = std::max(worst, with_fields[j] / whole[j] - 1.);
    of_rigid = std::max(of_rigid, stiff[j] / whole[j] - 1.);
  }
  EXPECT_LT(10. * worst, of_rigid);
}

/// Meshes that do not match: polynomials are the same on both sides, and frequencies lie between those of the frame in
/// one piece with either mesh.
TEST(FlexibleFaces, JoinMeshesThatDoNotMatch)
{
  const VectorXd coarse = in_one_piece(2), fine = in_one_piece(3), omega = welded(halves(4, 3));
  EXPECT_LT(omega.head(6).cwiseAbs().maxCoeff(), 1e-4 * omega[6]); // the whole moves freely
  for (int j = 6; j < 12; ++j)
  {
    EXPECT_LT(omega[j], coarse[j] * 1.001) << j; // what degree 4 leaves
    EXPECT_GT(omega[j], fine[j] * 0.999) << j;   // between nodes the two sides differ
  }
}

/// The axes of a face turn with its part, also in a mirror.
TEST(FlexibleFaces, DoNotDependOnWhereThePartsStand)
{
  const VectorXd        straight = welded(halves(3));
  const Eigen::Matrix3d turn     = Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., -1.).normalized()).toRotationMatrix();
  for (const double side : {1., -1.})
  {
    const Eigen::Matrix3d Q    = turn * Eigen::Vector3d(1., side, 1.).asDiagonal();
    auto                  bars = halves(3);
    for (Piece &piece : bars)
    {
      piece.placement.at = Q * piece.placement.at + Eigen::Vector3d(1., -2., 0.5);
      piece.placement.Q  = Q;
    }
    const VectorXd omega = welded(bars);
    for (int j = 6; j < 20; ++j)
      EXPECT_NEAR(omega[j], straight[j], 1e-7 * straight[j]) << side << " " << j;
  }
}

/// A half turned about the axis of the bar by a right angle has other axes in its face, of a square bar the same modes.
TEST(FlexibleFaces, MayBeTurnedInTheirPlane)
{
  const auto square = [](double angle)
  {
    auto bars = halves(3);
    for (Piece &piece : bars)
      piece.mesh = box_mesh({{2, 2, 2}}, {{part_length, part_width, part_width}});
    const Eigen::Vector3d middle(0., part_width / 2., part_width / 2.);
    bars[1].placement.Q  = Eigen::AngleAxisd(angle, Eigen::Vector3d::UnitX()).toRotationMatrix();
    bars[1].placement.at = Eigen::Vector3d(part_length, 0., 0.) + middle - bars[1].placement.Q * middle;
    return welded(bars);
  };
  const VectorXd straight = square(0.), turned = square(M_PI);
  for (int j = 6; j < 14; ++j)
    EXPECT_NEAR(turned[j], straight[j], 5e-3 * straight[j]) << j; // diagonals of the cells lie otherwise
}

std::string refusal_of_faces(const std::vector<Piece> &bars, const coupling::FrameJoint &joint)
{
  try
  {
    joined(bars, described(bars, {joint}), 2);
  }
  catch (const std::invalid_argument &error)
  {
    return error.what();
  }
  return "";
}

TEST(FlexibleFaces, AreRefusedWhereTheyCannotMoveAlike)
{
  const auto joint = weld("middle", {"first", "front"}, {"second", "rear"});
  auto       other = halves(3);
  make_flexible(other[1], "rear", 2);
  EXPECT_NE(refusal_of_faces(other, joint).find("give both coupling = \"flexible\" with the same 'degree'"),
            std::string::npos);

  auto tilted           = halves(3);
  tilted[1].placement.Q = Eigen::AngleAxisd(0.1, Eigen::Vector3d::UnitY()).toRotationMatrix();
  auto wide             = joint;
  wide.tolerance        = 1.;
  EXPECT_NE(refusal_of_faces(tilted, wide).find("parallel planes"), std::string::npos);

  auto nearby = halves(3);
  nearby[1].placement.at += 2. * part_width * Eigen::Vector3d::UnitY();
  EXPECT_NE(refusal_of_faces(nearby, wide).find("do not overlap"), std::string::npos);

  auto unjoined = halves(3);
  make_flexible(unjoined[0], "rear", 3);
  EXPECT_NE(refusal_of_faces(unjoined, joint).find("has no joint"), std::string::npos);

  EXPECT_NE(refusal_of_faces(halves(8), joint).find("too few for fields of degree 8"), std::string::npos);
}

TEST(Contact, NeedsANormalAcrossItsFaces)
{
  auto joint      = weld("middle", {"first", "front"}, {"second", "rear"});
  joint.kind      = coupling::JointKind::contact;
  joint.normal    = Eigen::Vector3d::UnitZ();
  const auto bars = halves(1);
  EXPECT_NE(refusal_of_faces(bars, joint).find("90 degrees off the normal of 'first.front'"), std::string::npos);
  joint.normal = Eigen::Vector3d::UnitX();
  EXPECT_EQ(refusal_of_faces(bars, joint), "");
}

} // namespace
} // namespace gestell::test
