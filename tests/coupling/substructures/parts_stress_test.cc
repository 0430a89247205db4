// Stresses and section forces of a frame of parts.

#include "coupling/frame/stress_field.h"
#include "tests/coupling/substructures/pieces.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>
#include <Eigen/LU>

namespace gestell::test::parts_stress
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr auto stiff = fem::InterfaceCoupling::rigid;
constexpr auto even  = fem::InterfaceCoupling::average;

/// In single precision stresses of unit motions are rounded to 6e-8; they cancel to some tenths of a percent.
constexpr double single_precision = 1e-5;

struct TwoBars
{
  std::vector<Piece> pieces;
  Matrix3d           Q; ///< of the whole
};

/// Two bars end to end, the whole turned by Q, the second one besides about its axis, mirrored if so.  Without Poisson
/// contraction and with stresses linear over the sections, rigid joints and averaged ends do not disturb them.
TwoBars two_bars(bool mirrored)
{
  TwoBars        two{{bar("first", stiff, stiff), bar("second", stiff, even)}, {}};
  const Matrix3d turn = Eigen::AngleAxisd(0.5 * M_PI, Vector3d::UnitX()).toRotationMatrix();
  const Vector3d sides(1., mirrored ? -1. : 1., 1.), middle(0., 0.5 * part_width, 0.5 * part_height), at(1., -2., 0.5);
  two.Q                   = Eigen::AngleAxisd(0.7, Vector3d(1., 2., -1.).normalized()).toRotationMatrix();
  two.pieces[0].placement = {two.Q, at};
  const Matrix3d Q2       = two.Q * turn * sides.asDiagonal();
  two.pieces[1].placement = {Q2, at + two.Q * (middle + part_length * Vector3d::UnitX()) - Q2 * middle};
  two.pieces[0].geometry.interfaces.erase(two.pieces[0].geometry.interfaces.begin());
  two.pieces[0].geometry.supports = {clamped("ground", {"x0"})};
  for (Piece &piece : two.pieces)
  {
    piece.geometry.material.nu   = 0.;
    piece.geometry.stress        = true;
    piece.geometry.cuts          = {{"middle", {0.3, 0., 0.}, {1., 0., 0.}, ""}};
    piece.geometry.stress_points = {{"edge", {0.17, part_width, part_height}, {}, ""}};
  }
  return two;
}

TEST(SectionsOfParts, AndSupportsBalanceTheInertiaOfEveryMotionWhateverModesAreOmitted)
{
  std::srand(1);
  const auto [pieces, Q] = two_bars(true);
  for (const int modes : {0, 3})
  {
    const auto frame =
        whole(pieces, described(pieces, {weld("middle", {"first", "front"}, {"second", "rear"})}), modes);
    const Vector3d g(4., -9., 30.), force(3e4, -1e4, 2e4);
    const auto     n    = frame.M.rows();
    VectorXd       load = frame.translations_load * g;
    for (int d = 0; d < 3; ++d)
      load[frame.interfaces[0].coordinate[d]] += force[d];
    const VectorXd p = 1e-4 * VectorXd::Random(n), a = frame.M.lu().solve(load - frame.C * p);
    const Vector3d loads = force + frame.mass * g - frame.translations_load.transpose() * a;
    for (int d = 0; d < 3; ++d)
    {
      const std::string name = std::string("first.support.ground.") + "xyz"[d];
      const auto        row  = std::find_if(frame.outputs.begin(), frame.outputs.end(),
                                            [&](const fem::FrameOutput &output) { return output.name == name; });
      ASSERT_NE(row, frame.outputs.end());
      EXPECT_NEAR(row->on_q.dot(p) + row->on_a.dot(a) + row->under_acceleration.dot(g), -Q.col(d).dot(loads),
                  1e-8 * loads.norm())
          << modes << " modes, " << name;
    }
  }
}

/// Pulled, bent at the free end and hanging along their axis: sigma = (N(x)/A + bending) e_x e_x^T in every part.
TEST(StressesOfParts, AreExactForLinearStressesInTurnedAndMirroredParts)
{
  const double A = part_width * part_height, rho = 7850.;
  const double I_y = A * part_height * part_height / 12., I_z = A * part_width * part_width / 12.;
  for (const bool mirrored : {false, true})
  {
    const auto [pieces, Q] = two_bars(mirrored);
    const auto frame    = whole(pieces, described(pieces, {weld("middle", {"first", "front"}, {"second", "rear"})}), 0);
    const Vector3d axis = Q.col(0), force = 3e4 * axis, moment = Q * Vector3d(0., 800., -500.), g = 40. * axis;
    VectorXd       load = frame.translations_load * g;
    for (int d = 0; d < 3; ++d)
    {
      load[frame.interfaces[0].coordinate[d]] += force[d];
      load[frame.interfaces[0].coordinate[3 + d]] += moment[d];
    }
    const VectorXd p = frame.C.lu().solve(load);
    ASSERT_EQ(frame.interfaces.size(), 1u);
    ASSERT_FALSE(frame.stress.empty());
    const auto field =
        coupling::stress_field(frame.stress, coupling::stress_state(frame.stress, p, {g[0], g[1], g[2]}));

    const auto own_stress = [&](const Piece &piece, const Vector3d &x) // along the bar, x in the part
    {
      const double   to_end = part_length - x[0] + (piece.name == "first" ? part_length : 0.);
      const Vector3d M = piece.placement.Q.transpose() * moment * piece.placement.Q.determinant(); // an axial vector
      const double   N = 3e4 + rho * A * 40. * to_end;
      return N / A + M[1] * (x[2] - 0.5 * part_height) / I_y - M[2] * (x[1] - 0.5 * part_width) / I_z;
    };
    double largest = 0., error = 0.;
    for (int i = 0; i < frame.stress.n_points(); ++i)
    {
      const Piece   &piece = pieces[std::size_t(frame.stress.point[i]) < frame.points.size() / 2 ? 0 : 1];
      const Vector3d x =
          piece.placement.Q.transpose() * (Vector3d(frame.points[frame.stress.point[i]].data()) - piece.placement.at);
      const Matrix3d         S = own_stress(piece, x) * axis * axis.transpose();
      const coupling::Stress exact =
          (coupling::Stress() << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)).finished();
      largest = std::max(largest, exact.cwiseAbs().maxCoeff());
      error   = std::max(error, (field.at(i) - exact).cwiseAbs().maxCoeff());
    }
    EXPECT_LT(error, single_precision * largest) << (mirrored ? "mirrored" : "turned");

    const auto value = [&](const std::string &name)
    {
      const auto row = std::find_if(frame.outputs.begin(), frame.outputs.end(),
                                    [&](const fem::FrameOutput &output) { return output.name == name; });
      return row->on_q.dot(p) + row->under_acceleration.dot(g);
    };
    for (const Piece &piece : pieces)
    {
      const double      to_end = part_length - 0.3 + (piece.name == "first" ? part_length : 0.);
      const Vector3d    M      = piece.placement.Q.transpose() * moment * piece.placement.Q.determinant();
      const std::string cut = piece.name + ".cut.middle", point = piece.name + ".stress.edge.";
      EXPECT_NEAR(value(cut), 3e4 + rho * A * 40. * to_end, 1e-3);
      EXPECT_NEAR(value(cut + ".M1"), M[1], 1e-5) << "along the axes of the part: " << piece.name;
      EXPECT_NEAR(value(cut + ".M2"), M[2], 1e-5);
      const double sigma = own_stress(piece, {0.17, part_width, part_height});
      EXPECT_NEAR(value(point + "xx"), sigma, 1e-8 * largest);
      EXPECT_NEAR(value(point + "yz"), 0., 1e-8 * largest);
    }
    EXPECT_EQ(frame.stress.rigid,
              (std::vector<std::string>{"first: support ground", "first: interface front", "second: interface rear"}));
    EXPECT_EQ(frame.stress.triangles, frame.triangles);
  }
}

} // namespace
} // namespace gestell::test::parts_stress
