// The oil columns of a hydraulic cylinder: tangents, natural frequency, steady speed, valve; and together with joints.

#include "mechanism/elements/hydraulic_cylinder.h"
#include "tests/support/element_probe.h"
#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using mechanism::HydraulicCylinder;

HydraulicCylinder::Parameters valve_cylinder()
{
  HydraulicCylinder::Parameters P;
  P.area_a     = 2e-3;
  P.area_b     = 1.2e-3;
  P.volume_a   = 4e-4;
  P.volume_b   = 5e-4;
  P.pressure_a = 6e6;
  P.pressure_b = 5e6;
  P.leakage    = 1e-12;
  P.control    = HydraulicCylinder::Control::valve;
  P.course     = 0.4;
  P.rated_flow = 1e-3;
  P.rated_drop = 1e6;
  P.supply     = 2e7;
  P.tank       = 2e5;
  return P;
}

TEST(HydraulicCylinder, TangentIsThatOfDifferencesAndPressuresFulfilTheBalanceOfEachChamber)
{
  for (const double opening : {0.4, -0.7})
  {
    auto P   = valve_cylinder();
    P.course = opening;
    const HydraulicCylinder cylinder(P);
    Probe probe{0., Eigen::Vector3d(2e-3, 2.3e-3, -1.8e-3), Eigen::Vector3d(0.1, 0.2, -0.1), Eigen::Vector3d::Zero()};
    const Eigen::VectorXd history = started(cylinder, probe);
    Eigen::Matrix3d       tangent;
    Eigen::Vector3d       p;
    cylinder.tangent(probe.motion(true), history.data(), {1., 0., 0.}, p.data(), tangent.data());
    for (int j = 0; j < 3; ++j)
    {
      const double h    = 1e-8; // quotients: rounding 1e-16/h of each value, h^2 of the logarithm's third derivative
      Probe        plus = probe, minus = probe;
      plus.u[j] += h;
      minus.u[j] -= h;
      const Eigen::VectorXd difference =
          (force(cylinder, plus, history.data()) - force(cylinder, minus, history.data())) / (2. * h);
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(tangent(i, j), difference[i], 1e-6 * tangent.row(i).norm()) << i << j;
    }
    // V p'/K = Q - A x', with a' = (p_1 - a)/T by the virtual coordinates.
    const auto pressure = [&](const Probe &at, int i) { return cylinder.quantity(i, at.motion(true), history.data()); };
    const double dt     = 1e-8;
    Probe        moved  = probe;
    probe.v[1]          = (p[1] - probe.u[1]) / HydraulicCylinder::lag;
    probe.v[2]          = (p[2] - probe.u[2]) / HydraulicCylinder::lag;
    moved.u             = probe.u + dt * probe.v;
    Probe before        = probe;
    before.u            = probe.u - dt * probe.v;
    const double rate   = (pressure(moved, 1) - pressure(before, 1)) / (2. * dt);
    const double volume = P.volume_a + P.area_a * probe.u[0];
    EXPECT_NEAR(volume * rate / P.bulk_modulus, pressure(probe, 3) - P.area_a * probe.v[0],
                1e-5 * P.area_a * probe.v[0]);
  }
}

std::string cylinder(const std::string &keys)
{
  return "[element.cylinder]\ntype = \"hydraulic cylinder\"\nfrom = \"slide\"\narea_a = \"20 cm^2\"\narea_b = \"12 "
         "cm^2\"\n"
         "volume_a = \"400 cm^3\"\nvolume_b = \"500 cm^3\"\n" +
         keys;
}

const double c_oil = 1.4e9 * (2e-3 * 2e-3 / 4e-4 + 1.2e-3 * 1.2e-3 / 5e-4); // K (A^2/V_a + B^2/V_b)

TEST(HydraulicCylinder, MassSwingsOnTheClosedColumns)
{
  const double m = 200., w = std::sqrt(c_oil / m);
  const auto   motion = run(slider(m, "50 ms") + cylinder("flow = 0\n[start]\nq = { slide = \"10 um\" }\n"),
                            {"run.step=10 us", "output.signals.F=cylinder.force", "output.picture_step=0"});
  double       error  = 0.;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
    error = std::max(error, std::abs(motion.at(i, 1) - 1e-5 * std::cos(w * motion.at(i, 0))));
  // BDF 2: (w h)^2/3 w t = 8e-4 of the phase; the columns of 0.2 m are stiffer by 1e-4 at this amplitude.
  EXPECT_LT(error, 2e-3 * 1e-5) << motion.result.failure;
  EXPECT_NEAR(motion.at(0, 3), -c_oil * 1e-5, 1e-3 * c_oil * 1e-5);
}

TEST(HydraulicCylinder, CommandedFlowGivesItsSpeedAgainstAnyLoad)
{
  const auto motion = run(slider(200., "0.6 s") +
                              cylinder("pressure_a = \"60 bar\"\npressure_b = \"100 bar\"\n"
                                       "flow = [{ at = \"50 ms\", to = \"240 cm^3/s\", rate = \"2400 cm^3/s^2\" }]\n") +
                              "[element.load]\ntype = \"spring-damper\"\nfrom = \"slide\"\ndamping = \"60 kN s/m\"\n",
                          {"run.step=0.1 ms", "output.signals.F=cylinder.force", "output.signals.p=cylinder.pressure_a",
                           "output.picture_step=0"});
  EXPECT_EQ(count(motion, "next_segment"), 2);
  EXPECT_NEAR(motion.signal("v").final, 0.12, 1e-7);
  EXPECT_NEAR(motion.signal("F").final, 60e3 * 0.12, 1e-2);
  expect_closed_balance(motion, 1e-3);
}

TEST(HydraulicCylinder, AValveDividesThePressureByItsFlow)
{
  const auto motion =
      run(slider(50., "0.8 s") +
              cylinder("pressure_a = \"90 bar\"\npressure_b = \"140 bar\"\nrated_flow = \"1000 cm^3/s\"\n"
                       "rated_drop = \"10 bar\"\nsupply_pressure = \"200 bar\"\n"
                       "valve = [{ at = \"20 ms\", to = 0.05, rate = \"2/s\" }]\n") +
              "[element.load]\ntype = \"spring-damper\"\nfrom = \"slide\"\ndamping = \"60 kN s/m\"\n",
          {"run.step=0.1 ms", "output.signals.pa=cylinder.pressure_a", "output.signals.pb=cylinder.pressure_b",
           "output.signals.Q=cylinder.flow", "output.picture_step=0"});
  const double v = motion.signal("v").final, p_a = motion.signal("pa").final, p_b = motion.signal("pb").final;
  EXPECT_GT(v, 0.02);
  EXPECT_NEAR(motion.signal("Q").final, 2e-3 * v, 1e-5 * 2e-3);
  const double Q = 0.05 * 1e-3; // opening times rated flow
  // 2e-4: what is left of the transient after 0.8 s; the laminar part is far below.
  EXPECT_NEAR(2e-3 * v, Q * std::sqrt((2e7 - p_a) / 1e6), 2e-4 * 2e-3 * v);
  EXPECT_NEAR(1.2e-3 * v, Q * std::sqrt(p_b / 1e6), 2e-4 * 2e-3 * v);
  EXPECT_NEAR(2e-3 * p_a - 1.2e-3 * p_b, 60e3 * v, 2e-4 * 60e3 * v);
}

// An arm on a hinge, held by a cylinder between two turning bodies: joints and states without mass together.
TEST(HydraulicCylinder, HoldsAJointedArmFromAStaticInitialStateOn)
{
  const std::string arm =
      "gravity = [0, 0, -10]\n" + planar_body("arm", "300 kg", "90 kg m^2", "['1 m', 0, 0]") +
      revolute("hinge", "ground", "arm", "[0, 0, 0]") +
      measure(
          "length", "distance",
          {{"from", "ground"}, {"at_from", "['0.6 m', 0, '-0.8 m']"}, {"to", "arm"}, {"at_to", "['0.6 m', 0, 0]"}}) +
      element("cylinder", "hydraulic cylinder",
              {{"on", "length"},
               {"zero_at", "0.8 m"},
               {"area_a", "20 cm^2"},
               {"volume_a", "2000 cm^3"},
               {"volume_b", "2000 cm^3"},
               {"flow", "0"}}) +
      start("rule = 'static'") + steps("0.1 ms", "20 ms", {{"method", "bdf"}}) +
      signals("phi = 'arm.angle', F = 'cylinder.force', Z = 'hinge.fz', X = 'hinge.fx'");
  const auto   motion = run(arm);
  const double phi = motion.at(0, 1), F = motion.at(0, 2), dx = 0.6 * std::cos(phi) - 0.6,
               dz = -0.6 * std::sin(phi) + 0.8;
  const double l = std::hypot(dx, dz), x = l - 0.8, K = 1.4e9, L = 1.;
  // Both columns closed, and the moments about the hinge: z dFx - x dFz of weight and cylinder.
  EXPECT_NEAR(F, 2e-3 * K * (std::log(L / (L + x)) - std::log(L / (L - x))), 1e-9 * 5e3);
  EXPECT_NEAR(F / l * (0.6 * std::cos(phi) * dz + 0.6 * std::sin(phi) * dx), 3000. * std::cos(phi), 1e-9 * 3000.);
  // The forces of the hinge are consistent from the first instant on, and nothing moves.
  for (const std::size_t row : {std::size_t(0), motion.n_rows() - 1})
  {
    EXPECT_NEAR(motion.at(row, 3), 3000. - F * dz / l, 1e-6 * 3000.) << row;
    EXPECT_NEAR(motion.at(row, 4), -F * dx / l, 1e-6 * 3000.) << row;
    EXPECT_NEAR(motion.at(row, 1), phi, 1e-10) << row;
  }
}

/// The number behind "at t = " of the warning that says this; nan if there is none.
double warned_at(const SceneRun &motion, const std::string &what)
{
  for (const std::string &warning : coupling::texts_of(motion.result.findings))
    if (warning.find(what) != std::string::npos)
      return std::stod(warning.substr(warning.find("at t = ") + 7));
  return std::nan("");
}

// x = v/w sin w t; chamber A of 0.2 m is without pressure at x = 0.2 m (exp(p_0/K) - 1).
TEST(HydraulicCylinder, CavitationGivesAWarningWithItsTime)
{
  const std::string start = "pressure_a = \"10 bar\"\npressure_b = \"200 bar\"\nflow = 0\n[start]\nrule = \"given\"\n"
                            "v = { slide = \"80 mm/s\" }\n[element.weight]\ntype = \"force\"\nfrom = \"slide\"\n"
                            "constant = \"22 kN\"\n"; // holds 1.2e-3 m^2 200 bar - 2e-3 m^2 10 bar
  const double      m = 200., w = std::sqrt(c_oil / m), x = 0.2 * std::expm1(1e6 / 1.4e9);
  const auto        motion = run(slider(m, "20 ms") + cylinder(start), {"run.step=10 us", "output.picture_step=0"});
  // The columns become softer by x/L, 7e-4, on the way.
  EXPECT_NEAR(warned_at(motion, "cylinder: the pressure in chamber A falls below zero"), std::asin(w * x / 0.08) / w,
              2e-3 / w);
  EXPECT_TRUE(std::isnan(warned_at(motion, "chamber B"))) << "it stays above 200 bar - K x/L";
}

// 0.12 m/s from the middle: chamber B ends at 0.41667 m, and the last hundredth of both columns is 6.17 mm.
TEST(HydraulicCylinder, TheEndOfItsStrokeGivesAWarningWithItsTime)
{
  const std::string flow   = "pressure_a = \"60 bar\"\npressure_b = \"100 bar\"\nflow = \"240 cm^3/s\"\n[start]\n"
                             "v = { slide = \"120 mm/s\" }\n";
  const auto        motion = run(slider(200., "3.45 s") + cylinder(flow), {"run.step=1 ms", "output.picture_step=0"});
  EXPECT_NEAR(warned_at(motion, "the end of its stroke on the side of chamber B"), (0.416667 - 0.00616667) / 0.12,
              1e-4);
  EXPECT_TRUE(std::isnan(warned_at(motion, "the end of its stroke on the side of chamber A")));
}

// At 1 m/s half of the clearance volume, 1e-5 m^3 on 1e-3 m^2, is left 5 mm behind the dead centre; the open valve
// would let the piston through the head.
TEST(GasForce, AWarningNamesTheEndOfItsStroke)
{
  const auto motion = run(slider(1e6, "107 ms") + "[element.gas]\ntype = \"gas force\"\nfrom = \"slide\"\n"
                                                  "area = 1e-3\nclearance_volume = 1e-5\nsuction_pressure = \"1 bar\"\n"
                                                  "delivery_pressure = \"2 bar\"\n[start]\nrule = \"given\"\n"
                                                  "q = { slide = 0.1 }\nv = { slide = -1 }\n",
                          {"run.step=0.1 ms", "output.picture_step=0"});
  EXPECT_NEAR(warned_at(motion, "gas: the piston reaches the end of its stroke"), 0.105, 1e-6); // 200 N on 1e6 kg
}

TEST(HydraulicCylinder, BadInputAndMethodsAreRefused)
{
  expect_complaint(slider(1., "1 s") + cylinder(""), "'flow'");
  expect_complaint(slider(1., "1 s") + cylinder("valve = 2\nrated_flow = \"1 cm^3/s\"\n"), "rated_drop");
  expect_complaint(slider(1., "1 s") + cylinder("valve = 2\nrated_flow = \"1 cm^3/s\"\nrated_drop = \"1 bar\"\n"
                                                "supply_pressure = \"9 bar\"\n"),
                   "opening of the valve = 2");
  expect_complaint(slider(1., "1 s") + cylinder("flow = 0\nrated_flow = \"1 cm^3/s\"\n"), "unknown key 'rated_flow'");
  expect_refusal([&] { run(slider(1., "1 s") + cylinder("flow = 0\n"), {"run.method=newmark"}); },
                 "use the method bdf");
}

} // namespace
} // namespace gestell::tests
