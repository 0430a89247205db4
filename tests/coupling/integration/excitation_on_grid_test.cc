// Loads at the points of a grid, whose harmonics turn by products, against their cosines.

#include "coupling/integration/system/excitation_on_grid.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace coupling;

Excitation three_harmonics()
{
  Excitation load(4);
  load.add_constant(1, 3.);
  load.add_constant(2, -1.);
  load.add_harmonic(0, 25., 2., -0.5);
  load.add_harmonic(2, 25., 0., 1.);
  load.add_harmonic(2, 411., -1., 4.);
  load.add_harmonic(3, 1e-3, 1., 1.);
  return load;
}

TEST(ExcitationOnGrid, IsTheLoadAtEveryPointInAnyOrderOfPoints)
{
  const Excitation load = three_harmonics();
  ExcitationOnGrid grid(load);
  Eigen::VectorXd  exact(4);
  const double     t_0 = -0.3, largest = 10.; // sum of all terms
  for (const double h : {1e-4, 0.017, 1e-4})
    for (const long k : {0L, 1L, 2L, 15L, 16L, 17L, 40L, 3L, 100000L, 99999L, 5L})
    {
      grid.find(t_0, h, k);
      const double t = t_0 + double(k) * h;
      load.at(t, exact);
      // cosines of an angle known to its own rounding, and the rounding of the products
      const double angle = 411. * (std::abs(t_0) + double(k) * h);
      const double error = (8. + 2. * angle) * std::numeric_limits<double>::epsilon() * largest;
      EXPECT_LE((grid.value() - exact).lpNorm<Eigen::Infinity>(), error) << "h " << h << ", k " << k;
    }
}

TEST(ExcitationOnGrid, APointDoesNotDependOnThoseBefore)
{
  const Excitation load = three_harmonics();
  ExcitationOnGrid grid(load), other(load);
  for (long k = 0; k < 50; ++k)
    grid.find(0.1, 2e-3, k);
  other.find(0.1, 2e-3, 49);
  EXPECT_EQ(grid.value(), other.value());
}

} // namespace
} // namespace gestell::tests
