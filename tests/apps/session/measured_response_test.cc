// Measured curves: tables and universal files, and what is wrong with them.

#include "apps/analysis/frf/measured_response.h"
#include "apps/scene/file/universal_file.h"
#include "fem/values/two_pi.h"
#include "tests/support/refusal.h"
#include "tests/support/scene_text.h"
#include "tests/support/test.h"

namespace gestell::tests
{
namespace
{

using apps::FrequencyResponse;
using apps::MeasuredResponse;
using Complex = std::complex<double>;

/// Two receptances of x and y by a force at a.
FrequencyResponse two_pairs()
{
  FrequencyResponse response;
  response.kind = "receptance";
  for (const std::string to : {"x", "y"})
    response.pairs.push_back({"a", to, "m/N", 0, {}, {}});
  return response;
}

class Measured : public ::testing::Test
{
protected:
  std::vector<MeasuredResponse> read(const std::string &name, const std::string &text,
                                     const std::string &pair = "") const
  {
    const std::string path = folder_.write(name, text);
    return apps::measured_responses({pair.empty() ? path : pair + "=" + path}, two_pairs());
  }
  std::string complaint(const std::string &name, const std::string &text, const std::string &pair = "") const
  {
    return refusal([&] { read(name, text, pair); });
  }

private:
  test::SceneFolder folder_;
};

/// A data set 58 with its head and numbers.
std::string data_set(const std::string &form, const std::string &numbers, const std::string &axis = "18",
                     const std::string &ordinate = "8", const std::string &kind = "58")
{
  std::string text = "    -1\n    " + kind + "\ntip, x\nNONE\n23-Nov-26 10:00:00\nNONE\nNONE\n" +
                     "    4         1    1         0       NONE         1   1       NONE         2   3\n" + form + "\n";
  for (const std::string &type : {axis, ordinate, std::string("13"), std::string("0")})
    text += "        " + type + "    0    0    0                 NONE                 NONE\n";
  return text + numbers + "    -1\n";
}

void expect_curve(const MeasuredResponse &curve, const std::vector<double> &f, const std::vector<Complex> &values)
{
  EXPECT_EQ(curve.frequencies_hz, f);
  ASSERT_EQ(curve.values.size(), values.size());
  for (std::size_t i = 0; i < values.size(); ++i)
    EXPECT_LT(std::abs(curve.values[i] - values[i]), 1e-12 * std::abs(values[i])) << i;
}

} // namespace

TEST_F(Measured, TablesOfPartsAndOfAmplitudeAndPhaseAreTheSame)
{
  const auto parts = read("parts.csv", "frequency [Hz],re [m/N],im [m/N]\n1,3e-6,4e-6\n2,0,-5e-6\n");
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_EQ(parts[0].pair, 0);
  EXPECT_TRUE(parts[0].has_phase);
  expect_curve(parts[0], {1., 2.}, {{3e-6, 4e-6}, {0., -5e-6}});
  const auto polar = read("polar.csv", "frequency [Hz];amplitude [um/N];phase [deg]\n1;5;53.13010235415598\n2;5;-90\n");
  expect_curve(polar[0], {1., 2.}, {{3e-6, 4e-6}, {0., -5e-6}});
  const auto radians = read("radians.csv", "frequency [Hz],abs [m/N],phase [rad]\n2,5e-6,-1.5707963267948966\n");
  expect_curve(radians[0], {2.}, {{0., -5e-6}});
  EXPECT_FALSE(read("plain.csv", "Frequency [Hz],magnitude\n2,5e-6\n")[0].has_phase);
}

TEST_F(Measured, CurvesGoToThePairsThatTheyAreNamedAfter)
{
  EXPECT_EQ(read("own.csv", "frequency [Hz],y/a re [m/N],y/a im [m/N]\n1,1,2\n")[0].pair, 1);
  EXPECT_EQ(read("given.csv", "frequency [Hz],re,im\n1,1,2\n", "y/a")[0].pair, 1);
  const auto both = read("both.csv", "frequency [Hz],first re,first im,second re,second im\n1,1,2,3,4\n");
  ASSERT_EQ(both.size(), 2u);
  EXPECT_EQ(both[1].pair, 1);
  EXPECT_EQ(both[1].values[0], Complex(3., 4.));
}

TEST_F(Measured, AccelerationsAreIntegratedToDisplacements)
{
  const double w     = two_pi * 2.;
  const auto   table = read("a.csv", "frequency [Hz],re [m/s^2/N],im [m/s^2/N]\n0,7,7\n2,3,4\n");
  expect_curve(table[0], {2.}, {-Complex(3., 4.) / (w * w)});
  const auto universal = read("a.uff", data_set("         5         1         1  2.00000E+00  1.00000E+00  0.00000E+00",
                                                "  3.00000E+00  4.00000E+00\n", "18", "12"));
  expect_curve(universal[0], {2.}, {-Complex(3., 4.) / (w * w)});
}

TEST_F(Measured, UniversalFilesHoldRealAndComplexValuesOfEvenAndUnevenSpacing)
{
  // Numbers of Fortran: no blank before a minus, D for E, several points on a line.
  const auto even =
      read("even.uff", data_set("         5         3         1  1.00000E+00  5.00000E-01  0.00000E+00",
                                "  1.00000E+00-2.00000E+00  3.00000E+00  4.00000E+00  5.00000E+00\n  6.00000E+00\n"));
  expect_curve(even[0], {1., 1.5, 2.}, {{1., -2.}, {3., 4.}, {5., 6.}});
  EXPECT_EQ(even[0].name, "tip, x");
  const auto uneven =
      read("uneven.uff",
           data_set("         6         2         0  0.00000E+00  0.00000E+00  0.00000E+00",
                    "  1.00000E+00  1.000000000000D-01  2.000000000000D-01\n  4.00000E+00  0.3D+00  0.4D+00\n"));
  expect_curve(uneven[0], {1., 4.}, {{0.1, 0.2}, {0.3, 0.4}});
  const auto real = read("real.unv", data_set("         2         2         1  1.00000E+00  1.00000E+00  0.00000E+00",
                                              "  7.00000E+00  8.00000E+00\n"));
  expect_curve(real[0], {1., 2.}, {7., 8.});
  EXPECT_FALSE(real[0].has_phase);
  const auto pairs = read("pairs.unv", data_set("         4         2         0  0.00000E+00  0.00000E+00  0.00000E+00",
                                                "  1.00000E+00  7.0E+00  3.00000E+00  8.0E+00\n"));
  expect_curve(pairs[0], {1., 3.}, {7., 8.});
}

TEST_F(Measured, WhatIsWrongIsReportedWithItsPlace)
{
  using ::testing::HasSubstr;
  const std::string good = "         5         1         1  2.00000E+00  1.00000E+00  0.00000E+00",
                    one  = "  3.0  4.0\n";
  EXPECT_THAT(complaint("x.txt", "1"), HasSubstr("needs a table (.csv) or a universal file"));
  EXPECT_THAT(complaint("x.csv", "f,re,im\n1,2,3\n"), HasSubstr("x.csv:1: needs a first column \"frequency [Hz]\""));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],re\n1,2\n"), HasSubstr("column \"re\" or \"im\" is missing"));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],re,im\n2,1,1\n1,1,1\n"),
              HasSubstr("x.csv:3: frequencies must ascend"));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],re [kg],im [kg]\n2,1,1\n"),
              HasSubstr("the unit [kg] does not match x/a"));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],re,im\n2,1,one\n"), HasSubstr("got 'one'"));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],re,im\n2,1,1\n", "z/a"), HasSubstr("there is no pair \"z/a\""));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],a re,a im,b re,b im,c re,c im\n2,1,1,1,1,1,1\n"),
              HasSubstr("is an extra curve"));
  EXPECT_THAT(complaint("x.csv", "frequency [Hz],a re,a im,b re,b im\n2,1,1,1,1\n", "x/a"),
              HasSubstr("contains 2 curves"));
  EXPECT_THAT(complaint("x.uff", "    -1\n    15\n    -1\n"), HasSubstr("contains no data set 58"));
  EXPECT_THAT(complaint("x.uff", data_set(good, one, "18", "8", "58b")), HasSubstr("is binary"));
  EXPECT_THAT(complaint("x.uff", data_set(good, one, "17")),
              HasSubstr("x.uff:10: data set 58: its abscissa is of type 17"));
  EXPECT_THAT(complaint("x.uff", data_set(good, "  3.0\n")), HasSubstr("has 1 numbers; 1 points need 2"));
  EXPECT_THAT(complaint("x.uff", data_set(good, "  3.0 four\n")), HasSubstr("x.uff:14: data set 58: got 'four'"));
  EXPECT_THAT(complaint("x.uff", data_set("         7         1         1  2.0  1.0  0.0", one)),
              HasSubstr("data type is 7"));
  EXPECT_THAT(complaint("x.uff", data_set("         5         2         1  2.0 -1.0  0.0", "1 1 1 1\n")),
              HasSubstr("must ascend"));
  EXPECT_THAT(complaint("x.uff", "    -1\n    58\nname\n"), HasSubstr("ends within data set 58"));
  EXPECT_THAT(complaint("x.uff", "    -1\n   164\n         5  mm (milli-newton)\n    -1\n" + data_set(good, one)),
              HasSubstr("export the file in SI"));
  EXPECT_THAT(refusal([] { apps::measured_responses({"/nowhere.csv"}, two_pairs()); }), HasSubstr("cannot be read"));
}

} // namespace gestell::tests
