// Modal superposition (5.5.3/8 to 13) of a chain of masses, held at one end and driven at the other.

#include "apps/analysis/periodic/periodic_motions.h"
#include "apps/scene/build/build_machine.h"
#include "apps/session/session.h"
#include "coupling/modes/superposition.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_parts.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;
using ::testing::Contains;
using ::testing::HasSubstr;

/// n masses and n springs, 1 kg and `stiffness` together; damping in proportion to the stiffness.
struct Chain
{
  int    n         = 30;
  double stiffness = 2e5;  ///< [N/m] of the whole
  double damping   = 4e-5; ///< [s] times stiffness

  double spring() const { return stiffness * n; }
  double mass() const { return 1. / n; }
  /// omega_j of (C - omega^2 M), j = 0, 1, ...: the closed solution with one end held and the other free.
  double omega(int j) const
  {
    return 2. * std::sqrt(spring() / mass()) * std::sin((2. * j + 1.) * M_PI / (4. * n + 2.));
  }

  /// A matrix with w on the diagonal and -1 beside it, the last element 1, times factor; else the identity.
  std::string file(bool stiff, double factor) const
  {
    std::string text = "%%MatrixMarket matrix coordinate real symmetric\n" + std::to_string(n) + ' ' +
                       std::to_string(n) + ' ' + std::to_string(stiff ? 2 * n - 1 : n) + '\n';
    for (int i = 1; i <= n; ++i)
      text += std::to_string(i) + ' ' + std::to_string(i) + ' ' + number(factor * (stiff && i < n ? 2. : 1.)) + '\n';
    for (int i = 2; stiff && i <= n; ++i)
      text += std::to_string(i) + ' ' + std::to_string(i - 1) + ' ' + number(-factor) + '\n';
    return text;
  }
};

struct ChainScene
{
  explicit ChainScene(const Chain &chain = {})
  {
    folder.write("m.mtx", chain.file(false, chain.mass()));
    folder.write("c.mtx", chain.file(true, chain.spring()));
    folder.write("b.mtx", chain.file(true, chain.damping * chain.spring()));
    tip = chain.n;
  }

  std::string path(const std::string &reduction, const std::string &more,
                   const std::string &run = "method = 'exact'\ntolerance = 1e-11\nend = 0.1\n") const
  {
    return folder.write("chain.toml",
                        test::quoted("name = 'chain'\n[frame]\nmass = 'm.mtx'\nstiffness = 'c.mtx'\ndamping = 'b.mtx'\n"
                                     "[frame.interface.tip]\nrows = { ux = " +
                                     std::to_string(tip) + " }\n[reduction]\n" + reduction + '\n' + more +
                                     "[output.signals]\nx = 'frame.tip.ux'\nv = 'frame.tip.ux_rate'\n[run]\n" + run));
  }

  test::SceneFolder folder;
  int               tip;
};

const std::string load = "[element.load]\ntype = 'force'\nfrom = 'frame.tip'\nto = 'ground'\ndirection = [1, 0, 0]\n"
                         "constant = '30 N'\nharmonics = [{ amplitude = '40 N', frequency = '110 Hz' }]\n";
const std::string stop = "[element.stop]\ntype = 'stop'\nfrom = 'frame.tip'\nto = 'ground'\ndirection = [1, 0, 0]\n"
                         "gap = '0.1 mm'\nstiffness = 4e5\n";

struct Answer
{
  explicit Answer(const std::string &path) : result(Session(path).run()) {}

  const coupling::SignalSummary &operator[](std::size_t i) const { return result.run->signals.at(i); }

  Result result;
};

coupling::Superposition of_scene(const std::string &path)
{
  const Scene scene = read_scene(path);
  auto        machine =
      frame_path(scene) == FramePath::sparse ? build_machine(scene, scene.frame.matrices) : build_machine(scene);
  auto options = scene.reduction.superposition.value();
  return coupling::superpose(machine, Eigen::VectorXd::Zero(machine.size()), options);
}

} // namespace

/// A change of coordinates: peaks, their times, events and energy, to the tolerance of the steps.
TEST(ModalSuperposition, WithAllModesIsTheFullMachine)
{
  const ChainScene scene;
  const Answer     modal(scene.path("method = 'modal'\nmodes = 30", load + stop));
  const Answer     full(scene.path("method = 'none'", load + stop));
  EXPECT_EQ(modal.result.model.modes, 30);
  ASSERT_EQ(modal.result.run->events.size(), full.result.run->events.size());
  ASSERT_GT(full.result.run->events.size(), 2u);
  for (std::size_t i = 0; i < full.result.run->events.size(); ++i)
    EXPECT_NEAR(modal.result.run->events[i].t, full.result.run->events[i].t, 1e-9) << i;
  for (const std::size_t i : {0u, 1u})
  {
    EXPECT_NEAR(modal[i].max, full[i].max, 1e-9 * full[i].max) << i;
    EXPECT_NEAR(modal[i].final, full[i].final, 1e-9 * full[i].max) << i;
  }
  EXPECT_NEAR(modal.result.run->energy.input, full.result.run->energy.input, 1e-8 * full.result.run->energy.input);
}

/// The same on a sparse frame of more coordinates than are kept dense, in the lowest of its modes.
TEST(ModalSuperposition, OfALargeFrameMeetsTheClosedFrequencies)
{
  Chain chain;
  chain.n = 900;
  const ChainScene scene(chain);
  const Answer     modal(scene.path("method = 'modal'\nmodes = 12", load));
  const Answer     reduced(scene.path("method = 'craig-bampton'\nmodes = 60", load));
  EXPECT_EQ(modal.result.model.dofs, 12);
  EXPECT_NEAR(modal[0].max, reduced[0].max, 0.02 * reduced[0].max); // 1 / (2 m + 1) of the static deflection
  EXPECT_NEAR(modal[1].max, reduced[1].max, 0.02 * reduced[1].max);
  const auto modes = of_scene(scene.path("method = 'modal'\nmodes = 12", load));
  for (int j = 0; j < 12; ++j)
    EXPECT_NEAR(modes.modes.omega[j], chain.omega(j), 1e-9 * chain.omega(j)) << j;
}

/// The share of the tip's deflection above mode m of a rod, 8 / pi^2 sum 1/(2 j + 1)^2, falls like 2 / (pi^2 m).
TEST(ModalSuperposition, LeavesOutOfStaticsWhatTheSeriesOfARodSays)
{
  Chain chain;
  chain.n = 400;
  const ChainScene scene(chain);
  for (const int m : {5, 10, 20})
  {
    const auto   modes = of_scene(scene.path("method = 'modal'\nmodes = " + std::to_string(m), load));
    double       sum   = 0.;
    const double n     = chain.n; // the tip of mode j over omega_j^2, exactly
    for (int j = 0; j < m; ++j)
    {
      const double a = (2. * j + 1.) * M_PI / (2. * n + 1.), tip = 2. / std::sqrt(2. * n + 1.) * std::sin(n * a);
      sum += tip * tip / chain.mass() / std::pow(chain.omega(j), 2);
    }
    EXPECT_NEAR(modes.static_residual, 1. - sum * chain.stiffness, 1e-9) << m;
    EXPECT_NEAR(modes.static_residual * m, 2. / (M_PI * M_PI), 0.03) << m;
  }
}

/// The book's rule: up to four times the highest frequency of the loads; or what is asked for.
TEST(ModalSuperposition, ChoosesItsModesByTheLoads)
{
  const ChainScene scene;
  const Chain      chain;
  const auto       below = [&](double hz)
  {
    int count = 0;
    while (chain.omega(count) <= 2. * M_PI * hz)
      ++count;
    return count;
  };
  EXPECT_EQ(of_scene(scene.path("method = 'modal'", load)).modes.omega.size(), below(440.));
  EXPECT_EQ(of_scene(scene.path("method = 'modal'\nfrequency = '900 Hz'", load)).modes.omega.size(), below(900.));
  // Of both rules the one with more modes, and not one mode too many.
  for (const std::string &acting : {stop, load})
  {
    const auto by_tolerance = of_scene(scene.path("method = 'modal'\ntolerance = 0.03", acting));
    const int  m            = int(by_tolerance.modes.omega.size());
    EXPECT_LE(by_tolerance.static_residual, 0.03);
    EXPECT_GT(m, below(440.));
    const auto fewer = of_scene(scene.path("method = 'modal'\nmodes = " + std::to_string(m - 1), acting));
    EXPECT_GT(fewer.static_residual, 0.03);
  }
}

/// What the rule does not see is noted: loads above the modes kept, forces that no one knows the frequency of.
TEST(ModalSuperposition, NotesLoadsThatItsModesDoNotReach)
{
  const ChainScene scene;
  EXPECT_THAT(of_scene(scene.path("method = 'modal'\nmodes = 1", load)).notes,
              Contains(HasSubstr("a load has 110 Hz, above the highest retained mode")));
  const std::string pulse = "[element.pulse]\ntype = 'formula force'\nfrom = 'frame.tip'\nto = 'ground'\n"
                            "direction = [1, 0, 0]\nforce = '40 N*sin(2*pi*2900 Hz*t)'\n";
  EXPECT_THAT(of_scene(scene.path("method = 'modal'", pulse)).notes,
              Contains(HasSubstr("\"pulse\" excites the machine by a force of unknown frequencies")));
  EXPECT_THAT(of_scene(scene.path("method = 'modal'\nmodes = 30", load)).notes, testing::IsEmpty());
}

/// At rest under a constant load it is in the equilibrium of the modes kept, and stays there.
TEST(ModalSuperposition, StartsInItsOwnEquilibrium)
{
  const ChainScene  scene;
  const std::string weight = "[element.load]\ntype = 'force'\nfrom = 'frame.tip'\nto = 'ground'\n"
                             "direction = [1, 0, 0]\nconstant = '90 N'\n[start]\nrule = 'static'\n";
  const Answer      modal(scene.path("method = 'modal'\nmodes = 4", weight + stop));
  EXPECT_LT(std::abs(modal[1].max), 1e-9);
  EXPECT_LT(std::abs(modal[1].min), 1e-9);
  EXPECT_GT(modal[0].max, 1e-4); // on the stop
  EXPECT_THAT(modal.result.warnings, Contains(HasSubstr("% too small without the truncated modes"))) << "four modes";
}

/// Without a method central differences with a step of their own; one that is too long is cut below 2 / omega_max.
TEST(ModalSuperposition, KeepsCentralDifferencesStable)
{
  const ChainScene  scene;
  const std::string reduction = "method = 'modal'\nmodes = 10";
  const double      limit     = 2. / Chain().omega(9);
  const Answer      own(scene.path(reduction, load, "end = 0.1\n"));
  EXPECT_EQ(own.result.run->method, "central differences");
  EXPECT_NEAR(own.result.requested.run->method.step, 0.25 * limit, 1e-9 * limit);
  const Answer exact(scene.path(reduction, load));
  EXPECT_NEAR(own[0].max, exact[0].max, 0.01 * exact[0].max);
  // A damper ends motions within 1/lambda; steps by themselves show it.
  const std::string damper = "[element.damper]\ntype = 'spring-damper'\nfrom = 'frame.tip'\nto = 'ground'\n"
                             "direction = [1, 0, 0]\ndamping = '50 kN s/m'\n";
  const Answer      damped(scene.path(reduction, load + damper, "end = 0.02\n")),
      true_one(scene.path(reduction, load + damper, "method = 'exact'\ntolerance = 1e-9\nend = 0.02\n"));
  EXPECT_NEAR(damped[1].max, true_one[1].max, 0.05 * true_one[1].max);
  const Answer coarse(scene.path(reduction, load + damper, "step = '0.01 ms'\nend = 0.02\n"));
  EXPECT_THAT(coarse.result.warnings, Contains(HasSubstr("dampers damp motions within")));
  const Answer longer(scene.path(reduction, load, "method = 'central-difference'\nstep = '1 ms'\nend = 0.1\n"));
  EXPECT_TRUE(longer.result.run->failure.empty());
  EXPECT_NEAR(longer.result.requested.run->method.step, 0.95 * limit, 1e-9 * limit);
  EXPECT_THAT(longer.result.warnings, Contains(HasSubstr("stable up to 2 / omega_max")));
}

/// A stop is engaged in the averaged machine, open in the one of most moments.
TEST(ModalSuperposition, WarnsWhereTheMachineOfTheMomentIsAnother)
{
  const ChainScene scene;
  const Answer     hits(scene.path("method = 'modal'\nmodes = 12", load + stop));
  EXPECT_THAT(coupling::texts_of(hits.result.run->findings), Contains(HasSubstr("the actual frequencies differed")));
  const Answer linear(scene.path("method = 'modal'\nmodes = 12", load));
  EXPECT_THAT(coupling::texts_of(linear.result.run->findings), Not(Contains(HasSubstr("the actual frequencies"))));
}

/// Damping in proportion to the stiffness couples no modes, a damper at the tip does.
TEST(ModalSuperposition, ReportsWhatDiagonalDampingLeavesOut)
{
  const ChainScene  scene;
  const std::string damper = "[element.damper]\ntype = 'spring-damper'\nfrom = 'frame.tip'\nto = 'ground'\n"
                             "direction = [1, 0, 0]\ndamping = '200 N s/m'\n",
                    few = "method = 'modal'\nmodes = 8\n", diagonal = few + "damping = 'diagonal'\n";
  const Answer proportional(scene.path(diagonal, load)), full(scene.path(few, load));
  EXPECT_NEAR(proportional[0].max, full[0].max, 1e-9 * full[0].max);
  EXPECT_THAT(proportional.result.warnings, Not(Contains(HasSubstr("diagonal"))));
  const Answer damped(scene.path(diagonal, load + damper)), whole(scene.path(few, load + damper));
  EXPECT_THAT(damped.result.warnings, Contains(HasSubstr("ignores coupling of modes by up to")));
  EXPECT_GT(std::abs(damped[0].max - whole[0].max), 1e-3 * whole[0].max);
}

/// A given position that the modes cannot take is not changed without a word.
TEST(ModalSuperposition, NotesWhatIsLostOfAGivenStart)
{
  const ChainScene  scene;
  const std::string start = "[start]\nq = { 'frame.tip.ux' = '1 mm' }\n";
  const Answer      few(scene.path("method = 'modal'\nmodes = 3", start)),
      all(scene.path("method = 'modal'\nmodes = 30", start));
  EXPECT_THAT(coupling::texts_of(few.result.run->findings),
              Contains(HasSubstr("of the elastic energy of the given initial state")));
  EXPECT_THAT(coupling::texts_of(all.result.run->findings), testing::IsEmpty());
  EXPECT_NEAR(all[0].max, 1e-3, 1e-6);
}

TEST(ModalSuperposition, IsNotAGroundForBranches)
{
  const ChainScene scene;
  PeriodicRequest  request;
  request.along = "element.load.constant";
  request.from = request.to = "30 N";
  Session session(scene.path("method = 'modal'\nmodes = 6", load));
  expect_refusal([&] { begin_branches(session, request); }, "not possible with reduction.method");
}

TEST(ModalSuperposition, IsRefusedWhereTheEigenproblemIsSingular)
{
  const ChainScene scene;
  const auto       said = [&](const std::string &more, const std::string &modes = "")
  { return refusal([&] { Session(scene.path("method = 'modal'\n" + modes, more)).run(); }); };
  const std::string rotor = "[body.drum]\ntype = 'rotor'\naxis = [1, 0, 0]\non = 'ground'\ninertia = 1\n";
  EXPECT_THAT(said(rotor), HasSubstr("\"drum\" moves freely: this motion has no stiffness"));
  EXPECT_THAT(said(rotor + "[element.motor]\ntype = 'asynchronous motor'\non = 'drum'\nbreakdown_torque = 10\n"
                           "breakdown_slip = 0.1\nsynchronous_speed = '600 1/min'\n"),
              HasSubstr("\"motor\" turns \"drum\""));
  EXPECT_THAT(said(load, "modes = 0"), HasSubstr("modes is 0"));
  EXPECT_THAT(said(load, "modes = 31"), HasSubstr("have 30 coordinates"));
  EXPECT_THAT(said(load, "eigensolver = 'lobpcg'"), HasSubstr("is not for method = \"modal\""));
  EXPECT_EQ(said(load), "");
}

} // namespace gestell::tests
