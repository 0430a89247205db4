// Rotors with an unbalance: against closed solutions, energy, and the Sommerfeld effect.
// The scene run_up.toml: a motor with an unbalance runs up through the resonances of its foundation.

#include "apps/analysis/analyses.h"
#include "apps/analysis/spectra/spectrum_values.h"
#include "fem/values/two_pi.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_response.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

#include <Eigen/LU>

namespace gestell::tests
{
namespace
{

using Complex = std::complex<double>;

/// A carrier of mass m on a spring k and a damper b, on it a rotor of inertia J with U.
constexpr double m = 20., k = 8e4, b = 60., U = 0.02;

std::string carrier(const std::string &damping = "60")
{
  return slider_body("carrier", "20", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "carrier"}, {"stiffness", "8e4"}, {"damping", damping}});
}

std::string rotor(double inertia, const Keys &more = {}, const std::string &unbalance = "20 g m")
{
  Keys keys = {{"on", "carrier"}, {"unbalance", unbalance}};
  keys.insert(keys.end(), more.begin(), more.end());
  return rotor_body("rotor", number(inertia), "[0, 1, 0]", keys);
}

std::string run_of(const std::string &method, const std::string &end, const std::string &step)
{
  return "[run]\n" + method + "\nend = \"" + end + "\"\n[output]\nstep = \"" + step +
         "\"\nsignals = { x = \"carrier.displacement\", omega = \"rotor.speed\", F = \"rotor unbalance.force\" }\n";
}

SceneRun run_text(const std::string &text)
{
  const test::SceneFolder folder;
  return SceneRun(folder.write("scene.toml", text));
}

/// U w^2/(k - m w^2 + i w b)
Complex orbit(double omega)
{
  return U * omega * omega / Complex(k - m * omega * omega, b * omega);
}

/// Largest |x - exact| over a run of a rotor so heavy that its speed is constant, begun on its orbit, beside its
/// amplitude.
double orbit_error(double omega, double phase, const std::string &method)
{
  const Complex  X   = orbit(omega) * std::polar(1., phase);
  const SceneRun run = run_text(
      carrier() + rotor(1e12, {{"unbalance_phase", number(phase)}}) +
      table("start", {{"q", "{ carrier = " + number(X.real()) + " }"},
                      {"v", "{ rotor = " + number(omega) + ", carrier = " + number(-omega * X.imag()) + " }"}}) +
      run_of(method, number(5. * two_pi / omega) + " s", number(0.01 * two_pi / omega) + " s"));
  double worst = 0.;
  for (std::size_t row = 0; row < run.n_rows(); ++row)
    worst = std::max(
        worst, std::abs(run.at(row, run.column("x")) - (X * std::exp(Complex(0., omega * run.at(row, 0)))).real()));
  EXPECT_NEAR(run.signal("omega").final / omega, 1., 1e-9);
  EXPECT_NEAR(run.signal("F").max / (U * omega * omega), 1., 1e-9);
  return worst / std::abs(X);
}

} // namespace

TEST(Unbalance, AtConstantSpeedShakesItsCarrierAsTheClosedSolution)
{
  // Below, at and above the resonance of 63 rad/s.
  for (const double omega : {30., 63., 150.})
    EXPECT_LT(orbit_error(omega, 0.7, "method = \"bdf\"\ntolerance = 1e-9"), 1e-6) << omega;
}

TEST(Unbalance, IsIntegratedToSecondOrderByTheNewmarkFamily)
{
  const auto error = [](const std::string &step)
  { return orbit_error(63., 0., "method = \"newmark\"\nstep = " + step); };
  EXPECT_NEAR(std::log2(error("1e-3") / error("5e-4")), 2., 0.1);
}

TEST(Unbalance, OnAPointOfAFrameActsInBothDirectionsAcrossTheAxis)
{
  // A point mass in space: its orbit under the force U w^2 that turns is a circle of radius U/m about its mean, in the
  // sense of the rotor: about -y, x leads z.
  const double      omega = 50.;
  const std::string text  = point_body("block", "20", "[0, 0, 0]") +
                           rotor_body("rotor", "1e12", "[0, -1, 0]", {{"on", "block"}, {"unbalance", "20 g m"}}) +
                           // x = -U/m cos(w t), z = -U/m sin(w t): the centre of mass of both rests
                           table("start", {{"q", "{ 'block.ux' = " + number(-U / m) + " }"},
                                           {"v", "{ rotor = 50, 'block.uz' = " + number(-U / m * omega) + " }"}}) +
                           "[run]\nmethod = \"bdf\"\ntolerance = 1e-10\nend = \"0.5 s\"\n[output]\nstep = \"1 ms\"\n"
                           "signals = { x = \"block.ux\", z = \"block.uz\" }\n";
  const SceneRun run = run_text(test::quoted(text));
  for (std::size_t row = 0; row < run.n_rows(); ++row)
  {
    const double t = run.at(row, 0);
    EXPECT_NEAR(run.at(row, run.column("x")), -U / m * std::cos(omega * t), 1e-6 * U / m);
    EXPECT_NEAR(run.at(row, run.column("z")), -U / m * std::sin(omega * t), 1e-6 * U / m);
  }
}

TEST(Unbalance, ExchangesEnergyWithoutLosingAny)
{
  // Rotor and carrier alone: what the one loses the other gains, and the sum with U phi' x'.t stays.
  const SceneRun run = run_text("gravity = [0, 0, -9.81]\n" + carrier("0") + rotor(0.05) +
                                table("start", {{"q", "{ carrier = '2 mm' }"}, {"v", "{ rotor = 60 }"}}) +
                                run_of("method = \"bdf\"\ntolerance = 1e-10", "2 s", "1 ms"));
  EXPECT_EQ(run.result.failure, "");
  EXPECT_LT(run.result.energy.residual, 1e-6 * run.result.energy.exchanged);
  EXPECT_NEAR(run.result.energy.dissipated, 0., 1e-6 * run.result.energy.exchanged);
  // It does exchange: the speed swings by more than a per cent.
  EXPECT_GT(run.signal("omega").max - run.signal("omega").min, 0.6);
}

TEST(Unbalance, HoldsAWeakMotorAtTheResonance)
{
  // 0.5 N m turn the rotor from 30 to 90 rad/s in 6 s without unbalance; with it the carrier takes b (U/b)^2 w^3/2 = 52
  // W at its resonance of 63 rad/s, 0.8 N m, and the rotor stays there (Sommerfeld).
  const auto final_speed = [](const std::string &torque, const std::string &unbalance)
  {
    return run_text(carrier() + rotor(0.05, {}, unbalance) +
                    element("motor", "force", {{"about", "[0, 1, 0]"}, {"from", "rotor"}, {"constant", torque}}) +
                    table("start", {{"v", "{ rotor = 30 }"}}) +
                    run_of("method = \"bdf\"\ntolerance = 1e-7", "6 s", "10 ms"))
        .signal("omega")
        .final;
  };
  EXPECT_NEAR(final_speed("0.5 N m", "0 kg m"), 30. + 0.5 / 0.05 * 6., 1e-6);
  const double weak = final_speed("0.5 N m", "20 g m"), strong = final_speed("20 N m", "20 g m");
  EXPECT_GT(weak, 50.);
  EXPECT_LT(weak, 64.);
  EXPECT_GT(strong, 300.);
}

TEST(Unbalance, UnderGravityIsAPendulum)
{
  // J phi'' + U g phi = 0 about the position below the axis; e_1 = x, so that it hangs at 90 degrees about y.
  const double      g = 9.81, J = 0.05;
  const std::string text =
      "gravity = [0, 0, -9.81]\n" +
      rotor_body("rotor", "0.05", "[0, 1, 0]", {{"unbalance", "20 g m"}, {"unbalance_phase", "90 deg"}});
  const test::SceneFolder folder;
  apps::FrfOptions        options;
  options.from = options.to = {"rotor"};
  options.lowest            = "0.1 Hz";
  options.highest           = "2 Hz";
  const auto response       = scene_response(folder.write("scene.toml", text), options).response;
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
    EXPECT_NEAR((1. / response.pairs[0].values[i]).real(), U * g - J * std::pow(two_pi * response.frequencies_hz[i], 2),
                1e-12 * J * 160.);
}

TEST(Unbalance, CouplesRotorAndCarrierInTheFrequencyResponse)
{
  // At rest with the centre of mass across x: M = [m  -U; -U  J], since dn/dphi = -e_1 there.
  const double            J = 0.05;
  const test::SceneFolder folder;
  apps::FrfOptions        options;
  options.from = options.to  = {"carrier", "rotor"};
  const std::string path     = folder.write("scene.toml", carrier() + rotor(J, {{"unbalance_phase", "90 deg"}}));
  const auto        response = scene_response(path, options).response;
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
  {
    const double  w = two_pi * response.frequencies_hz[i], w2 = w * w;
    const Complex a(k - m * w2, b * w), d = -J * w2, c = w2 * U, det = a * d - c * c;
    const Complex H[] = {d / det, -c / det, -c / det, a / det};
    for (std::size_t pair = 0; pair < 4; ++pair)
      EXPECT_LT(std::abs(response.pairs[pair].values[i] - H[pair]), 1e-11 * std::abs(H[pair])) << pair << ' ' << w;
  }
}

TEST(Unbalance, ActsAtItsPlaceOnACarrierThatTilts)
{
  // 0.3 m above an interface that moves along x and tilts about y: x of the place is u_x + 0.3 r_y.
  const double      J = 0.05, lever = 0.3;
  const std::string text = "[frame]\nmass = [[20, 0], [0, 2]]\nstiffness = [[8e4, 0], [0, 5e4]]\n"
                           "damping = [[60, 0], [0, 10]]\n" +
                           table("frame.interface.top", {{"rows", "{ ux = 1, ry = 2 }"}, {"position", "[0, 0, 1]"}}) +
                           rotor_body("rotor", number(J), "[0, 1, 0]",
                                      {{"on", "frame.top"},
                                       {"unbalance", "20 g m"},
                                       {"unbalance_phase", "90 deg"},
                                       {"unbalance_position", "[0, 0.2, 1.3]"}});
  const test::SceneFolder folder;
  apps::FrfOptions        options;
  options.from = options.to = {"frame.top.ux", "frame.top.ry", "rotor"};
  const auto response       = scene_response(folder.write("scene.toml", text), options).response;
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
  {
    const double    w = two_pi * response.frequencies_hz[i];
    Eigen::Matrix3d M, B = Eigen::Vector3d(60., 10., 0.).asDiagonal(), C = Eigen::Vector3d(8e4, 5e4, 0.).asDiagonal();
    M << 20., 0., -U, 0., 2., -lever * U, -U, -lever * U, J;
    const Eigen::Matrix3cd H = ((C - w * w * M).cast<Complex>() + Complex(0., w) * B.cast<Complex>()).eval().inverse();
    for (int from = 0; from < 3; ++from)
      for (int to = 0; to < 3; ++to)
        EXPECT_LT(std::abs(response.pairs[std::size_t(3 * from + to)].values[i] - H(to, from)),
                  1e-10 * std::abs(H(to, from)));
  }
}

TEST(Unbalance, AtRestHasAForceWithoutAResponseInFirstOrder)
{
  // The magnitude of U (phi'^2 n - phi'' t) has a kink where both are zero, and none while the rotor turns.
  const test::SceneFolder folder;
  apps::FrfOptions        options;
  options.from         = {"carrier"};
  options.to           = {"rotor unbalance.force"};
  const auto answer_of = [&](const std::string &start)
  { return scene_response(folder.write("scene.toml", carrier() + rotor(0.05) + start), options).response; };
  expect_refusal([&] { answer_of(""); }, "has a kink at the operating point");
  EXPECT_FALSE(answer_of(table("start", {{"v", "{ rotor = 60 }"}})).pairs.empty());
}

TEST(Unbalance, WhatCannotBeIsReportedWithItsRemedy)
{
  using ::testing::HasSubstr;
  const std::string run = run_of("method = \"exact\"\nstep = 1e-4", "0.1 s", "1 ms");
  EXPECT_THAT(refusal([&] { run_text(carrier() + rotor(0.05) + run); }),
              HasSubstr("use the method bdf or one of the Newmark family"));
  const auto complaint = [](const Keys &more)
  { return test::complaint(test::quoted(carrier() + rotor_body("rotor", "0.001", "[0, 1, 0]", more))); };
  EXPECT_THAT(complaint({{"unbalance_phase", "1"}}), HasSubstr("has 'unbalance_phase' but no 'unbalance'"));
  EXPECT_THAT(complaint({{"unbalance", "-1 g m"}}), HasSubstr("unbalance"));
  EXPECT_THAT(complaint({{"unbalance", "2 kg"}}), HasSubstr("2.4 g m"));
  EXPECT_THAT(complaint({{"unbalance", "0.1"}, {"mass", "2"}}), HasSubstr("m from the axis"));
}

TEST(Unbalance, GearedToAnotherRotor_ItMovesAsOneRotorOfBothInertias)
{
  // What rounding leaves of the closing of a gear of a ratio that is no binary fraction goes on to the carrier by
  // accelerations: controlled steps must tell it from an error.
  const std::string start = table("start", {{"q", "{ rotor = -0.2064 }"}, {"v", "{ rotor = -1 }"}}),
                    run   = run_of("method = \"bdf\"\ntolerance = 1e-10", "0.3 s", "1 ms");
  const SceneRun one      = run_text(carrier() + rotor(0.5 + 0.5439 * 0.5439 * 0.08) + start + run);
  const SceneRun two =
      run_text(carrier() + rotor(0.5) + rotor_body("second", "0.08", "[0, 1, 0]") +
               joint("gear", "gear", {{"from", "rotor"}, {"to", "second"}, {"ratio", "0.5439"}}) + start + run);
  ASSERT_EQ(two.result.failure, "");
  ASSERT_EQ(two.n_rows(), one.n_rows());
  double largest = 0., apart = 0.;
  for (std::size_t row = 0; row < one.n_rows(); ++row)
  {
    largest = std::max(largest, std::abs(one.at(row, one.column("x"))));
    apart   = std::max(apart, std::abs(one.at(row, one.column("x")) - two.at(row, two.column("x"))));
  }
  EXPECT_LT(apart, 1e-7 * largest); // a thousand times the tolerance, of hundreds of steps
}

TEST(UnbalanceAtTheStart, PushesByTheAccelerationThatTheMotorGives)
{
  const std::string motor = element(
      "drive", "asynchronous motor",
      {{"on", "rotor"}, {"breakdown_torque", "60 N m"}, {"breakdown_slip", "0.12"}, {"synchronous_speed", "300 rpm"}});
  // From rest F = U phi'', J phi'' = M, beside a carrier that hardly follows; the first row tells it as those behind
  // do.
  for (const char *method : {"method = \"bdf\"\nstep = \"1 ms\"", "method = \"bdf\"\ntolerance = 1e-8"})
  {
    const SceneRun run = run_text(carrier() + rotor(0.5) + motor + run_of(method, "5 ms", "1 ms"));
    const double   F   = run.at(1, run.column("F"));
    EXPECT_GT(F, 0.);
    EXPECT_NEAR(run.at(0, run.column("F")), F, 1e-2 * F) << method;
  }
}

TEST(RunUpScene, EndsInTheVibrationOfConstantSpeed)
{
  apps::Session      session(shipped("run_up.toml"));
  const apps::Result result = apps::complete_run(session);
  ASSERT_TRUE(result.run->failure.empty());
  EXPECT_LT(result.run->energy.residual, 1e-6 * result.run->energy.exchanged);
  const auto *found = apps::answer_in<apps::RunSpectra>(result.answers);
  ASSERT_TRUE(found && found->orders);
  const apps::OrderTracking &orders = *found->orders;
  const double               omega = orders.speed_rpm.back() * M_PI / 30., U = 0.06, m = 300., b = 1.2e3;
  for (const apps::OrderedSignal &signal : orders.signals)
    if (signal.name == "x" || signal.name == "z")
    {
      const double k = signal.name == "x" ? 1.2e6 : 2.6e6;
      const double X = U * omega * omega / std::abs(std::complex<double>(k - m * omega * omega, b * omega));
      // 2.5 s above the resonances exp(-b t/(2 m)) leaves 0.7 % of up to 2 mm, at other frequencies.
      EXPECT_NEAR(signal.amplitudes[0].back() / X, 1., 0.02) << signal.name;
      const auto &order = signal.amplitudes[0];
      const auto  top   = std::size_t(std::max_element(order.begin(), order.end()) - order.begin());
      // The shaking is largest where the speed has just gone through the resonance.
      const double own = std::sqrt(k / m) * 30. / M_PI;
      EXPECT_GT(orders.speed_rpm[top], own) << signal.name;
      EXPECT_LT(orders.speed_rpm[top], 1.35 * own) << signal.name;
    }
}

} // namespace gestell::tests
