#include "apps/output/interactive/live_chart.h"
#include "apps/output/interactive/machine_animation.h"
#include "apps/output/interactive/page_scripts.h"
#include "apps/output/interactive/short_motion.h"
#include "apps/output/pictures/chosen_pictures.h"
#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/tables/noise.h"
#include "apps/output/text/base64.h"
#include "apps/output/text/html.h"
#include "tests/support/output_example.h"
#include "tests/support/test.h"

using namespace gestell;
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

/// A run of 1000 pictures at 0, 1, ... ms, each of which has its number as its coordinates.
Result numbered_pictures()
{
  Result               result = example_result();
  coupling::RunResult &run    = *result.run;
  run.picture_times.clear(), run.picture_states.clear();
  for (int i = 0; i < 1000; ++i)
  {
    run.picture_times.push_back(1e-3 * i);
    run.picture_states.push_back(Eigen::Vector4d::Constant(i));
  }
  return result;
}

/// The last picture is the end of the run, and one shows the main peak.
TEST(AnimationInstants, HoldTheEndAndTheMainPeak)
{
  Result result                = numbered_pictures();
  result.peak                  = PeakState{"F_P", "N", 1e6, 0.2341, Eigen::Vector4d::Constant(234.1)};
  const AnimationInstants seen = animation_instants(result, 200);
  ASSERT_EQ(seen.times.size(), 201u); // those chosen, and the peak
  EXPECT_EQ(seen.times.back(), result.run->picture_times.back());
  EXPECT_EQ(seen.states.back()[0], 999.);
  const auto peak = std::find(seen.times.begin(), seen.times.end(), 0.2341);
  ASSERT_NE(peak, seen.times.end());
  EXPECT_EQ(seen.states[std::size_t(peak - seen.times.begin())][0], 234.1);
  EXPECT_TRUE(std::is_sorted(seen.times.begin(), seen.times.end()));
  result.peak->t = result.run->picture_times[237]; // a picture itself
  EXPECT_EQ(animation_instants(result, 200).times.size(), 200u);
}

/// Wherever the peak lies, at the ends too: as many as asked for, at most a stride and the peak's shift apart.
TEST(ChosenPictures, AreEvenWithTheEndsAndThePeak)
{
  Result result = numbered_pictures();
  for (const std::size_t peak : {0u, 1u, 5u, 237u, 994u, 998u, 999u})
  {
    result.peak       = PeakState{"F_P", "N", 1e6, result.run->picture_times[peak], {}};
    const auto chosen = chosen_pictures(result, 100);
    ASSERT_EQ(chosen.size(), 100u);
    EXPECT_EQ(chosen.front(), 0u);
    EXPECT_EQ(chosen.back(), 999u);
    EXPECT_TRUE(std::binary_search(chosen.begin(), chosen.end(), peak)) << peak;
    for (std::size_t i = 1; i < chosen.size(); ++i)
    {
      EXPECT_GT(chosen[i], chosen[i - 1]) << peak;
      EXPECT_LE(chosen[i] - chosen[i - 1], 2u * 11u) << peak; // 999 / 99, rounded up, twice beside the peak
    }
  }
  EXPECT_EQ(chosen_pictures(result, 1000).size(), 1000u);
  EXPECT_EQ(chosen_pictures(result, 2000).back(), 999u);
}

/// Constant speed is straight at whatever instants; a circle of 90 degrees a step is not.
TEST(ShortMotion, IsStraightByTheTimesOfItsInstants)
{
  const std::vector<double> times = {0., 1., 1.01, 1.02, 2., 3.};
  Eigen::MatrixXd           line(3, 6), circle(3, 6);
  for (Eigen::Index k = 0; k < 6; ++k)
  {
    const double t = times[std::size_t(k)], angle = M_PI / 2. * t;
    line.col(k)   = Eigen::Vector3d(5. * t, -t, 2.);
    circle.col(k) = Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.);
  }
  EXPECT_TRUE(is_straight(line, times, 1e-12));
  EXPECT_FALSE(is_straight(circle, times, 0.1));
  EXPECT_TRUE(is_straight(Eigen::MatrixXd(3, 0), {}, 0.));
}

/// Modes need no run: the crank is there, stands as at their configuration, and the mode turns it: u = phi e x (x - c).
TEST(MachineAnimation, ShowsCoupledModesAboutTheirConfiguration)
{
  Result result   = example_result();
  result.modes_at = Eigen::Vector4d(0., 0., 2.6, 0.13);
  for (const bool with_run : {true, false})
  {
    if (!with_run)
      result.run.reset();
    const MachineAnimation machine(result);
    const auto             bodies = mechanism_shapes(result.scenery, result.modes_at);
    ASSERT_EQ(machine.parts().size(), 1 + bodies.size());
    for (std::size_t i = 0; i < bodies.size(); ++i)
      EXPECT_EQ(machine.parts()[1 + i].points, bodies[i].points) << bodies[i].name;

    const Shape    &crank = machine.parts()[1];
    const auto      mode  = machine.machine_mode(Eigen::Vector4d(0., 0., 0.06, 0.));
    Eigen::Vector3d centre(0.5, 0.5, 2.);
    for (std::size_t i = 0; i < crank.points.size(); ++i)
      EXPECT_LT(
          (mode[1].segment<3>(3 * long(i)) - 0.06 * Eigen::Vector3d::UnitY().cross(crank.points[i] - centre)).norm(),
          1e-8); // by differences of 1e-6
  }
}

/// From where the parts rest the motion leads to where the pictures put them.
TEST(MachineAnimation, MovesFromItsRestToThePictures)
{
  Result result   = example_result();
  result.modes_at = Eigen::Vector4d(0., 0., 2.6, 0.13);
  const MachineAnimation machine(result);
  const auto             motion = machine.motion(result.run->picture_states);
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto bodies = mechanism_shapes(result.scenery, result.run->picture_states[k]);
    for (std::size_t i = 0; i < bodies.size(); ++i)
      for (std::size_t p = 0; p < bodies[i].points.size(); ++p)
        EXPECT_LT((machine.parts()[1 + i].points[p] + motion[1 + i].ideal.col(long(k)).segment<3>(3 * long(p)) -
                   bodies[i].points[p])
                      .norm(),
                  1e-12);
  }
}
