#include "fem/assembly/quadratic_mesh.h"
#include "fem/mesh/wall_thickness.h"
#include "fem/recovery/discretisation.h"
#include "fem/recovery/refinement.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/lowest_modes.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

const fem::Material steel = free_steel().material;

fem::MeshError free_error(const fem::Mesh &mesh)
{
  const auto quadratic = fem::quadratic_mesh(mesh);
  return {quadratic,
          {{steel}, std::vector<int>(quadratic.n_cells(), 0)},
          fem::AffineConstraints(fem::MultipointConstraints(quadratic.n_nodes()))};
}

/// u = the square of a linear function times a direction: its stresses are linear.
Eigen::VectorXd quadratic_field(const fem::QuadraticMesh &mesh)
{
  Eigen::VectorXd u(3 * mesh.n_nodes());
  for (int i = 0; i < mesh.n_nodes(); ++i)
  {
    const auto  &x      = mesh.points[i];
    const double s      = x[0] - 0.5 * x[1] + 0.3 * x[2];
    u.segment<3>(3 * i) = s * s * Eigen::Vector3d(1., 0.4, -0.7);
  }
  return u;
}

TEST(MeshError, VanishesForFieldsTheElementsHold)
{
  for (const fem::Mesh &mesh : {box_mesh({3, 3, 3}, {1., 1., 1.}, 0.2), brick_mesh({3, 3, 3}, {1., 1., 1.})})
  {
    const auto            error = free_error(mesh);
    const Eigen::VectorXd u     = quadratic_field(error.mesh());
    const double          scale = 210e9 * 4.; // of the energy, E |grad u|^2
    // The fit is regularised by 1e-6 of its diagonal, which leaves about the square of that in the energy.
    EXPECT_LT(error.of_cells(u).sum(), 1e-9 * scale);
  }
}

struct Effectivity
{
  double of_error, relative; // estimated over true error of omega^2; estimated relative error of the frequency
};

/// In-plane shear of the thick plate, whose frequency is known.
template <typename MakeMesh>
Effectivity of_plate(const MakeMesh &make_mesh, int n)
{
  fem::FrameSpecification specification;
  specification.material = {200e9, 0.3, 8000., "plate"};
  specification.supports = {clamped("x sides", {"x0", "x1"}, {{false, true, true}}),
                            clamped("y sides", {"y0", "y1"}, {{true, false, true}})};
  const auto   plate     = fem::discretise_with_mesh_error(make_mesh({{n, n, 1}}, {{10., 10., 1.}}, 0.), specification);
  const Modes  modes     = lowest_modes(plate.matrices, 6);
  const double exact     = std::sqrt(200e9 / 2.6 / 8000.) / 20.;
  int          nearest   = 0;
  for (int j = 0; j < 6; ++j)
    if (std::abs(modes.frequency_hz[j] - exact) < std::abs(modes.frequency_hz[nearest] - exact))
      nearest = j;
  const Eigen::VectorXd q      = modes.shape.col(nearest);
  const double          omega2 = q.dot(plate.matrices.C * q) / q.dot(plate.matrices.M * q);
  const double          eta2   = plate.mesh_error->of_cells(q).sum() / q.dot(plate.matrices.M * q);
  const double          truth  = omega2 - std::pow(2. * M_PI * exact, 2);
  return {eta2 / truth, fem::relative_frequency_error(eta2 / omega2)};
}

TEST(MeshError, IsThatOfAPlateWithinAFactorOfTwo)
{
  for (const int n : {4, 8})
  {
    EXPECT_GT(of_plate(box_mesh, n).of_error, 0.5) << n;
    EXPECT_LT(of_plate(box_mesh, n).of_error, 2.) << n;
    EXPECT_GT(of_plate(brick_mesh, n).of_error, 0.5) << n;
    EXPECT_LT(of_plate(brick_mesh, n).of_error, 2.) << n;
  }
}

TEST(Refinement, MakesCellsSmallWhereTheErrorIsAndGrowsGently)
{
  const auto      error = free_error(box_mesh({8, 8, 1}, {8., 8., 1.}));
  Eigen::VectorXd eta2(error.mesh().n_cells());
  for (int i = 0; i < eta2.size(); ++i)
    eta2[i] = error.mesh().points[error.mesh().nodes(i)[0]][0] < 2. ? 1. : 1e-4;
  fem::Refinement refinement;
  refinement.growth   = 2.;
  refinement.largest  = 2.;
  refinement.smallest = 1e-3;
  const auto points   = fem::refine(error, eta2, refinement);

  double near = 0., far = 1e9;
  for (const fem::SizePoint &p : points)
  {
    near = p.at[0] < 1.5 ? std::max(near, p.size) : near;
    far  = p.at[0] > 6.5 ? std::min(far, p.size) : far;
    EXPECT_LE(p.size, 2.);
    for (const fem::SizePoint &other : points)
    {
      const double distance = std::hypot(p.at[0] - other.at[0], p.at[1] - other.at[1], p.at[2] - other.at[2]);
      if (distance < 1.01)
      {
        EXPECT_LE(p.size, other.size + 0.3 * distance + 1e-3);
      }
    }
  }
  EXPECT_LT(1.5 * near, far);
  const fem::SizeField field(points, 2.);
  EXPECT_LT(field({0.5, 4., 0.5}), field({7.5, 4., 0.5}));
  EXPECT_EQ(field({100., 0., 0.}), 2.) << "far from the mesh";
}

TEST(WallThickness, OfAPlateIsMeasuredThroughIt)
{
  // 1 x 1 x 0.01 m, triangles with sides of 0.1 m and a diagonal of 0.1414 m: nearly all of the skin is thinner.
  const auto walls = fem::wall_thickness(box_mesh({10, 10, 1}, {1., 1., 0.01}));
  EXPECT_NEAR(walls.thinnest, 0.01, 1e-9);
  EXPECT_NEAR(walls.median_ratio, 0.1 * std::sqrt(2.) / 0.01, 1e-6);
  EXPECT_NEAR(walls.thin_share, 2. / 2.04, 1e-6);
  EXPECT_EQ(fem::wall_thickness(box_mesh({2, 2, 2}, {1., 1., 1.})).thin_share, 0.);
}

} // namespace
} // namespace gestell::test
