#include "coupling/reduction/reduce_frame.h"
#include "coupling/reduction/shapes/fixed_interface_frame.h"
#include "fem/recovery/discretisation.h"
#include "tests/coupling/reduction/basis_with_modes.h"
#include "tests/support/box_mesh.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell
{
namespace
{

using test::box_mesh;
using test::free_steel;
using test::with_modes;

/// Two boxes side by side that nothing connects.
fem::Mesh two_boxes()
{
  fem::Mesh       mesh  = box_mesh({{2, 1, 1}}, {{1., 0.3, 0.2}});
  const fem::Mesh other = mesh;
  const int       n = static_cast<int>(mesh.points.size()), n_skin = static_cast<int>(mesh.skin.size());
  for (const fem::Point3 &x : other.points)
    mesh.points.push_back({x[0], x[1] + 1., x[2]});
  for (const auto &[a, b, c, d] : other.cells)
    mesh.cells.push_back({a + n, b + n, c + n, d + n});
  for (const auto &[a, b, c] : other.skin)
    mesh.skin.push_back({a + n, b + n, c + n});
  for (const auto &[name, triangles] : other.surfaces)
    for (const int t : triangles)
      mesh.surfaces["second " + name].push_back(t + n_skin);
  mesh.cell_solid.resize(mesh.cells.size(), 1);
  mesh.solids = {"first", "second"};
  return mesh;
}

TEST(FreeFrame, HasSixNamedZeroModesAndTheFrequenciesOfAFreeBeam)
{
  // Bending of a free bar after Timoshenko, by Rayleigh's quotient with Euler's shape w,
  //   f = f_E / sqrt(1 + r^2/l^2 (49.48 + 12.30 E / (kappa G))),  f_E = 4.7300^2 / (2 pi) sqrt(E I / (rho A l^4)),
  // 49.48 = l^2 int w'^2 / int w^2 (rotary inertia), 12.30 = l^2 int w'''^2 / int w''^2 (shear), kappa = 5/6.
  // Lengthwise f = sqrt(E/rho) / (2 l), exact for nu = 0.
  const double l = 2., a = 0.1, E = 210e9, rho = 7850.;
  auto         specification = free_steel();
  specification.material.nu  = 0.;
  specification.interfaces   = {test::interface("end", {"x1"}, fem::InterfaceCoupling::average)};
  const auto frame           = fem::discretise(box_mesh({{16, 1, 1}}, {{l, a, a}}), specification);
  const auto reduced         = coupling::reduce_frame(frame, with_modes(24));

  EXPECT_EQ((reduced.frequencies_hz.array() == 0.).count(), 6);
  EXPECT_EQ(reduced.facts.free_motions,
            (std::vector<std::string>{"translation along x", "translation along y", "translation along z",
                                      "rotation about x", "rotation about y", "rotation about z"}));
  EXPECT_LT(reduced.facts.rigid_energy, 1e-14);

  const double euler = 4.730041 * 4.730041 / (2. * M_PI) * std::sqrt(E * a * a / 12. / (rho * std::pow(l, 4)));
  const double bar   = euler / std::sqrt(1. + a * a / 12. / (l * l) * (49.48 + 12.30 * 2. / (5. / 6.)));
  for (const int bending : {6, 7}) // 16 quadratic cells along the bar are too stiff by less than 0.5 %
  {
    EXPECT_GT(reduced.frequencies_hz[bending], 0.9995 * bar);
    EXPECT_LT(reduced.frequencies_hz[bending], 1.005 * bar);
  }
  const double lengthwise = std::sqrt(E / rho) / (2. * l);
  // The interface's rigid bending of its end face and 24 modes leave 0.3 %.
  EXPECT_LT((reduced.frequencies_hz.array() / lengthwise - 1.).abs().minCoeff(), 5e-3);
}

/// What the difference of large matrices leaves in C*_11 would let a machine on it swing with 1 mHz, or drift away.
TEST(FreeFrame, CostsNothingAtAllToMoveRigidly)
{
  const auto mesh          = box_mesh({{6, 1, 1}}, {{1., 0.1, 0.1}});
  auto       specification = free_steel();
  specification.interfaces = {test::interface("end", {"x1"}, fem::InterfaceCoupling::rigid)};
  const auto one           = coupling::reduce_frame(fem::discretise(mesh, specification), with_modes(4));
  EXPECT_TRUE(one.C.topRows(6).isZero(0.)) << "one interface alone moves rigidly only";

  specification.interfaces.push_back(test::interface("begin", {"x0"}, fem::InterfaceCoupling::rigid));
  const auto      two  = coupling::reduce_frame(fem::discretise(mesh, specification), with_modes(4));
  Eigen::VectorXd turn = Eigen::VectorXd::Zero(two.M.rows()); // about z
  for (const auto &interface : two.interfaces)
  {
    turn[interface.coordinate[0]] = -interface.position[1];
    turn[interface.coordinate[1]] = interface.position[0];
    turn[interface.coordinate[5]] = 1.;
  }
  const double terms = turn.cwiseAbs().dot(two.C.cwiseAbs() * turn.cwiseAbs());
  EXPECT_LT(std::abs(turn.dot(two.C * turn)), 1e-14 * terms);
}

TEST(FreeFrame, OfTwoPartsNamesTwelveMotionsPartByPart)
{
  // Each part has an interface that holds it, as q1 must.
  auto specification       = free_steel();
  specification.interfaces = {test::interface("first", {"x1"}, fem::InterfaceCoupling::rigid),
                              test::interface("second", {"second x1"}, fem::InterfaceCoupling::rigid)};
  const auto reduced       = coupling::reduce_frame(fem::discretise(two_boxes(), specification), with_modes(6));
  EXPECT_EQ((reduced.frequencies_hz.array() == 0.).count(), 12);
  ASSERT_EQ(reduced.facts.free_motions.size(), 12u);
  EXPECT_EQ(reduced.facts.free_motions[0].find("translation along x of part 1 of 2, near ("), 0u)
      << reduced.facts.free_motions[0];
  EXPECT_EQ(reduced.facts.free_motions[11].find("rotation about z of part 2 of 2, near ("), 0u)
      << reduced.facts.free_motions[11];
}

TEST(FreeFrame, WhosePartNoInterfaceHoldsIsRefusedNamingThePart)
{
  auto specification       = free_steel();
  specification.supports   = {test::clamped("wall", {"x0"})};
  specification.interfaces = {test::interface("first", {"x1"}, fem::InterfaceCoupling::rigid)};
  const std::string message =
      tests::refusal([&] { coupling::reduce_frame(fem::discretise(two_boxes(), specification), with_modes(6)); });
  EXPECT_NE(message.find("translation along x of part 2 of 2, near ("), std::string::npos) << message;
  EXPECT_NE(message.find("an interface that constrains it"), std::string::npos) << message;
}

TEST(FreeFrame, OnWheelsHasTheMotionsItsSpringsLeave)
{
  // Springs under the foot along z only: two translations and the turn about z stay.
  auto specification       = free_steel();
  specification.supports   = {test::foundation("wheels", {"z0"}, {{0., 0., 1e6}})};
  specification.interfaces = {test::interface("end", {"x1"}, fem::InterfaceCoupling::rigid)};
  const auto reduced =
      coupling::reduce_frame(fem::discretise(box_mesh({{3, 2, 1}}, {{1., 0.6, 0.1}}), specification), with_modes(10));
  EXPECT_EQ((reduced.frequencies_hz.array() == 0.).count(), 3);
  EXPECT_EQ(reduced.facts.free_motions.size(), 3u);
}

/// A frame so slender that its softest elastic motion costs hardly more than rounding of its rigid ones.
TEST(FreeFrame, OfGreatSlendernessHasItsRigidMotionsApartFromTheModesWithTheInterfaceFree)
{
  auto specification       = free_steel();
  specification.interfaces = {test::interface("left", {"x0"}, fem::InterfaceCoupling::average),
                              test::interface("right", {"x1"}, fem::InterfaceCoupling::average)};
  const auto frame         = fem::discretise(box_mesh({{24, 1, 1}}, {{20., 0.05, 0.02}}), specification);
  auto       options       = with_modes(6);
  options.method           = "free-interface";
  const auto reduced       = coupling::reduce_frame(frame, options);

  coupling::FixedInterfaceFrame full(frame, frame.interface_coordinates());
  EXPECT_EQ((reduced.frequencies_hz.array() == 0.).count(), 6);
  // The inertia counts the frequencies of C + E, |E| ~ growth eps diag(C), which moves omega^2 of a mode v^T M v = 1 by
  // at most growth eps max C_ii/M_ii: so far beside a frequency it tells how many lie below, on every processor.
  const double largest = frame.C.diagonal().cwiseQuotient(frame.M.diagonal()).maxCoeff();
  for (int j = 6; j < 12; ++j)
  {
    const double omega  = 2. * M_PI * reduced.frequencies_hz[j];
    const double growth = full.below_if_free(0.9 * omega).growth;
    const double nearby = std::max(1e-5, growth * std::numeric_limits<double>::epsilon() * largest / (omega * omega));
    EXPECT_LT(nearby, 0.05); // neighbours are 1.6 and more apart, but those of a square section
    EXPECT_EQ(full.below_if_free((1. - nearby) * omega).negative, j);
    EXPECT_EQ(full.below_if_free((1. + nearby) * omega).negative, j + 1);
  }
}

} // namespace
} // namespace gestell
