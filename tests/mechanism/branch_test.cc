// What holds for every element with branches: its law by the branch in the history is the law by the motion, smoothly
// continued, and its guards tell every change of branch.

#include "mechanism/elements/blanking_force.h"
#include "mechanism/elements/clearance.h"
#include "mechanism/elements/common_tangents.h"
#include "mechanism/elements/connecting_rod.h"
#include "mechanism/elements/cutting_force.h"
#include "mechanism/elements/formula_force.h"
#include "mechanism/elements/journal_bearing.h"
#include "mechanism/elements/point_contact.h"
#include "mechanism/elements/table_force.h"
#include "tests/support/branch_samples.h"
#include "tests/support/prescribed_path.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const CuttingForce::Parameters tool{5e3, 6e-4, 4e-4, 0.02};

BlankingForce::Parameters sheet(double exponent)
{
  return {0.004, 0.8, 3.2e8, 0.35, exponent, 0.25, 0.08, 9e9, 0.152};
}

/// A journal that moves along a slanted radius while it turns.
Probe journal_probe(const Probe &radial)
{
  const Eigen::Vector3d along(0.6, -0.8, 0.), turning(0., 0., 5.);
  return {radial.t, radial.u[0] * along + radial.t * turning, radial.v[0] * along + turning, radial.a[0] * along};
}

/// A point that moves along the normal of a plane while it slides.
Probe contact_probe(const Probe &normal)
{
  const Eigen::Vector3d along(1., 0., 0.), sliding(0., 0.3, -0.2);
  return {normal.t, normal.u[0] * along + normal.t * sliding, normal.v[0] * along + sliding, normal.a[0] * along};
}

/// Corners at 0.3 and 0.5 without a jump, beside the rows at the ends.
TableForce::Parameters table(TableForce::Against against)
{
  return {against, {{0.1, 0.}, {0.3, 80.}, {0.5, -40.}, {0.9, 0.}}};
}

/// Kinks within the parts of a condition, which come into play with it; jumps at u = 0.2 and t = 0.70007.
Formula kinked_force()
{
  const Formula t = Formula::variable(0), u = Formula::variable(1), v = Formula::variable(2);
  return conditional(u - 0.2, Relation::below, 3. * abs(v) - u, max(u, 0.5) * sign(v)) + step(t - 0.70007);
}

Probe sheet_probe(double z, double v, double a = 0.)
{
  return probe1(0.152 + z, v, a);
}

// --- one transition

/// A motion at a switching point, on its way through it.
struct Switch
{
  std::string               name;
  std::shared_ptr<ForceLaw> element;
  Eigen::VectorXd           history; ///< of the branch before
  Probe                     probe;
  int                       guard;
  std::string               kind;
};

std::ostream &operator<<(std::ostream &out, const Switch &s)
{
  return out << s.name;
}

Eigen::VectorXd numbers(double first, double second = 0.)
{
  return Eigen::Vector2d(first, second);
}

std::vector<Switch> switches()
{
  const auto conrod  = std::make_shared<ConnectingRod>(rod);
  const auto contact = std::make_shared<Clearance>(play);
  const auto cut     = std::make_shared<CuttingForce>(tool);
  const auto loaded  = [&](const ForceLaw &e, const Probe &p) { return started(e, p); };

  std::vector<Switch> all = {
      {"rod_opens", conrod, loaded(*conrod, rod_probe(1e-4, 0.)), rod_probe(0., -0.2), 0, "conrod_open"},
      {"rod_closes", conrod, loaded(*conrod, rod_probe(-1e-4, 0.)), rod_probe(0., 0.2), 0, "conrod_close_compression"},
      {"rod_taut", conrod, loaded(*conrod, rod_probe(-1e-4, 0.)), rod_probe(-4e-4, -0.2), 1, "conrod_close_tension"},
      {"rod_slack", conrod, loaded(*conrod, rod_probe(-5e-4, 0.)), rod_probe(-4e-4, 0.2), 0, "conrod_leave_tension"},
      {"tool_in", cut, numbers(0.), probe1(4e-4, 0.03), 0, "tool_contact"},
      {"tool_out", cut, numbers(1.), probe1(4e-4, -0.03), 0, "tool_release"}};
  for (const double s : {-1., 1.})
  {
    const std::string side   = s < 0. ? "negative" : "positive";
    const auto        inside = [&](double v) { return loaded(*contact, probe1(s * 7e-5, s * v)); };
    all.push_back(
        {"touch_" + side, contact, numbers(0.), probe1(s * 5e-5, s * 0.1), s > 0. ? 0 : 1, "contact_" + side});
    all.push_back({"leave_" + side, contact, inside(0.), probe1(s * 5e-5, s * -0.1), 0, "separation"});
    all.push_back({"lose_" + side, contact, inside(0.), probe1(s * 6e-5, s * -0.25, s * -1e3), 1, "contact_slack"});
    all.push_back({"regain_" + side, contact, inside(-0.3), probe1(s * 6e-5, s * -0.25, s * 1e3), 1, "contact_grip"});
    all.push_back({"drop_" + side, contact, inside(-0.3), probe1(s * 5e-5, s * -0.4), 0, "separation"});
  }
  for (const double s : {-1., 1.})
  {
    const auto stop = std::make_shared<Clearance>(
        Clearance::Parameters{-2e-5, 1e9, 4., s > 0. ? Clearance::Stops::above : Clearance::Stops::below});
    const std::string     side = s < 0. ? "_below" : "_above";
    const Eigen::VectorXd in   = loaded(*stop, probe1(s * 1e-5, 0.));
    all.push_back({"stop_met" + side, stop, numbers(0.), probe1(s * -2e-5, s * 0.1), 0, "contact"});
    all.push_back({"stop_left" + side, stop, in, probe1(s * -2e-5, s * -0.1), 0, "separation"});
    all.push_back({"stop_lost" + side, stop, in, probe1(s * -1e-5, s * -0.25, s * -1e3), 1, "contact_slack"});
  }
  const auto            journal = std::make_shared<JournalBearing>(bearing);
  const Eigen::VectorXd pressed = loaded(*journal, journal_probe(probe1(7e-5, 0.)));
  all.push_back({"journal_touches", journal, numbers(0.), journal_probe(probe1(5e-5, 0.1)), 0, "contact"});
  all.push_back({"journal_leaves", journal, pressed, journal_probe(probe1(5e-5, -0.1)), 0, "separation"});
  all.push_back({"journal_lost", journal, pressed, journal_probe(probe1(6e-5, -0.25, -1e3)), 1, "contact_slack"});
  const auto plane =
      std::make_shared<PointContact>(PointContact::Parameters{{-1e-5, 1e9, 4., Clearance::Stops::below}, rubbing});
  const Eigen::VectorXd lying = loaded(*plane, contact_probe(probe1(0., 0.)));
  all.push_back({"point_lands", plane, numbers(0.), contact_probe(probe1(1e-5, -0.1)), 0, "contact"});
  all.push_back({"point_lifts_off", plane, lying, contact_probe(probe1(1e-5, 0.1)), 0, "separation"});
  all.push_back({"point_lost", plane, lying, contact_probe(probe1(0., 0.25, 1e3)), 1, "contact_slack"});
  // Left strand at its deflection d, the right one taut; then the right flank of a gear. With damping, forces begin
  // with a jump.
  const auto strands = std::make_shared<Belt>(Belt::Parameters{8e4, 50., 5e-3, -0.09, 0.5});
  const auto strand  = [](double d, double v, double a = 0.) {
    return Probe{0.3, Eigen::Vector3d(d - 5e-3, 1e-4, 1e-5), Eigen::Vector3d(v, 0.1, 0.), Eigen::Vector3d(a, 0., 0.)};
  };
  all.push_back({"strand_met", std::make_shared<Belt>(Belt::Parameters{8e4, 0., 5e-3, -0.09, 0.5}), numbers(0., 1.),
                 strand(0., 0.1), 0, "left_taut"});
  all.push_back({"strand_slack", strands, numbers(1., 1.), strand(1e-4, -0.16, -1e3), 0, "left_slack"});
  all.push_back({"strand_again", strands, numbers(2., 1.), strand(1e-4, -0.16, 1e3), 0, "left_taut"});
  all.push_back({"strand_relaxed", strands, numbers(2., 1.), strand(0., -0.3), 1, "left_relaxed"});
  const auto teeth = std::make_shared<GearPair>(GearPair::Parameters{5e6, 500., -1e-4, 0.47, 0.5}, 0.2);
  const auto flank = [](double d, double v) {
    return Probe{0.3, Eigen::Vector3d(-d - 3e-4, d + 1e-4, 1e-5), Eigen::Vector3d(-v, v, 0.), Eigen::Vector3d::Zero()};
  };
  all.push_back({"flank_met", std::make_shared<GearPair>(GearPair::Parameters{5e6, 0., -1e-4, 0.47, 0.5}, 0.2),
                 numbers(0., 0.), flank(0., 0.1), 1, "right_contact"});
  all.push_back({"flank_left", teeth, numbers(0., 1.), flank(1e-5, -0.1), 1, "right_separation"});
  const auto over_u = std::make_shared<TableForce>(table(TableForce::Against::displacement));
  const auto over_v = std::make_shared<TableForce>(table(TableForce::Against::rate));
  const auto over_t = std::make_shared<TableForce>(table(TableForce::Against::time));
  all.push_back({"table_u_on", over_u, numbers(1.), probe1(0.3, 2.), 0, "next_segment"});
  all.push_back({"table_u_back", over_u, numbers(2.), probe1(0.3, -2.), 1, "previous_segment"});
  all.push_back({"table_v_on", over_v, numbers(2.), probe1(0., 0.5, 2.), 0, "next_segment"});
  all.push_back({"table_v_back", over_v, numbers(3.), probe1(0., 0.5, -2.), 1, "previous_segment"});
  all.push_back({"table_t_on", over_t, numbers(1.), probe1(0., 2.), 0, "next_segment"});
  const Formula u = Formula::variable(FormulaForce::displacement), v = Formula::variable(FormulaForce::rate);
  const auto    bent = std::make_shared<FormulaForce>(
      FormulaForce::Parameters{-80. * max(u - 0.3, 0.) * (1. + v) + power(v, 2.) * abs(u - 0.4)});
  all.push_back({"formula_up", bent, Eigen::Vector3d(-1., -1., 0.), probe1(0.3, 2.), 0, "max_1_rises"});
  all.push_back({"formula_down", bent, Eigen::Vector3d(1., 1., 0.), probe1(0.4, -2.), 1, "abs_2_falls"});
  for (const double n : {1., 2., 7.5, 8.})
  {
    const auto            blanking = std::make_shared<BlankingForce>(sheet(n));
    const std::string     power    = "_n" + std::to_string(static_cast<int>(10. * n));
    const auto            at       = [&](double z) { return loaded(*blanking, sheet_probe(z, 0.1)); };
    const Eigen::VectorXd out      = at(-1e-3);
    const auto            unloaded = [&](double z_max) // having turned at z_max
    {
      Eigen::VectorXd history = at(z_max);
      blanking->transition(0, sheet_probe(z_max, 0.).motion(true), history.data());
      return history;
    };
    const auto released = [&](double z_max)
    {
      Eigen::VectorXd history = unloaded(z_max);
      blanking->transition(0, sheet_probe(0., -0.1).motion(true), history.data());
      return history;
    };
    all.push_back({"sheet_met" + power, blanking, out, sheet_probe(0., 0.1), 0, "tool_contact"});
    all.push_back(
        {"force_maximum" + power, blanking, at(1e-3), sheet_probe(1.4e-3, 0.1), 1, "tool_force_maximum_passed"});
    all.push_back({"broken" + power, blanking, at(2e-3), sheet_probe(2.4e-3, 0.1), 1, "fracture_branch_end"});
    all.push_back({"severed" + power, blanking, at(3e-3), sheet_probe(4e-3, 0.1), 1, "sheet_severed"});
    for (const double z_max : {3e-4, 2e-3, 3e-3})
    {
      const std::string     where = power + "_at_" + std::to_string(static_cast<int>(1e6 * z_max)) + "um";
      const double          z_e   = z_max + force(*blanking, sheet_probe(z_max, 0.), at(z_max).data())[0] / 9e9;
      const Eigen::VectorXd line = unloaded(z_max), free = released(z_max);
      all.push_back({"turns" + where, blanking, at(z_max), sheet_probe(z_max, 0., -5.), 0, "tool_unload"});
      all.push_back({"releases" + where, blanking, line, sheet_probe(z_e, -0.1), 0, "tool_release"});
      all.push_back({"returns" + where, blanking, free, sheet_probe(z_e, 0.1), 0, "tool_contact"});
      all.push_back({"reloads" + where, blanking, line, sheet_probe(z_max, 0.1), 1, "tool_reload"});
    }
  }
  return all;
}

using Branches = ::testing::TestWithParam<Switch>;

// dt = 1e-7 s moves u by some 1e-8 m, far above the rounding of u = 0.15 m (3e-17 m) and far inside every branch.
constexpr double dt = 1e-7;

TEST_P(Branches, GuardsCrossZeroAtTheSwitchingPointAndTheNextOnesAreOpenAfterIt)
{
  const Switch   &s       = GetParam();
  Eigen::VectorXd history = s.history;
  ASSERT_EQ(s.element->branches()->guards(history.data())[s.guard].kind, s.kind);
  EXPECT_LT(past(*s.element, s.guard, s.probe.moved(-dt), history.data()), 0.);
  EXPECT_GT(past(*s.element, s.guard, s.probe.moved(dt), history.data()), 0.);
  EXPECT_NEAR(past(*s.element, s.guard, s.probe, history.data()), 0., 1e-15);

  s.element->branches()->transition(s.guard, s.probe.motion(true), history.data());
  for (int i = 0; i < s.element->branches()->n_guards(history.data()); ++i)
  {
    EXPECT_LE(past(*s.element, i, s.probe, history.data()), 1e-15);
    EXPECT_LT(past(*s.element, i, s.probe.moved(dt), history.data()), 0.)
        << s.element->branches()->guards(history.data())[i].kind;
  }
}

TEST_P(Branches, ForceAndEnergyDoNotJumpAtATransition)
{
  const Switch   &s       = GetParam();
  Eigen::VectorXd history = s.history;
  const auto      motion  = s.probe.motion(true);
  const auto      before  = force(*s.element, s.probe, history.data(), true);
  const double    energy  = s.element->stored_energy(motion, history.data());
  s.element->branches()->transition(s.guard, motion, history.data());
  // The switching point is exact to the rounding of u, 3e-17 m, with stiffnesses up to 9e9 N/m; F_max = 1e6 N.
  EXPECT_LT((force(*s.element, s.probe, history.data(), true) - before).norm(), 1e-6);
  EXPECT_NEAR(s.element->stored_energy(motion, history.data()), energy, 1e-12 * (1. + std::abs(energy))); // F du
}

// One branch goes on beyond its switching point with continuous first derivatives: how much they change across it falls
// with the distance, where the law by motion has a kink that stays.
TEST_P(Branches, LawOfABranchIsSmoothAcrossItsSwitchingPoints)
{
  const Switch   &s     = GetParam();
  const int       k     = s.element->n_measures();
  Eigen::VectorXd after = s.history;
  s.element->branches()->transition(s.guard, s.probe.motion(true), after.data());
  for (const Eigen::VectorXd &history : {s.history, after})
  {
    const auto slopes = [&](double time)
    {
      Eigen::VectorXd p(k);
      Eigen::MatrixXd d(k, 2 * k); // dp/du, dp/dv
      s.element->derivatives(s.probe.moved(time).motion(true), history.data(), p.data(), d.data(), d.data() + k * k);
      return d;
    };
    // Ten times nearer, ten times less (or still less); 10 N/m of rounding in slopes up to 9e9 N/m, 1e-3 N s/m.
    const Eigen::MatrixXd near = slopes(0.1 * dt) - slopes(-0.1 * dt), far = slopes(dt) - slopes(-dt);
    EXPECT_LT(near.leftCols(k).norm(), 0.11 * far.leftCols(k).norm() + 10.);
    EXPECT_LT(near.rightCols(k).norm(), 0.11 * far.rightCols(k).norm() + 1e-3);

    // Central quotient over the switching point, measure by measure.
    for (int j = 0; j < k; ++j)
    {
      const double d    = 1e-8;
      Probe        plus = s.probe, minus = s.probe;
      plus.u[j] += d, minus.u[j] -= d;
      const Eigen::VectorXd quotient =
          (force(*s.element, plus, history.data(), true) - force(*s.element, minus, history.data(), true)) / (2. * d);
      // A third derivative, up to F_max n^3 / z_m^3, times d^2 / 6 is 3 N/m; the rounding of u, 3e-17 m, 30 N/m.
      EXPECT_LT((quotient - slopes(0.).col(j)).norm(), 1e-6 * slopes(0.).norm() + 100.);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, Branches, ::testing::ValuesIn(switches()),
                         [](const auto &information) { return information.param.name; });

// --- a whole motion

std::vector<Drive> drives()
{
  return {{"sheet",
           std::make_shared<BlankingForce>(sheet(7.5)),
           [](double t) { return swinging(t, 0.1519, 4e-3, 3e-4, 20.); },
           1.2,
           {"tool_contact", "tool_unload", "tool_release", "tool_reload", "tool_force_maximum_passed",
            "fracture_branch_end", "sheet_severed"}},
          {"play",
           std::make_shared<Clearance>(play),
           [](double t)
           {
             const Probe slow = swinging(t, 1e-6, 0., 8e-5, 600.), fast = swinging(t, 0., 0., 4e-5, 9000.);
             return Probe{t, slow.u + fast.u, slow.v + fast.v, slow.a};
           },
           0.05,
           {"contact_positive", "contact_negative", "separation", "contact_slack", "contact_grip"}},
          {"stop",
           std::make_shared<Clearance>(Clearance::Parameters{1e-5, 1e9, 4., Clearance::Stops::below}),
           [](double t)
           {
             const Probe slow = swinging(t, 1e-6, 0., 8e-5, 600.), fast = swinging(t, 0., 0., 4e-5, 9000.);
             return Probe{t, slow.u + fast.u, slow.v + fast.v, slow.a};
           },
           0.05,
           {"contact", "separation", "contact_slack", "contact_grip"}},
          {"journal",
           std::make_shared<JournalBearing>(bearing),
           [](double t)
           {
             const Probe slow = swinging(t, 6e-5, 0., 5e-5, 600.), fast = swinging(t, 0., 0., 4e-5, 9000.);
             return journal_probe({t, slow.u + fast.u, slow.v + fast.v, slow.a});
           },
           0.05,
           {"contact", "separation", "contact_slack", "contact_grip"}},
          {"table_over_time",
           std::make_shared<TableForce>(table(TableForce::Against::time)),
           [](double t) { return swinging(t, 0., 0., 1., 7.); },
           1.23,
           {"next_segment"}},
          {"table_over_displacement",
           std::make_shared<TableForce>(table(TableForce::Against::displacement)),
           [](double t) { return swinging(t, 0.4, 0., 0.7, 7.); },
           3.,
           {"next_segment", "previous_segment"}},
          {"table_over_rate",
           std::make_shared<TableForce>(table(TableForce::Against::rate)),
           [](double t) { return swinging(t, 0., 0.4, 0.1, 7.); },
           3.,
           {"next_segment", "previous_segment"}},
          {"formula",
           std::make_shared<FormulaForce>(FormulaForce::Parameters{kinked_force()}),
           [](double t) { return swinging(t, 0.4, 0., 0.7, 7.); },
           3.,
           // The others change sides at rest, and come into play on the right one.
           {"if_1_rises", "if_1_falls", "abs_2_rises", "max_3_rises", "max_3_falls", "sign_4_falls", "step_5_rises"}},
          {"rod",
           std::make_shared<ConnectingRod>(rod),
           [](double t)
           {
             const Probe  slide = swinging(t, -2e-4, 0., 5e-4, 300.);
             const double phi = 2.5 + 3. * t, d = 1e-6;
             const double rate = (rod_position(phi + d) - rod_position(phi - d)) / (2. * d);
             return Probe{t, Eigen::Vector3d(phi, slide.u[0] - rod_position(phi), 0.),
                          Eigen::Vector3d(3., slide.v[0] - 3. * rate, 0.), Eigen::Vector3d::Zero()};
           },
           0.1,
           {"conrod_open", "conrod_close_compression", "conrod_close_tension", "conrod_leave_tension"}},
          {"tool",
           std::make_shared<CuttingForce>(tool),
           [](double t) { return swinging(t, 3e-4, 0., 8e-4, 100.); },
           0.2,
           {"tool_contact", "tool_release"}}};
}

using Path = ::testing::TestWithParam<Drive>;

TEST_P(Path, LawFollowedByItsGuardsIsTheLawOfTheMotion)
{
  expect_guards_to_tell_every_branch(GetParam());
}

INSTANTIATE_TEST_SUITE_P(All, Path, ::testing::ValuesIn(drives()),
                         [](const auto &information) { return information.param.name; });

// --- trial motions far away

TEST(Continuation, StaysFiniteFarBeyondTheSwitchingPoint)
{
  const ConnectingRod conrod(rod);
  const CuttingForce  cut(tool);
  const double        in_contact = 1., compressed = started(conrod, rod_probe(1e-4, 0.))[0];
  Eigen::VectorXd     p(3);
  Eigen::MatrixXd     dp(3, 3);
  conrod.tangent(rod_probe(-0.3, 1.).motion(true), &compressed, {1., 1e5, 0.}, p.data(), dp.data());
  EXPECT_TRUE(p.allFinite() && dp.allFinite()); // exp(3000) is not
  cut.tangent(probe1(-1., 1.).motion(true), &in_contact, {1., 1e5, 0.}, p.data(), dp.data());
  EXPECT_TRUE(std::isfinite(p[0]) && std::isfinite(dp(0, 0)));
}

TEST(Continuation, ByTangentsIsSmoothWhereItBegins)
{
  const ConnectingRod conrod(rod);
  const CuttingForce  cut(tool);
  const double        in_contact = 1., compressed = started(conrod, rod_probe(1e-4, 0.))[0], d = 1e-10;
  const auto          slope = [](const ForceLaw &element, const Probe &probe, const double *history)
  {
    Eigen::VectorXd p(3);
    Eigen::MatrixXd du(3, 3), dv(3, 3);
    element.derivatives(probe.motion(true), history, p.data(), du.data(), dv.data());
    return Eigen::Vector3d(p[0], du(0, 0), dv(0, 0));
  };
  const auto expect_equal = [](const Eigen::Vector3d &left, const Eigen::Vector3d &right)
  {
    for (int i = 0; i < 3; ++i)
      EXPECT_NEAR(left[i], right[i], 1e-5 * std::abs(left[i])); // 2 d over the lengths p0, z_p: 2e-6
  };
  const double start_rod = -rod.closing_length, start_cut = tool.contact_at - tool.peak_penetration;
  expect_equal(slope(conrod, rod_probe(start_rod - d, 0.5), &compressed),
               slope(conrod, rod_probe(start_rod + d, 0.5), &compressed));
  expect_equal(slope(cut, probe1(start_cut - d, 0.01), &in_contact),
               slope(cut, probe1(start_cut + d, 0.01), &in_contact));
}

} // namespace
} // namespace gestell::tests
