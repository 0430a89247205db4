// Natural frequencies along a coordinate against closed forms.

#include "apps/analysis/along/modes_along.h"
#include "coupling/machine/configuration/loop_closure.h"
#include "fem/values/two_pi.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::AlongResult;
using apps::ModesOptions;

AlongResult along(const apps::Scene &scene, const ModesOptions &options)
{
  apps::PreparedMachine prepared = apps::prepare_machine(scene);
  return apps::modes_along_result(scene, prepared, options);
}

AlongResult along(const std::string &text, const ModesOptions &options)
{
  return along(test::scene_of(text), options);
}

apps::Scene press(const std::vector<std::string> &overrides = {})
{
  return apps::read_scene(std::string(GESTELL_SOURCE_DIR) + "/apps/scenes/press_minimal.toml", overrides);
}

ModesOptions of(const std::string &coordinate, int positions = 73, const std::string &from = "",
                const std::string &to = "")
{
  ModesOptions options;
  options.along     = coordinate;
  options.positions = positions;
  options.from      = from;
  options.to        = to;
  return options;
}

std::string complaint(const std::string &text, const ModesOptions &options)
{
  return refusal([&] { along(text, options); });
}

void expect_words(const std::string &said, const std::string &words)
{
  EXPECT_NE(said.find(words), std::string::npos) << "said: " << said << "\nnot: " << words;
}

// Crank J on a torsional spring c, ideal rod without mass, slide m.
constexpr double r = 0.1, l = 0.4, J = 2., m = 200., c = 8000.;

const std::string slider_crank =
    rotor_body("crank", "2", "[0, -1, 0]") + slider_body("slide", "200", "[1, 0, 0]", {{"position", "[0.5, 0, 0]"}}) +
    joint("rod", "distance",
          {{"from", "crank"}, {"at_from", "[0.1, 0, 0]"}, {"to", "slide"}, {"at_to", "[0.5, 0, 0]"}}) +
    element("drive", "spring-damper", {{"from", "crank"}, {"stiffness", "8000"}, {"damping", "20"}});

/// dx/dphi of x = r cos phi + sqrt(l^2 - r^2 sin^2 phi)
double transmission(double phi)
{
  const double s = r * std::sin(phi);
  return -s - s * r * std::cos(phi) / std::sqrt(l * l - s * s);
}

double reduced_inertia(double phi)
{
  return J + m * std::pow(transmission(phi), 2);
}

/// Beside the slider-crank an oscillator of 8.5 Hz, which the crank's passes on its way between 10.1 and 7 Hz.
std::string with_oscillator(double coupling)
{
  std::string text = slider_crank + slider_body("other", "1", "[1, 0, 0]") +
                     element("spring", "spring-damper", {{"from", "other"}, {"stiffness", "2852.3"}});
  if (coupling > 0.)
    text += "[element.coupling]\ntype = \"spring-damper\"\nfrom = \"slide\"\nto = \"other\"\nstiffness = " +
            std::to_string(coupling) + "\n";
  return text;
}

// A load m on a rope of 2 m from a trolley.
const std::string load_on_rope = "gravity = [0, 0, -9.81]\n" +
                                 slider_body("trolley", "50", "[1, 0, 0]", {{"position", "[0, 0, 5]"}}) +
                                 point_body("load", "20", "[0, 0, 3]");
const std::string ideal_rope = "[joint.rope]\ntype = \"distance\"\nfrom = \"trolley\"\nto = \"load\"\n";
// The rope stretches by 20 g / 9810 = 0.02 m; without load it is 2 m long.
const std::string elastic_rope =
    measure("rope", "distance", {{"from", "trolley"}, {"to", "load"}}) +
    element("spring", "spring-damper", {{"on", "rope"}, {"stiffness", "9810"}, {"rest", "2"}});

} // namespace

// m(phi) = J + m x'^2: a torsional spring at the crank gives f = sqrt(c / m(phi)) / 2 pi, dead centres included, where
// joints held by the crank's angle alone would be singular.
TEST(ModesAlong, SliderCrankOnATorsionalSpringHasItsReducedMass)
{
  const AlongResult result = along(slider_crank, of("crank"));
  ASSERT_EQ(result.modes.positions.size(), 73u);
  for (const auto &at : result.modes.positions)
  {
    ASSERT_EQ(at.gap, "");
    EXPECT_EQ(at.configuration, coupling::Configuration::equilibrium);
    ASSERT_EQ(at.modes.size(), 1u);
    const double M = reduced_inertia(at.x), omega = std::sqrt(c / M), zeta = 20. / (2. * M * omega);
    EXPECT_NEAR(at.modes[0].frequency_hz, omega / two_pi, 1e-9);
    EXPECT_NEAR(at.modes[0].damping_ratio, zeta, 1e-9);
    EXPECT_NEAR(at.modes[0].damped_frequency_hz, omega * std::sqrt(1. - zeta * zeta) / two_pi, 1e-9);
  }
  for (int k = 0; k < 37; ++k) // dead centres at positions 0, 36 and 72
    EXPECT_NEAR(result.modes.positions[36 - k].modes[0].frequency_hz,
                result.modes.positions[36 + k].modes[0].frequency_hz, 1e-9);
}

TEST(ModesAlong, ADrivenCrankHeldLeavesTheElasticRod)
{
  const std::string elastic =
      slider_crank.substr(0, slider_crank.find("[joint.rod]")) +
      measure("span", "distance",
              {{"from", "crank"}, {"at_from", "[0.1, 0, 0]"}, {"to", "slide"}, {"at_to", "[0.5, 0, 0]"}}) +
      element("rod", "spring-damper", {{"on", "span"}, {"stiffness", "1e7"}, {"rest", "0.4"}});
  ModesOptions options = of("crank.angle", 25);
  options.hold         = {"crank"};
  for (const auto &at : along(elastic, options).modes.positions)
  {
    ASSERT_EQ(at.modes.size(), 1u);
    const double sine = r * std::sin(at.x) / l; // of the rod against the slide's way
    EXPECT_NEAR(at.modes[0].frequency_hz, std::sqrt(1e7 / m * (1. - sine * sine)) / two_pi, 1e-7);
  }
}

TEST(ModesAlong, LinesOfUncoupledOscillatorsCross)
{
  const AlongResult result = along(with_oscillator(0.), of("crank"));
  const int         other  = result.modes.positions[0].modes[0].shape[2] != 0. ? 0 : 1; // crank, slide, other
  int               above = 0, below = 0;
  for (const auto &at : result.modes.positions)
  {
    ASSERT_EQ(at.modes.size(), 2u);
    EXPECT_NEAR(at.modes[other].frequency_hz, std::sqrt(2852.3) / two_pi, 1e-9);
    EXPECT_NEAR(at.modes[1 - other].frequency_hz, std::sqrt(c / reduced_inertia(at.x)) / two_pi, 1e-9);
    ++(at.modes[1 - other].frequency_hz > at.modes[other].frequency_hz ? above : below);
  }
  EXPECT_GT(above, 10);
  EXPECT_GT(below, 10);
}

// Shapes turn within 1/20 of a step.
TEST(ModesAlong, LinesOfWeaklyCoupledOscillatorsVeerAway)
{
  const AlongResult result = along(with_oscillator(100.), of("crank"));
  for (const auto &at : result.modes.positions)
  {
    ASSERT_EQ(at.modes.size(), 2u);
    EXPECT_LT(at.modes[0].frequency_hz, at.modes[1].frequency_hz);
  }
  EXPECT_GT(result.modes.linearisations, 73 + 4 * 4); // four veerings, refined
}

TEST(ModesAlong, ALoadSwingsByItsGeometricStiffness)
{
  for (const bool elastic : {false, true})
  {
    const double length       = elastic ? 2.02 : 2.;
    ModesOptions options      = of("trolley", 3, "0 m", "1 m");
    options.hold              = {"trolley"};
    const AlongResult with    = along(load_on_rope + (elastic ? elastic_rope : ideal_rope), options);
    options.geometric         = coupling::GeometricStiffness::left_out;
    const AlongResult without = along(load_on_rope + (elastic ? elastic_rope : ideal_rope), options);
    for (int k = 0; k < 3; ++k)
      for (int j = 0; j < 2; ++j) // in the plane and out of it
      {
        EXPECT_NEAR(with.modes.positions[k].modes[j].frequency_hz, std::sqrt(9.81 / length) / two_pi, 1e-9);
        EXPECT_EQ(without.modes.positions[k].modes[j].frequency_hz, 0.) << elastic;
      }
    EXPECT_TRUE(without.modes.free[0]);
    EXPECT_FALSE(with.modes.free[0]);
  }
}

// The trolley moves too: the load swings against it in the plane, and both drive away together.
TEST(ModesAlong, AFreeDriveIsAFreeMotionAndIsNamed)
{
  const AlongResult result = along(load_on_rope + ideal_rope, of("trolley", 3, "0 m", "1 m"));
  const auto       &modes  = result.modes.positions[1].modes;
  ASSERT_EQ(modes.size(), 3u);
  EXPECT_EQ(modes[0].frequency_hz, 0.);
  EXPECT_TRUE(result.modes.free[0]);
  EXPECT_EQ(result.modes.moves_most[0], "trolley");
  EXPECT_NEAR(modes[1].frequency_hz, std::sqrt(9.81 / 2.) / two_pi, 1e-9);
  EXPECT_NEAR(modes[2].frequency_hz, std::sqrt(9.81 / 2. * (1. + 20. / 50.)) / two_pi, 1e-9);
}

// A cylinder's length takes the place of what its law prescribes: the rope gets longer.
TEST(ModesAlong, ADrivenLengthIsACoordinate)
{
  ModesOptions options     = of("rope", 4, "1 m", "4 m");
  options.hold             = {"trolley"};
  const AlongResult result = along(load_on_rope + ideal_rope + "motion = { speed = \"0.1 m/s\" }\n", options);
  for (const auto &at : result.modes.positions)
    EXPECT_NEAR(at.modes[0].frequency_hz, std::sqrt(9.81 / at.x) / two_pi, 1e-9) << at.x;
  EXPECT_EQ(result.modes.positions.back().x, 4.);
}

// Beyond the reach of the crank's circle there is no position; the others are computed.
TEST(ModesAlong, PositionsThatCannotBeAssembledAreGaps)
{
  const AlongResult result =
      along(slider_crank + "[start]\nq = { crank = \"70 deg\" }\n", of("slide", 5, "-0.15 m", "0.03 m"));
  for (const auto &at : result.modes.positions)
    EXPECT_EQ(at.gap.empty(), at.x < 0.01) << at.x << " " << at.gap;
  const auto warnings = apps::along_warnings(result);
  ASSERT_FALSE(warnings.empty());
  expect_words(warnings[0], "1 of 5 positions are omitted");
}

// f / f_0 = k at omega = 2 pi k f_0; orders of 8.5 Hz/4 meet the constant line in all positions, the other one where
// sqrt(c / m(phi)) does.
TEST(ModesAlong, OrdersOfTheSpeedAreFoundWhereTheyMeetALine)
{
  ModesOptions options       = of("crank");
  options.speed              = "127.5 1/min"; // 2.125 Hz
  options.orders             = 4;
  options.band               = "0.1 %";
  const AlongResult result   = along(with_oscillator(0.), options);
  int               meetings = 0, constant = 0;
  for (const auto &meeting : result.meetings)
  {
    EXPECT_EQ(meeting.order, 4);
    EXPECT_NEAR(meeting.frequency_hz, 8.5, 0.0085);
    if (meeting.end - meeting.begin > 6.)
      ++constant;
    else
    {
      ++meetings;
      // the chord over 5 degrees is off by at most f'' h^2 / 8, here 0.02 Hz
      EXPECT_NEAR(std::sqrt(c / reduced_inertia(meeting.x)) / two_pi, 8.5, 0.03);
    }
  }
  EXPECT_EQ(constant, 1);
  EXPECT_EQ(meetings, 4);
}

// Play closed by 1 mm: engaged and geometric stiffness together are the tangent, which comes from dual numbers.
TEST(ModesAlong, StiffnessOfACompressedRodIsItsWholeTangent)
{
  coupling::Machine machine = apps::build_machine(press());
  Eigen::VectorXd   q = Eigen::VectorXd::Zero(machine.size()), zero = q;
  q[machine.model().coordinate("crank")] = 1.; // far above the sheet
  coupling::close_chains(machine, q);
  q[machine.model().coordinate("slide")] -= 1e-3;
  coupling::LocalState local;
  local.resize(machine);
  machine.gather(0., q, zero, zero, local);
  machine.events().start(local);
  const auto     &W  = machine.forces().directions();
  Eigen::MatrixXd dp = Eigen::MatrixXd::Zero(W.cols(), W.cols()), K, D;
  machine.forces().tangent(local, 1., 0., 0., local.p, dp);
  coupling::engaged_matrices(machine, q, {}, K, D);
  const Eigen::MatrixXd whole = -(W * dp * W.transpose()), geometric = coupling::geometric_stiffness(machine, local);
  EXPECT_GT(geometric.norm(), 1e-5 * whole.norm()); // F r = 900 kN 0.08 m
  EXPECT_LT((K + geometric - whole).norm(), 1e-13 * whole.norm());
}

// The press of the reference 20 degrees before its lower dead centre, where the rod is stiff in either way of
// reckoning.
TEST(ModesAlong, WithoutGeometricStiffnessThePressHasTheFrequenciesOfItsReference)
{
  ModesOptions options     = of("crank", 3, "140 deg", "180 deg");
  options.geometric        = coupling::GeometricStiffness::left_out;
  const AlongResult result = along(press(), options);
  const auto       &modes  = result.modes.positions[1].modes;
  EXPECT_EQ(result.modes.positions[1].configuration, coupling::Configuration::equilibrium);
  const double expected[] = {11.58486756566711, 19.964060481812542, 84.67576532126137, 132.75797317903064};
  ASSERT_EQ(modes.size(), 5u); // the first is the drive's turning, held by weights alone
  for (int j = 1; j < 5; ++j)
    EXPECT_NEAR(modes[j].frequency_hz, expected[j - 1], 1e-9 * expected[j - 1]); // tests/reference/press/modes.csv
  EXPECT_NEAR(result.speed, M_PI, 1e-12);                                        // that of the start: 30 1/min
}

// The punch would stand in the sheet here and push at the rod.
TEST(ModesAlong, TechnologicalForcesRest)
{
  const ModesOptions options = of("crank", 3, "160 deg", "180 deg");
  const AlongResult  strong  = along(press(), options),
                    weak     = along(press({"element.sheet.shear_resistance=\"100 MPa\""}), options);
  for (int k = 0; k < 3; ++k)
    for (int j = 0; j < 5; ++j)
      EXPECT_EQ(strong.modes.positions[k].modes[j].frequency_hz, weak.modes.positions[k].modes[j].frequency_hz);
}

// Nothing holds the load: it would fall out of every equilibrium.
TEST(ModesAlong, WithoutEquilibriumThePositionIsUndeformedAndThisIsReported)
{
  const AlongResult result = along(load_on_rope, of("trolley", 3, "0 m", "1 m"));
  for (const auto &at : result.modes.positions)
  {
    EXPECT_EQ(at.gap, "");
    EXPECT_EQ(at.configuration, coupling::Configuration::undeformed);
  }
  expect_words(apps::along_warnings(result).front(), "3 positions are linearised in the undeformed configuration");
  expect_words(apps::along_warnings(result).front(), "load.uz");
}

TEST(ModesAlong, BadInputIsReported)
{
  expect_words(complaint(slider_crank, of("cranc")), "did you mean 'crank'");
  expect_words(complaint(slider_crank, of("crank", 1)), "--positions is 1");
  expect_words(complaint(slider_crank, of("slide")), "--from");
  expect_words(complaint(slider_crank, of("crank", 5, "10 deg", "10 deg")), "must differ");
  expect_words(complaint(slider_crank, of("crank", 5, "10 mm", "20 deg")), "--from: ");
  ModesOptions options = of("crank");
  options.speed        = "30 Hz";
  expect_words(complaint(slider_crank, options), "--speed: ");
  options      = of("crank");
  options.hold = {"rod"};
  expect_words(complaint(slider_crank, options), "no coordinate \"rod\"");
  options      = of("crank");
  options.band = "200 %";
  expect_words(complaint(slider_crank, options), "--band");
  options      = of("crank");
  options.hold = {"crank"};
  expect_words(complaint(slider_crank, options), "leave no DOF");
}

} // namespace gestell::tests
