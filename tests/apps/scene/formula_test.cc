// Formulas: from the text with units to the program, and the element "formula force" from the scene to the motion.

#include "apps/scene/language/parse_quantity.h"
#include "coupling/machine/configuration/dense_matrices.h"
#include "tests/support/scene_motion.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace apps;

// --- reading

const std::vector<Variable> motion_variables = {
    {"t", "time", {0, 0, 1}}, {"u", "displacement", {1, 0, 0}}, {"v", "its rate", {1, 0, -1}}};

std::optional<Quantity> parameter(const std::string &name)
{
  static const std::map<std::string, Quantity> known = {
      {"gap", {0.01, {1, 0, 0}, true, Counts::nothing}},
      {"stiffness", {2e4, {0, 1, -2}, true, Counts::nothing}},
      {"plain", {3., {}, false, Counts::nothing}}, // written as a number: of any dimension
  };
  const auto found = known.find(name);
  return found == known.end() ? std::nullopt : std::optional<Quantity>(found->second);
}

mechanism::Formula read(const std::string &text, const Kind &kind = kind::force)
{
  return formula_as(parse_expression(text, motion_variables, parameter, {"gap", "stiffness", "plain"}), kind, text);
}

std::string complaint_about(const std::string &text, const Kind &kind = kind::force)
{
  return refusal([&] { read(text, kind); });
}

struct Law
{
  std::string text;
  double (*expected)(double t, double u, double v);
};

std::ostream &operator<<(std::ostream &out, const Law &law)
{
  return out << law.text;
}

using FormulaText = ::testing::TestWithParam<Law>;

TEST_P(FormulaText, IsTheLawAnEngineerMeans)
{
  const mechanism::Formula f = read(GetParam().text);
  for (const double t : {0., 0.03})
    for (const double u : {-0.02, 0.004, 0.05})
      for (const double v : {-0.5, 1.5})
      {
        const double x[] = {t, u, v}, expected = GetParam().expected(t, u, v);
        EXPECT_NEAR(f.value(x), expected, 1e-14 * (std::abs(expected) + 100.))
            << t << " " << u << " " << v; // roundings
      }
}

INSTANTIATE_TEST_SUITE_P(
    Laws, FormulaText,
    ::testing::Values(
        Law{"-(900 N/m)*u - 5e6 N/m^3 * u^3 - 20 N s/m * v + 10 N*sin(2*pi*3 Hz*t)", [](double t, double u, double v)
            { return -900. * u - 5e6 * u * u * u - 20. * v + 10. * std::sin(6. * M_PI * t); }},
        Law{"-stiffness * max(0, u - gap)", [](double, double u, double) { return -2e4 * std::max(0., u - 0.01); }},
        Law{"-stiffness * max(u/mm - 10, 0) * mm",
            [](double, double u, double) { return -2e4 * std::max(u - 0.01, 0.); }},
        Law{"-6 N * tanh(v / (1 cm/s)) * (1 + 0.2*abs(u)/gap)",
            [](double, double u, double v) { return -6. * std::tanh(v / 0.01) * (1. + 20. * std::abs(u)); }},
        Law{"if(u < gap, 0, if(v >= 0, -40 N, -10 N))",
            [](double, double u, double v) { return u < 0.01  ? 0.
                                                    : v >= 0. ? -40.
                                                              : -10.; }},
        Law{"if(t > 20 ms, 100 N, 5 kN*t/s)", [](double t, double, double) { return t > 0.02 ? 100. : 5e3 * t; }},
        Law{"-8 N*sign(v)*step(u - gap)",
            [](double, double u, double v) { return u >= 0.01 ? (v > 0. ? -8. : 8.) : 0.; }},
        Law{"3 N * 2^(u/gap) - 1 N*atan(u/gap) + 2 N*atan2(v, 1 m/s) + min(u, gap) * 2 N/m",
            [](double, double u, double v) {
              return 3. * std::pow(2., u / 0.01) - std::atan(u / 0.01) + 2. * std::atan2(v, 1.) +
                     2. * std::min(u, 0.01);
            }},
        Law{"5 N * sqrt(u^2 + gap^2) / gap * exp(-t/(10 ms))",
            [](double t, double u, double) { return 500. * std::hypot(u, 0.01) * std::exp(-t / 0.01); }},
        Law{"plain*u + 1 N", [](double, double u, double) { return 3. * u + 1.; }},
        Law{"12 N", [](double, double, double) { return 12.; }}));

TEST(FormulaText, ReportsWhatIsWrongAndAtWhichCharacter)
{
  struct Mistake
  {
    std::string text, words;
  };
  const std::vector<Mistake> mistakes = {
      {"900 N/m*u + 3 mm", "adds m to N; both must have the same dimension (character 11)"},
      {"900 N/m*u - 20 N*v", "subtracts kg m^2/s^3 from N; both must have the same dimension (character 11)"},
      {"900 N/m*u + stifness*u", "names 'stifness', which is neither a variable, a parameter nor a unit; did you mean "
                                 "'stiffness'?; the variables are t (time), u (displacement), v (its rate)"},
      {"900 N/m*u + stifness*u", "(character 13)"},
      {"900 N/m*w", "names 'w'"},
      {"3 N*sine(t/s)", "calls an unknown function 'sine'; did you mean 'sin'? (character 5)"},
      {"3 N*sin(t)", "takes sin() of s; it needs a plain number or an angle (character 5)"},
      {"3 µm * 5 N/m * exp(u)", "takes exp() of m; it needs a plain number or an angle (character 16)"}, // not bytes
      {"5 N u", "lacks an operator (* / + -) before 'u' (character 5)"},
      {"5 N t", "uses 't', which is a unit and a variable"},
      {"if(u < 3 kg, 1 N, 2 N)", "compares kg with m; both must have the same dimension (character 6)"},
      {"if(u < gap, 1 N, 2 m)", "chooses between m and N; both must have the same dimension (character 1)"},
      {"if(u, 1 N, 2 N)", "has an if() without a comparison (< <= > >=) as its first argument (character 5)"},
      {"if(u < gap, 1 N)", "gives if() too few arguments"},
      {"(u < gap) * 1 N", "closing ')'"},
      {"u < gap", "compares outside of a condition"},
      {"u^v * 1 N", "has an exponent with a unit (character 2)"},
      {"u^(v s/m) * 1 N", "character"},
      {"(-2)^(t/s) * 1 N", "raises a number that is not above zero to an exponent that varies (character 5)"},
      {"1 N * (u^(t/s))", "raises m to an exponent that varies; only a plain number can have one (character 9)"},
      {"3 N*u/0", "divides by zero (character 6)"},
      {"3 N*(u/mm)*log(0)", "is not a finite number (character 12)"},
      {"3 N*max(u)", "gives max() 1 arguments instead of 2 (character 5)"},
      {"3 N*(u", "lacks a closing ')' (character 7)"},
      {"900 N/m^2*u", "needs a force such as \"46 kN\", got \"900 N/m^2*u\", which is in N/m"},
      {"u/m", "without a unit"},
      {"3 kg", "needs a force such as \"46 kN\", got \"3 kg\", 3 kg"}};
  for (const auto &[text, words] : mistakes)
    EXPECT_NE(complaint_about(text).find(words), std::string::npos) << text << "\nsaid: " << complaint_about(text);
}

TEST(FormulaText, InferredFromAValueIsOneOfTheVariablesOnlyWhereThereAreAny)
{
  const auto nothing = [](const std::string &) { return std::optional<Quantity>(); };
  EXPECT_THROW(parse_quantity("2*u", nothing), std::invalid_argument);
  EXPECT_DOUBLE_EQ(parse_quantity("2*t", nothing).value, 2000.); // tonnes
}

TEST(FormulaText, OfEverySizeIsReadOrRefused)
{
  std::string flat = "u", deep = "u";
  for (int i = 0; i < 200; ++i)
    flat += " + u";
  for (int i = 0; i < 100; ++i)
    deep = "u + (" + deep + ")";
  const double x[] = {0., 2., 0.};
  EXPECT_EQ(read(flat, kind::length).value(x), 402.);
  EXPECT_NE(complaint_about(deep, kind::length).find("nesting of parentheses"), std::string::npos);
}

// --- the element

const std::string formula_slider = "[parameters]\ngap = '10 mm'\nk   = '20 N/mm'\n" +
                                   slider_body("slide", "2", "[1, 0, 0]") + start("v = { slide = 1 }") +
                                   "[run]\nend = '0.2 s'\n" +
                                   signals("x = 'slide.displacement', v = 'slide.velocity', F = 'law.force'");

std::string law(const std::string &formula)
{
  return "[element.law]\ntype = \"formula force\"\nfrom = \"slide\"\nforce = \"" + formula + "\"\n";
}

const Settings bdf_20us = {"run.step=10 us"}, controlled = {"run.tolerance=1e-9"},
               exactly = {"run.method=exact", "run.tolerance=1e-10"};

using FormulaRun = ::testing::TestWithParam<Settings>;

TEST_P(FormulaRun, OfACubicSpringIsThatOfTheElement)
{
  const SceneRun formula = run(formula_slider + law("-k*u - 5e8 N/m^3 * u^3"), GetParam());
  const SceneRun element = run(formula_slider + "[element.law]\ntype = \"cubic spring\"\nfrom = \"slide\"\n"
                                                "stiffness = \"k\"\ncubic = \"5e8 N/m^3\"\n",
                               GetParam());
  ASSERT_EQ(formula.n_rows(), element.n_rows());
  // Two ways to sum up the same force; what Newton leaves, 1e-10 of a correction, is the same in both.
  for (std::size_t row = 0; row < formula.n_rows(); row += 50)
    EXPECT_NEAR(formula.at(row, 1), element.at(row, 1), 1e-11 * element.signal("x").max) << row;
  EXPECT_NEAR(formula.signal("F").max, -element.signal("F").min, 1e-9 * element.signal("F").max); // acts, resists
  EXPECT_LT(formula.result.energy.residual, 1e-4);
}

TEST_P(FormulaRun, LocatesItsKinks)
{
  // Free to 10 mm at 1 m/s, there a spring: half a period of omega = 100 1/s, and back.
  const SceneRun motion = run(formula_slider + law("-k*max(u - gap, 0)"), GetParam());
  EXPECT_NEAR(time_of(motion, "max_1_rises"), 0.01, 1e-9);
  EXPECT_NEAR(time_of(motion, "max_1_falls"), 0.01 + M_PI / 100., 1e-7);
  EXPECT_EQ(motion.result.events.size(), 2u);
  EXPECT_NEAR(motion.signal("v").final, -1., 1e-6);
  EXPECT_NEAR(motion.signal("F").min, -2e4 * 0.01, 1e-3);
}

TEST_P(FormulaRun, OfAContactAfterHertzGivesBackTheSpeed)
{
  const SceneRun motion = run(formula_slider + law("-9 N * (max(u - gap, 0)/mm)^1.5"), GetParam());
  EXPECT_NEAR(time_of(motion, "max_1_rises"), 0.01, 1e-9);
  EXPECT_NEAR(motion.signal("v").final, -1., 1e-5);
  // m v^2/2 = c/2.5 d^2.5 with c = 9 N/mm^1.5
  EXPECT_NEAR(motion.signal("x").max, 0.01 + 1e-3 * std::pow(2.5 * 1000. / 9., 0.4), 1e-6);
}

TEST_P(FormulaRun, LocatesItsJumps)
{
  const SceneRun motion = run(formula_slider + law("if(t < 20 ms, 0, if(t < 50 ms, -40 N, 10 N))"), GetParam());
  EXPECT_NEAR(time_of(motion, "if_1_rises"), 0.02, 1e-12);
  EXPECT_NEAR(time_of(motion, "if_2_rises"), 0.05, 1e-12);
  EXPECT_NEAR(motion.signal("v").final, 1. - 20. * 0.03 + 5. * 0.15, 1e-6);
  EXPECT_NEAR(motion.signal("x").final, 0.2 - 0.6 * (0.2 - 0.035) + 0.5 * 5. * 0.15 * 0.15, 1e-6);
}
INSTANTIATE_TEST_SUITE_P(Methods, FormulaRun,
                         ::testing::Values(bdf_20us, controlled, exactly,
                                           Settings{"run.method=newmark", "run.step=10 us"}));

TEST(FormulaForceElement, TellsItsEventsAfterwardsToo)
{
  const SceneRun motion =
      run(formula_slider + law("-k*abs(u - gap)*step(u - gap) + 0*abs(v)*1 N s/m + 0*abs(u)*1 N/m + "
                               "0*abs(u - 5 mm)*1 N/m + 0*abs(u - 6 mm)*1 N/m + 0*abs(u - 7 mm)*1 N/m + "
                               "0*abs(u - 8 mm)*1 N/m + 0*abs(u - 9 mm)*1 N/m + 0*abs(u - 9.5 mm)*1 N/m"),
          {"run.step=10 us", "run.events=false"});
  EXPECT_NEAR(time_of(motion, "abs_5_rises"), 5e-3, 1e-9);
  EXPECT_NEAR(time_of(motion, "abs_10_rises"), 9.5e-3, 1e-9);
  EXPECT_NEAR(time_of(motion, "step_2_falls"), 0.01 + M_PI / 100., 1e-5);
}

const std::string twisted =
    rotor_body("wheel", "0.5", "[0, 0, 1]") +
    element("shaft", "formula force",
            {{"from", "wheel"}, {"force", "-(200 N m/rad)*u - 3 N m s/rad * v - 40 N m * (u/rad)^3"}}) +
    start("q = { wheel = '0.1 rad' }") + steps("1 ms", "1 s") + signals("M = 'shaft.torque', a = 'shaft.angle'");

TEST(FormulaForceElement, TurnsWhatTurns)
{
  const SceneRun motion = run(twisted);
  EXPECT_EQ(motion.signal("M").unit, "N m");
  EXPECT_NEAR(motion.at(0, 1), -20. - 40e-3, 1e-9);
  EXPECT_LT(std::abs(motion.signal("a").final), 0.1 * std::exp(-3.)); // decays with b/(2 J) = 3 1/s
}

TEST(FormulaForceElement, IsStructureByItsDerivatives)
{
  const test::SceneFolder folder;
  const Scene             scene   = read_scene(folder.write("scene.toml", twisted));
  const coupling::Machine machine = build_machine(scene);
  Eigen::MatrixXd         K, D;
  coupling::engaged_matrices(machine, Eigen::VectorXd::Constant(1, 0.1), {}, K, D);
  EXPECT_NEAR(K(0, 0), 200. + 120. * 0.01, 1e-12);
  EXPECT_NEAR(D(0, 0), 3., 1e-12);
}

TEST(FormulaForceElement, RefusesWhatMakesNoSense)
{
  const auto said = [](const std::string &formula)
  { return test::complaint(formula_slider + law(formula), {"run.step=1 ms"}); };
  EXPECT_EQ(said("-k*u"), "");
  EXPECT_EQ(said("-k*u + 3 mm").find("scene.toml:18: element.law.force: \"-k*u + 3 mm\" adds m to N"), 0u)
      << said("-k*u + 3 mm");
  EXPECT_NE(said("-k*u^2").find("needs a force such as"), std::string::npos);
  EXPECT_NE(said("-kk*u").find("did you mean 'k'"), std::string::npos) << said("-kk*u");
  EXPECT_NE(test::complaint(formula_slider + law("-k*u"), {"run.step=1 ms", "parameters.u=3"})
                .find("a variable of the formula and a parameter"),
            std::string::npos);
  EXPECT_NE(
      test::complaint(formula_slider + "[element.law]\ntype = \"formula force\"\nfrom = \"slide\"\n", {"run.step=1 ms"})
          .find("the key 'force' is missing"),
      std::string::npos);
}

TEST(FormulaForceElement, ThatFallsOverTheRateIsDryFrictionThatChatters)
{
  const SceneRun motion = run(formula_slider + law("-20 N*sign(v)"), {"run.step=0.1 ms", "run.end=0.15 s"});
  EXPECT_NEAR(time_of(motion, "sign_1_falls"), 0.1, 1e-9);
  EXPECT_NEAR(motion.signal("v").final, 0., 2. * 10. * 1e-4); // to and fro within a step
  EXPECT_NEAR(motion.signal("x").final, 0.05, 1e-4);
}

TEST(FormulaForceElement, ThatIsNotANumberStopsTheRun)
{
  for (const std::string formula : {"1 N*sqrt(0.1 - u/m)", "1 N*sqrt(0.1 - abs(u/m))"}) // u comes to 0.1 m at 1 m/s
  {
    const SceneRun motion = stopped(formula_slider + law(formula), {"run.step=1 ms"});
    EXPECT_NE(motion.result.failure, "") << formula;
    EXPECT_NEAR(motion.at(motion.n_rows() - 1, 0), 0.1, 0.01) << formula;
  }
}

} // namespace
} // namespace gestell::tests
