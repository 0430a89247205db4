#include "apps/output/interactive/live_chart.h"
#include "apps/output/interactive/page_scripts.h"
#include "apps/output/interactive/short_motion.h"
#include "apps/output/tables/noise.h"
#include "apps/output/text/base64.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace gestell::apps;

namespace
{

/// The motion that its short form stands for.
Eigen::MatrixXd restored(const ShortMotion &motion, Eigen::Index numbers, Eigen::Index instants)
{
  Eigen::MatrixXd u = Eigen::MatrixXd::Zero(numbers, instants);
  for (std::size_t r = 0; r < motion.n_shapes(); ++r)
    for (Eigen::Index k = 0; k < instants; ++k)
      for (Eigen::Index i = 0; i < numbers; ++i)
        u(i, k) += motion.weights[std::size_t(k) * motion.n_shapes() + r] * motion.shapes[r][std::size_t(i)];
  return u;
}

} // namespace

TEST(Base64, IsThatOfTheStandard)
{
  // RFC 4648, section 10
  for (const auto &[bytes, text] : {std::pair<std::string, std::string>("", ""),
                                    {"f", "Zg=="},
                                    {"fo", "Zm8="},
                                    {"foo", "Zm9v"},
                                    {"foob", "Zm9vYg=="},
                                    {"fooba", "Zm9vYmE="},
                                    {"foobar", "Zm9vYmFy"}})
    EXPECT_EQ(base64(bytes), text);
}

/// cos, sin and a constant: a body that turns and stands off its axis is three shapes, at however many instants.
TEST(ShortMotion, OfABodyThatTurnsHasThreeShapes)
{
  Eigen::MatrixXd u(30, 101);
  for (Eigen::Index k = 0; k < u.cols(); ++k)
    for (Eigen::Index i = 0; i < u.rows(); ++i)
      u(i, k) = 0.3 + double(i) * std::cos(0.1 * double(k)) + (30. - double(i)) * std::sin(0.1 * double(k));
  const ShortMotion motion = short_motion(u, 0.01);
  EXPECT_LE(motion.n_shapes(), 3u);
  // 0.01 by what is left out, and half a step of 16 bits of each shape, of at most some 200 at its largest.
  EXPECT_LT((restored(motion, 30, 101) - u).cwiseAbs().maxCoeff(), 0.01 + 3. * 0.5 * 200. / 32767.);
}

TEST(ShortMotion, OfRestIsEmpty)
{
  EXPECT_EQ(short_motion(Eigen::MatrixXd::Zero(9, 5), 1e-6).n_shapes(), 0u);
}

TEST(LiveChart, KeepsEveryExtremeAndTheRowsAboutAMark)
{
  std::vector<double> x;
  Curve               curve;
  for (int i = 0; i < 100000; ++i)
  {
    x.push_back(1e-5 * i);
    curve.y.push_back(i == 31415 ? 7. : i == 27182 ? -7. : std::sin(3e-3 * i));
  }
  const auto rows = telling_rows(x, {curve}, {{0.5000049, "event", 1}}, 600);
  EXPECT_LT(rows.size(), 2000u);
  for (const std::size_t i : {0u, 31415u, 27182u, 50000u, 50001u, 99999u})
    EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), i)) << i;
}

/// A gap at the begin of a stretch must not hide the peak behind it.
TEST(LiveChart, KeepsThePeakBehindAGap)
{
  Curve               curve;
  std::vector<double> x;
  for (int i = 0; i < 100; ++i)
  {
    x.push_back(i);
    curve.y.push_back(i < 10 ? std::nan("") : i == 37 ? 9. : 0.);
  }
  const auto rows = telling_rows(x, {curve}, {}, 2);
  EXPECT_TRUE(std::binary_search(rows.begin(), rows.end(), 37u));
  EXPECT_TRUE(telling_rows({}, {}, {}, 10).empty());
}

TEST(LiveChart, LeavesPanelsPictures)
{
  Chart chart;
  chart.panels.resize(2);
  EXPECT_EQ(live_figure(chart, "<svg/>").find("live"), std::string::npos);
}

TEST(LiveChart, NamesOfTheUserDoNotEndTheScript)
{
  EXPECT_EQ(inside_script("\"</script>\""), "\"\\u003c/script>\"");
}

TEST(Noise, IsBelowABillionthOfTheLargestOfItsUnit)
{
  Noise noise;
  noise.see("N", -2e5);
  noise.see("m", 1e-3);
  EXPECT_EQ(noise.without("N", -1.4e-10), 0.);
  EXPECT_EQ(noise.without("N", 3e-4), 3e-4);
  EXPECT_EQ(noise.without("m", 1e-10), 1e-10);
  EXPECT_EQ(noise.without("rad", 1e-30), 1e-30);
}
