#include "fem/recovery/skin_stress.h"

#include "fem/assembly/mesh_ties.h"
#include "fem/assembly/quadratic_mesh.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using fem::StressOf;
using Stress = Eigen::Matrix<double, 6, 1>; // xx yy zz xy yz xz

constexpr double E = 210e9, length = 2., width = 0.2, height = 0.25;

Stress hooke(const Matrix3d &H, double nu)
{
  const double   lambda = E * nu / ((1. + nu) * (1. - 2. * nu)), mu = E / (2. * (1. + nu));
  const Matrix3d S = lambda * H.trace() * Matrix3d::Identity() + mu * (H + H.transpose());
  return (Stress() << S(0, 0), S(1, 1), S(2, 2), S(0, 1), S(1, 2), S(0, 2)).finished();
}

fem::FrameSpecification free_bar(double nu)
{
  auto specification        = free_steel();
  specification.material.nu = nu;
  specification.stress      = true;
  return specification;
}

fem::Mesh bar_mesh(int n)
{
  return box_mesh({{4 * n, n, n}}, {{length, width, height}}, 0.25);
}

Vector3d place(const fem::FrameMatrices &frame, std::size_t i)
{
  return Vector3d(frame.picture.points[frame.stress.point[i]].data());
}

/// Coordinates of the free frame that follow a field; they are the displacements of the nodes in their order.
template <typename Field>
VectorXd nodal(const fem::Mesh &mesh, const Field &field)
{
  const auto nodes = fem::quadratic_mesh(mesh).points;
  VectorXd   q(3 * nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i)
    q.segment<3>(3 * Eigen::Index(i)) = field(Vector3d(nodes[i].data()));
  return q;
}

/// Largest difference between the recovered stress and one that is known, over all points or over some.
template <typename ModalPropagation, typename Counts>
double largest_error(const fem::FrameMatrices &frame, const VectorXd &q, const ModalPropagation &exact,
                     const Counts &counts)
{
  const VectorXd sigma = fem::stresses(frame.stress, q, StressOf::mean);
  double         error = 0.;
  for (std::size_t i = 0; i < frame.stress.point.size(); ++i)
    if (counts(place(frame, i)))
      error = std::max(error, (sigma.segment<6>(6 * Eigen::Index(i)) - exact(place(frame, i))).cwiseAbs().maxCoeff());
  return error;
}

template <typename ModalPropagation>
double largest_error(const fem::FrameMatrices &frame, const VectorXd &q, const ModalPropagation &exact)
{
  return largest_error(frame, q, exact, [](const Vector3d &) { return true; });
}

TEST(SkinStress, OfALinearStrainIsExactOnAnyMesh)
{
  // u quadratic in x with all products: P2 holds it, and so does the line inside every cell.
  Matrix3d constant;
  constant << 1., 2., -3., 0.5, -1.5, 4., 2.5, -0.7, 0.3;
  constant *= 1e-4;
  const auto field = [&](const Vector3d &x) -> Vector3d
  {
    const Vector3d squares(1e-4 * x[0] * x[2], 2e-4 * x[1] * x[1] - 1e-4 * x[0] * x[1], 3e-4 * x[2] * x[1]);
    return constant * x + squares + Vector3d(1e-3, 0., 2e-3);
  };
  const auto gradient = [&](const Vector3d &x) -> Matrix3d
  {
    Matrix3d H;
    H << 1e-4 * x[2], 0., 1e-4 * x[0], -1e-4 * x[1], 4e-4 * x[1] - 1e-4 * x[0], 0., 0., 3e-4 * x[2], 3e-4 * x[1];
    return constant + H;
  };
  const double                scale = E * 4e-4;
  const std::array<double, 3> size  = {length, width, height};
  const auto mixed = [](int i, int, int) { return i < 4 ? fem::CellKind::hexahedron : fem::CellKind::prism; };
  for (const auto &mesh : {bar_mesh(2), brick_mesh({8, 2, 2}, size, 0.2), prism_mesh({8, 2, 2}, size, 0.2),
                           filled_mesh({8, 2, 2}, size, mixed, 0.2)})
  {
    const auto     frame = fem::discretise(mesh, free_bar(0.3));
    const VectorXd q     = nodal(mesh, field);
    EXPECT_LT(largest_error(frame, q, [&](const Vector3d &x) { return hooke(gradient(x), 0.3); }), 1e-11 * scale);
    EXPECT_LT(fem::stresses(frame.stress, q, StressOf::deviation).cwiseAbs().maxCoeff(), 1e-11 * scale);
    EXPECT_EQ(frame.stress.triangles, frame.picture.triangles)
        << "with one material its points are those of the picture";
  }
}

/// A box of 1 x 0.3 x 0.2 m bent to an arc of 1 rad, its edges along the arc curved.
fem::Mesh arc_mesh(int n)
{
  fem::Mesh  mesh = box_mesh({4 * n, n, n}, {1., 0.3, 0.2});
  const auto bent = [](double x, double y, double z) {
    return fem::Point3{(1. + y) * std::sin(x), (1. + y) * std::cos(x) - 1., z};
  };
  for (const auto &cell : mesh.cells)
    for (int a = 0; a < 4; ++a)
      for (int b = 0; b < 4; ++b)
        if (cell[a] < cell[b])
        {
          const fem::Point3 &p = mesh.points[cell[a]], &q = mesh.points[cell[b]];
          mesh.middles[{cell[a], cell[b]}] = bent(0.5 * (p[0] + q[0]), 0.5 * (p[1] + q[1]), 0.5 * (p[2] + q[2]));
        }
  for (auto &point : mesh.points)
    point = bent(point[0], point[1], point[2]);
  return mesh;
}

TEST(SkinStress, InCellsWithCurvedSidesIsExactIfConstantAndConvergesWithTheSquareOfTheSize)
{
  Matrix3d constant;
  constant << 1., 2., -3., 0.5, -1.5, 4., 2.5, -0.7, 0.3;
  constant *= 1e-4;
  const auto linear = [&](const Vector3d &x) -> Vector3d { return constant * x; };
  const auto arc    = arc_mesh(2);
  EXPECT_LT(largest_error(fem::discretise(arc, free_bar(0.3)), nodal(arc, linear),
                          [&](const Vector3d &) { return hooke(constant, 0.3); }),
            1e-11 * E * 4e-4);

  const Vector3d k(3., -2., 1.), along(1e-4, 2e-4, -1e-4);
  const auto     wave  = [&](const Vector3d &x) -> Vector3d { return std::sin(k.dot(x)) * along; };
  const auto     error = [&](int n)
  {
    const auto mesh = arc_mesh(n);
    return largest_error(fem::discretise(mesh, free_bar(0.3)), nodal(mesh, wave),
                         [&](const Vector3d &x) { return hooke(std::cos(k.dot(x)) * along * k.transpose(), 0.3); });
  };
  EXPECT_NEAR(std::log2(error(2) / error(4)), 2., 0.3);
}

TEST(SkinStress, OfALinearStrainIsExactAcrossATieOfMeshesThatDoNotMatch)
{
  const auto field = [](const Vector3d &x) -> Vector3d
  { return 1e-4 * Vector3d(x[0] * x[2], x[1] * x[1] - x[0] * x[1], x[2] * x[1]); };
  const auto gradient = [](const Vector3d &x) -> Matrix3d
  { return 1e-4 * (Matrix3d() << x[2], 0., x[0], -x[1], 2. * x[1] - x[0], 0., 0., x[2], x[1]).finished(); };
  const auto                 quad = fem::quadratic_mesh(tied_mesh({length, width, height}));
  fem::MultipointConstraints constraints(quad.n_nodes());
  fem::tie_meshes(quad, {}, constraints);
  const fem::AffineConstraints affine(constraints);
  const fem::Material          steel = free_bar(0.3).material;
  fem::FrameMatrices           frame;
  frame.stress = fem::skin_stress(quad, [&](int) -> const fem::Material & { return steel; }, affine, {});
  ASSERT_LT(affine.n_coordinates(), 3 * quad.n_nodes());
  VectorXd q(affine.n_coordinates());
  for (int i = 0; i < 3 * quad.n_nodes(); ++i)
    if (affine.coordinate(i) >= 0)
      q[affine.coordinate(i)] = field(Vector3d(quad.points[i / 3].data()))[i % 3];
  std::vector<int> point_of(quad.n_nodes(), -1); // of the picture, as it numbers its points
  for (const auto &face : quad.skin)
    for (int k = 0; k < 3; ++k)
      if (int &point = point_of[face[k]]; point < 0)
      {
        point = int(frame.picture.points.size());
        frame.picture.points.push_back(quad.points[face[k]]);
      }
  EXPECT_LT(largest_error(frame, q, [&](const Vector3d &x) { return hooke(gradient(x), 0.3); }), 1e-10 * E * 4e-4);
}

TEST(SkinStress, ConvergesWithTheSquareOfTheSize)
{
  const double k     = 3.;
  const auto   field = [&](const Vector3d &x) -> Vector3d { return Vector3d(std::sin(k * x[0]), 0., 0.) * 1e-4; };
  const auto   error = [&](const fem::Mesh &mesh)
  {
    return largest_error(fem::discretise(mesh, free_bar(0.3)), nodal(mesh, field),
                         [&](const Vector3d &x)
                         {
                           Matrix3d H = Matrix3d::Zero();
                           H(0, 0)    = 1e-4 * k * std::cos(k * x[0]);
                           return hooke(H, 0.3);
                         });
  };
  const auto boxes  = [](int n) { return box_mesh({{8 * n, n, n}}, {{length, width, height}}); };
  const auto bricks = [](int n) { return brick_mesh({{8 * n, n, n}}, {{length, width, height}}); };
  EXPECT_NEAR(std::log2(error(boxes(1)) / error(boxes(2))), 2., 0.3);
  EXPECT_NEAR(std::log2(error(bricks(1)) / error(bricks(2))), 2., 0.3);
}

TEST(SkinStress, OfAHangingBarIsItsWeightBelow)
{
  // nu = 0: sigma_zz = rho g z above the free end z = 0, all others zero; u is quadratic and meets the clamped end.
  auto specification     = free_bar(0.);
  specification.supports = {clamped("ceiling", {"z1"})};
  const auto   frame     = fem::discretise(box_mesh({{1, 2, 5}}, {{0.2, 0.3, 1.5}}, 0.25), specification);
  const double weight    = 7850. * 9.81;
  const auto   q         = statics(frame, -9.81 * frame.acceleration_load.col(2));
  EXPECT_LT(largest_error(frame, q, [&](const Vector3d &x) { return Stress(weight * x[2] * Stress::Unit(2)); }),
            1e-9 * weight * 1.5);
}

/// A bar clamped at x = 0, its free end averaged to a node.
fem::FrameMatrices cantilever(int n, double nu, fem::InterfaceCoupling coupling)
{
  auto specification       = free_bar(nu);
  specification.supports   = {clamped("wall", {"x0"})};
  specification.interfaces = {interface("tip", {"x1"}, coupling)};
  return fem::discretise(box_mesh({{4 * n, n, n}}, {{length, width, height}}), specification);
}

TEST(SkinStress, OfPureBendingIsThatOfABeam)
{
  // nu = 0: sigma_xx = M z / I with z from the axis; a moment +ry pulls where z > 0 as u_x = theta z.
  const auto   frame = cantilever(1, 0., fem::InterfaceCoupling::average);
  const double I = width * std::pow(height, 3) / 12., moment = 1e5, edge = moment * 0.5 * height / I;
  const auto   q = statics(frame, moment * VectorXd::Unit(frame.C.rows(), frame.interfaces[0].coordinate[fem::ry]));
  EXPECT_LT(largest_error(frame, q,
                          [&](const Vector3d &x)
                          { return Stress(moment * (x[2] - 0.5 * height) / I * Stress::Unit(0)); }),
            1e-9 * edge);
}

TEST(SkinStress, OfACantileverApproachesTheBeamAwayFromItsEnds)
{
  // sigma_xx = -F (l - x) z / I of Saint-Venant's bar is exact a height away from both ends; its shear is quadratic,
  // so that a mesh is needed.  The error falls at least with the power 1.5 of the size (2 in the limit).
  const double I = width * std::pow(height, 3) / 12., force = 1e4;
  const auto   error = [&](int n)
  {
    const auto     frame = cantilever(n, 0., fem::InterfaceCoupling::average);
    const auto     q = statics(frame, force * VectorXd::Unit(frame.C.rows(), frame.interfaces[0].coordinate[fem::uz]));
    const VectorXd sigma = fem::stresses(frame.stress, q, StressOf::mean);
    double         worst = 0.;
    for (std::size_t i = 0; i < frame.stress.point.size(); ++i)
    {
      const Vector3d x = place(frame, i);
      if (x[0] < 1.5 * height || x[0] > length - 1.5 * height)
        continue;
      const double exact = -force * (length - x[0]) * (x[2] - 0.5 * height) / I;
      worst              = std::max(worst, std::abs(sigma[6 * Eigen::Index(i)] - exact));
    }
    return worst / (force * length * 0.5 * height / I);
  };
  const double coarse = error(1), fine = error(2);
  EXPECT_LT(fine, 0.02) << "two bricks through the height";
  EXPECT_GT(coarse / fine, std::pow(2., 1.5));
}

TEST(SkinStress, KnowsWhereSurfacesAreHeldRigid)
{
  const auto frame = cantilever(2, 0.3, fem::InterfaceCoupling::rigid);
  ASSERT_EQ(frame.stress.rigid, (std::vector<std::string>{"support wall", "interface tip"}));
  const double brick = length / 8.;
  for (std::size_t i = 0; i < frame.stress.point.size(); ++i)
  {
    const double x        = place(frame, i)[0];
    const int    expected = x < 1.01 * brick ? 0 : x > length - 1.01 * brick ? 1 : -1;
    EXPECT_EQ(frame.stress.nearby[i], expected) << "at x = " << x;
  }
}

TEST(SkinStress, JumpsBetweenMaterialsAndIsNotAveragedThere)
{
  // A bar stretched by the same strain everywhere (nu = 0), half of it ten times softer.
  const auto    mesh = box_mesh({{4, 1, 1}}, {{length, width, height}});
  const auto    quad = fem::quadratic_mesh(mesh);
  fem::Material hard = free_steel().material, soft = hard;
  hard.nu = soft.nu = 0.;
  soft.E            = 0.1 * E;
  const auto beyond = [&](int cell)
  {
    double x = 0.;
    for (int k = 0; k < 4; ++k)
      x += 0.25 * quad.points[quad.cells[cell][k]][0];
    return x > 0.5 * length;
  };
  const auto recovery =
      fem::skin_stress(quad, [&](int cell) -> const fem::Material & { return beyond(cell) ? soft : hard; },
                       fem::AffineConstraints(fem::MultipointConstraints(quad.n_nodes())), {});
  const VectorXd sigma = fem::stresses(
      recovery, nodal(mesh, [](const Vector3d &x) { return Vector3d(1e-4 * x[0], 0., 0.); }), StressOf::mean);
  ASSERT_EQ(recovery.point.size(), 20u + 4u) << "the four points between the halves count twice";
  int n_soft = 0;
  for (std::size_t i = 0; i < recovery.point.size(); ++i)
  {
    const bool is_soft = recovery.lame[i][1] < 0.5 * 0.5 * E;
    n_soft += is_soft;
    EXPECT_NEAR(sigma[6 * Eigen::Index(i)], is_soft ? 2.1e6 : 21e6, 1.);
  }
  EXPECT_EQ(n_soft, 12);
}

} // namespace
} // namespace gestell::test
