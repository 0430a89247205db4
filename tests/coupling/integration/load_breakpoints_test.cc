// How far the loads of a run would move a machine.

#include "coupling/integration/step/load_breakpoints.h"

#include "tests/support/small_system.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;
using Vector = Eigen::VectorXd;
using Matrix = Eigen::MatrixXd;

constexpr double m = 4., force = 1e3, end = 64.; // instants 1 s apart

SmallSystem loaded(double stiffness, std::function<double(double)> load, double unit_of_length = 1.)
{
  const double square = unit_of_length * unit_of_length;
  SmallSystem  system(Matrix::Constant(1, 1, m * square), Matrix::Zero(1, 1),
                      Matrix::Constant(1, 1, stiffness * square));
  system.set_load([=](double t) -> Vector { return Vector::Constant(1, load(t) * unit_of_length); });
  return system;
}

LoadedMotion motion(const SecondOrderSystem &system)
{
  LocalState begin;
  begin.resize(system);
  return load_breakpoints(system, begin, end);
}

double bell(double t)
{
  return force * std::exp(-std::pow((t - 40.) / 2., 2));
}

TEST(LoadBreakpoints, MoveAStiffSystemAsTheirStaticsDo)
{
  const double k = 1e8;
  EXPECT_NEAR(motion(loaded(k, bell)).way, std::sqrt(m) * force / k, 1e-6 * std::sqrt(m) * force / k);
}

TEST(LoadBreakpoints, MoveAFreeMassAsLongAsTheyAreSeen)
{
  const LoadedMotion free = motion(loaded(0., bell));
  EXPECT_DOUBLE_EQ(free.way, std::sqrt(m) * force / m);
  EXPECT_DOUBLE_EQ(free.speed, free.way);
}

TEST(LoadBreakpoints, AreNoneWhereNothingChanges)
{
  EXPECT_EQ(motion(loaded(10., [](double) { return force; })).way, 0.);
  SmallSystem unloaded(Matrix::Identity(1, 1), Matrix::Zero(1, 1), Matrix::Identity(1, 1));
  EXPECT_EQ(motion(unloaded).way, 0.);
}

TEST(LoadBreakpoints, DoNotDependOnUnits)
{
  EXPECT_NEAR(motion(loaded(50., bell, 1e-3)).way, motion(loaded(50., bell)).way, 1e-10);
}

} // namespace
} // namespace gestell::tests
