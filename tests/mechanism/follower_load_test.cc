// A load that turns with its body: its power, and its force against the motion it drives.

#include "mechanism/elements/follower_load.h"
#include "mechanism/elements/profile_force.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using mechanism::FollowerLoad;
using mechanism::Formula;
using mechanism::Placement;
using mechanism::ProfileForce;
using mechanism::Vector3d;

const Placement plate(Vector3d(1., 0., 0.5), Vector3d(0.2, 0., 0.1),
                      {{Vector3d::UnitX(), Vector3d::Zero()}, {Vector3d::UnitZ(), Vector3d::Zero()}},
                      Vector3d::UnitY());

/// 5 N + 2 N sin(3 t + 0.4)
std::shared_ptr<ProfileForce> thrust()
{
  const auto t = Formula::variable(0);
  return std::make_shared<ProfileForce>(mechanism::CommandedProfile(
      mechanism::PositionFunction(5. + 2. * applied(mechanism::Function::sin, 3. * t + 0.4))));
}

TEST(FollowerLoad, ItsPowerIsThatOfTheForceAtItsPoint)
{
  const FollowerLoad  load(plate, Vector3d::UnitX(), thrust());
  const double        u[] = {0.1, -0.2, 0.7}, v[] = {0.5, 0.3, -2.}, a[] = {0., 0., 0.}, t = 0.3;
  double              p[3];
  std::vector<double> history(load.n_history());
  load.start({t, u, v, a}, history.data());
  load.force({t, u, v, a}, history.data(), p);
  Placement::MovedVector x;
  plate.position(u, v, x);
  const Vector3d e = plate.direction(Vector3d::UnitX(), u);
  const double   P = 5. + 2. * std::sin(3. * t + 0.4);
  EXPECT_NEAR(load.quantity(0, {t, u, v, a}, history.data()), P, 1e-14);
  EXPECT_NEAR(p[0] * v[0] + p[1] * v[1] + p[2] * v[2], P * e.dot(x.rate), 1e-13);
  EXPECT_NEAR(p[0], P * std::cos(0.7), 1e-14); // turned about y by 0.7
  EXPECT_NEAR(p[1], -P * std::sin(0.7), 1e-14);
  // The arm (0.8, 0.4) from the centre turns with the load: a moment of 0.4 P about y at every angle.
  EXPECT_NEAR(p[2], 0.4 * P, 1e-14);
}

TEST(FollowerLoad, AcceptsCommandsOfItsLaw)
{
  const FollowerLoad  load(plate, Vector3d::UnitX(), thrust());
  const double        u[] = {0.1, -0.2, 0.7}, v[] = {0.5, 0.3, -2.}, a[] = {0., 0., 0.};
  std::vector<double> history(load.n_history());
  load.start({0., u, v, a}, history.data());
  EXPECT_TRUE(load.command({"set", -7.}, {1., u, v, a}, history.data()));
  EXPECT_NEAR(load.quantity(0, {1.5, u, v, a}, history.data()), -7., 1e-14);
  EXPECT_FALSE(load.command({"jump"}, {1., u, v, a}, history.data()));
}

TEST(FollowerLoad, RefusesWhatItCannotMove)
{
  EXPECT_THROW(FollowerLoad(Placement(Vector3d::Zero()), Vector3d::UnitX(), thrust()), std::invalid_argument);
}

} // namespace
} // namespace gestell::tests
