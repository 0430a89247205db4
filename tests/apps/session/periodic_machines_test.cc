// Periodic motions of kinds of machines: geared drives come to that to which a run settles, and names of coordinates
// mean their motions; of linear laws alone no method has a nonlinear measure to solve for; under a load that turns with
// its body multipliers of small vibrations are those of the linear machine.

#include "apps/session/session.h"
#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/follower_plate.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// A belt of ratio i as one spring.
std::string spring_of_belt(double i)
{
  return measure("belt", "sum",
                 {{"terms",
                   "[{ of = 'motor', factor = '40 mm' }, { of = 'wheel', factor = '" + number(-0.04 * i) + " m' }]"}}) +
         element("belt", "spring-damper", {{"on", "belt"}, {"stiffness", "50 N/mm"}, {"damping", "200 N s/m"}});
}

/// A motor that drives a wheel by a belt of ratio i, `more` on the wheel.
std::string belt_drive(double i, const std::string &more = "", const std::string &run = "exact",
                       const std::string &belt = "")
{
  return rotor_body("motor", "0.02 kg m^2", "[0, 1, 0]") +
         rotor_body("wheel", "0.4 kg m^2", "[0, 1, 0]", {{"position", "['0.3 m', 0, 0]"}}) +
         (belt.empty() ? spring_of_belt(i) : belt) +
         element("drive", "asynchronous motor",
                 {{"on", "motor"},
                  {"to", "ground"},
                  {"breakdown_torque", "12 N m"},
                  {"breakdown_slip", "20 %"},
                  {"synchronous_speed", "1500 1/min"}}) +
         element("load", "spring-damper", {{"from", "wheel"}, {"about", "[0, 1, 0]"}, {"damping", "0.3 N m s/rad"}}) +
         more +
         test::quoted("[start]\nrule = 'given'\nv = { motor = '1450 1/min', wheel = '" + number(1450. / i) +
                      " 1/min' }\n[run]\nmethod = '" + run +
                      "'\ntolerance = 1e-9\nstep = '1 ms'\nend = '8 s'\n"
                      "[output.signals]\nT = 'drive.torque'\nF = 'belt.force'\nw = 'wheel.speed'\n");
}

const std::string crank = slider_body("slide", "8 kg", "[0, 0, 1]") + element("rod", "connecting rod",
                                                                              {{"from", "wheel"},
                                                                               {"to", "slide"},
                                                                               {"crank_radius", "20 mm"},
                                                                               {"length", "300 mm"},
                                                                               {"stiffness", "2 kN/mm"},
                                                                               {"damping", "3 kN s/m"}});

PeriodicResult by(const std::string &method, const std::string &text)
{
  PeriodicRequest request{method};
  return periodic_of(text, request);
}

double largest_of(const SceneRun &motion, const std::string &name, double from, bool least = false)
{
  const std::size_t column = motion.column(name);
  double            value  = least ? 1e300 : -1e300;
  for (std::size_t i = 0; i < motion.n_rows(); ++i)
    if (motion.at(i, 0) >= from)
      value = least ? std::min(value, motion.at(i, column)) : std::max(value, motion.at(i, column));
  return value;
}

} // namespace

TEST(GearedRotors, RoundOnesHaveTheTorqueToWhichARunSettles)
{
  for (const double i : {3.7, 2.05})
  {
    const test::SceneFolder folder;
    const SceneRun          motion(folder.write("scene.toml", belt_drive(i)));
    for (const std::string method : {"shooting", "harmonic-balance", "settling"})
    {
      const PeriodicResult result = by(method, belt_drive(i));
      ASSERT_EQ(result.entries.size(), 1u) << method << result.failure;
      const PeriodicEntry &entry = result.entries[0];
      EXPECT_TRUE(entry.solution.stable()) << method;
      EXPECT_EQ(entry.solution.verification.failure, "");
      for (std::size_t k = 0; k < 3; ++k) // e^(-t/tau) of the run at its end is 1e-9, tau = 0.35 s at most
      {
        const double value = motion.signal(entry.signals[k].name).final;
        EXPECT_NEAR(entry.signals[k].max, value, 1e-6 * std::abs(value)) << method << ' ' << entry.signals[k].name;
        EXPECT_NEAR(entry.signals[k].min, value, 1e-6 * std::abs(value)) << method << ' ' << entry.signals[k].name;
      }
    }
  }
}

/// Two drives turn each at its own speed, beside a vibration of another frequency: two angles are free.
TEST(GearedRotors, TwoDrivesHaveTwoFreeAnglesInEveryMethodThatFindsIncrements)
{
  const auto drive = [](const std::string &name, double load)
  {
    return rotor_body(name, "0.02 kg m^2", "[0, 1, 0]") +
           element("motor_" + name, "asynchronous motor",
                   {{"on", name},
                    {"to", "ground"},
                    {"breakdown_torque", "12 N m"},
                    {"breakdown_slip", "20 %"},
                    {"synchronous_speed", "1500 1/min"}}) +
           element("load_" + name, "spring-damper",
                   {{"from", name}, {"about", "[0, 1, 0]"}, {"damping", number(load) + " N m s/rad"}});
  };
  const std::string text =
      drive("a", 0.01) + drive("b", 0.03) + slider_body("slide", "1", "[1, 0, 0]") +
      element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1000"}, {"damping", "5"}}) +
      cosine_load("slide", 3., 25.) +
      test::quoted("[start]\nrule = 'given'\nv = { a = '1400 1/min', b = '1300 1/min' }\n"
                   "[output.signals]\nwa = 'a.speed'\nwb = 'b.speed'\nx = 'slide.displacement'\n");
  const PeriodicResult shot = by("shooting", text);
  ASSERT_EQ(shot.entries.size(), 1u) << shot.failure;
  const PeriodicResult collocated = by("collocation", text);
  ASSERT_EQ(collocated.entries.size(), 1u) << collocated.failure;
  EXPECT_EQ(collocated.entries[0].solution.method, "collocation");
  for (const PeriodicResult *result : {&shot, &collocated})
  {
    const PeriodicEntry &entry = result->entries[0];
    EXPECT_TRUE(entry.solution.stable());
    for (const auto &[k, damping] : {std::pair{0, 0.01}, {1, 0.03}}) // 2 M_k s s_k/(s^2 + s_k^2) = d w, s = 1 - w/w_s
    {
      const double w = entry.signals[std::size_t(k)].mean, s = 1. - w / (50. * M_PI);
      EXPECT_NEAR(24. * s * 0.2 / (s * s + 0.04), damping * w, 1e-7 * damping * w) << k;
    }
    const double x = 3. / std::hypot(1000. - 625., 5. * 25.);
    EXPECT_NEAR(entry.signals[2].max, x, 1e-6 * x);
  }
}

TEST(GearedRotors, ACrankBehindABeltHasTheExtremesToWhichARunSettles)
{
  const std::string       text = belt_drive(3.7, crank);
  const test::SceneFolder folder;
  const SceneRun          motion(folder.write("scene.toml", text), {"output.step=0.2 ms"});
  const PeriodicResult    result = by("shooting", text);
  ASSERT_EQ(result.entries.size(), 1u) << result.failure;
  const PeriodicEntry &entry = result.entries[0];
  EXPECT_TRUE(entry.solution.stable());
  for (std::size_t k = 0; k < 3; ++k)
  {
    const apps::SignalOrbit &signal = entry.signals[k];
    const double             size   = signal.max - signal.min; // rows of 0.2 ms miss an extreme by a thousandth of it
    EXPECT_NEAR(signal.max, largest_of(motion, signal.name, 6.), 1e-3 * size) << signal.name;
    EXPECT_NEAR(signal.min, largest_of(motion, signal.name, 6., true), 1e-3 * size) << signal.name;
  }
}

/// Both strands of a tight belt are together the spring; one that becomes slack has a stable steady state as well.
TEST(GearedRotors, ABeltOfTwoStrandsHasTheSteadyStateOfItsSpring)
{
  const auto strands = [](const std::string &pretension)
  {
    return element("belt", "belt",
                   {{"from", "motor"},
                    {"to", "wheel"},
                    {"at_from", "[0, 0, 0]"},
                    {"at_to", "['0.3 m', 0, 0]"},
                    {"axis", "[0, 1, 0]"},
                    {"radius_from", "40 mm"},
                    {"radius_to", "148 mm"},
                    {"stiffness", "25 N/mm"},
                    {"damping", "100 N s/m"},
                    {"pretension", pretension}});
  };
  const auto with_strands = [&](const std::string &pretension)
  {
    const std::string text = belt_drive(3.7, crank, "exact", strands(pretension));
    return test::with(text, "F = \"belt.force\"", "F = \"belt.hub_force\"");
  };
  const PeriodicResult spring = by("shooting", belt_drive(3.7, crank)), belt = by("shooting", with_strands("5 kN")),
                       slack = by("shooting", with_strands("20 N"));
  for (const PeriodicResult *result : {&spring, &belt, &slack})
  {
    ASSERT_EQ(result->entries.size(), 1u) << result->failure;
    EXPECT_TRUE(result->entries[0].solution.stable());
  }
  const PeriodicEntry &a = spring.entries[0], &b = belt.entries[0];
  EXPECT_NEAR(b.solution.period, a.solution.period, 1e-9 * a.solution.period);
  for (const std::size_t k : {0u, 2u})
  {
    const double size = a.signals[k].max - a.signals[k].min;
    EXPECT_NEAR(b.signals[k].max, a.signals[k].max, 1e-6 * size) << a.signals[k].name;
    EXPECT_NEAR(b.signals[k].min, a.signals[k].min, 1e-6 * size) << a.signals[k].name;
  }
}

/// An ideal gear instead of the belt: its joint tells the ratio; the variational equations accompany BDF.
TEST(GearedRotors, AnIdealGearOfAnyRatioIsFoundInItsJoint)
{
  const std::string text =
      rotor_body("motor", "0.02 kg m^2", "[0, 1, 0]") + rotor_body("wheel", "0.4 kg m^2", "[0, 1, 0]") +
      joint("gear", "gear", {{"from", "motor"}, {"to", "wheel"}, {"ratio", "1/3.7"}}) +
      element("drive", "formula force",
              {{"from", "motor"}, {"to", "ground"}, {"about", "[0, 1, 0]"}, {"force", "40 N*m - 0.3 N*m*s/rad*v"}}) +
      element("load", "spring-damper", {{"from", "wheel"}, {"about", "[0, 1, 0]"}, {"damping", "0.3 N m s/rad"}}) +
      test::quoted("[start]\nrule = 'given'\nv = { motor = '130 rad/s' }\n[run]\nmethod = 'bdf'\ntolerance = 1e-8\n"
                   "end = '1 s'\n[output.signals]\nw = 'motor.speed'\n");
  const double w        = 40. / (0.3 + 0.3 / (3.7 * 3.7)),
               of_speed = -0.3 * (1. + 1. / (3.7 * 3.7)) / (0.02 + 0.4 / (3.7 * 3.7));
  for (const std::string method : {"", "settling"})
  {
    const PeriodicResult result = by(method, text);
    ASSERT_EQ(result.entries.size(), 1u) << result.failure;
    const PeriodicEntry &entry = result.entries[0];
    EXPECT_NEAR(std::abs(entry.signals[0].mean), w, 1e-5 * w);
    if (method.empty())
    {
      EXPECT_EQ(entry.solution.method, "shooting");
      EXPECT_NEAR(entry.solution.largest_multiplier(), std::exp(of_speed * entry.solution.period), 1e-3);
    }
  }
}

/// A belt so stiff that it hardly moves: steps of the smooth motion are long, and their own tangents grow on it.
TEST(GearedRotors, AreStableHoweverStiffTheirBelt)
{
  const std::string text =
      rotor_body("motor", "0.02 kg m^2", "[0, 1, 0]") + rotor_body("wheel", "0.4 kg m^2", "[0, 1, 0]") +
      measure("belt", "sum",
              {{"terms", "[{ of = 'motor', factor = '40 mm' }, { of = 'wheel', factor = '-148 mm' }]"}}) +
      element("belt", "spring-damper", {{"on", "belt"}, {"stiffness", "400 kN/mm"}, {"damping", "5 kN s/m"}}) +
      element("drive", "formula force",
              {{"from", "motor"}, {"to", "ground"}, {"about", "[0, 1, 0]"}, {"force", "40 N*m - 0.3 N*m*s/rad*v"}}) +
      element("load", "spring-damper", {{"from", "wheel"}, {"about", "[0, 1, 0]"}, {"damping", "0.3 N m s/rad"}}) +
      test::quoted("[start]\nrule = 'given'\nv = { motor = '130 rad/s', wheel = '35.135 rad/s' }\n"
                   "[run]\nmethod = 'exact'\ntolerance = 1e-9\nend = '1 s'\n"
                   "[output.signals]\nw = 'motor.speed'\n");
  const double of_speed = -0.3 * (1. + 1. / (3.7 * 3.7)) / (0.02 + 0.4 / (3.7 * 3.7));
  for (const std::string method : {"shooting", "collocation"})
  {
    const PeriodicResult result = by(method, text);
    ASSERT_EQ(result.entries.size(), 1u) << method << result.failure;
    const coupling::PeriodicSolution &found = result.entries[0].solution;
    EXPECT_NEAR(found.largest_multiplier(), std::exp(of_speed * found.period), 1e-4) << method;
  }
}

/// A pendulum of three coordinates in its ideal pin, whose force turns with it, and the same of one angle: multipliers
/// by the variational equations beside BDF are those of exact tangents, to the second order of the steps.
TEST(IdealJoints, OfAPendulumHaveTheMultipliersOfItsAngle)
{
  const auto driven = [](const std::string &more, const std::string &run)
  {
    return "gravity = [0, 0, '-10 m/s^2']\n" + more +
           element("drive", "force",
                   {{"from", "bob"},
                    {"to", "ground"},
                    {"about", "[0, 1, 0]"},
                    {"harmonics", "[{ amplitude = '3 N m', frequency = '0.8 Hz' }]"}}) +
           test::quoted("[run]\n" + run + "\nend = '1 s'\n[output.signals]\nM = 'drive.torque'\n");
  };
  const std::string damper =
      element("damper", "spring-damper",
              {{"from", "bob"}, {"to", "ground"}, {"about", "[0, 1, 0]"}, {"damping", "0.2 N m s/rad"}});
  const auto exact = by("shooting", driven(rotor_body("bob", "0.6 kg m^2", "[0, 1, 0]") +
                                               element("weight", "formula force",
                                                       {{"from", "bob"},
                                                        {"to", "ground"},
                                                        {"about", "[0, 1, 0]"},
                                                        {"force", "-10 N*m*sin(u) - 0.2 N*m*s/rad*v"}}),
                                           "method = 'exact'\ntolerance = 1e-10"));
  ASSERT_EQ(exact.entries.size(), 1u) << exact.failure;
  double off[2];
  for (const int k : {0, 1})
  {
    const auto jointed = by("shooting", driven(planar_body("bob", "2 kg", "0.1 kg m^2", "[0, 0, '-0.5 m']") +
                                                   revolute("pin", "bob", "ground", "[0, 0, 0]") + damper,
                                               "method = 'bdf'\nstep = '" + std::to_string(4 >> k) + " ms'"));
    ASSERT_EQ(jointed.entries.size(), 1u) << jointed.failure;
    EXPECT_EQ(jointed.entries[0].solution.method, "shooting");
    const auto &found = jointed.entries[0].solution.multipliers, &right = exact.entries[0].solution.multipliers;
    off[k] = 0.;
    for (const auto &mu : right)
      off[k] = std::max(off[k], (found.array() - mu).abs().minCoeff());
  }
  EXPECT_LT(off[1], 1e-3);
  EXPECT_NEAR(std::log2(off[0] / off[1]), 2., 0.3);
}

/// q of an interface whose row is that of -ux: the values by the names of coordinates are those of signals, and a
/// start.
TEST(NamesOfCoordinates, MeanTheMotionWhereAFrameHasItsOppositeSign)
{
  const std::string text =
      "[frame]\nmass = [[2.0, 0.0], [0.0, 1.0]]\ndamping = [[0.06, -0.02], [-0.02, 0.04]]\n"
      "stiffness = [[3.0, -1.0], [-1.0, 2.0]]\n" +
      table("frame.interface.one", {{"rows", "{ '-ux' = 1 }"}, {"position", "[0, 0, 0]"}}) +
      element("cubic", "cubic spring",
              {{"from", "frame.one"}, {"to", "ground"}, {"direction", "[1, 0, 0]"}, {"cubic", "0.5"}}) +
      cosine_load("frame.one", 0.8, 1.3) + test::quoted("[output.signals]\nx = 'frame.one.ux'\n");
  const PeriodicResult result = by("shooting", text);
  ASSERT_EQ(result.entries.size(), 1u) << result.failure;
  const PeriodicEntry &entry = result.entries[0];
  std::string          q, v;
  for (std::size_t i = 0; i < result.coordinates.size(); ++i)
  {
    const auto &[name, sign] = result.coordinates[i];
    q += (i > 0 ? ", '" : "'") + name + "' = " + number(sign * entry.solution.q[Eigen::Index(i)]);
    v += (i > 0 ? ", '" : "'") + name + "' = " + number(sign * entry.solution.v[Eigen::Index(i)]);
    if (name == "frame.one.ux")
    {
      EXPECT_NEAR(sign * entry.solution.q[Eigen::Index(i)], entry.rows[1], 1e-12);
    }
  }
  // All of them are a start, from which the machine stays on the motion.
  PeriodicRequest here;
  here.method         = "shooting";
  here.own["lead-in"] = 0;
  const PeriodicResult again =
      periodic_of(text + test::quoted("[start]\nrule = 'given'\nq = { " + q + " }\nv = { " + v + " }\n"), here);
  ASSERT_EQ(again.entries.size(), 1u) << again.failure;
  EXPECT_EQ(again.entries[0].solution.work.iterations, 0);
  EXPECT_LT((again.entries[0].solution.q - entry.solution.q).norm(), 1e-12);
}

namespace
{

using apps::PeriodicRequest;

std::string load(const std::string &harmonics)
{
  return element("load", "force",
                 {{"from", "slide"}, {"to", "ground"}, {"direction", "[1, 0, 0]"}, {"harmonics", harmonics}});
}

const std::string five_hertz = "[{ amplitude = '10 N', frequency = '5 Hz' }]";

std::string spring(const std::string &to)
{
  return element("spring", "spring-damper",
                 {{"from", "slide"}, {"to", to}, {"stiffness", "1000"}, {"damping", "1"}, {"direction", "[1, 0, 0]"}});
}

std::string slide()
{
  return slider_body("slide", "1", "[1, 0, 0]");
}

struct Kind
{
  const char *name;
  std::string scene;
};

std::vector<Kind> kinds()
{
  const std::string signal = test::quoted("[output.signals]\nx = 'slide.displacement'\n");
  return {{"held and pushed", slide() + spring("ground") + load(five_hertz) + signal},
          {"held by a spring without a damper",
           slide() + element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1000"}}) + load(five_hertz) +
               signal},
          {"held at rest", slide() + spring("ground") + signal},
          {"free and pushed", slide() + load(five_hertz) + signal},
          {"two, held by each other",
           slide() + slider_body("other", "2", "[1, 0, 0]") + spring("other") + load(five_hertz) + signal}};
}

} // namespace

/// What is held and pushed swings by |F / (c - m w^2 + i w b)| with every method (averaging to the second order of
/// small forces); of the others each method finds a motion, tells where the long run led, or fails in words.
TEST(LinearMotions, AreFoundOrRefusedByEveryMethod)
{
  const double w = 10. * M_PI, amplitude = 10. / std::hypot(1000. - w * w, w);
  for (const Kind &kind : kinds())
    for (const std::string method :
         {"shooting", "collocation", "harmonic-balance", "settling", "minimise", "averaging"})
    {
      SCOPED_TRACE(std::string(kind.name) + ", " + method);
      const test::SceneFolder folder;
      PeriodicRequest         request{method};
      request.period = "0.2 s";
      if (method == "minimise")
        request.own["starts"] = 2;
      const bool is_held  = std::string(kind.name).rfind("held", 0) == 0;
      const auto scene    = folder.write("scene.toml", test::quoted(kind.scene));
      const auto answered = [&](const apps::PeriodicResult &result)
      {
        EXPECT_TRUE(!result.entries.empty() || result.long_run || result.failure.size() > 20u);
        if (std::string(kind.name) != "held and pushed")
          return;
        ASSERT_FALSE(result.entries.empty()) << result.failure;
        EXPECT_NEAR(result.entries[0].signals.at(0).max, amplitude, (method == "averaging" ? 1e-2 : 1e-4) * amplitude);
      };
      try
      {
        answered(periodic_of(Session(scene), request));
      }
      catch (const std::invalid_argument &refusal)
      {
        EXPECT_FALSE(is_held && method != "averaging" && method != "minimise") << refusal.what();
        EXPECT_THAT(refusal.what(), testing::HasSubstr(method == "harmonic-balance" ? "harmonic balance" : method));
      }
    }
}

namespace
{

constexpr double Omega = 7.3;

/// The plate under a load so small that it stays linear: angles of 1e-4 change multipliers by their squares.
PeriodicResult vibrations(const std::string &method, double P)
{
  PeriodicRequest request{method};
  if (method == "shooting" || method == "collocation") // a flutter leaves the motion before
    request.own["lead-in"] = 0;
  return periodic_of(follower_plate(P, 2e-3) + cosine_load("plate", 0.05, Omega) +
                         test::quoted("[start]\nrule = 'static'\n[output.signals]\nx = 'plate.ux'\n"),
                     request);
}

} // namespace

TEST(FollowerOrbits, HaveTheMultipliersOfTheLinearMachine)
{
  for (const double P : {-200., -400.})
    for (const std::string method : {"shooting", "collocation", "harmonic-balance"})
    {
      const PeriodicResult result = vibrations(method, P);
      ASSERT_EQ(result.entries.size(), 1u) << method << result.failure;
      const auto &solution = result.entries[0].solution;
      EXPECT_EQ(solution.stable(), P > -300.) << method;
      for (const std::complex<double> &s : plate_roots(P, 2e-3))
      {
        const std::complex<double> expected = std::exp(s * 2. * M_PI / Omega);
        double                     nearest  = 1e9;
        for (const std::complex<double> &mu : solution.multipliers)
          nearest = std::min(nearest, std::abs(mu - expected));
        EXPECT_LT(nearest, 1e-6 * std::max(1., std::abs(expected))) << method << ' ' << P << ' ' << expected;
      }
    }
}

TEST(FollowerOrbits, AreNotAveraged)
{
  expect_refusal([] { vibrations("averaging", -200.); }, "follower forces");
}

} // namespace gestell::tests
