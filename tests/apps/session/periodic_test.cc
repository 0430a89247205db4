// Periodic motions of scenes: against the reference, other methods, and what must hold of any of them.

#include "tests/apps/session/periodic_scenes.h"
#include "tests/support/reference_table.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

/// x'' + 2 zeta x' + g(x) = F0 + F cos(Omega t), g with a dead zone of half width 1 and unit slope.
std::string play(double zeta, double F0, double F, double Omega)
{
  return slider_body("slide", "1", "[1, 0, 0]") +
         element("damper", "spring-damper", {{"from", "slide"}, {"damping", number(2. * zeta)}}) +
         element("play", "clearance", {{"from", "slide"}, {"stiffness", "1"}, {"gap", "1"}}) +
         cosine_load("slide", F, Omega, F0) + test::quoted(output_x);
}

/// The first signal at a share of the period, by the cubic through the four rows about it.
double signal_at(const PeriodicEntry &entry, double share)
{
  const int    rows = 512, first = int(rows * share) - 1;
  const double sigma = rows * share - first;
  double       value = 0.;
  for (int a = 0; a < 4; ++a)
  {
    double weight = 1.;
    for (int b = 0; b < 4; ++b)
      if (b != a)
        weight *= (sigma - b) / (a - b);
    value += weight * entry.rows[std::size_t((first + a + rows) % rows) * (entry.signals.size() + 1) + 1];
  }
  return value;
}

/// The entry whose start, or whose place at the begin of a later period of the load, is nearest to x, v of the slide.
double nearest(const PeriodicResult &result, int ratio, double x, double v, const PeriodicEntry **found)
{
  double least = 1e300;
  for (const PeriodicEntry &entry : result.entries)
    if (entry.solution.ratio == ratio)
      for (int k = 0; k < ratio; ++k)
      {
        const double apart = k == 0 ? std::hypot(entry.solution.q[0] - x, entry.solution.v[0] - v)
                                    : std::abs(signal_at(entry, double(k) / ratio) - x);
        if (apart < least)
        {
          least  = apart;
          *found = &entry;
        }
      }
  return least;
}

} // namespace

/// The three coexisting motions of Duffing's oscillator, with the harmonics of the reference.
TEST(PeriodicScene, ThreeSolutionsOfDuffingsOscillatorAreFoundWithoutHints)
{
  const PeriodicResult result = periodic_of(duffing(0.05, 0.5, 0.3, 1.4));

  EXPECT_EQ(result.method, "minimise");
  int rows = 0;
  for (const ReferenceRow &row : read_reference("periodic/duffing_shooting.csv"))
    if (row["case"] == "duffing1")
    {
      const PeriodicEntry *entry = nullptr;
      EXPECT_LT(nearest(result, 1, row.number("x(0)"), row.number("v(0)"), &entry), 1e-9);
      ASSERT_NE(entry, nullptr);
      EXPECT_NEAR(entry->signals[0].max, row.number("max|x|"), 1e-9);
      EXPECT_NEAR(entry->signals[0].amplitude[0], row.number("harmonic1"), 1e-9);
      EXPECT_NEAR(entry->signals[0].amplitude[2], row.number("harmonic3"), 1e-9);
      EXPECT_EQ(entry->solution.stable(), row["stability"] == "stable");
      ++rows;
    }
  EXPECT_EQ(rows, 3);
}

/// Events cut the orbit: multipliers are right only with the derivative of their times.
TEST(PeriodicScene, MotionsWithPlayAndTheirSubharmonicsMeetTheReference)
{
  const double zeta[] = {0.05, 0.05, 0.05, 0.1}, F0[] = {0.3, 0.3, 0.1, 0.3}, F[] = {1., 0.5, 2., 1.},
               Omega[] = {0.7, 1.8, 1.8, 1.8};
  PeriodicRequest request{"minimise"};
  request.own["starts"] = 40;
  for (int i = 0; i < 4; ++i)
  {
    const PeriodicResult result = periodic_of(play(zeta[i], F0[i], F[i], Omega[i]), request);
    for (const ReferenceRow &row : read_reference("periodic/clearance_periodic.csv"))
      if (row["case"] == "clearance" + std::to_string(i + 1))
      {
        const int            ratio = int(row.number("period_in_forcing_periods"));
        const PeriodicEntry *entry = nullptr;
        // A third of 512 rows lies between two of them: the cubic errs by h^4 |x''''| 3/128, h = T/512 = 0.02 s, and at
        // most by h^3/16 times the jumps of x''' at the contacts, of order one.
        EXPECT_LT(nearest(result, ratio, row.number("x(0)"), row.number("v(0)"), &entry), ratio == 3 ? 1e-6 : 1e-9)
            << row["case"] << " ratio " << ratio;
        ASSERT_NE(entry, nullptr);
        EXPECT_NEAR(std::abs(entry->solution.multipliers[0]), row.number("|mu1|"), 1e-8) << row["case"];
        EXPECT_NEAR(std::abs(entry->solution.multipliers[1]), row.number("|mu2|"), 1e-8) << row["case"];
      }
  }
}

/// Folds of the one-harmonic equations are those of the closed formula, six digits in the table.
TEST(PeriodicScene, BranchesTurnWhereTheReferenceSays)
{
  PeriodicRequest request{"harmonic-balance"};
  request.own["harmonics"]    = 1;
  request.along               = "parameters.Omega";
  request.from                = "1.0";
  request.to                  = "1.7";
  std::string       text      = duffing(0.05, 0.5, 0.3, 1.);
  const std::string frequency = number(1. / (2. * M_PI)) + " Hz";
  text.replace(text.find(frequency), frequency.size(), "Omega/(2*pi) * 1 Hz");
  const PeriodicResult result = periodic_of("[parameters]\nOmega = 1.0\n" + text, request);
  std::vector<double>  folds;
  for (const apps::SpecialPoint &point : result.special_points)
    if (point.kind == "fold")
    {
      folds.push_back(point.parameter);
      // Where the branch turns, neighbours of the nearest point lie on the same side of the fold.
      const auto at = [&](int i) { return result.entries.at(std::size_t(i)).parameter - point.parameter; };
      const int  k  = point.solution - 1;
      EXPECT_GT(at(k - 1) * at(k + 1), 0.);
      EXPECT_GT(at(k - 2) * at(k + 2), 0.);
    }
  ASSERT_EQ(folds.size(), 2u) << result.failure;
  EXPECT_NEAR(folds[0], 1.551342, 1e-6);
  EXPECT_NEAR(folds[1], 1.261164, 1e-6);
}

/// A press with motor, play and a sheet for every stroke: the period that shooting finds is that to which it settles.
TEST(PeriodicScene, ThePressCompletesARevolutionInThePeriodToWhichItSettles)
{
  const auto shot    = periodic_of(Session(press_minimal));
  const auto settled = periodic_of(Session(press_minimal), {"settling"});
  ASSERT_EQ(shot.entries.size(), 1u) << shot.failure;
  ASSERT_EQ(settled.entries.size(), 1u) << settled.failure;
  EXPECT_NEAR(shot.entries[0].solution.period, settled.entries[0].solution.period,
              1e-9 * settled.entries[0].solution.period);
  EXPECT_TRUE(shot.entries[0].solution.stable());
}

TEST(PeriodicScene, ARunThatStartsOnTheOrbitRepeatsAtOnce)
{
  const double       T = periodic_of(Session(press_minimal)).entries.at(0).solution.period;
  const apps::Result run =
      Session(press_minimal, {"start.rule=periodic", "run.method=exact", "run.order=6", "run.tolerance=1e-8",
                              "run.step=1 ms", "run.end=" + number(T) + " s", "output.step=" + number(T) + " s"})
          .run();
  const coupling::RunResult &history = *run.run;
  ASSERT_EQ(history.failure, "");
  const std::size_t width = history.columns.size(), last = history.rows.size() - width;
  for (std::size_t j = 1; j + 3 < width; ++j)
    if (history.columns[j] == "x3" || history.columns[j] == "x1")
    {
      EXPECT_NEAR(history.rows[last + j], history.rows[j], 1e-6 * std::abs(history.rows[j])) << history.columns[j];
    }
}

/// Asked for a motion of two periods, or for twice the period, one of one period is told as such.
TEST(PeriodicScene, AMotionIsReportedByItsOwnPeriod)
{
  PeriodicRequest twice, longer;
  twice.method = longer.method = "shooting";
  twice.ratio                  = 2;
  longer.period                = number(4. * M_PI / 1.4) + " s";
  for (const PeriodicRequest &request : {twice, longer})
  {
    const PeriodicResult result = periodic_of(duffing(0.05, 0.5, 0.3, 1.4), request);
    ASSERT_EQ(result.entries.size(), 1u) << result.failure;
    EXPECT_EQ(result.entries[0].solution.ratio, 1);
    EXPECT_NEAR(result.entries[0].solution.period, 2. * M_PI / 1.4, 1e-12);
  }
  longer.period = "3 s";
  EXPECT_THAT(refusal([&] { periodic_of(duffing(0.05, 0.5, 0.3, 1.4), longer); }), testing::HasSubstr("do not repeat"));
}

TEST(PeriodicScene, RefusesWhatHasNoPeriodWithTheWayOut)
{
  const std::string slide = slider_body("slide", "1", "[1, 0, 0]") +
                            element("spring", "spring-damper", {{"from", "slide"}, {"stiffness", "1"}});
  const auto words = [&](const std::string &text, const PeriodicRequest &request = {})
  { return refusal([&] { periodic_of(text, request); }); };

  EXPECT_THAT(words(slide), testing::HasSubstr("--period"));
  const std::string two = slide + cosine_load("slide", 1., 1.) +
                          element("other", "force",
                                  {{"from", "slide"},
                                   {"to", "ground"},
                                   {"direction", "[1, 0, 0]"},
                                   {"harmonics", "[{ amplitude = '1 N', frequency = '0.2250790790392765 Hz' }]"}});
  EXPECT_THAT(words(two), testing::HasSubstr("no common period"));
  EXPECT_THAT(words(two), testing::HasSubstr("0.22507908 Hz"));
  const std::string course =
      slide + element("course", "formula force", {{"from", "slide"}, {"force", "sin(3*t / (1 s)) * 1 N"}});
  EXPECT_THAT(words(course), testing::AllOf(testing::HasSubstr("'course'"), testing::HasSubstr("--period")));
  PeriodicRequest wrong;
  wrong.period = "2 s";
  EXPECT_THAT(words(course, wrong), testing::HasSubstr("does not repeat"));
  wrong.period = "-2 s";
  EXPECT_THAT(words(course, wrong), testing::HasSubstr("must be a positive time"));
  PeriodicRequest along;
  along.along = "parameters.x";
  along.from  = "1 m";
  along.to    = "2 s";
  EXPECT_THAT(words(test::quoted("gravity = [0, 0, 'x/(1 s^2)']\n[parameters]\nx = '1 m'\n") + slide +
                        cosine_load("slide", 1., 2.),
                    along),
              testing::HasSubstr("the same unit"));
  along.along = "parameters.y";
  EXPECT_THAT(words(test::quoted("[parameters]\nx = '1 m'\n") + slide + cosine_load("slide", 1., 2.), along),
              testing::HasSubstr("no parameter 'y'"));
}

/// Duffing's oscillator whose load has the frequency that a formula of the parameter n gives [rad/s].
std::string duffing_along(const std::string &Omega, const std::string &n)
{
  std::string       text = duffing(0.05, 0.5, 0.3, 1.);
  const std::string own  = number(1. / (2. * M_PI)) + " Hz";
  text.replace(text.find(own), own.size(), "(" + Omega + ")/(2*pi) * 1 Hz");
  return "[parameters]\nn = " + n + "\n" + text;
}

TEST(PeriodicScene, ABranchToTheFrequencyZeroOfTheLoadIsRefusedPlainly)
{
  PeriodicRequest along;
  along.along = "parameters.n";
  along.from  = "1.5";
  for (const std::string to : {"0", "-0.7"})
  {
    along.to                = to;
    const std::string words = refusal([&] { periodic_of(duffing_along("n", "1.5"), along); });
    EXPECT_THAT(words, testing::HasSubstr("--to " + to + ": the period becomes infinite at parameters.n = 0,"));
  }
}

TEST(PeriodicScene, ABranchEndsWhereThePeriodBecomesInfinite)
{
  PeriodicRequest along;
  along.along                 = "parameters.n";
  along.from                  = "1.5";
  along.to                    = "-1.5";
  along.points                = 10;
  const PeriodicResult result = periodic_of(duffing_along("n^2 - 0.25", "1.5"), along);
  EXPECT_THAT(result.failure, testing::HasSubstr("the period becomes infinite at parameters.n = 0.5"));
}

/// x'' + 0.1 x' + x = n cos(2 t) answers with n/sqrt(3^2 + 0.2^2).
TEST(PeriodicScene, ABranchBeginsAtRestWhereTheLoadIsZero)
{
  PeriodicRequest along;
  along.along      = "parameters.n";
  along.from       = "0";
  along.to         = "0.3";
  along.points     = 10;
  std::string text = duffing(0.05, 0., 0.3, 2.);
  text.replace(text.find("0.29999999999999999 N"), 21, "n * 1 N");
  const PeriodicResult result = periodic_of("[parameters]\nn = 0\n" + text, along);
  EXPECT_EQ(result.failure, "");
  ASSERT_GT(result.entries.size(), 5u);
  EXPECT_EQ(result.entries.front().parameter, 0.);
  EXPECT_EQ(result.entries.front().solution.residual, 0.);
  EXPECT_EQ(result.entries.back().parameter, 0.3);
  const auto  &end = result.entries.back().solution;
  const double x   = std::hypot(end.q[0], end.v[0] / 2.);
  EXPECT_NEAR(x, 0.3 / std::hypot(3., 0.2), 1e-8);
}

TEST(PeriodicScene, EntriesThatDoNotChangeTheMotionAreNotAParameterOfABranch)
{
  PeriodicRequest along;
  along.from = "1";
  along.to   = "2";
  for (const std::string key : {"run.step", "run.tolerance", "run.end", "output.rows", "reduction.modes",
                                "start.q.slide", "modes.number", "\"run\".end", "description"})
  {
    along.along             = key;
    const std::string words = refusal([&] { periodic_of(duffing(0.05, 0.5, 0.3, 1.4), along); });
    EXPECT_THAT(words, testing::HasSubstr("--along " + key));
    EXPECT_THAT(words, testing::HasSubstr("does not change the equations of motion"));
    EXPECT_THAT(words, testing::HasSubstr("parameters.NAME"));
  }
}

} // namespace gestell::tests
