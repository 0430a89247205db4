#include "coupling/algebra/dense_modes.h"
#include "coupling/substructures/parts_recipe.h"
#include "tests/coupling/substructures/pieces.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>

namespace gestell::test
{
namespace
{

using coupling::FrameOfParts;
using coupling::ReducedFrame;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr auto rigid   = fem::InterfaceCoupling::rigid;
constexpr auto average = fem::InterfaceCoupling::average;

/// Two bars one behind the other, the second one on a foundation in its front.
std::vector<Piece> two_bars()
{
  std::vector<Piece> bars{bar("first", average, rigid), bar("second", rigid, average, part_length, 3)};
  bars[1].geometry.supports = {foundation("feet", {"z0"}, {3e8, 2e8, 5e8})};
  return bars;
}

FrameOfParts joined_bars(const std::vector<Piece> &bars)
{
  return described(bars, {weld("middle", {"first", "front"}, {"second", "rear"})});
}

/// The same in one mesh: one interface holds the two faces in the middle together, as a rigid section.
fem::FrameMatrices one_piece(const std::vector<Piece> &bars)
{
  fem::Mesh       mesh = bars[0].mesh;
  const fem::Mesh more = bars[1].mesh;
  const int       n = int(mesh.points.size()), n_skin = int(mesh.skin.size());
  for (const fem::Point3 &x : more.points)
    mesh.points.push_back({x[0] + part_length, x[1], x[2]});
  for (const auto &[a, b, c, d] : more.cells)
    mesh.cells.push_back({a + n, b + n, c + n, d + n});
  for (const auto &[a, b, c] : more.skin)
    mesh.skin.push_back({a + n, b + n, c + n});
  for (const auto &[name, triangles] : more.surfaces)
    for (const int t : triangles)
      mesh.surfaces["second " + name].push_back(t + n_skin);
  mesh.cell_solid.resize(mesh.cells.size(), 1);
  mesh.solids              = {"first", "second"};
  auto specification       = free_steel();
  specification.interfaces = {interface("rear", {"x0"}, average), interface("middle", {"x1", "second x0"}, rigid),
                              interface("front", {"second x1"}, average)};
  specification.supports   = {foundation("feet", {"second z0"}, {3e8, 2e8, 5e8})};
  return fem::discretise(mesh, specification);
}

VectorXd frequencies(const ReducedFrame &frame, int n)
{
  return frame.frequencies_hz.head(n);
}

double largest_difference(const VectorXd &a, const VectorXd &b)
{
  return ((a - b).array() / b.array()).abs().maxCoeff();
}

TEST(JoinedParts, WithAllModesHaveTheFrequenciesOfTheFrameInOnePiece)
{
  const auto bars = two_bars();
  const auto full = one_piece(bars);
  const auto one  = coupling::reduce_frame(full, keeping(full, all_modes));
  const auto two  = whole(bars, joined_bars(bars), all_modes);
  ASSERT_EQ(two.frequencies_hz.size(), one.frequencies_hz.size());
  EXPECT_LT(largest_difference(frequencies(two, 60), frequencies(one, 60)), 1e-9);
  EXPECT_EQ(two.n_full, one.n_full + 6); // the two faces of the joint
}

TEST(JoinedParts, ConvergeFromAboveWithTheModesOfParts)
{
  const auto     bars  = two_bars();
  const auto     full  = one_piece(bars);
  const VectorXd exact = frequencies(coupling::reduce_frame(full, keeping(full, all_modes)), 10);
  double         last  = INFINITY;
  for (const int modes : {4, 8, 16, 32})
  {
    const VectorXd f = frequencies(whole(bars, joined_bars(bars), modes), 10);
    EXPECT_GT((f - exact).minCoeff(), -1e-9 * exact.maxCoeff()) << modes;
    const double error = largest_difference(f, exact);
    EXPECT_LT(error, last);
    last = error;
  }
  EXPECT_LT(last, 2e-3);
}

TEST(JoinedParts, KnowHowMuchTheOmittedModesRaiseFrequencies)
{
  const auto     bars  = two_bars();
  const auto     full  = one_piece(bars);
  const VectorXd exact = frequencies(coupling::reduce_frame(full, keeping(full, all_modes)), 8);
  for (const int modes : {8, 16})
  {
    const auto     both  = joined(bars, joined_bars(bars), modes);
    const VectorXd f     = coupling::dense_modes(both.matrices.C, both.matrices.M).omega.head(8) / (2. * M_PI);
    const VectorXd error = (f - exact).array() / exact.array();
    for (int j = 0; j < 8; ++j)
      if (!std::isnan(both.left_out[j]))
      {
        EXPECT_LT(error[j], 1.05 * both.left_out[j] + 1e-9) << modes << " modes, mode " << j;
        EXPECT_LT(both.left_out[j], 3. * error[j] + 1e-6) << modes << " modes, mode " << j;
      }
    EXPECT_FALSE(std::isnan(both.left_out[4]));
  }
}

TEST(JoinedParts, DeflectUnderStaticLoadsAsOnePieceWhateverTheirModes)
{
  const auto bars       = two_bars();
  const auto full       = one_piece(bars);
  const auto one        = coupling::reduce_frame(full, keeping(full, 0));
  const auto two        = whole(bars, joined_bars(bars), 3);
  const auto compliance = [](const ReducedFrame &frame, const std::string &at, const std::string &from)
  {
    const auto find = [&](const std::string &name)
    {
      for (const auto &interface : frame.interfaces)
        if (interface.name == name)
          return interface.coordinate;
      throw std::invalid_argument(name);
    };
    const auto     i = find(at), j = find(from);
    const MatrixXd H = frame.C.ldlt().solve(MatrixXd::Identity(frame.C.rows(), frame.C.cols()));
    return MatrixXd(H(std::vector<int>(i.begin(), i.end()), std::vector<int>(j.begin(), j.end())));
  };
  const MatrixXd own = compliance(one, "rear", "rear"), across = compliance(one, "rear", "front");
  EXPECT_LT((compliance(two, "first.rear", "first.rear") - own).norm(), 1e-9 * own.norm());
  EXPECT_LT((compliance(two, "first.rear", "second.front") - across).norm(), 1e-9 * across.norm());
  EXPECT_LT((compliance(two, "second.front", "first.rear") - across.transpose()).norm(), 1e-9 * across.norm());
}

TEST(JoinedParts, FloatInSixRigidMotionsWithTheMassOfAll)
{
  auto bars = two_bars();
  bars[1].geometry.supports.clear();
  const auto frame = whole(bars, joined_bars(bars), 6);
  EXPECT_EQ(frame.n_rigid(), 6);
  EXPECT_EQ(frame.facts.free_motions.size(), 6u);
  const double mass = 2. * 7850. * part_length * part_width * part_height;
  EXPECT_NEAR(frame.mass, mass, 1e-9 * mass);
  EXPECT_LT((frame.facts.whole.centre - Eigen::Vector3d(part_length, part_width / 2., part_height / 2.)).norm(), 1e-9);
  // gravity: the load of a unit acceleration does the work of the whole mass in a unit translation
  MatrixXd up = MatrixXd::Zero(frame.M.rows(), 3);
  for (const auto &interface : frame.interfaces)
    for (int d = 0; d < 3; ++d)
      up(interface.coordinate[d], d) = 1.;
  const MatrixXd weight = up.transpose() * frame.translations_load;
  EXPECT_LT((weight - mass * MatrixXd::Identity(3, 3)).norm(), 1e-8 * mass);
}

TEST(JoinedParts, DoNotDependOnTheOrderOfTheScene)
{
  const auto bars     = two_bars();
  const auto forward  = whole(bars, joined_bars(bars), 8);
  const auto turned   = std::vector<Piece>{bars[1], bars[0]};
  const auto backward = whole(turned, described(turned, {weld("middle", {"second", "rear"}, {"first", "front"})}), 8);
  EXPECT_LT(largest_difference(frequencies(forward, 20), frequencies(backward, 20)), 1e-10);
}

TEST(JoinedParts, AreNotChangedByTheirSecondReductionWithAllModes)
{
  const auto bars  = two_bars();
  const auto both  = joined(bars, joined_bars(bars), 8);
  const auto last  = whole(bars, joined_bars(bars), 8);
  const auto modes = coupling::dense_modes(both.matrices.C, both.matrices.M, coupling::cancelled_by_reduction);
  EXPECT_EQ(last.n_interface, 12);
  ASSERT_EQ(last.frequencies_hz.size(), modes.omega.size());
  EXPECT_LT(largest_difference(last.frequencies_hz, modes.omega / (2. * M_PI)), 1e-10);
}

/// x' = Q x, with the corners of cells in their order.
fem::Mesh moved(fem::Mesh mesh, const coupling::Placement &placement)
{
  for (fem::Point3 &x : mesh.points)
  {
    const Eigen::Vector3d there = placement.at + placement.Q * Eigen::Vector3d(x[0], x[1], x[2]);
    x                           = {there[0], there[1], there[2]};
  }
  if (placement.Q.determinant() < 0.)
  {
    for (auto &cell : mesh.cells)
      std::swap(cell[0], cell[1]);
    for (auto &triangle : mesh.skin)
      std::swap(triangle[0], triangle[1]);
  }
  return mesh;
}

/// By its invariants: matrices of the interfaces, and the energy of modes behind them.
void expect_equal_parts(const ReducedFrame &a, const ReducedFrame &b)
{
  const auto n = a.n_interface;
  ASSERT_EQ(n, b.n_interface);
  const auto coupled = [n](const ReducedFrame &frame)
  { return MatrixXd(frame.M.topRightCorner(n, 8) * frame.M.bottomLeftCorner(8, n)); };
  for (const auto &[x, y] : {std::pair(MatrixXd(a.M.topLeftCorner(n, n)), MatrixXd(b.M.topLeftCorner(n, n))),
                             std::pair(MatrixXd(a.C.topLeftCorner(n, n)), MatrixXd(b.C.topLeftCorner(n, n))),
                             std::pair(coupled(a), coupled(b))})
    EXPECT_LT((x - y).norm(), 1e-9 * y.norm());
  const MatrixXd La = a.translations_load.topRows(n), Lb = b.translations_load.topRows(n);
  EXPECT_LT((La - Lb).norm(), 1e-9 * Lb.norm());
  EXPECT_LT((a.facts.whole.centre - b.facts.whole.centre).norm(), 1e-9);
  EXPECT_LT((a.facts.whole.inertia - b.facts.whole.inertia).norm(), 1e-9 * b.facts.whole.inertia.norm());
}

TEST(PlacedPart, IsThePartDrawnThereTurnedOrMirrored)
{
  coupling::Placement turned{Eigen::AngleAxisd(0.7, Eigen::Vector3d(1., 2., -1.).normalized()).matrix(), {1., -2., 3.}},
      mirrored = turned;
  mirrored.Q   = mirrored.Q * Eigen::Vector3d(-1., 1., 1.).asDiagonal();
  for (const auto &placement : {turned, mirrored})
  {
    Piece drawn = bar("part", rigid, average), there = drawn;
    drawn.mesh = there.mesh = box_mesh({{2, 2, 1}}, {{part_length, part_width, part_height}}, 0.2);
    drawn.placement         = placement;
    there.mesh              = moved(there.mesh, placement);
    expect_equal_parts(reduced(drawn, 8), reduced(there, 8));
  }
}

TEST(EqualParts, AreReducedOnceAndGiveTheNumbersOfTwoReductions)
{
  auto bars = two_bars();
  for (Piece &piece : bars)
  {
    piece.mesh         = bars[0].mesh;
    piece.geometry     = bar("", rigid, rigid).geometry;
    piece.geometry.cad = std::string(GESTELL_SOURCE_DIR) + "/meshes/portal_frame.geo"; // for its bytes
  }
  const auto frame  = joined_bars(bars);
  int        n_made = 0;
  const auto make   = [&](const coupling::FramePart &part)
  {
    ++n_made;
    const auto matrices = fem::discretise(bars[0].mesh, part.geometry);
    return coupling::reduce_frame(matrices, keeping(matrices, 5));
  };
  auto parts = coupling::equal_parts_once(frame, {}, make);
  EXPECT_EQ(n_made, 1);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].M, parts[1].M);
  expect_equal_parts(coupling::placed(parts[1], "second", frame.parts[1].placement), reduced(bars[1], 5));

  auto other = frame;
  other.parts[1].geometry.material.rho *= 2.;
  coupling::equal_parts_once(other, {}, make);
  EXPECT_EQ(n_made, 3);
}

} // namespace
} // namespace gestell::test
