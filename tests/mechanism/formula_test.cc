#include "mechanism/functions/formula.h"
#include "tests/support/allocation_counter.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using namespace mechanism;

const Formula x = Formula::variable(0), y = Formula::variable(1), z = Formula::variable(2);

double value_of(const Formula &f, double at, const double *sides = nullptr)
{
  return f.value(&at, sides);
}

// --- derivatives

/// A formula of x beside f, f' and f'' by hand.
struct ByHand
{
  std::string                                 name;
  Formula                                     formula;
  std::function<Formula::Derivatives(double)> expected;
};

std::ostream &operator<<(std::ostream &out, const ByHand &f)
{
  return out << f.name;
}

using D = Formula::Derivatives;

std::vector<ByHand> by_hand()
{
  using std::cos, std::exp, std::log, std::pow, std::sin, std::sqrt;
  return {{"sine", applied(Function::sin, 3. * x),
           [](double s) {
             return D{sin(3. * s), 3. * cos(3. * s), -9. * sin(3. * s)};
           }},
          {"cosine", applied(Function::cos, x),
           [](double s) {
             return D{cos(s), -sin(s), -cos(s)};
           }},
          {"tangent", applied(Function::tan, x),
           [](double s)
           {
             const double c = cos(s);
             return D{std::tan(s), 1. / (c * c), 2. * sin(s) / (c * c * c)};
           }},
          {"root", power(x, 0.5),
           [](double s) {
             return D{sqrt(s), 0.5 / sqrt(s), -0.25 / (s * sqrt(s))};
           }},
          {"exponential", applied(Function::exp, -2. * x),
           [](double s) {
             return D{exp(-2. * s), -2. * exp(-2. * s), 4. * exp(-2. * s)};
           }},
          {"logarithm", applied(Function::log, x),
           [](double s) {
             return D{log(s), 1. / s, -1. / (s * s)};
           }},
          {"tanh", applied(Function::tanh, x),
           [](double s)
           {
             const double h = std::tanh(s);
             return D{h, 1. - h * h, -2. * h * (1. - h * h)};
           }},
          {"arctangent", applied(Function::atan, x),
           [](double s)
           {
             const double r = 1. + s * s;
             return D{std::atan(s), 1. / r, -2. * s / (r * r)};
           }},
          {"cube", power(x, 3.),
           [](double s) {
             return D{s * s * s, 3. * s * s, 6. * s};
           }},
          {"inverse_square", power(x, -2.),
           [](double s) {
             return D{pow(s, -2), -2. * pow(s, -3), 6. * pow(s, -4)};
           }},
          {"real_power", power(x, 2.5),
           [](double s) {
             return D{pow(s, 2.5), 2.5 * pow(s, 1.5), 3.75 * sqrt(s)};
           }},
          {"high_power", power(x, 40.),
           [](double s) {
             return D{pow(s, 40), 40. * pow(s, 39), 1560. * pow(s, 38)};
           }},
          {"power_of_two", power(2., x),
           [](double s) {
             return D{pow(2., s), log(2.) * pow(2., s), log(2.) * log(2.) * pow(2., s)};
           }},
          {"quotient", (1. - x) / (2. + x),
           [](double s) {
             return D{(1. - s) / (2. + s), -3. / pow(2. + s, 2), 6. / pow(2. + s, 3)};
           }},
          {"product", x * applied(Function::exp, x),
           [](double s) {
             return D{s * exp(s), (1. + s) * exp(s), (2. + s) * exp(s)};
           }},
          {"angle", atan2(applied(Function::sin, 2. * x), applied(Function::cos, 2. * x)),
           [](double s) {
             return D{2. * s, 2., 0.};
           }},
          {"modulus", abs(1. - power(x, 2.)),
           [](double s)
           {
             const double side = s < 1. ? 1. : -1.;
             return D{side * (1. - s * s), -2. * side * s, -2. * side};
           }},
          {"larger", max(x, power(x, 2.)),
           [](double s) {
             return s < 1. ? D{s, 1., 0.} : D{s * s, 2. * s, 2.};
           }},
          {"smaller", min(x, power(x, 2.)),
           [](double s) {
             return s < 1. ? D{s * s, 2. * s, 2.} : D{s, 1., 0.};
           }},
          {"choice", conditional(x - 1., Relation::not_above, power(x, 3.), 3. * x - 2.), [](double s) {
             return s <= 1. ? D{s * s * s, 3. * s * s, 6. * s} : D{3. * s - 2., 3., 0.};
           }}};
}

using Derivatives = ::testing::TestWithParam<ByHand>;

TEST_P(Derivatives, OfDualsAreThoseByHand)
{
  const ByHand &f = GetParam();
  for (const double s : {0.3, 0.7, 1.3})
  {
    const double direction = 1.;
    const D      found = f.formula.along(&s, &direction), expected = f.expected(s);
    const auto   near = [](double a, double b) { return std::abs(a - b) <= 1e-13 * (1. + std::abs(b)); }; // roundings
    EXPECT_TRUE(near(found.value, expected.value)) << found.value << " for " << expected.value;
    EXPECT_TRUE(near(found.first, expected.first)) << found.first << " for " << expected.first;
    EXPECT_TRUE(near(found.second, expected.second)) << found.second << " for " << expected.second;
    EXPECT_DOUBLE_EQ(value_of(f.formula, s), found.value); // one program for every number
  }
}

INSTANTIATE_TEST_SUITE_P(ByHand, Derivatives, ::testing::ValuesIn(by_hand()),
                         [](const auto &information) { return information.param.name; });

TEST(Formula, HasMixedSecondDerivatives)
{
  // (d/ds)^2 of x^2 sin(y) along d: 2 dx^2 sin y + 4 x dx dy cos y - x^2 dy^2 sin y.
  const Formula f   = power(x, 2.) * applied(Function::sin, y);
  const double  p[] = {1.7, 0.4}, d[] = {-0.6, 2.1}, s = std::sin(p[1]), c = std::cos(p[1]);
  const auto    found = f.along(p, d);
  EXPECT_NEAR(found.first, 2. * p[0] * d[0] * s + p[0] * p[0] * d[1] * c, 1e-14 * 10.);
  EXPECT_NEAR(found.second, 2. * d[0] * d[0] * s + 4. * p[0] * d[0] * d[1] * c - p[0] * p[0] * d[1] * d[1] * s,
              1e-14 * 10.);
}

TEST(Formula, KnowsWhatItDependsOn)
{
  const Formula f = 2. * z + 3. - x;
  EXPECT_EQ(f.n_variables(), 3);
  EXPECT_FALSE(f.is_constant());
  EXPECT_EQ(Formula(3.).n_variables(), 0);
}

TEST(Formula, FoldsItsConstants)
{
  const Formula two = 2., f = applied(Function::sin, power(two, 3.) - 1.) / max(two, abs(Formula(-5.)));
  ASSERT_TRUE(f.is_constant());
  EXPECT_EQ(f.constant(), std::sin(7.) / 5.);
  EXPECT_EQ(f.n_kinks(), 0);
  EXPECT_EQ(conditional(two, Relation::below, x, y).n_variables(), 2); // y alone
}

// --- kinks

TEST(Formula, GoesOnSmoothlyOnTheSideItIsGiven)
{
  const double above = 1., below = -1.;
  EXPECT_EQ(value_of(abs(x), -0.2), 0.2);
  EXPECT_EQ(value_of(abs(x), -0.2, &above), -0.2);
  EXPECT_EQ(value_of(abs(x), 0.2, &below), -0.2);
  EXPECT_EQ(value_of(max(x, 1.), 0.8, &above), 0.8);
  EXPECT_EQ(value_of(min(x, 1.), 0.8, &above), 1.);
  EXPECT_EQ(value_of(step(x), -0.1, &above), 1.);
  EXPECT_EQ(value_of(step(x), 0.1, &below), 0.);
  EXPECT_EQ(value_of(sign(x), 0.1, &below), -1.);
  const Formula choice = conditional(x, Relation::above, 10. + x, 20. + x);
  EXPECT_EQ(value_of(choice, -0.5, &above), 9.5);
  EXPECT_EQ(value_of(choice, 0.5, &below), 20.5);
}

TEST(Formula, IsAtAKinkWhatTheFunctionSaysThere)
{
  EXPECT_EQ(value_of(sign(x), 0.), 0.);
  EXPECT_EQ(value_of(step(x), 0.), 1.);
  const auto chosen = [](Relation relation) { return value_of(conditional(x, relation, 1., 2.), 0.); };
  EXPECT_EQ(chosen(Relation::above), 2.);
  EXPECT_EQ(chosen(Relation::not_below), 1.);
  EXPECT_EQ(chosen(Relation::below), 2.);
  EXPECT_EQ(chosen(Relation::not_above), 1.);
}

TEST(Formula, TellsTheArgumentsOfTheKinksOnItsWay)
{
  const Formula f = abs(x - 1.) + conditional(x - 2., Relation::below, max(x, 3.), sign(x - 5.));
  ASSERT_EQ(f.kinks(), (std::vector<std::string>{"abs", "if", "max", "sign"}));
  double       arguments[] = {77., 77., 77., 77.};
  const double at          = 1.5;
  f.kink_arguments(&at, nullptr, arguments);
  EXPECT_EQ(arguments[0], 0.5);
  EXPECT_EQ(arguments[1], -0.5);
  EXPECT_EQ(arguments[2], -1.5);
  EXPECT_EQ(arguments[3], 77.); // in the part that was not chosen
}

TEST(Formula, EvaluatesTheChosenPartOnly)
{
  const Formula f = conditional(x, Relation::above, power(x, 0.5), 0.);
  EXPECT_EQ(value_of(f, -1.), 0.);
  EXPECT_EQ(value_of(f, 4.), 2.);
}

TEST(Formula, GoesOnAsAnOddRootBeyondAKinkOnly)
{
  const Formula hertz = power(max(x, 0.), 1.5);
  const double  above = 1., at = -0.04, direction = 1.;
  EXPECT_EQ(value_of(hertz, at), 0.);
  EXPECT_NEAR(value_of(hertz, at, &above), -0.008, 1e-17);
  EXPECT_NEAR(hertz.along(&at, &direction, &above).first, 1.5 * 0.2, 1e-15); // as at 0.04: the slope goes on
  EXPECT_TRUE(std::isnan(value_of(power(x, 1.5), at)));
}

TEST(Formula, DoesNotHideWhatIsNotANumber)
{
  const Formula root = power(x, 0.5);
  for (const Formula &f : {max(root, 0.), min(0., root), conditional(root, Relation::above, 1., 2.), sign(root),
                           step(root), abs(root), 0. * root})
    EXPECT_TRUE(std::isnan(value_of(f, -1.)));
}

// --- limits

TEST(Formula, IsEvaluatedWithoutAllocation)
{
  using Dual        = Eigen::AutoDiffScalar<Eigen::Matrix<double, 2, 1>>;
  const Formula f   = abs(x) * power(y, 3.) + conditional(x, Relation::above, applied(Function::sin, z), max(x, y));
  const double  p[] = {0.3, -2., 1.}, d[] = {1., 1., 1.};
  const Dual    q[]    = {Dual(0.3, 2, 0), Dual(-2., 2, 1), Dual(1.)};
  const long    before = allocations;
  double        sum    = 0.;
  for (int i = 0; i < 10; ++i)
    sum += f.value(p) + f.value(q).derivatives()[0] + f.along(p, d).second;
  const long of_formulas = allocations - before;
  EXPECT_NE(sum, 0.);
  EXPECT_EQ(of_formulas, 0);
  const std::vector<double> counted(3, sum);
  EXPECT_EQ(allocations > before, counts_allocations); // not where the memory belongs to a sanitizer
}

TEST(Formula, RefusesWhatItCannotHold)
{
  EXPECT_THROW(Formula::variable(-1), std::invalid_argument);
  EXPECT_THROW(Formula::variable(Formula::max_variables), std::invalid_argument);
  Formula    deep   = x;
  const auto deepen = [&]
  {
    for (int i = 0; i <= Formula::max_depth; ++i)
      deep = (x + i) * deep;
  };
  EXPECT_THROW(deepen(), std::invalid_argument);
  Formula    bent = x;
  const auto bend = [&]
  {
    for (int i = 0; i <= Formula::max_kinks; ++i)
      bent = abs(bent - 1.);
  };
  EXPECT_THROW(bend(), std::invalid_argument);
  EXPECT_EQ(bent.n_kinks(), Formula::max_kinks); // as many as there may be
}

} // namespace
} // namespace gestell::tests
