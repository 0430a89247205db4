// Six forces and moments of a section against hand statics: equilibrium of the part above holds for any mesh and plane.

#include "fem/assembly/quadratic_mesh.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/brick_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

#include <Eigen/Geometry>
#include <Eigen/SparseLU>

namespace gestell::test::section_forces
{
namespace
{

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::VectorXd;
using Six = Eigen::Matrix<double, 6, 1>; // N V1 V2 T M1 M2

constexpr double length = 1.5, width = 0.4, height = 0.3, rho = 7850.;
constexpr double rounding = 1e-8; // of statics, some digits of 1e-16 times a condition of 1e6

fem::CutSpecification cut_at(const std::string &name, const Vector3d &through, const Vector3d &normal)
{
  return {name, {through[0], through[1], through[2]}, {normal[0], normal[1], normal[2]}, "press.toml:50: frame.cut"};
}

Six section(const fem::FrameMatrices &frame, const std::string &name, const VectorXd &q,
            const Vector3d &g = Vector3d::Zero(), const VectorXd &a = {})
{
  Six result;
  for (int k = 0; k < 6; ++k)
  {
    const auto &row = output(frame, "cut." + name + fem::section_components[k][0]);
    EXPECT_EQ(row.unit, k < 3 ? "N" : "N m");
    result[k] = row.on_q.dot(q) + row.under_acceleration.dot(g) + (a.size() > 0 ? row.on_a.dot(a) : 0.);
  }
  return result;
}

/// Components of a force and a moment along the columns of `axes`.
Six along(const Matrix3d &axes, const Vector3d &force, const Vector3d &moment)
{
  return (Six() << axes.transpose() * force, axes.transpose() * moment).finished();
}

void expect_equal(const Six &found, const Six &expected, const std::string &where)
{
  EXPECT_LT((found - expected).head<3>().norm(), rounding * expected.head<3>().norm()) << where;
  EXPECT_LT((found - expected).tail<3>().norm(), rounding * expected.tail<3>().norm()) << where;
}

struct Bar
{
  std::string kind;
  fem::Mesh   mesh;
  bool        plane_faces = true; ///< then centroid and weight of the part of a cell above a plane are exact
};

std::vector<Bar> bars()
{
  const std::array<double, 3> size = {length, width, height};
  return {{"tetrahedra", box_mesh({6, 2, 2}, size, 0.25)},
          {"prisms", prism_mesh({5, 2, 2}, size)},
          {"tied meshes", tied_mesh(size)},
          {"distorted hexahedra", brick_mesh({5, 2, 2}, size, 0.2), false},
          {"distorted prisms", prism_mesh({5, 2, 2}, size, 0.2), false}};
}

/// Held at x = 0, with a node that takes the mean of the free end.
fem::FrameSpecification cantilever()
{
  auto specification       = free_steel();
  specification.supports   = {clamped("wall", {"x0"})};
  specification.interfaces = {interface("tip", {"x1"}, fem::InterfaceCoupling::average)};
  return specification;
}

VectorXd load_on_tip(const fem::FrameMatrices &frame, const Vector3d &force, const Vector3d &moment)
{
  VectorXd load = VectorXd::Zero(frame.C.rows());
  for (int d = 0; d < 3; ++d)
  {
    load[frame.interfaces[0].coordinate[d]]     = force[d];
    load[frame.interfaces[0].coordinate[3 + d]] = moment[d];
  }
  return load;
}

/// The bar beyond the plane x + a (y - y_m) + b (z - z_m) = s: its mass times its centre, from the centroid of the
/// section.
Vector3d moment_of_mass_beyond(double s, double a, double b)
{
  const double A = width * height, Iy = A * width * width / 12., Iz = A * height * height / 12., l = length - s;
  return rho * Vector3d(0.5 * (A * l * l - a * a * Iy - b * b * Iz), a * Iy, b * Iz);
}

void expect_hand_statics_of_a_cantilever(const fem::Support &wall)
{
  const Vector3d F(3e3, -2e3, 4e3), M(500., 800., -600.), tip(length, 0.5 * width, 0.5 * height);
  for (const auto &[kind, mesh, plane_faces] : bars())
  {
    const Vector3d g             = plane_faces ? Vector3d(1., -2., -9.81) : Vector3d(0., 0., 0.);
    auto           specification = cantilever();
    specification.supports       = {wall};
    struct Plane
    {
      double s, a, b;
    };
    const std::vector<Plane> planes = {{0.53, 0., 0.},   {0.75, 0., 0.}, {0.66, 0.5, -0.4}, {0.8, 0.2, -0.3},
                                       {1.1, -0.4, 0.1}, {0.05, 0., 0.}, {1.45, 0., 0.1},   {0.001, 0., 0.}};
    for (std::size_t i = 0; i < planes.size(); ++i)
      specification.cuts.push_back(
          cut_at(std::to_string(i), {planes[i].s, 0.5 * width, 0.5 * height}, {1., planes[i].a, planes[i].b}));
    specification.cuts[1].first = fem::Vector3{0.3, 0.4, -0.5};
    for (std::size_t i = 0; i < planes.size() && !plane_faces; ++i)
      specification.cuts[i].about = specification.cuts[i].through;
    const auto     frame = fem::discretise(mesh, specification);
    const VectorXd q     = statics(frame, load_on_tip(frame, F, M) + frame.acceleration_load * g);
    for (std::size_t i = 0; i < planes.size(); ++i)
    {
      const auto &[s, a, b] = planes[i];
      const Vector3d n      = Vector3d(1., a, b).normalized();
      const Vector3d first  = i == 1 ? Vector3d(0.3, 0.4, -0.5) : Vector3d(0., 1., 0.); // y follows x
      Matrix3d       axes;
      axes.col(0) = n;
      axes.col(1) = (first - first.dot(n) * n).normalized();
      axes.col(2) = n.cross(axes.col(1));
      const Vector3d c(s, 0.5 * width, 0.5 * height);
      const double   mass = rho * width * height * (length - s);
      expect_equal(section(frame, std::to_string(i), q, g),
                   along(axes, F + mass * g, M + (tip - c).cross(F) + moment_of_mass_beyond(s, a, b).cross(g)),
                   kind + ", plane " + std::to_string(i));
    }
  }
}

TEST(SectionForces, OfACantileverAreThoseOfHandStaticsThroughAnyPlaneOfAnyMesh)
{
  expect_hand_statics_of_a_cantilever(clamped("wall", {"x0"}));
}

/// A foundation acts on its side of the plane, however close.
TEST(SectionForces, OfACantileverOnAFoundationAreThoseOfHandStatics)
{
  expect_hand_statics_of_a_cantilever(foundation("wall", {"x0"}, {{2e9, 3e9, 4e9}}));
}

TEST(SectionForces, TurnWithTheFrame)
{
  const Matrix3d Q = Eigen::AngleAxisd(0.8, Vector3d(1., -2., 0.5).normalized()).toRotationMatrix();
  const Vector3d F(3e3, -2e3, 4e3), M(500., 800., -600.), x(0.7, 0.1, 0.2), n(1., 0.2, -0.1), first(0., 1., 1.);
  Six            found[2];
  for (const bool turned : {false, true})
  {
    const Matrix3d R             = turned ? Q : Matrix3d(Matrix3d::Identity());
    auto           mesh          = box_mesh({4, 2, 2}, {length, width, height}, 0.2);
    auto           specification = cantilever();
    const auto     array         = [](const Vector3d &v) { return fem::Vector3{v[0], v[1], v[2]}; };
    for (auto &point : mesh.points)
      point = array(R * Vector3d(point.data()));
    specification.cuts          = {cut_at("middle", R * x, R * n)};
    specification.cuts[0].first = array(R * first);
    specification.cuts[0].about = array(R * Vector3d(0.5, 0., 0.));
    const auto frame            = fem::discretise(mesh, specification);
    found[turned]               = section(frame, "middle", statics(frame, load_on_tip(frame, R * F, R * M)));
  }
  expect_equal(found[1], found[0], "turned");
}

/// A bar that a foundation shakes as a rigid body, u'' = b + beta x (x - c): the section carries the inertia of all
/// that lies beyond the plane, also through the middle of cells.
TEST(SectionForces, CarryTheInertiaOfARigidBarBeyondAnyPlane)
{
  const Vector3d b(3., -4., 5.), beta(20., 30., -10.);
  const double   A = width * height;
  for (const auto &[kind, mesh, plane_faces] : bars())
  {
    if (!plane_faces)
      continue;
    auto specification     = cantilever();
    specification.supports = {foundation("wall", {"x0"}, {{2e9, 3e9, 4e9}})};
    const double places[]  = {0.05, 0.31, 0.53, 0.75, 1.1, 1.45};
    for (const double s : places)
      specification.cuts.push_back(cut_at(std::to_string(s), {s, 0., 0.}, {1., 0., 0.}));
    const auto frame = fem::discretise(mesh, specification);
    for (const double s : places)
    {
      const Vector3d c(s, 0.5 * width, 0.5 * height), to_c = c - Vector3d(frame.centre.data());
      VectorXd       motion(6); // at c; its row of the frame is about the centre of mass
      motion << b - beta.cross(to_c), beta;
      const VectorXd a = frame.rigid_motions * motion, q = statics(frame, -(frame.M * a));
      const double   l = length - s;
      const Vector3d first(0.5 * l * l * A, 0., 0.), square(l * l * l / 3. * A, l * A * width * width / 12.,
                                                            l * A * height * height / 12.); // int x - c, its squares
      const Vector3d inertia = square.sum() * beta - square.cwiseProduct(beta);
      const Six      expected =
          along(Matrix3d::Identity(), -rho * (l * A * b + beta.cross(first)), -rho * (first.cross(b) + inertia));
      EXPECT_LT((section(frame, std::to_string(s), q, Vector3d::Zero(), a) - expected).norm(),
                rounding * rho * length * A * b.norm()) // of the whole bar
          << kind << ", plane at " << s;
    }
  }
}

/// A load on a node between two planes is the difference of their forces; it turns about both.
TEST(SectionForces, DifferByTheLoadBetweenTwoCuts)
{
  auto specification                   = cantilever();
  specification.interfaces             = {interface("load", {}, fem::InterfaceCoupling::node)};
  specification.interfaces[0].position = fem::Vector3{0.75, width, height};
  specification.cuts = {cut_at("near", {0.5, 0., 0.}, {1., 0., 0.}), cut_at("far", {1., 0., 0.}, {1., 0., 0.})};
  for (auto &cut : specification.cuts)
    cut.about = fem::Vector3{0., 0., 0.};
  const auto     frame = fem::discretise(brick_mesh({4, 2, 2}, {length, width, height}), specification);
  const Vector3d F(3e3, -2e3, 4e3);
  VectorXd       load = VectorXd::Zero(frame.C.rows());
  for (int d = 0; d < 3; ++d)
    load[frame.interfaces[0].coordinate[d]] = F[d];
  const VectorXd q = statics(frame, load);
  expect_equal(section(frame, "near", q),
               along(Matrix3d::Identity(), F, Vector3d(frame.interfaces[0].position.data()).cross(F)), "near");
  EXPECT_LT(section(frame, "far", q).norm(), rounding * F.norm()) << "nothing pulls beyond the load";
}

/// A portal, both of whose corners are pushed aside by F/2: planes through both legs carry F and its moment, the middle
/// of the girder neither normal force nor bending moment, as the load is antisymmetric.
TEST(SectionForces, OfAPortalAreThoseOfHandStatics)
{
  const auto portal = [](int i, int, int k)
  { return i == 0 || i == 5 || k == 4 ? std::optional(fem::CellKind::hexahedron) : std::nullopt; };
  auto specification     = free_steel();
  specification.supports = {clamped("feet", {"z0"})};
  specification.cuts     = {cut_at("legs", {0., 0., 0.9}, {0., 0., 1.}), cut_at("girder", {1.2, 0., 0.}, {1., 0., 0.})};
  const double corners[] = {0., 2.4};
  for (const double x : corners)
  {
    specification.interfaces.push_back(interface(x > 0. ? "right" : "left", {}, fem::InterfaceCoupling::node));
    specification.interfaces.back().position = fem::Vector3{x, 0., 2.};
  }
  const auto   frame = fem::discretise(filled_mesh({6, 1, 5}, {2.4, 0.3, 2.}, portal), specification);
  const double F     = 1e4;
  VectorXd     load  = VectorXd::Zero(frame.C.rows());
  for (const auto &node : frame.interfaces)
    load[node.coordinate[fem::ux]] = 0.5 * F;
  const VectorXd q = statics(frame, load);
  const Vector3d force(F, 0., 0.), arm(0., -0.15, 1.1); // from the middle between the legs
  Matrix3d       axes;
  axes << 0., 1., 0., 0., 0., 1., 1., 0., 0.; // z x y
  expect_equal(section(frame, "legs", q), along(axes, force, arm.cross(force)), "legs");
  const Six middle = section(frame, "girder", q); // x y z
  EXPECT_NEAR(middle[0], 0., 1e-7 * F);
  EXPECT_NEAR(middle[4], 0., 1e-7 * F * 2.);
  EXPECT_GT(std::abs(middle[2]), 0.2 * F) << "shear";
}

/// Newton's law in a vibration: supports, section and inertia of the part below are in equilibrium, and so is the part
/// above.
TEST(SectionForces, AreInEquilibriumWithSupportsAndInertiaInAVibration)
{
  auto specification                   = free_steel();
  specification.supports               = {foundation("wall", {"x0"}, {{2e9, 3e9, 4e9}})};
  specification.interfaces             = {interface("tip", {}, fem::InterfaceCoupling::node)};
  specification.interfaces[0].position = fem::Vector3{length, width, height};
  specification.cuts                   = {cut_at("middle", {0.751, 0., 0.}, {1., 0., 0.})}; // cells end at 0.75
  const auto     mesh                  = brick_mesh({4, 1, 1}, {length, width, height});
  const auto     nodes                 = fem::quadratic_mesh(mesh).points;
  const auto     frame                 = fem::discretise(mesh, specification);
  const double   omega                 = 2. * M_PI * 400.; // between the first frequencies
  const Vector3d F(3e3, -2e3, 4e3);
  VectorXd       load = VectorXd::Zero(frame.C.rows());
  for (int d = 0; d < 3; ++d)
    load[frame.interfaces[0].coordinate[d]] = F[d];
  const Eigen::SparseLU<Eigen::SparseMatrix<double>> dynamic(
      Eigen::SparseMatrix<double>(frame.C - omega * omega * frame.M));
  const VectorXd q = dynamic.solve(load), inertia = omega * omega * (frame.M * q); // -M q''

  Vector3d       below = Vector3d::Zero(), above = Vector3d::Zero(), moment = Vector3d::Zero();
  const Vector3d c(0.751, 0.5 * width, 0.5 * height);
  Eigen::Index   next = 0;
  for (const auto &node : nodes)
  {
    const Vector3d x(node.data());
    const bool     tip = (x - Vector3d(length, width, height)).norm() < 1e-9; // its coordinates are the last
    const Vector3d f   = (inertia + load).segment<3>(tip ? inertia.size() - 3 : next);
    next += tip ? 0 : 3;
    (x[0] > 0.7501 ? above : below) += f;
    if (x[0] > 0.7501)
      moment += (x - c).cross(f);
  }
  const Six found = section(frame, "middle", q);
  expect_equal(found, along(Matrix3d::Identity(), above, moment), "above");
  Vector3d support;
  for (int d = 0; d < 3; ++d)
    support[d] = output(frame, std::string("support.wall.") + "xyz"[d]).on_q.dot(q);
  EXPECT_GT(below.norm(), 0.01 * F.norm()) << "or the inertia below proves nothing";
  EXPECT_LT((support + found.head<3>() + below).norm(), rounding * found.head<3>().norm());
}

TEST(SectionForces, WithAFirstDirectionAlongTheNormalAreRefused)
{
  auto specification          = cantilever();
  specification.cuts          = {cut_at("middle", {0.7, 0., 0.}, {1., 0., 0.})};
  specification.cuts[0].first = fem::Vector3{2., 0., 0.};
  expect_refusal(
      [&] {
        fem::discretise(brick_mesh({4, 1, 1}, {length, width, height}), specification);
      },
      "first direction is parallel to the normal");
}

} // namespace
} // namespace gestell::test::section_forces
