// Gas in a cylinder: its work, what it stores and what it dissipates.

#include "mechanism/elements/gas_force.h"
#include "tests/support/prescribed_path.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

GasForce::Parameters cylinder()
{
  GasForce::Parameters gas;
  gas.area             = 0.01;
  gas.clearance_volume = 5e-5;
  gas.initial_pressure = 1e5;
  gas.back_pressure    = 1e5;
  gas.valves           = GasForce::Valves{1e5, 6e5};
  return gas;
}

// n/(n-1) P_s (V_1 - V_4) [(P_d/P_s)^((n-1)/n) - 1], V_1 the largest volume, V_4 = V_c (P_d/P_s)^(1/n).
TEST(GasForce, OfACompressorTakesItsIndicatedWork)
{
  for (const bool grows : {true, false})
  {
    GasForce::Parameters data = cylinder();
    data.grows                = grows;
    const GasForce gas(data);
    const double   s = grows ? 1. : -1., stroke = 0.1;
    const auto     motion = [&](double time)
    {
      return Probe{time, Eigen::VectorXd::Constant(1, s * 0.5 * stroke * (1. + std::cos(0.3 + time))),
                   Eigen::VectorXd::Constant(1, -s * 0.5 * stroke * std::sin(0.3 + time)), Eigen::VectorXd::Zero(1)};
    };
    Eigen::VectorXd history = started(gas, motion(0.));
    double          work = 0., dissipated = 0., begin = 0., begin_dissipated = 0.;
    constexpr int   steps = 400000; // two turns; the second one is periodic
    const double    h     = 4. * M_PI / steps;
    std::string     kinds;
    for (int i = 0; i < steps; ++i)
    {
      if (i == steps / 2)
      {
        begin            = work;
        begin_dissipated = dissipated;
      }
      const Probe  middle = motion((i + 0.5) * h), end = motion((i + 1) * h);
      const double taken = -force(gas, middle, history.data(), true)[0] * middle.v[0];
      const double lost  = taken - gas.stored_power(middle.motion(true), history.data());
      work += h * taken;
      dissipated += h * lost;
      // Compression and expansion lose nothing, delivery does; it is closed at the end of the step in which it turns.
      const bool delivers = gas.guards(history.data())[0].kind == "delivery_closes", turned = s * middle.v[0] > 0.;
      ASSERT_GE(delivers && turned ? 0. : lost, -1e-12 * std::abs(taken));
      ASSERT_LE(delivers ? 0. : lost, 1e-12 * std::abs(taken));
      for (int g = 0; g < gas.n_guards(history.data()); ++g)
        if (past(gas, g, motion(i * h), history.data()) <= 0. && past(gas, g, end, history.data()) > 0.)
        {
          kinds += gas.guards(history.data())[g].kind + " ";
          gas.transition(g, end.motion(true), history.data());
          break;
        }
      gas.accept(end.motion(true), history.data());
    }
    const double n = 1.3, V_1 = 5e-5 + 0.01 * stroke, V_4 = 5e-5 * std::pow(6., 1. / n);
    const double indicated = n / (n - 1.) * 1e5 * (V_1 - V_4) * (std::pow(6., (n - 1.) / n) - 1.);
    EXPECT_NEAR(work - begin, indicated, 1e-3 * indicated); // transitions at the ends of steps
    EXPECT_NEAR(dissipated - begin_dissipated, indicated, 1e-3 * indicated);
    EXPECT_EQ(kinds, "delivery_opens delivery_closes suction_opens suction_closes delivery_opens delivery_closes "
                     "suction_opens suction_closes ");
  }
}

TEST(GasForce, WithValvesStoresWhatItsPowerSays)
{
  for (const double n : {1., 1.3})
  {
    GasForce::Parameters data = cylinder();
    data.exponent             = n;
    data.initial_pressure     = 2e5;
    const GasForce gas(data);
    for (const double branch : {-1., 0., 1.})
    {
      Eigen::VectorXd history = started(gas, probe1(0.05, 0.));
      history[0]              = branch;
      const double u = 0.03, d = 1e-7, speed = -0.7;
      const double slope = (gas.stored_energy(probe1(u + d, 0.).motion(true), history.data()) -
                            gas.stored_energy(probe1(u - d, 0.).motion(true), history.data())) /
                           (2. * d);
      const double power = gas.stored_power(probe1(u, speed).motion(true), history.data());
      EXPECT_NEAR(power, slope * speed, 1e-6 * std::abs(power)) << n << ' ' << branch;
    }
  }
}

TEST(GasForce, EnclosedGivesBackWhatItTook)
{
  GasForce::Parameters data = cylinder();
  data.valves.reset();
  for (const double n : {1., 1.4})
  {
    data.exponent = n;
    const GasForce        gas(data);
    const Eigen::VectorXd history = started(gas, probe1(0.05, 0.));
    const double          u = 0.02, d = 1e-6;
    const double          slope = (gas.stored_energy(probe1(u + d, 0.).motion(), history.data()) -
                          gas.stored_energy(probe1(u - d, 0.).motion(), history.data())) /
                         (2. * d);
    EXPECT_NEAR(-force(gas, probe1(u, 0.), history.data())[0], slope, 1e-6 * std::abs(slope));
    EXPECT_EQ(gas.n_guards(history.data()), 0);
  }
}

TEST(GasForce, RefusesWhatMakesNoSense)
{
  const auto refused = [](auto change)
  {
    GasForce::Parameters gas = cylinder();
    change(gas);
    return refusal([&] { GasForce{gas}; });
  };
  EXPECT_NE(refused([](auto &gas) { gas.area = 0.; }).find("area"), std::string::npos);
  EXPECT_NE(refused([](auto &gas) { gas.clearance_volume = 0.; }).find("clearance_volume"), std::string::npos);
  EXPECT_NE(refused([](auto &gas) { gas.exponent = 0.9; }).find("exponent"), std::string::npos);
  EXPECT_NE(refused([](auto &gas) { gas.valves->delivery = 5e4; }).find("above the suction pressure"),
            std::string::npos);
  EXPECT_NE(refused([](auto &gas) { gas.initial_pressure = 7e5; }).find("between the pressures"), std::string::npos);
  const GasForce gas(cylinder());
  expect_refusal([&] { started(gas, probe1(-0.01, 0.)); }, "volume at the start");
}

} // namespace
} // namespace gestell::tests
