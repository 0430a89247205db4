// The stress at chosen points as outputs.

#include "fem/assembly/quadratic_mesh.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/test.h"

#include <Eigen/LU>

namespace gestell::test::stress_points
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr double                E = 210e9, nu = 0.3;
constexpr std::array<double, 3> size = {2., 0.2, 0.25};

fem::FrameSpecification with_point(const fem::Vector3 &at)
{
  auto specification          = free_steel();
  specification.stress_points = {{"root", at, fem::Vector3{1., 1., -0.5}, "press.toml:60: frame.stress_point.root"}};
  return specification;
}

/// Between nodes, of a stress that is linear in x.
TEST(StressPoints, OfALinearStressAreExactAnywhereOnTheSkin)
{
  const auto gradient = [](const Vector3d &x) -> Matrix3d
  { return 1e-4 * (Matrix3d() << x[2], 1., x[0], -x[1], 2. * x[1] - x[0], 3., 2., x[2], x[1]).finished(); };
  const auto field = [](const Vector3d &x) -> Vector3d
  { return 1e-4 * Vector3d(x[0] * x[2] + x[1], x[1] * x[1] - x[0] * x[1] + 3. * x[2], x[2] * x[1] + 2. * x[0]); };
  const double   lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
  const Vector3d at(0.77, 0.061, 0.25), n                           = Vector3d(1., 1., -0.5).normalized();
  const Matrix3d H = gradient(at), sigma = lambda * H.trace() * Matrix3d::Identity() + mu * (H + H.transpose());
  for (const auto &mesh : {box_mesh({5, 2, 2}, size, 0.25), brick_mesh({5, 2, 2}, size), prism_mesh({5, 2, 2}, size)})
  {
    const auto frame = fem::discretise(mesh, with_point({at[0], at[1], at[2] + 0.01}));
    const auto nodes = fem::quadratic_mesh(mesh).points;
    VectorXd   q(3 * nodes.size());
    for (std::size_t i = 0; i < nodes.size(); ++i)
      q.segment<3>(3 * Eigen::Index(i)) = field(Vector3d(nodes[i].data()));
    const auto stress = [&](const std::string &name) { return output(frame, "stress.root." + name).on_q.dot(q); };
    EXPECT_NEAR(stress("xx"), sigma(0, 0), 1e-11 * E);
    EXPECT_NEAR(stress("yy"), sigma(1, 1), 1e-11 * E);
    EXPECT_NEAR(stress("zz"), sigma(2, 2), 1e-11 * E);
    EXPECT_NEAR(stress("xy"), sigma(0, 1), 1e-11 * E);
    EXPECT_NEAR(stress("yz"), sigma(1, 2), 1e-11 * E);
    EXPECT_NEAR(stress("xz"), sigma(0, 2), 1e-11 * E);
    EXPECT_NEAR(stress("normal"), n.dot(sigma * n), 1e-11 * E);
    EXPECT_EQ(output(frame, "stress.root.xx").unit, "Pa");
    EXPECT_THAT(frame.statements, ::testing::Contains(::testing::HasSubstr("10 mm from the given point")));
    EXPECT_TRUE(frame.stress.empty()) << "no stresses of the whole skin were requested";
  }
}

TEST(StressPoints, FarFromTheSurfaceAreRefused)
{
  const auto mesh = box_mesh({8, 1, 1}, size);
  expect_refusal(
      [&] {
        fem::discretise(mesh, with_point({1., 0.1, 0.8}));
      },
      "press.toml:60: frame.stress_point.root: the point (1 0.1 0.8) m is 0.55 m away from the surface");
  EXPECT_NO_THROW(fem::discretise(mesh, with_point({1., 0.1, 0.5})));
}

TEST(StressPoints, InElementsAtRigidSurfacesAreNoted)
{
  auto specification     = with_point({0.05, 0.1, 0.25});
  specification.supports = {clamped("wall", {"x0"})};
  const auto frame       = fem::discretise(box_mesh({8, 1, 1}, size), specification);
  EXPECT_THAT(frame.notes, ::testing::Contains(::testing::HasSubstr("in an element at the rigid support wall")));
}

} // namespace
} // namespace gestell::test::stress_points
