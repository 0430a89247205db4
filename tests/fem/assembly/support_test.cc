#include "fem/assembly/rigid_motions.h"
#include "fem/recovery/discretisation.h"
#include "tests/support/box_mesh.h"
#include "tests/support/statics.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using fem::discretise;

fem::Mesh upright_bar()
{
  return box_mesh({{2, 2, 6}}, {{0.4, 0.3, 1.5}}, 0.25);
}

fem::CutSpecification cut(const std::string &name, const fem::Vector3 &through, const fem::Vector3 &normal)
{
  return {name, through, normal, "press.toml:50: frame.cut." + name};
}

/// A bar along z on springs, with a node on its top and some planes across it.
fem::FrameSpecification bar_on_springs()
{
  auto specification       = free_steel();
  specification.supports   = {foundation("feet", {"z0"}, {{2e8, 3e8, 4e8}}, {{2e3, 3e3, 4e3}})};
  specification.interfaces = {interface("top", {"z1"}, fem::InterfaceCoupling::average)};
  specification.cuts = {cut("low", {{0., 0., 0.37}}, {{0., 0., 1.}}), cut("high", {{0., 0., 1.1}}, {{0., 0., 2.}}),
                        cut("oblique", {{0.2, 0.1, 0.7}}, {{0.3, -0.2, 1.}})};
  return specification;
}

TEST(Foundation, SinksByTheLoadOverItsTotalStiffness)
{
  // The mean of the foot moves by F / k exactly, however the frame bends: reaction = k mean(u).
  const auto            frame  = discretise(upright_bar(), bar_on_springs());
  const auto            weight = frame.mass * 9.81;
  const Eigen::VectorXd q      = statics(frame, -9.81 * frame.acceleration_load.col(2));
  EXPECT_NEAR(output(frame, "support.feet.z").on_q.dot(q), weight, 1e-9 * weight) << "feet pressed down push up";
  EXPECT_NEAR(output(frame, "support.feet.x").on_q.dot(q), 0., 1e-9 * weight);

  // A frame a million times stiffer than its springs sinks as a whole.
  auto stiff       = bar_on_springs();
  stiff.material.E = 210e15;
  const auto block = discretise(upright_bar(), stiff);
  const int  top   = block.interfaces[0].coordinate[fem::uz];
  EXPECT_NEAR(statics(block, Eigen::VectorXd::Unit(block.C.rows(), top))[top] * 4e8, 1., 1e-5);
}

TEST(Clamp, CarriesTheWeightOfTheNodesItHoldsToo)
{
  // Forces and moments of a free body are in balance: no row of C carries anything for a translation.
  auto specification           = bar_on_springs();
  specification.supports       = {clamped("feet", {"z0"}), clamped("left", {"x0"})};
  specification.interfaces     = {};
  const auto            frame  = discretise(upright_bar(), specification);
  const Eigen::Vector3d g      = {1., -2., -9.81};
  const Eigen::VectorXd q      = statics(frame, frame.acceleration_load * g);
  const auto            weight = frame.mass * g;
  for (int d = 0; d < 3; ++d)
  {
    double force = 0., held = 0.;
    for (const std::string support : {"feet", "left"})
    {
      const auto &one = output(frame, "support." + support + "." + "xyz"[d]);
      force += one.on_q.dot(q) + one.under_acceleration.dot(g);
      held += one.under_acceleration.dot(g);
    }
    EXPECT_NEAR(force, -weight[d], 1e-9 * frame.mass * 9.81);
    EXPECT_GT(held / -weight[d], 0.02) << "or the test shows nothing";
  }
}

TEST(Clamp, AnswersWhatAFoundationPushesTheNodesTheyShareToo)
{
  // A wall holds the edge of the feet: their springs and dampers act on its nodes as well, and all balance the load.
  auto specification     = bar_on_springs();
  specification.supports = {clamped("wall", {"x0"}), foundation("feet", {"z0"}, {{2e8, 3e8, 4e8}}, {{2e3, 3e3, 4e3}})};
  specification.interfaces    = {};
  const auto            frame = discretise(upright_bar(), specification);
  const Eigen::Vector3d g     = {1., -2., -9.81};
  const Eigen::VectorXd q     = statics(frame, frame.acceleration_load * g);
  const Eigen::VectorXd rates = q; // what dampers do to any rates is balanced by the free nodes' alone
  for (int d = 0; d < 3; ++d)
  {
    double force = 0., damping = 0.;
    for (const std::string support : {"wall", "feet"})
    {
      const auto &one = output(frame, "support." + support + "." + "xyz"[d]);
      force += one.on_q.dot(q) + one.under_acceleration.dot(g);
      damping += one.on_v.dot(rates);
    }
    EXPECT_NEAR(force, -frame.mass * g[d], 1e-9 * frame.mass * 9.81) << d;
    EXPECT_NEAR(damping, -frame.translations.col(d).dot(frame.B * rates), 1e-9 * std::abs(damping)) << d;
  }
}

TEST(Rayleigh, DampsInProportionToMassAndStiffnessOfTheMaterial)
{
  auto damped                = bar_on_springs();
  damped.rayleigh_mass       = 3.;
  damped.rayleigh_stiffness  = 2e-5;
  auto floating              = bar_on_springs();
  floating.supports          = {};
  const auto            with = discretise(upright_bar(), damped), without = discretise(upright_bar(), bar_on_springs());
  const Eigen::MatrixXd C = discretise(upright_bar(), floating).C, B = with.B - without.B;
  EXPECT_LT((B - 3. * Eigen::MatrixXd(with.M) - 2e-5 * C).norm(), 1e-12 * B.norm()) << "springs of the feet stay out";
}

TEST(Rayleigh, OfMassGivesAWarningWhereTheFrameIsUnconstrained)
{
  auto frame          = bar_on_springs();
  frame.rayleigh_mass = 3.;
  EXPECT_TRUE(discretise(upright_bar(), frame).notes.empty());
  frame.supports   = {};
  const auto notes = discretise(upright_bar(), frame).notes;
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("their speed halves in 0.231 s"), std::string::npos) << notes[0]; // ln 2 / 3
}

TEST(Foundation, GivesStiffnessAndDampingOfItsTotalsToTranslations)
{
  const auto            frame = discretise(upright_bar(), bar_on_springs());
  const Eigen::MatrixXd C     = frame.translations.transpose() * (frame.C * frame.translations);
  const Eigen::MatrixXd B     = frame.translations.transpose() * (frame.B * frame.translations);
  const double          k[3] = {2e8, 3e8, 4e8}, d[3] = {2e3, 3e3, 4e3};
  for (int i = 0; i < 3; ++i)
  {
    EXPECT_NEAR(C(i, i), k[i], 1e-6 * k[i]);
    EXPECT_NEAR(B(i, i), d[i], 1e-10 * d[i]);
    EXPECT_NEAR(output(frame, std::string("support.feet.") + "xyz"[i]).on_v.dot(frame.translations.col(i)), -d[i],
                1e-10 * d[i]);
  }
}

TEST(Foundation, ResistsTiltByTheSecondMomentOfItsArea)
{
  // k_z / A int y^2 dA about the centre line of a foot 0.4 x 0.3 m.
  auto specification          = bar_on_springs();
  specification.supports      = {foundation("feet", {"z0"}, {{0., 0., 4e8}})};
  specification.interfaces    = {};
  const auto            frame = discretise(upright_bar(), specification);
  const Eigen::VectorXd tilt  = frame.rigid_motions.col(fem::rx);
  EXPECT_NEAR(tilt.dot(frame.C * tilt), 4e8 * 0.3 * 0.3 / 12., 1e-4 * 4e8 * 0.3 * 0.3 / 12.);
}

TEST(Foundation, ByAreaIsTheSameAsByItsTotals)
{
  auto  totals = bar_on_springs(), by_area = bar_on_springs();
  auto &support    = by_area.supports[0];
  support.per_area = {true, true};
  for (int d = 0; d < 3; ++d)
  {
    support.stiffness[d] /= 0.4 * 0.3;
    support.damping[d] /= 0.4 * 0.3;
  }
  const auto a = discretise(upright_bar(), totals), b = discretise(upright_bar(), by_area);
  EXPECT_LT((Eigen::MatrixXd(a.C) - Eigen::MatrixXd(b.C)).norm(), 1e-13 * a.C.norm());
  EXPECT_LT((Eigen::MatrixXd(a.B) - Eigen::MatrixXd(b.B)).norm(), 1e-13 * a.B.norm());
}

TEST(Foundation, ActsAlongItsAxes)
{
  // Translations along the axes meet the three stiffnesses one by one; the reactions are the global components.
  auto         specification = bar_on_springs();
  const double c = std::cos(0.4), s = std::sin(0.4);
  specification.supports[0].axes = {{{c, s, 0.}, {-s, c, 0.}, {0., 0., 1.}}};
  const auto            frame    = discretise(upright_bar(), specification);
  const Eigen::Vector3d u(c, s, 0.);
  const Eigen::VectorXd q = frame.translations * u;
  EXPECT_NEAR(q.dot(frame.C * q), 2e8, 1e-6 * 2e8);
  EXPECT_NEAR(q.dot(frame.B * q), 2e3, 1e-10 * 2e3);
  for (int d = 0; d < 3; ++d)
    EXPECT_NEAR(output(frame, std::string("support.feet.") + "xyz"[d]).on_q.dot(q), -2e8 * u[d], 1e-6 * 2e8);
  const Eigen::VectorXd across = frame.translations * Eigen::Vector3d(-s, c, 0.);
  EXPECT_NEAR(q.dot(frame.C * across), 0., 1e-6 * 2e8);

  specification.supports[0].axes[1] = {0., 1., 0.};
  expect_refusal([&] { discretise(upright_bar(), specification); }, "at right angles");
}

TEST(Foundation, OfDampersAloneHoldsNothingAndDissipates)
{
  auto specification       = bar_on_springs();
  specification.supports   = {clamped("feet", {"z0"}), foundation("damper", {"z1"}, {}, {{0., 0., 5e4}})};
  specification.interfaces = {};
  const auto with          = discretise(upright_bar(), specification);
  specification.supports.pop_back();
  const auto without = discretise(upright_bar(), specification);
  EXPECT_EQ((Eigen::MatrixXd(with.C) - Eigen::MatrixXd(without.C)).norm(), 0.);
  const Eigen::VectorXd up = with.translations.col(2);
  EXPECT_NEAR(up.dot(with.B * up), 5e4, 1e-9 * 5e4);
  EXPECT_NEAR(output(with, "support.damper.z").on_v.dot(up), -5e4, 1e-9 * 5e4);
}

TEST(ClampedSupport, AnswersEveryLoadWithItsReaction)
{
  auto specification     = bar_on_springs();
  specification.supports = {clamped("feet", {"z0"})};
  const auto frame       = discretise(upright_bar(), specification);
  for (int d = 0; d < 3; ++d)
  {
    const Eigen::VectorXd force = 1e4 * Eigen::VectorXd::Unit(frame.C.rows(), frame.interfaces[0].coordinate[d]);
    const Eigen::VectorXd q     = statics(frame, force);
    for (int e = 0; e < 3; ++e)
      EXPECT_NEAR(output(frame, std::string("support.feet.") + "xyz"[e]).on_q.dot(q), d == e ? -1e4 : 0., 1e-5);
  }
}

TEST(ClampedSupport, HoldsOnlyTheNamedDirectionsAndCountsSharedNodesOnce)
{
  auto specification     = free_steel();
  specification.supports = {clamped("x side", {"x0"}, {{true, false, false}}),
                            clamped("y side", {"y0"}, {{false, true, false}}),
                            clamped("feet", {"z0"}, {{false, false, true}})};
  const auto frame       = discretise(upright_bar(), specification);
  // Stress-free but for its weight: three symmetry planes hold it, the feet carry the load of all free nodes.
  const Eigen::VectorXd load = -frame.acceleration_load.col(2);
  EXPECT_NEAR(output(frame, "support.feet.z").on_q.dot(statics(frame, load)), -load.sum(), 1e-9 * frame.mass);

  specification.supports.push_back(clamped("again", {"z0"}, {{false, false, true}}));
  EXPECT_EQ(output(discretise(upright_bar(), specification), "support.again.z").on_q.norm(), 0.);
}

TEST(Supports, OfImpossibleNumbersAreRefused)
{
  const auto refuse = [](fem::Support support)
  {
    support.place          = "press.toml:33: frame.support.feet";
    auto specification     = free_steel();
    specification.supports = {support};
    return refusal([&] { discretise(upright_bar(), specification); });
  };
  EXPECT_NE(refuse(foundation("feet", {"z0"}, {{1e8, -1., 1e8}}))
                .find("press.toml:33: frame.support.feet: support \"feet\": stiffness in y is -1 N/m"),
            std::string::npos);
  EXPECT_NE(refuse(foundation("feet", {"z0"}, {{1e8, 0., 0.}}, {{0., 0., -2.}})).find("damping in z is -2 N s/m"),
            std::string::npos);
  EXPECT_NE(refuse(foundation("feet", {"z0"}, {{0., 0., 0.}})).find("acts in no direction"), std::string::npos);
  EXPECT_NE(refuse(clamped("feet", {"z0"}, {{false, false, false}})).find("acts in no direction"), std::string::npos);
  EXPECT_NE(refuse(clamped("feet", {"foot"})).find("surface \"foot\", which does not exist in the frame"),
            std::string::npos);
  EXPECT_NE(refuse(foundation("feet", {"z0"}, {{std::nan(""), 0., 0.}})).find("stiffness in x is nan"),
            std::string::npos);
}

/// Volume of the bar, 0.4 x 0.3 x 1.5 m, above planes at any height in its cells; an oblique plane parts it at its
/// mean height over the section.
TEST(CutForce, CarriesTheWeightOfWhatIsAboveThePlane)
{
  auto specification = bar_on_springs();
  for (int i = 0; i < 7; ++i)
    specification.cuts.push_back(cut("at" + std::to_string(i), {{0., 0., 0.3 + 0.071 * i}}, {{0., 0., 1.}}));
  specification.cuts.push_back(cut("turned", {{0., 0., 0.6}}, {{0., 0., -1.}}));
  for (const bool is_clamped : {false, true})
  {
    if (is_clamped)
      specification.supports = {clamped("feet", {"z0"})};
    const auto            frame = discretise(upright_bar(), specification);
    const Eigen::Vector3d g     = {0., 0., -9.81};
    const Eigen::VectorXd q     = statics(frame, frame.acceleration_load * g);
    const auto            force = [&](const std::string &name)
    {
      const auto &row = output(frame, "cut." + name);
      return row.on_q.dot(q) + row.under_acceleration.dot(g);
    };
    const double line = -9.81 * frame.mass / 1.5; // N/m
    for (int i = 0; i < 7; ++i)
      EXPECT_NEAR(force("at" + std::to_string(i)), line * (1.2 - 0.071 * i), 1e-6) << i;
    EXPECT_NEAR(force("turned"), line * 0.9, 1e-6) << "compression";
    const double middle = 0.71; // of the centre line, where 0.3 (0.2 - 0.2) - 0.2 (0.15 - 0.1) + (z - 0.7) = 0
    EXPECT_NEAR(force("oblique"), line * (1.5 - middle) / std::sqrt(1.13), 1e-6);
  }
}

TEST(CutForce, TakesTheShareOfALoadAlongItsNormalThroughEveryPlane)
{
  const auto      frame = discretise(upright_bar(), bar_on_springs());
  Eigen::VectorXd load  = Eigen::VectorXd::Zero(frame.C.rows());
  for (int d = 0; d < 3; ++d)
    load[frame.interfaces[0].coordinate[d]] = 1e4 * (d + 1);
  const Eigen::VectorXd q = statics(frame, load);
  EXPECT_NEAR(output(frame, "cut.low").on_q.dot(q), 3e4, 1e-4);
  EXPECT_NEAR(output(frame, "cut.high").on_q.dot(q), 3e4, 1e-4);
  EXPECT_EQ(output(frame, "cut.low").on_v.norm(), 0.);
  EXPECT_NEAR(output(frame, "cut.oblique").on_q.dot(q), (0.3 * 1e4 - 0.2 * 2e4 + 3e4) / std::sqrt(1.13), 1e-4);
}

/// A bar that creeps under a pull, B v = f: its own dampers carry the pull through every plane to the support.
TEST(CutForce, ContainsTheDampersOfTheCells)
{
  auto specification               = bar_on_springs();
  specification.rayleigh_stiffness = 2e-5;
  for (const bool is_clamped : {false, true})
  {
    if (is_clamped)
      specification.supports = {clamped("feet", {"z0"})};
    auto                  frame = discretise(upright_bar(), specification);
    const Eigen::VectorXd pull  = 1e5 * Eigen::VectorXd::Unit(frame.C.rows(), frame.interfaces[0].coordinate[fem::uz]);
    frame.C                     = frame.B;
    const Eigen::VectorXd v     = statics(frame, pull);
    EXPECT_NEAR(output(frame, "cut.low").on_v.dot(v), 1e5, 1e-4);
    EXPECT_NEAR(output(frame, "cut.oblique").on_v.dot(v), 1e5 / std::sqrt(1.13), 1e-4);
    EXPECT_NEAR(output(frame, "support.feet.z").on_v.dot(v), -1e5, 1e-4) << (is_clamped ? "clamped" : "on dampers");
  }
}

TEST(CutForce, OfARigidMotionIsZero)
{
  const auto frame = discretise(upright_bar(), bar_on_springs());
  for (const char *name : {"cut.low", "cut.oblique"})
    EXPECT_LT((output(frame, name).on_q.transpose() * frame.rigid_motions).cwiseAbs().maxCoeff(),
              1e-11 * output(frame, name).on_q.cwiseAbs().sum());
}

TEST(CutForce, ThroughAPlaneBesideTheFrameIsRefused)
{
  auto specification        = bar_on_springs();
  specification.cuts        = {cut("columns", {{0., 0., 3.}}, {{0., 0., 1.}})};
  const std::string message = refusal([&] { discretise(upright_bar(), specification); });
  EXPECT_NE(message.find("press.toml:50: frame.cut.columns: cut \"columns\": the plane does not cut the frame"),
            std::string::npos)
      << message;
  specification.cuts = {cut("columns", {{0., 0., 1.}}, {{0., 0., 0.}})};
  expect_refusal([&] { discretise(upright_bar(), specification); }, "normal is zero");
}

TEST(FreeMotions, AreNamedAsText)
{
  const auto names = [](std::vector<fem::Support> supports)
  {
    auto specification     = free_steel();
    specification.supports = std::move(supports);
    return fem::free_motions(discretise(upright_bar(), specification), {});
  };
  using Names = std::vector<std::string>;
  EXPECT_EQ(names({}), (Names{"translation along x", "translation along y", "translation along z", "rotation about x",
                              "rotation about y", "rotation about z"}));
  EXPECT_EQ(names({clamped("feet", {"z0"})}), Names());
  EXPECT_EQ(names({clamped("guide", {"z0"}, {{false, true, true}})}), Names{"translation along x"});
  EXPECT_EQ(names({foundation("feet", {"z0"}, {{0., 0., 1e6}})}),
            (Names{"translation along x", "translation along y", "rotation about z"}));
  EXPECT_EQ(names({foundation("feet", {"z0"}, {{1e3, 1e3, 1e3}})}), Names()) << "soft is not free";
}

TEST(FreeMotions, OfAHingeHaveTheAxisAndAPointOfIt)
{
  // z held on x = 0, x held on z = 0, y held on y = 0: only a turn about the edge x = z = 0 moves none of these.
  auto specification     = free_steel();
  specification.supports = {clamped("wall", {"x0"}, {{false, false, true}}),
                            clamped("floor", {"z0"}, {{true, false, false}}),
                            clamped("side", {"y0"}, {{false, true, false}})};
  EXPECT_EQ(fem::free_motions(discretise(upright_bar(), specification), {}),
            std::vector<std::string>{"rotation about y through (0, 0.15, 0) m"});
}

TEST(FreeMotions, EndWhereTheInterfaceIsFixed)
{
  auto specification       = free_steel();
  specification.interfaces = {interface("top", {"z1"}, fem::InterfaceCoupling::average)};
  const auto       frame   = discretise(upright_bar(), specification);
  std::vector<int> held(frame.interfaces[0].coordinate.begin(), frame.interfaces[0].coordinate.end());
  EXPECT_EQ(fem::free_motions(frame, {}).size(), 6u);
  EXPECT_EQ(fem::free_motions(frame, held).size(), 0u);
  held = {frame.interfaces[0].coordinate[fem::ux]};
  // Holding ux of the top leaves, besides the translations along y and z, turns that do not move it.
  EXPECT_EQ(fem::free_motions(frame, held).size(), 5u);
}

} // namespace
} // namespace gestell::test
