#include "fem/assembly/interfaces.h"
#include "fem/assembly/rigid_motions.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using fem::discretise;
using fem::Vector3;

constexpr Vector3 box_size{1., 0.8, 1.5};

fem::InterfaceSpecification node(const std::string &name, const Vector3 &position,
                                 const std::vector<std::string> &surfaces = {})
{
  auto specification     = interface(name, surfaces, fem::InterfaceCoupling::node);
  specification.position = position;
  return specification;
}

fem::FrameSpecification clamped_block(const std::vector<fem::InterfaceSpecification> &interfaces)
{
  auto specification       = free_steel();
  specification.supports   = {clamped("foot", {"z0"})};
  specification.interfaces = interfaces;
  return specification;
}

fem::Mesh tetrahedra()
{
  return box_mesh({3, 3, 3}, box_size, 0.2);
}

fem::Mesh hexahedra()
{
  return brick_mesh({3, 3, 3}, box_size, 0.2);
}

std::vector<int> interface_coordinates(const fem::FrameMatrices &frame)
{
  std::vector<int> q1;
  for (const fem::Interface &interface : frame.interfaces)
    std::copy_if(interface.coordinate.begin(), interface.coordinate.end(), std::back_inserter(q1),
                 [](int i) { return i >= 0; });
  return q1;
}

/// Flexibility of the node, H = (C^-1)_11 [3 x 3].
Eigen::Matrix3d node_flexibility(const fem::FrameMatrices &frame)
{
  const auto     &q1 = frame.interfaces[0].coordinate;
  Eigen::Matrix3d H;
  for (int j = 0; j < 3; ++j)
  {
    const Eigen::VectorXd q = statics(frame, Eigen::VectorXd::Unit(frame.C.rows(), q1[j]));
    for (int i = 0; i < 3; ++i)
      H(i, j) = q[q1[i]];
  }
  return H;
}

/// The same of a point of the skin of a frame without interfaces.
Eigen::Matrix3d flexibility_at(const fem::FrameMatrices &frame, const Vector3 &position)
{
  const auto           &points = frame.picture.points;
  const auto            point  = std::find(points.begin(), points.end(), position) - points.begin();
  const Eigen::MatrixXd rows   = Eigen::MatrixXd(frame.picture.displacement).middleRows(3 * point, 3);
  Eigen::Matrix3d       H;
  for (int j = 0; j < 3; ++j)
    H.col(j) = rows * statics(frame, rows.row(j).transpose());
  return H;
}

using NodeInterface = ::testing::TestWithParam<fem::Mesh (*)()>;

TEST_P(NodeInterface, IsTheNearestCornerWithThreeDisplacementsAndNoRotation)
{
  const auto mesh = GetParam()();
  const auto on   = [&](const fem::InterfaceSpecification &interface)
  { return discretise(mesh, clamped_block({interface})).interfaces.at(0); };
  const auto corner = on(node("tip", {3., 3., 3.}));
  EXPECT_EQ(corner.position, box_size);
  EXPECT_GE(*std::min_element(corner.coordinate.begin(), corner.coordinate.begin() + 3), 0);
  EXPECT_EQ(*std::max_element(corner.coordinate.begin() + 3, corner.coordinate.end()), -1);

  EXPECT_EQ(on(node("side", {3., 0.8, 1.4}, {"x0"})).position, (Vector3{0., 0.8, 1.5})) << "only on its surface";
}

TEST_P(NodeInterface, HasTheFlexibilityOfThatPointOfTheUncoupledFrame)
{
  const auto            mesh  = GetParam()();
  const Eigen::Matrix3d H     = node_flexibility(discretise(mesh, clamped_block({node("tip", box_size)}))),
                        plain = flexibility_at(discretise(mesh, clamped_block({})), box_size);
  EXPECT_LT((H - plain).norm(), 1e-11 * plain.norm());
}

TEST_P(NodeInterface, LeavesRigidMotionsFreeOfEnergyAndKeepsTheMass)
{
  auto specification           = clamped_block({node("a", {0, 0, 0}), node("b", {1, 0, 0}), node("c", {0, 0.8, 0})});
  specification.supports       = {};
  const auto            frame  = discretise(GetParam()(), specification);
  const auto           &R      = frame.rigid_motions;
  const Eigen::MatrixXd energy = R.transpose() * (frame.C * R);
  const Eigen::MatrixXd terms  = R.cwiseAbs().transpose() * (frame.C.cwiseAbs() * R.cwiseAbs());
  EXPECT_LT(energy.cwiseAbs().maxCoeff(), 1e-12 * terms.maxCoeff());
  EXPECT_NEAR(R.col(0).dot(frame.M * R.col(0)), frame.mass, 1e-9 * frame.mass);
}

INSTANTIATE_TEST_SUITE_P(Of, NodeInterface, ::testing::Values(tetrahedra, hexahedra),
                         [](const auto &mesh) { return mesh.param == tetrahedra ? "Tetrahedra" : "Hexahedra"; });

TEST(NodeInterfaces, HoldAFreeFrameByThreeNotOnALineAsThreeLegsDo)
{
  const auto free_of = [](const std::vector<fem::InterfaceSpecification> &interfaces)
  {
    auto specification     = clamped_block(interfaces);
    specification.supports = {};
    const auto frame       = discretise(tetrahedra(), specification);
    return fem::free_motions(frame, interface_coordinates(frame));
  };
  const auto a = node("a", {0, 0, 0}), b = node("b", {1, 0, 0}), c = node("c", {0, 0.8, 0});
  EXPECT_EQ(free_of({a}).size(), 3u) << "turns about it";
  ASSERT_EQ(free_of({a, b}).size(), 1u) << "turns about the line";
  EXPECT_EQ(free_of({a, b, c}).size(), 0u);
}

TEST(NodeInterfaces, BesideOthersAndAttachedMassesKeepTheirCoordinates)
{
  auto plate    = interface("plate", {"z1"}, fem::InterfaceCoupling::average);
  auto frame_of = [&](const std::vector<fem::AttachedMass> &masses)
  {
    auto specification   = clamped_block({node("a", {0., 0., 0.5}), plate, node("b", {1., 0.8, 0.5})});
    specification.masses = masses;
    return discretise(tetrahedra(), specification);
  };
  const auto plain = frame_of({});
  EXPECT_EQ(interface_coordinates(plain).size(), 12u);
  EXPECT_EQ(interface_coordinates(plain).back(), plain.M.rows() - 1);

  fem::AttachedMass box;
  box.name          = "box";
  box.mass          = 7.;
  box.interface     = "b";
  const auto loaded = frame_of({box});
  EXPECT_NEAR(loaded.mass, plain.mass + 7., 1e-9);
  for (int d = 0; d < 3; ++d)
  {
    const int i = loaded.interfaces[2].coordinate[d];
    EXPECT_NEAR(loaded.M.coeff(i, i) - plain.M.coeff(i, i), 7., 1e-9);
    EXPECT_NEAR(loaded.acceleration_load(i, d) - plain.acceleration_load(i, d), 7., 1e-9);
  }

  box.inertia               = Eigen::Matrix3d::Identity();
  const std::string message = refusal([&] { frame_of({box}); });
  EXPECT_NE(message.find("mass \"box\": interface \"b\" is a single node"), std::string::npos) << message;
}

TEST(NodeInterfaces, ReportWhereTheyStandIfThatIsNotWhatWasAskedFor)
{
  EXPECT_TRUE(discretise(tetrahedra(), clamped_block({node("tip", box_size)})).notes.empty());
  const auto notes = discretise(tetrahedra(), clamped_block({node("tip", {1., 0.8, 1.6})})).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("interface \"tip\" is the node at (1, 0.8, 1.5) m, 100 mm from its position"),
            std::string::npos)
      << notes[0];

  fem::Mesh known = tetrahedra();
  known.notes     = {"2 folds are straightened"};
  EXPECT_EQ(discretise(known, clamped_block({node("tip", box_size)})).notes, known.notes)
      << "what the mesh tells stays";
}

TEST(PointInterfaces, BesideTheirSurfaceAreReported)
{
  auto point     = interface("tip", {"z1"}, fem::InterfaceCoupling::point);
  point.position = Vector3{0.5, 0.4, 1.51}; // no farther than the facets of a curved surface could be
  EXPECT_TRUE(discretise(tetrahedra(), clamped_block({point})).notes.empty());
  point.position   = Vector3{0.5, 0.4, 2.5};
  const auto notes = discretise(tetrahedra(), clamped_block({point})).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("interface \"tip\" is the point of its surface at (0.5, 0.4, 1.5) m, 1000 mm from its "
                          "position (0.5, 0.4, 2.5) m"),
            std::string::npos)
      << notes[0];
}

/// The box around faces that are not plane stands for them: the top and a side of a block.
TEST(Interfaces, KnowTheBoxAroundTheirFaces)
{
  auto specification        = free_steel();
  specification.interfaces  = {interface("tip", {"z1", "x1"}, fem::InterfaceCoupling::rigid)};
  const fem::PlaneFace face = discretise(tetrahedra(), specification).interfaces.at(0).face;
  EXPECT_FALSE(face.known());
  EXPECT_FALSE(face.overlaps(face));
  for (int d = 0; d < 3; ++d)
  {
    EXPECT_NEAR(face.centre[d], 0.5 * box_size[d], 1e-14);
    EXPECT_NEAR((face.axes - Eigen::Matrix3d(face.axes.diagonal().asDiagonal())).norm(), 0., 1e-14);
    EXPECT_NEAR(face.axes(d, d), 0.5 * box_size[d], 1e-14);
  }
}

TEST(NodeInterfaces, RefuseWhatTheyCannotBe)
{
  const auto message = [](const fem::InterfaceSpecification &interface)
  { return refusal([&] { discretise(tetrahedra(), clamped_block({interface})); }); };
  auto nowhere     = node("tip", {});
  nowhere.position = {};
  EXPECT_NE(message(nowhere).find("\"tip\" is a single node, which is selected by position"), std::string::npos);
  EXPECT_NE(message(node("tip", {0., 0., 0.})).find("with the clamped support \"foot\""), std::string::npos);
  EXPECT_NE(message(node("tip", {0., 0., 1.}, {"z2"})).find("z2"), std::string::npos);
}

} // namespace
} // namespace gestell::test
