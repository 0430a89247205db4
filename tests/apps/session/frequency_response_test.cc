// Frequency responses of scenes: against closed solutions, the modes, and the time integration.

#include "apps/session/session.h"
#include "fem/values/two_pi.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_response.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::FrequencyResponse;
using apps::FrfOptions;
using apps::Session;
using Complex = std::complex<double>;

FrequencyResponse response_of(const std::string &path, const FrfOptions &options,
                              const std::vector<std::string> &overrides = {})
{
  return scene_response(path, options, overrides).response;
}

/// Of the text of a scene.
FrequencyResponse response_of_text(const std::string &text, const FrfOptions &options,
                                   const std::vector<std::string> &overrides = {})
{
  const test::SceneFolder folder;
  return response_of(folder.write("scene.toml", text), options, overrides);
}

FrfOptions options_of(const std::vector<std::string> &from, const std::vector<std::string> &to, double lowest = 0.5,
                      double highest = 50.)
{
  FrfOptions options;
  options.from    = from;
  options.to      = to;
  options.lowest  = number(lowest);
  options.highest = number(highest);
  options.points  = 60;
  return options;
}

/// A mass m on a spring c and a damper b.
constexpr double m = 2., c = 800., b = 3.;

const std::string oscillator =
    slider_body("slide", "2", "[1, 0, 0]") +
    element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "800"}, {"damping", "3"}}) +
    table("output", {{"signals", "{ x = 'slide.displacement', F = 'spring.force' }"}});

Complex receptance(double f)
{
  const double w = two_pi * f;
  return 1. / Complex(c - m * w * w, b * w);
}

/// Largest |H - exact| / |exact| of a pair.
template <typename Exact>
double error(const FrequencyResponse &response, std::size_t pair, const Exact &exact)
{
  double worst = 0.;
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
  {
    const Complex H = exact(response.frequencies_hz[i]);
    worst           = std::max(worst, std::abs(response.pairs[pair].values[i] - H) / std::abs(H));
  }
  return worst;
}

/// Largest |1/H - Z| of a pair whose resonances are not damped, beside its stiffness.
template <typename Exact>
double inverse_error(const FrequencyResponse &response, std::size_t pair, double stiffness, const Exact &Z)
{
  double worst = 0.;
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
    worst = std::max(worst, std::abs(1. / response.pairs[pair].values[i] - Z(response.frequencies_hz[i])) / stiffness);
  return worst;
}

/// c - m w^2
double dynamic_stiffness(double stiffness, double mass, double f)
{
  return stiffness - mass * std::pow(two_pi * f, 2);
}

} // namespace

TEST(FrequencyResponse, OfAnOscillatorIsItsClosedSolution)
{
  const auto response = response_of_text(oscillator, options_of({"slide"}, {"slide", "x", "slide.velocity", "F"}));
  ASSERT_EQ(response.pairs.size(), 4u);
  EXPECT_EQ(response.pairs[0].unit, "m/N");
  EXPECT_EQ(response.pairs[2].unit, "m/s/N");
  EXPECT_EQ(response.pairs[3].unit, "N/N");
  const auto i_omega = [](double f) { return Complex(0., two_pi * f); };
  EXPECT_LT(error(response, 0, receptance), 1e-14);
  EXPECT_LT(error(response, 1, receptance), 1e-14);
  EXPECT_LT(error(response, 2, [&](double f) { return i_omega(f) * receptance(f); }), 1e-14);
  EXPECT_LT(error(response, 3, [&](double f) { return (c + b * i_omega(f)) * receptance(f); }), 1e-14);
}

TEST(FrequencyResponse, OfItsKindIsDifferentiatedOnceOrTwice)
{
  FrfOptions options = options_of({"slide"}, {"slide"});
  for (const auto &[kind, times, unit] : {std::tuple("mobility", 1, "m/s/N"), {"accelerance", 2, "m/s^2/N"}})
  {
    options.kind        = kind;
    const auto response = response_of_text(oscillator, options);
    EXPECT_EQ(response.pairs[0].unit, unit);
    EXPECT_LT(
        error(response, 0, [t = times](double f) { return std::pow(Complex(0., two_pi * f), t) * receptance(f); }),
        1e-14);
  }
}

TEST(FrequencyResponse, TellsThePeakOfAnOscillator)
{
  const auto   response = response_of_text(oscillator, options_of({"slide"}, {"slide"}));
  const double D = b / (2. * std::sqrt(c * m)), f_0 = std::sqrt(c / m) / two_pi;
  ASSERT_EQ(response.pairs[0].peaks.size(), 1u);
  const auto &peak = response.pairs[0].peaks[0];
  EXPECT_NEAR(peak.frequency_hz, f_0 * std::sqrt(1. - 2. * D * D), 1e-7 * f_0);
  EXPECT_NEAR(peak.amplitude, 1. / (c * 2. * D * std::sqrt(1. - D * D)), 1e-9 / c / D);
  EXPECT_NEAR(peak.damping_ratio, D + 2. * D * D * D, 10. * std::pow(D, 5)); // what the width of a peak tells
}

// The crank press: elements of all kinds, in motion.

TEST(FrequencyResponse, OfThePressIsReciprocalWhereItsDrivesRest)
{
  const std::vector<std::string> places  = {"frame.crown.uz", "frame.table.uz", "slide", "crank"};
  FrfOptions                     options = options_of(places, places, 0.5, 300.);
  options.at                             = "undeformed";
  const auto response                    = response_of(shipped("press_minimal.toml"), options);
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < i; ++j)
    {
      const auto &H_ij = response.pairs[i * places.size() + j].values,
                 &H_ji = response.pairs[j * places.size() + i].values;
      for (std::size_t k = 0; k < H_ij.size(); ++k)
        EXPECT_LT(std::abs(H_ij[k] - H_ji[k]), 1e-12 * std::abs(H_ij[k])) << places[i] << ' ' << places[j];
    }
}

TEST(FrequencyResponse, OfALightlyDampedMachinePeaksAtItsModes)
{
  // Three masses of 100 kg on springs, a damper of each mass to the ground: B = a M, so that the modes stay real.
  const std::string text = "[frame]\nmass = [[100, 0, 0], [0, 100, 0], [0, 0, 100]]\n"
                           "stiffness = [[2e6, -1e6, 0], [-1e6, 2e6, -1e6], [0, -1e6, 1e6]]\n"
                           "damping = [[20, 0, 0], [0, 20, 0], [0, 0, 20]]\n" +
                           table("frame.interface.top", {{"rows", "{ uz = 3 }"}});
  const test::SceneFolder folder;
  const auto [result, response] =
      scene_response(folder.write("scene.toml", text), options_of({"frame.top.uz"}, {"frame.top.uz"}, 1., 60.));
  const auto &peaks = response.pairs[0].peaks;
  ASSERT_EQ(peaks.size(), 3u);
  for (std::size_t j = 0; j < 3; ++j)
  {
    // A peak lies beside its mode by what the others leave there: of second order in D = 1e-3.
    EXPECT_NEAR(peaks[j].frequency_hz / result.coupled_modes[j].frequency_hz, 1., 1e-5) << j;
    EXPECT_NEAR(peaks[j].damping_ratio / result.coupled_modes[j].damping_ratio, 1., 1e-2) << j;
  }
}

TEST(FrequencyResponse, OfAPendulumHasTheGeometricStiffnessOfItsJoint)
{
  // A rod of length 2 s on an ideal pin: (J + m s^2) phi'' + m g s phi = M, held up by the force of the joint alone.
  const double      mass = 3., J = 0.4, s = 0.5, g = 9.81;
  const std::string text = "gravity = [0, 0, -9.81]\n" + planar_body("rod", "3", "0.4", "[0, 0, -0.5]") +
                           revolute("pin", "rod", "ground", "[0, 0, 0]");
  const auto response = response_of_text(text, options_of({"rod.angle"}, {"rod.angle", "rod.ux"}, 0.1, 20.));
  EXPECT_EQ(response.pairs[0].unit, "rad/(N m)");
  EXPECT_EQ(response.pairs[1].unit, "m/(N m)");
  const double inertia = J + mass * s * s, weight = mass * g * s;
  EXPECT_LT(inverse_error(response, 0, inertia * std::pow(two_pi * 20., 2),
                          [&](double f) { return dynamic_stiffness(weight, inertia, f); }),
            1e-14);
  const auto &H = response.pairs;
  for (std::size_t k = 0; k < H[0].values.size(); ++k) // the centre moves across the rod
    EXPECT_NEAR(std::abs(H[1].values[k]) / std::abs(H[0].values[k]), s, 1e-12);
}

TEST(FrequencyResponse, TellsTheForceOfAnIdealJoint)
{
  // A rod without mass carries 3 kg along with the oscillator: its force is what these 3 kg need.
  const std::string text =
      oscillator.substr(0, oscillator.find("[output]")) +
      slider_body("mass", "3", "[1, 0, 0]", {{"position", "[1, 0, 0]"}}) +
      joint("rod", "distance", {{"from", "slide"}, {"at_from", "[0, 0, 0]"}, {"to", "mass"}, {"at_to", "[1, 0, 0]"}});
  const auto response = response_of_text(text, options_of({"slide"}, {"mass", "rod.force"}));
  const auto both     = [](double f) { return 1. / Complex(dynamic_stiffness(c, m + 3., f), b * two_pi * f); };
  EXPECT_LT(error(response, 0, both), 1e-13);
  const double sign = response.pairs[1].values[0].real() * -both(response.frequencies_hz[0]).real() > 0. ? 1. : -1.;
  EXPECT_LT(error(response, 1, [&](double f) { return sign * -3. * std::pow(two_pi * f, 2) * both(f); }), 1e-9);
}

TEST(FrequencyResponse, SeesAContactWhereItIsClosed)
{
  // 2 kg held on a stop of 800 N/m by their weight: closed; 1 mm above it: free.
  const std::string text =
      "gravity = [0, 0, -10]\n" + slider_body("slide", "2", "[0, 0, 1]") +
      element("stop", "stop",
              {{"from", "slide"}, {"direction", "[0, 0, 1]"}, {"gap", "0"}, {"side", "below"}, {"stiffness", "800"}});
  const auto on =
      response_of_text(text + "[start]\nq = { slide = -0.025 }\n", options_of({"slide"}, {"slide", "stop.force"}));
  EXPECT_EQ(on.closed_contacts.size(), 1u);
  const double largest = m * std::pow(two_pi * 50., 2);
  EXPECT_LT(inverse_error(on, 0, largest, [](double f) { return dynamic_stiffness(c, m, f); }), 1e-14);
  // Its force is derived by quotients: rounding of some 20 N in steps of 1e-6 m.
  EXPECT_LT(inverse_error(on, 1, largest / c, [](double f) { return dynamic_stiffness(c, m, f) / c; }), 1e-10);
  const auto off = response_of_text(text + "[start]\nq = { slide = 0.001 }\n", options_of({"slide"}, {"slide"}));
  EXPECT_TRUE(off.closed_contacts.empty());
  EXPECT_LT(error(off, 0, [](double f) { return Complex(-1. / (m * std::pow(two_pi * f, 2))); }), 1e-13);
}

/// A play of zero is closed on both sides and open in the point itself; a stop of zero gap is closed on one side.
TEST(FrequencyResponse, WarnsOfAContactThatJustTouches)
{
  const std::string slide = slider_body("slide", "2", "[0, 0, 1]") +
                            element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "800"}});
  for (const std::string type : {"stop", "clearance"})
  {
    const auto warnings = [&](const std::string &gap)
    {
      const std::string text = slide + element("touch", type, {{"from", "slide"}, {"gap", gap}, {"stiffness", "3000"}});
      const test::SceneFolder folder;
      std::string             all;
      for (const std::string &warning :
           scene_response(folder.write("scene.toml", text), options_of({"slide"}, {"slide"})).result.warnings)
        all += warning;
      return all;
    };
    EXPECT_THAT(warnings("0"), testing::HasSubstr("\"touch\" just touches")) << type;
    EXPECT_THAT(warnings("0.001"), testing::Not(testing::HasSubstr("touches"))) << type;
  }
}

/// The band is about the modes with the contacts as they are: an open stop of 1e6 N/m does not move it.
TEST(FrequencyResponse, LooksWhereTheMachineVibratesAtItsPoint)
{
  const std::string text =
      slider_body("slide", "2", "[0, 0, 1]") +
      element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "800"}}) +
      element("stop", "stop", {{"from", "slide"}, {"direction", "[0, 0, 1]"}, {"gap", "1"}, {"stiffness", "1e6"}});
  FrfOptions options;
  options.from = options.to = {"slide"};
  const auto   response     = response_of_text(text, options);
  const double own          = std::sqrt(800. / 2.) / two_pi;
  EXPECT_NEAR(response.frequencies_hz.front(), 0.25 * own, 1e-9 * own);
  EXPECT_NEAR(response.frequencies_hz.back(), 1.5 * own, 1e-9 * own);
}

TEST(FrequencyResponse, ThatSymmetryForbidsIsZero)
{
  // A mass between two equal ones rests while these are pressed together.
  const auto spring =
      [](const std::string &name, const std::string &from, const std::string &to, const std::string &stiffness)
  {
    return element(
        name, "spring-damper",
        {{"from", from}, {"to", to}, {"direction", "[1, 0, 0]"}, {"stiffness", stiffness}, {"damping", "0.3"}});
  };
  std::string text;
  for (const std::string name : {"left", "middle", "right"})
    text +=
        slider_body(name, name == "middle" ? "3.3" : "2", "[1, 0, 0]") + spring("foot_" + name, name, "ground", "700");
  text += spring("one", "left", "middle", "1234") + spring("other", "middle", "right", "1234") +
          spring("across", "left", "right", "567");
  const auto response = response_of_text(test::quoted(text), options_of({"across.displacement"}, {"left", "middle"}));
  EXPECT_EQ(response.pairs[0].peaks.size(), 1u);
  EXPECT_TRUE(response.pairs[1].peaks.empty());
  for (const Complex &value : response.pairs[1].values)
    EXPECT_EQ(value, 0.);
}

TEST(FrequencyResponse, OfAnUndampedMachineIsInfiniteAtItsFrequencies)
{
  const std::string text = slider_body("slide", "2", "[1, 0, 0]") +
                           element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "800"}});
  const auto response = response_of_text(text, options_of({"slide"}, {"slide"}));
  ASSERT_EQ(response.pairs[0].peaks.size(), 1u);
  EXPECT_NEAR(response.pairs[0].peaks[0].frequency_hz, 20. / two_pi, 1e-7);
  EXPECT_TRUE(std::isinf(response.pairs[0].peaks[0].amplitude));
  EXPECT_EQ(response.pairs[0].peaks[0].damping_ratio, 0.);
}

// --- as the time integration has it

/// Complex amplitude of a column over the last n rows, one period of omega.
Complex amplitude_of(const SceneRun &run, const std::string &column, double omega, std::size_t n)
{
  Complex           sum    = 0.;
  const std::size_t signal = run.column(column), end = run.n_rows() - 1; // the last row begins the next period
  for (std::size_t row = end - n; row < end; ++row)
    sum += run.at(row, signal) * std::exp(Complex(0., -omega * run.at(row, 0)));
  return 2. / double(n) * sum;
}

TEST(FrequencyResponse, IsTheSteadyVibrationOfTheTimeIntegration)
{
  // One mass on a spring to the ground, another one lying on it: their contact stays closed under its weight of 20 N,
  // where it is linear.  After 10 s what the start leaves has faded to exp(-37).
  const std::string text =
      "gravity = [0, 0, -10]\n" + slider_body("lower", "2", "[0, 0, 1]") + slider_body("upper", "2", "[0, 0, 1]") +
      element("spring", "spring-damper", {{"from", "lower"}, {"stiffness", "2000"}, {"damping", "30"}}) +
      element("film", "spring-damper",
              {{"from", "upper"}, {"to", "lower"}, {"direction", "[0, 0, 1]"}, {"damping", "40"}}) +
      element("contact", "stop",
              {{"from", "upper"},
               {"to", "lower"},
               {"direction", "[0, 0, 1]"},
               {"gap", "0"},
               {"side", "below"},
               {"stiffness", "8000"}}) +
      element("shaker", "force",
              {{"from", "lower"},
               {"direction", "[0, 0, 1]"},
               {"harmonics", "[{ amplitude = '1 N', frequency = '4 Hz' }]"}}) +
      "[start]\nrule = 'static'\n" + table("run", {{"method", "exact"}, {"step", "0.000244140625"}, {"end", "10"}}) +
      table("output", {{"step", "0.00390625"},
                       {"signals", "{ x_1 = 'lower.displacement', x_2 = 'upper.displacement', F = 'contact.force' }"}});
  const test::SceneFolder folder;
  const std::string       path     = folder.write("scene.toml", test::quoted(text));
  FrfOptions              options  = options_of({"lower"}, {"x_1", "x_2", "F"}, 4., 8.);
  const auto              response = response_of(path, options);
  ASSERT_EQ(response.frequencies_hz[0], 4.);
  EXPECT_EQ(response.closed_contacts.size(), 1u);
  const SceneRun run(path);
  const double   omega = two_pi * 4.;
  const Complex  force(0., -1.); // 1 N sin(omega t)
  for (std::size_t pair = 0; pair < 3; ++pair)
  {
    const Complex H = amplitude_of(run, response.pairs[pair].to, omega, 64) / force;
    EXPECT_LT(std::abs(H - response.pairs[pair].values[0]), 1e-8 * std::abs(H)) << response.pairs[pair].to;
  }
}

// --- an operating point that the machine leaves by itself

std::vector<std::string> warnings_of_text(const std::string &text, const FrfOptions &options)
{
  const test::SceneFolder folder;
  return scene_response(folder.write("scene.toml", text), options).result.warnings;
}

std::string spring_damper(const std::string &stiffness, const std::string &damping)
{
  return slider_body("slide", "2", "[1, 0, 0]") +
         element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", stiffness}, {"damping", damping}});
}

/// The warnings that speak of stability.
std::vector<std::string> told_of_stability(const std::string &text)
{
  std::vector<std::string> reported;
  for (const std::string &warning : warnings_of_text(text, options_of({"slide"}, {"slide"})))
    if (warning.find("stable") != std::string::npos)
      reported.push_back(warning);
  return reported;
}

/// A force on the slide that is a formula of u and v.
std::string formula_force(const std::string &force)
{
  return element("push", "formula force", {{"from", "slide"}, {"force", force}});
}

TEST(FrequencyResponse, OfAStableMachineSaysNothingOfStability)
{
  EXPECT_THAT(told_of_stability(oscillator), ::testing::IsEmpty());
  EXPECT_THAT(told_of_stability(spring_damper("800", "0")), ::testing::IsEmpty());
  EXPECT_THAT(told_of_stability(spring_damper("800", "7") + formula_force("3 N*s/m * v")), ::testing::IsEmpty());
}

// s^2 - 1.5 s + 400 = 0:  s = 0.75 +- 19.9859 i
TEST(FrequencyResponse, WarnsOfAVibrationThatGrows)
{
  using ::testing::HasSubstr;
  const auto reported = told_of_stability(spring_damper("800", "0") + formula_force("3 N*s/m * v"));
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_THAT(reported[0], HasSubstr("is unstable: a vibration of 3.18"));
  EXPECT_THAT(reported[0], HasSubstr("Hz that grows at 0.75 1/s (damping ratio -0.0375)"));
  EXPECT_THAT(reported[0], HasSubstr("never reached"));
}

// s^2 = 100
TEST(FrequencyResponse, WarnsOfADepartureFromAnUnstablePosition)
{
  const auto reported = told_of_stability(spring_damper("800", "0") + formula_force("1000 N/m * u"));
  ASSERT_EQ(reported.size(), 1u);
  EXPECT_THAT(reported[0], ::testing::HasSubstr("a non-oscillatory mode that grows at 10 1/s"));
}

// --- what cannot be answered is told

TEST(FrequencyResponse, RefusesWhatItCannotAnswer)
{
  const auto refused = [](FrfOptions options) { return refusal([&] { response_of_text(oscillator, options); }); };
  using ::testing::HasSubstr;
  EXPECT_THAT(refused(options_of({"slde"}, {"slide"})), HasSubstr("--from: signal \"slde\""));
  EXPECT_THAT(refused(options_of({"slide"}, {"spring.forc"})), HasSubstr("spring.force"));
  EXPECT_THAT(refused(options_of({"spring.force"}, {"slide"})), HasSubstr("not a displacement or an angle"));
  EXPECT_THAT(refused(options_of({"slide.velocity"}, {"slide"})), HasSubstr("not a displacement or an angle"));
  EXPECT_THAT(refused(options_of({}, {"slide"})), HasSubstr("--from is missing"));
  EXPECT_THAT(refused(options_of({"slide"}, {})), HasSubstr("--to is missing"));
  EXPECT_THAT(refused(options_of({"slide"}, {"slide"}, 20., 10.)), HasSubstr("--lowest is 20 Hz, --highest 10 Hz"));
  EXPECT_THAT(refused(options_of({"slide"}, {"slide"}, -1., 10.)), HasSubstr("above zero"));
  FrfOptions options = options_of({"slide"}, {"slide"});
  options.lowest     = "3 mm";
  EXPECT_THAT(refused(options), HasSubstr("--lowest: "));
  options        = options_of({"slide"}, {"slide"});
  options.points = 1;
  EXPECT_THAT(refused(options), HasSubstr("--points is 1"));
  options    = options_of({"slide"}, {"slide"});
  options.at = "strt";
  EXPECT_THAT(refused(options), HasSubstr("--at is \"strt\""));
}

} // namespace gestell::tests
