// Values of scenes: "40 mm", "2*crank_radius - 8 mm", "600 kN s/m".

#include "apps/scene/language/parse_quantity.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::apps;

std::optional<Quantity> parameter(const std::string &name)
{
  static const std::map<std::string, Quantity> known = {
      {"crank_radius", {0.08, {1, 0, 0}, true, Counts::nothing}},
      {"m1", {9500., {0, 1, 0}, true, Counts::nothing}},
      {"g", {9.81, {1, 0, -2}, true, Counts::nothing}},
      {"h", {0.004, {1, 0, 0}, true, Counts::nothing}},
      {"plain", {3., {}, false, Counts::nothing}}, // written as a number: of any dimension
  };
  const auto found = known.find(name);
  return found == known.end() ? std::nullopt : std::optional<Quantity>(found->second);
}

Quantity read(const std::string &text)
{
  return parse_quantity(text, parameter);
}

std::string quantity_complaint(const std::string &text)
{
  return gestell::tests::refusal([&] { read(text); });
}

std::string quantity_complaint(const std::string &text, const Kind &kind)
{
  return gestell::tests::refusal([&] { value_as(read(text), kind, text); });
}

void expect_words(const std::string &said, const std::string &words)
{
  EXPECT_THAT(said, ::testing::HasSubstr(words));
}

struct Reading
{
  std::string text;
  double      value;
  Dimension   dimension; // metre, kilogram, second
};

void PrintTo(const Reading &reading, std::ostream *out)
{
  *out << '"' << reading.text << '"';
}

using QuantityOf = ::testing::TestWithParam<Reading>;

TEST_P(QuantityOf, HasTheValueAndDimensionAnEngineerMeans)
{
  const auto &[text, value, dimension] = GetParam();
  const Quantity quantity              = read(text);
  EXPECT_NEAR(quantity.value, value, 1e-14 * std::abs(value)) << text; // a few roundings
  for (int i = 0; i < 3; ++i)
    EXPECT_NEAR(quantity.dimension[i], dimension[i], 1e-12) << text << ", exponent " << i;
}

INSTANTIATE_TEST_SUITE_P(
    Units, QuantityOf,
    ::testing::Values(Reading{"40 mm", 0.04, {1, 0, 0}}, Reading{"60 l/min", 1e-3, {3, 0, -1}},
                      Reading{"40mm", 0.04, {1, 0, 0}}, Reading{"2.5 cm", 0.025, {1, 0, 0}},
                      Reading{"30 um", 30e-6, {1, 0, 0}}, Reading{"30 µm", 30e-6, {1, 0, 0}},
                      Reading{"1e-3 m", 1e-3, {1, 0, 0}}, Reading{"10 us", 1e-5, {0, 0, 1}},
                      Reading{"2 min", 120., {0, 0, 1}}, Reading{"3 t", 3000., {0, 1, 0}},
                      Reading{"1200 kN/mm", 1.2e9, {0, 1, -2}}, Reading{"600 kN s/m", 6e5, {0, 1, -1}},
                      Reading{"600 kN*s/m", 6e5, {0, 1, -1}}, Reading{"600 kN·s/m", 6e5, {0, 1, -1}},
                      Reading{"250 kg m^2", 250., {2, 1, 0}}, Reading{"250 kg m²", 250., {2, 1, 0}},
                      Reading{"250 kg*m^2", 250., {2, 1, 0}}, Reading{"1300 kN m/rad", 1.3e6, {2, 1, -2}},
                      Reading{"3 kN m s/rad", 3000., {2, 1, -1}}, Reading{"240 Nm", 240., {2, 1, -2}},
                      Reading{"9.81 m/s^2", 9.81, {1, 0, -2}}, Reading{"9.81 m s^-2", 9.81, {1, 0, -2}},
                      Reading{"9.81 m/s/s", 9.81, {1, 0, -2}}, Reading{"7850 kg/m^3", 7850., {-3, 1, 0}},
                      Reading{"210 GPa", 210e9, {-1, 1, -2}}, Reading{"15 kW", 15e3, {2, 1, -3}},
                      Reading{"200 Hz", 200., {0, 0, -1}}, Reading{"5 1/s", 5., {0, 0, -1}},
                      Reading{"10 N/(m s)", 10., {0, 1, -3}}, Reading{"2 %", 0.02, {0, 0, 0}}));

constexpr double pi = 3.14159265358979323846;
INSTANTIATE_TEST_SUITE_P(Angles, QuantityOf,
                         ::testing::Values(Reading{"180 deg", pi, {0, 0, 0}}, Reading{"180°", pi, {0, 0, 0}},
                                           Reading{"2 rad", 2., {0, 0, 0}},
                                           // Of a shaft, 1/min means turns: 30 1/min = pi rad/s.
                                           Reading{"30 1/min", pi, {0, 0, -1}}, Reading{"30 rpm", pi, {0, 0, -1}},
                                           Reading{"sin(30 deg)", 0.5, {0, 0, 0}},
                                           Reading{"2*pi*50 rad/s", 100. * pi, {0, 0, -1}}));
INSTANTIATE_TEST_SUITE_P(
    Expressions, QuantityOf,
    ::testing::Values(Reading{"2*crank_radius - 8 mm", 0.152, {1, 0, 0}}, Reading{"1/2 * 3 kg", 1.5, {0, 1, 0}},
                      Reading{"-2^2", -4., {0, 0, 0}}, Reading{"2^3^2", 512., {0, 0, 0}},
                      Reading{"8/4/2", 1., {0, 0, 0}}, Reading{"2 - 3 - 4", -5., {0, 0, 0}},
                      Reading{"-(1 + 2) * 3", -9., {0, 0, 0}}, Reading{"(2 + 3) mm", 0.005, {1, 0, 0}},
                      Reading{"2 m^2", 2., {2, 0, 0}}, Reading{"(2 m)^2", 4., {2, 0, 0}},
                      Reading{"sqrt(16 m^2)", 4., {1, 0, 0}}, Reading{"max(3 mm, 0.2 cm)", 0.003, {1, 0, 0}},
                      Reading{"max(0, -3 mm)", 0., {1, 0, 0}}, Reading{"2 mm + 0", 0.002, {1, 0, 0}},
                      Reading{"atan2(2 m, 2 m)", pi / 4., {0, 0, 0}}, Reading{"tanh(0.5)", std::tanh(0.5), {0, 0, 0}},
                      Reading{"if(crank_radius > 8 cm, 1 kg, 2 kg)", 2., {0, 1, 0}},
                      Reading{"if(crank_radius >= 8 cm, 1 kg, 0)", 1., {0, 1, 0}},
                      Reading{"3 kg*sign(-2 m) + 1 kg*step(0)", -2., {0, 1, 0}}, Reading{"abs(-3 kg)", 3., {0, 1, 0}},
                      Reading{"exp(log(2))", 2., {0, 0, 0}}, Reading{"m1*g", 93195., {1, 1, -2}},
                      Reading{"m1 * g / (2 mm)", 46597500., {0, 1, -2}}, Reading{"crank_radius / mm", 80., {0, 0, 0}},
                      Reading{"1e3*mm", 1., {1, 0, 0}}));

TEST(Quantity, ParametersComeBeforeUnitsWhereAnOperandIsExpected)
{
  EXPECT_DOUBLE_EQ(read("2*h").value, 0.008); // sheet thickness, not hours
  EXPECT_DOUBLE_EQ(read("g").value, 9.81);    // gravity, not a gram
}

TEST(Quantity, WhatReadsInTwoWaysIsRefused)
{
  expect_words(quantity_complaint("10 N/m s"), "is ambiguous");
  expect_words(quantity_complaint("1/2 mm"), "is ambiguous");
  expect_words(quantity_complaint("3 g"), "a unit and a parameter");
  expect_words(quantity_complaint("30 km/h"), "a unit and a parameter");
}

TEST(Quantity, AddsLikeToLikeOnly)
{
  expect_words(quantity_complaint("2 mm + 3 kg"), "adds kg to m");
  expect_words(quantity_complaint("crank_radius - 8"), "subtracts a plain number from m");
  expect_words(quantity_complaint("sin(3 mm)"), "sin()");
  expect_words(quantity_complaint("2^(3 mm)"), "exponent");
}

TEST(Quantity, PlainParametersTakeTheDimensionOfTheirPlace)
{
  EXPECT_NO_THROW(read("plain + 8 mm"));
  EXPECT_DOUBLE_EQ(value_as(read("2*plain"), kind::mass, ""), 6.);
  EXPECT_DOUBLE_EQ(value_as(read("plain + 1 m"), kind::length, ""), 4.);
  EXPECT_NE(quantity_complaint("plain + 1 m", kind::mass), ""); // a length now, whatever `plain` is
}

TEST(Quantity, NonsenseIsRefusedWithTheReason)
{
  for (const auto &[text, reason] :
       std::map<std::string, std::string>{{"", "empty"},
                                          {"   ", "empty"},
                                          {"mm 3", "operator"},
                                          {"3 mmm", "did you mean 'mm'"},
                                          {"3 kG", "unknown unit"},
                                          {"2 +", "ends where"},
                                          {"(2", "closing"},
                                          {"2)", "operator"},
                                          {"2 3", "operator"},
                                          {"3 mm mm^", "exponent"},
                                          {"crank_radus", "parameter"},
                                          {"foo(3)", "unknown function"},
                                          {"max(1)", "arguments"},
                                          {"1/0", "zero"},
                                          {"sqrt(-1)", "negative"},
                                          {"10^-3 mm", "after its exponent; write 1e-3 mm"},
                                          {"2 $ 3", "'$'"},
                                          {"1e999", "range"},
                                          {"10^400", "finite"},
                                          {"log(0)", "finite"},
                                          {"3 m^1.5", "integer"},
                                          {"20 degC", "unknown unit"}})
    EXPECT_NE(quantity_complaint(text).find(reason), std::string::npos)
        << "\"" << text << "\": " << quantity_complaint(text);
}

TEST(Quantity, AMistakeIsShownWithTheCharacterItIsAt)
{
  expect_words(quantity_complaint("2*crank_radius + 3 kg"),
               "adds kg to m; both must have the same dimension (character 16)");
  expect_words(quantity_complaint("3 µm + parsec"), "(character 8)"); // of UTF-8, not bytes
  expect_words(quantity_complaint("(2"), "(character 3)");
  expect_words(quantity_complaint("sqrt(4) mm"), "lacks an operator (* / + -) before 'mm' (character 9)");
  expect_words(quantity_complaint("2 $ 3"), "(character 3)");
}

TEST(Quantity, DeepNestingIsRefusedInsteadOfOverflowingTheStack)
{
  expect_words(quantity_complaint(std::string(100000, '(')), "longer than");
}

TEST(Quantity, AWrongDimensionSaysWhatIsNeededAndWhatCame)
{
  EXPECT_EQ(quantity_complaint("3 kg", kind::length), "needs a length such as \"40 mm\", got \"3 kg\", 3 kg");
  EXPECT_EQ(
      quantity_complaint("3", kind::length),
      "needs a length such as \"40 mm\", got \"3\" without a unit; write a plain number in SI units without quotes");
  EXPECT_EQ(quantity_complaint("0", kind::length), ""); // zero of anything is zero
  expect_words(quantity_complaint("3 mm", kind::angular_speed), "an angular speed");
}

TEST(Quantity, TurnsAndRadiansPerSecondAreDistinguished)
{
  expect_words(quantity_complaint("5 Hz", kind::angular_speed), "revolutions");
  expect_words(quantity_complaint("30 rad/s", kind::frequency), "radians");
  expect_words(quantity_complaint("3 N m/Hz", kind::torsional_damping), "revolutions");
  EXPECT_EQ(quantity_complaint("30 rad/s", kind::angular_speed), "");
  EXPECT_EQ(quantity_complaint("2*pi * 1 rad * 50 Hz", kind::angular_speed), "");
  EXPECT_EQ(quantity_complaint("50 Hz", kind::frequency), "");
}

using TurnsPerMinute = ::testing::TestWithParam<std::string>;

TEST_P(TurnsPerMinute, AreTheSameTurnsOfAShaftInEverySpelling)
{
  const std::string text = GetParam();
  EXPECT_NEAR(value_as(read(text), kind::angular_speed, text), 50. * pi, 1e-13 * 50. * pi);
  EXPECT_NEAR(value_as(read(text), kind::frequency, text), 25., 1e-13 * 25.);
  EXPECT_NE(quantity_complaint(text, kind::number), "");
}

INSTANTIATE_TEST_SUITE_P(Spellings, TurnsPerMinute,
                         ::testing::Values("1500 1/min", "1500/min", "1500 /min", "1500/(min)", "1500/(1 min)",
                                           "1500 min^-1", "1500 min⁻¹", "1500 · min⁻¹", "1500 * min^-1", "1500*(1/min)",
                                           "1500 rpm", "1500 r/min", "1500 rev/min", "1500 U/min", "1500 U / min",
                                           "25 r/s", "25 U/s", "3*500/min", "3*(500 1/min)", "1e3 1/min + 500 rpm",
                                           "max(0, 1500/min)", "if(m1 > 1 t, 1500 rpm, 0)", "500*plain/min",
                                           "plain*(500 1/min)", "3000 1/min/s * 0.5 s"));

/// 1500 per minute could be 25 turns or 25 radians a second; 2 pi decides, and no check of dimensions sees it.
TEST(Quantity, WhatCouldCountTurnsOrRadiansIsRefused)
{
  for (const std::string text :
       {"1500/min*crank_radius", "crank_radius*1500 rpm", "3 N m/(1500/min)", "3 N m/rpm", "2*pi*(1500/min)",
        "(2*pi*1500) 1/min", "1/(1500/min)", "(1500/min)^2", "sqrt(9 1/min)", "exp(1500/min * 1 s)", "3/min + 2 Hz",
        "3/min + 2 1/s", "sin((2 s)*1500/min)", "3/r/min", "(3 rpm)*(2 rpm)", "2 rad * 3 rpm"})
    EXPECT_NE(quantity_complaint(text), "") << text;
  for (const std::string text : {"2*pi*1500/min", "pi/30*1500/min", "1500/(2 min)", "2 s * 1500/(1 s min)"})
    EXPECT_NE(quantity_complaint(text, kind::angular_speed).find("may count revolutions"), std::string::npos) << text;
  expect_words(quantity_complaint("(3 s)*1500/min", kind::angle), "may count revolutions");
  expect_words(quantity_complaint("3 N m/min^-1", kind::torsional_damping), "may count revolutions");
  EXPECT_EQ(quantity_complaint("100 mm/min", kind::speed), "");
  EXPECT_EQ(quantity_complaint("2 rad/min", kind::angular_speed), "");
  EXPECT_EQ(quantity_complaint("1500/(2 min)", kind::frequency), ""); // turns or not
  EXPECT_EQ(quantity_complaint("(3 min)/(2 min)", kind::number), "");
  EXPECT_EQ(quantity_complaint("1/(2*pi) * sqrt(9 N/m / m1)", kind::frequency), "");
  EXPECT_NE(quantity_complaint("3000 1/min/s", Kind{"plain rate", "3 1/s^2", {0, 0, -2}}), "");
}

/// The speed of a wheel that another one drives, in any order of the factors.
TEST(Quantity, TurnsOfAShaftTimesARatioOfLengthsAreTurns)
{
  for (const std::string text :
       {"(600 1/min)*80 mm/(200 mm)", "80 mm*(600 1/min)/(200 mm)", "80 mm/(200 mm)*600 rpm",
        "(600 1/min)*(80 mm/(200 mm))", "(600 1/min)/(200 mm)*80 mm", "80 mm*(600/min)/(200 mm)"})
    EXPECT_NEAR(value_as(read(text), kind::angular_speed, text), 8. * pi, 1e-13) << text;
  EXPECT_NEAR(value_as(read("80 mm*(600 rpm)/(200 rpm)"), kind::length, ""), 0.24, 1e-15);
  EXPECT_NEAR(value_as(read("(600 rpm)*80 mm/(200 mm)"), kind::frequency, ""), 4., 1e-14);
  expect_words(quantity_complaint("600 1/min*80 mm", kind::speed), "revolutions or radians could be meant");
  expect_words(quantity_complaint("(600 rpm)*2 kg m^2", kind::torsional_damping),
               "revolutions or radians could be meant");
  expect_words(quantity_complaint("(600 rpm)*pi*80 mm/(200 mm)", kind::angular_speed), "remove pi");
}

TEST(Quantity, TurnsOfAShaftMeetRadiansWhereTheirMeaningIsReported)
{
  EXPECT_NEAR(read("(1500 rpm)/(50 rad/s)").value, pi, 1e-14); // a ratio of speeds
  EXPECT_NEAR(read("(1500 rpm)/(500/min)").value, 3., 1e-14);
  EXPECT_NEAR(read("sin(15 rpm * 1 s)").value, 1., 1e-14); // a quarter of a turn
  EXPECT_NEAR(value_as(read("30 rpm + 1 rad/s"), kind::angular_speed, ""), pi + 1., 1e-14);
  expect_words(quantity_complaint("30 rpm + 1 rad/s", kind::frequency), "radians");
  EXPECT_NEAR(value_as(read("30 1/min * 2 s"), kind::angle, ""), 2. * pi, 1e-14);
}

TEST(Quantity, SignsOfATypesetTextMeanWhatTheyShow)
{
  EXPECT_DOUBLE_EQ(read("3 m·s⁻²").value, 3.);
  EXPECT_DOUBLE_EQ(read("2×3 mm²").value, 6e-6);
  EXPECT_DOUBLE_EQ(read("30 μm").value, 30e-6); // the Greek letter
  EXPECT_DOUBLE_EQ(read("−3 mm").value, -3e-3);
  EXPECT_DOUBLE_EQ(read("2*π").value, 2. * pi);
  EXPECT_DOUBLE_EQ(read("3\u00a0mm").value, 3e-3); // a space that does not break
  expect_words(quantity_complaint("3 mm⁻"), "raised sign");
  expect_words(quantity_complaint("3 Ω"), "'Ω', which has no meaning"); // the whole character
}

TEST(Quantity, ADecimalCommaIsNamed)
{
  expect_words(quantity_complaint("1,5 mm"), "has a decimal comma; write 1.5 (character 2)");
  expect_words(quantity_complaint("2*(1,5 mm)"), "decimal comma");
  EXPECT_DOUBLE_EQ(read("max(1,5)").value, 5.); // two arguments
}

TEST(Quantity, AProposedUnitMakesSenseInItsPlace)
{
  const auto said = [](const std::string &text, const Kind &kind)
  { return gestell::tests::refusal([&] { parse_quantity(text, parameter, {}, &kind); }); };
  expect_words(said("3 KJ", kind::torque), "did you mean 'kJ'");
  expect_words(said("3 Mn", kind::force), "did you mean 'MN'");
  EXPECT_EQ(said("3 Mn", kind::length).find("'MN'"), std::string::npos); // the nearest, but no length
  expect_words(said("3 N/mm2", kind::pressure), "did you mean 'mm^2'");
  expect_words(said("3 Nmm", kind::torque), "did you mean 'N mm'");
  expect_words(said("3 parsec", kind::length), "unknown unit 'parsec'; a length is given as \"40 mm\"");
  expect_words(said("3 RPM", kind::angular_speed), "rpm");
}

TEST(Quantity, UnitsOfTheWorkshopAreThoseOfTheirStandards)
{
  EXPECT_DOUBLE_EQ(read("3 in").value, 0.0762);
  EXPECT_DOUBLE_EQ(read("3 kp").value, 29.41995);
  EXPECT_DOUBLE_EQ(read("3 lb").value, 1.36077711);
  EXPECT_NEAR(read("3 lbf").value, 13.3446648458, 1e-9);
  EXPECT_NEAR(read("3 psi").value, 20684.27188, 1e-5);
  EXPECT_NEAR(read("3 PS").value, 2206.49625, 1e-9);
  EXPECT_NE(quantity_complaint("3 lb", kind::force), ""); // a mass
}

TEST(Quantity, MatrixEntriesMayCarryPowersOfAMetreForRotations)
{
  EXPECT_EQ(quantity_complaint("250 kg m^2", kind::mass_entry), "");
  EXPECT_EQ(quantity_complaint("250 kg", kind::mass_entry), "");
  EXPECT_NE(quantity_complaint("250 kg m^3", kind::mass_entry), "");
  EXPECT_NE(quantity_complaint("250 N/m", kind::mass_entry), "");
}

TEST(Quantity, DimensionsAreDescribedAsEngineersWriteThem)
{
  EXPECT_EQ(describe({1, 1, -2}), "N");
  EXPECT_EQ(describe({1, 0, -2}), "m/s^2");
  EXPECT_EQ(describe({-3, 1, 0}), "kg/m^3");
  EXPECT_EQ(describe({0, 0, -1}), "1/s");
  EXPECT_EQ(describe({0, 0, 0}), "a plain number");
}

} // namespace
