// Columns under loads that follow their motion: modes, frequency responses and derivatives against closed
// forms.

#include "apps/output/tables/mode_tables.h"
#include "apps/scene/build/build_machine.h"
#include "coupling/modes/energy_shares.h"
#include "coupling/modes/modes.h"
#include "coupling/modes/operating_point.h"
#include "coupling/sensitivity/frequency_sensitivities.h"
#include "coupling/simulation/checks/stability_guard.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using coupling::Machine;
using coupling::Mode;
using Complex = std::complex<double>;

constexpr double two_pi = 2. * M_PI;

const std::string run_table = steps("1 ms", "1 s") + signals("a = 'b1.angle'");

std::string load(const std::string &tip, double P, const std::string &body)
{
  return element(
      "P", "force",
      {{"from", body}, {"at_from", tip}, {"direction", "[0, 0, -1]"}, {"carried_by", body}, {"constant", number(P)}});
}

std::string hinge(const std::string &name, const std::string &from, const std::string &to, double z, double k, double b)
{
  Keys spring = {{"from", to}, {"about", "[0, 1, 0]"}, {"stiffness", number(k)}, {"damping", number(b)}};
  if (from != "ground")
    spring.push_back({"to", from});
  return revolute(name, from, to, vector(0., 0., z)) + element("k" + name, "spring-damper", spring);
}

constexpr double J = 1e-6; ///< [kg m^2] of each mass about itself

/// Ziegler's column: masses 2 m and m at the ends of two links of length 1 m on springs k = 100 N m, P = kappa k/l.
std::string ziegler(double kappa, double damping = 0.)
{
  return planar_body("b1", "2", number(J), "[0, 0, 1]") + planar_body("b2", "1", number(J), "[0, 0, 2]") +
         hinge("j1", "ground", "b1", 0., 100., damping) + hinge("j2", "b1", "b2", 1., 100., damping) +
         load("[0, 0, 2]", 100. * kappa, "b2") + run_table;
}

struct Column
{
  explicit Column(const std::string &text)
      : scene(test::scene_of(text)), machine(apps::build_machine(scene)), q(apps::modes_configuration(scene, machine))
  {
  }
  std::vector<Mode> modes() const { return coupling::coupled_modes(machine, q, {}, 20); }

  apps::Scene                    scene;
  Machine                        machine;
  Eigen::VectorXd                q;
  const std::vector<std::string> open{};
};

/// Of a x^2 - b x + 1 = 0, x = -s^2 m l^2/k, which is 2 x^2 - (7 - 2 kappa) x + 1 = 0 without J.
struct Ziegler
{
  explicit Ziegler(double kappa) : a((3. + J) * (1. + J) - 1.), b((2. - kappa) * (1. + J) + (3. + J) + 2. - kappa) {}
  /// The lower root and the higher one, or a pair.
  std::pair<Complex, Complex> x() const
  {
    const Complex root = std::sqrt(Complex(b * b - 4. * a));
    return {(b - root) / (2. * a), (b + root) / (2. * a)};
  }
  double a, b;
};

/// s of both, k/(m l^2) = 100/s^2.
std::pair<Complex, Complex> roots(double kappa)
{
  const auto [first, second] = Ziegler(kappa).x();
  return {std::sqrt(-100. * first), std::sqrt(-100. * second)};
}

TEST(FollowerModes, OfZieglersColumnAreThoseOfItsClosedForm)
{
  for (const double kappa : {0.3, 1., 1.9, 2.08})
  {
    const auto modes           = Column(ziegler(kappa)).modes();
    const auto [first, second] = roots(kappa);
    ASSERT_EQ(modes.size(), 2u);
    EXPECT_NEAR(modes[0].frequency_hz, std::abs(first.imag()) / two_pi, 1e-8) << kappa;
    EXPECT_NEAR(modes[1].frequency_hz, std::abs(second.imag()) / two_pi, 1e-8) << kappa;
    EXPECT_EQ(modes[0].growth, 0.);
    EXPECT_EQ(modes[1].growth, 0.);
  }
  const auto modes = Column(ziegler(1.)).modes();
  EXPECT_NEAR(modes[0].frequency_hz, 0.745, 5e-4);
  EXPECT_NEAR(modes[1].frequency_hz, 2.404, 5e-4);
}

TEST(FollowerModes, FlutterWithTheGrowthOfTheClosedForm)
{
  for (const double kappa : {2.1, 2.3, 3.})
  {
    const auto    modes = Column(ziegler(kappa)).modes();
    const Complex s     = roots(kappa).first;
    ASSERT_EQ(modes.size(), 2u);
    for (const Mode &mode : modes)
      EXPECT_NEAR(mode.frequency_hz, std::abs(s.imag()) / two_pi, 1e-8) << kappa;
    EXPECT_NEAR(modes[0].growth, std::abs(s.real()), 1e-7) << kappa;
    EXPECT_NEAR(modes[1].growth, -std::abs(s.real()), 1e-7) << kappa;
    EXPECT_NEAR(modes[0].damping_ratio, -std::abs(s.real()) / std::abs(s), 1e-8);
  }
  EXPECT_NEAR(Column(ziegler(2.3)).modes()[0].growth, 2.31, 0.005);
}

// Energies of a flutter are no constants: their shares are not defined, those below the limit are.
TEST(FollowerModes, HaveEnergySharesUnlessTheyFlutter)
{
  for (const double kappa : {1.9, 2.3})
  {
    const Column column(ziegler(kappa));
    const auto   shares = coupling::energy_shares(column.machine, column.q, {}, column.modes());
    EXPECT_EQ(shares.strain.array().isNaN().all(), kappa > 2.);
    EXPECT_EQ(shares.kinetic.array().isNaN().all(), kappa > 2.);
    EXPECT_EQ(apps::kinetic_text(shares, 0) == "not defined", kappa > 2.) << apps::kinetic_text(shares, 0);
    if (kappa < 2.)
    {
      EXPECT_NEAR(shares.kinetic.col(0).sum(), 1., 1e-9);
    }
  }
}

// H. Ziegler, Die Stabilitaetskriterien der Elastomechanik, Ingenieur-Archiv 20 (1952): equal small dampers in both
// hinges bring the limit from 2.086 down to 41/28.
TEST(FollowerModes, AreDestabilisedByDampers)
{
  for (const double share : {0.99, 1.01})
  {
    double least = 1.;
    for (const Mode &mode : Column(ziegler(share * 41. / 28., 0.01)).modes())
      least = std::min(least, mode.damping_ratio);
    EXPECT_EQ(least<0., share> 1.) << least;
  }
}

TEST(FollowerModes, GrowAsTheFrequencyResponseSays)
{
  for (const double kappa : {1., 2.3})
  {
    Column                       column(ziegler(kappa));
    const coupling::InitialState start{0., column.q, Eigen::VectorXd::Zero(column.q.size())};
    const auto                   point   = coupling::machine_point(column.machine, start);
    const auto                   growing = coupling::LinearResponse(column.machine, point.point).growing();
    ASSERT_TRUE(growing);
    ASSERT_EQ(growing->size(), kappa > 2. ? 1u : 0u);
    for (const Complex &s : *growing)
      EXPECT_NEAR(s.real(), std::abs(roots(kappa).first.real()), 1e-6);
  }
}

// a x^2 - b x + 1 = 0: dx/dkappa = x db/dkappa/(2 a x - b), db/dkappa = -2 - J.
TEST(FollowerModes, HaveTheDerivativesOfTheirClosedForm)
{
  const double kappa = 1.3, step = 1e-6;
  Column       column(ziegler(kappa)), below(ziegler(kappa - step)), above(ziegler(kappa + step));
  const auto   at    = [](const Column &of) { return coupling::LinearisedAt{&of.machine, of.q, &of.open}; };
  const auto   modes = column.modes();
  const auto   found = coupling::frequency_sensitivities(modes, {{at(below), at(above), step}});
  for (int j = 0; j < 2; ++j)
  {
    const double  omega = two_pi * modes[std::size_t(j)].frequency_hz, x = omega * omega / 100.;
    const Ziegler closed(kappa);
    const double  slope = -(2. + J) * x / (2. * closed.a * x - closed.b) * 100. / (2. * omega) / two_pi;
    EXPECT_NEAR(found(j, 0), slope, 1e-7 * std::abs(slope)) << j;
  }
}

// The modes that methods are laid over are these.
TEST(FollowerModes, AreThoseThatStabilityLooksAt)
{
  for (const double damping : {0., 0.4})
    for (const double kappa : {1., 2.3})
    {
      Column                         column(ziegler(kappa, damping));
      const coupling::InitialState   start{0., column.q, Eigen::VectorXd::Zero(column.q.size())};
      const coupling::LinearSpectrum spectrum = linear_spectrum(column.machine, start);
      ASSERT_EQ(spectrum.machines.size(), 1u);
      coupling::MethodOptions bdf = coupling::options_of("bdf");
      bdf.step                    = 1e-3;
      const coupling::StabilityGuard guard(spectrum, bdf);
      const std::vector<Mode>        modes = column.modes();
      ASSERT_EQ(guard.modes().size(), modes.size());
      int reported = 0;
      for (const Mode &mode : modes)
      {
        if (std::isnan(mode.damping_ratio)) // dampers mix a flutter and its partner so that neither is one of the two
          continue;
        ++reported;
        const bool found = std::any_of(guard.modes().begin(), guard.modes().end(),
                                       [&](const coupling::ModeAccuracy &looked)
                                       {
                                         const auto &[omega, zeta] = looked.mode;
                                         const double hz           = omega * std::sqrt(1. - zeta * zeta) / two_pi;
                                         return std::abs(hz - mode.damped_frequency_hz) < 1e-7 &&
                                                std::abs(zeta - mode.damping_ratio) < 1e-7;
                                       });
        EXPECT_TRUE(found) << mode.damped_frequency_hz << ' ' << mode.damping_ratio << " of " << kappa;
      }
      EXPECT_GE(reported, damping == 0. ? 2 : 1);
    }
}

/// A uniform cantilever of EI = 1, l = 1, mass 1 as n rigid links, under a follower load at its tip.
std::string beck(int n, double P)
{
  const double h = 1. / n;
  std::string  text;
  for (int i = 0; i < n; ++i)
  {
    const std::string own = "b" + std::to_string(i + 1), before = i == 0 ? "ground" : "b" + std::to_string(i);
    text += planar_body(own, number(h), number(h * h * h / 12.), vector(0., 0., (i + 0.5) * h)) +
            hinge("j" + std::to_string(i + 1), before, own, i * h, (i == 0 ? 2. : 1.) / h, 0.);
  }
  return text + load(vector(0., 0., 1.), P, "b" + std::to_string(n)) + run_table;
}

// Beck 1952: flutter from 20.05 EI/l^2 on, at omega = 11.02 sqrt(EI/(m l^4)); links err by the square of their length.
TEST(FollowerModes, OfBecksColumnFlutterFromItsLimitOn)
{
  const auto stable = Column(beck(10, 0.97 * 20.05)).modes(), flutter = Column(beck(10, 1.03 * 20.05)).modes();
  for (const Mode &mode : stable)
    EXPECT_EQ(mode.growth, 0.);
  EXPECT_GT(flutter[0].growth, 0.1);
  EXPECT_NEAR(two_pi * flutter[0].frequency_hz, 11.02, 0.3);
}

} // namespace
} // namespace gestell::tests
