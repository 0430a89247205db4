#include "coupling/frame/mesh_extrapolation.h"

#include "coupling/frame/mesh_convergence.h"
#include "tests/support/test.h"

namespace gestell::test
{
namespace
{

using coupling::Approach;
using coupling::Extrapolated;
using coupling::MeshValue;

Extrapolated extrapolate(const std::vector<MeshValue> &meshes)
{
  return coupling::extrapolate(meshes, Approach::from_above);
}

/// v = 10 + c n^-k with an estimate that is wrong by a factor.
MeshValue mesh(double n, double k, double c = 1000., double factor = 0.7)
{
  const double error = c * std::pow(n, -k);
  return {n, 10. + error, factor * error / 10.};
}

TEST(Extrapolation, OfThreeMeshesFindsOrderAndLimitOfAPowerWhateverTheirSizes)
{
  for (const double k : {0.5, 0.9, 1.33, 2.})
  {
    const auto result = extrapolate({mesh(1e3, k), mesh(2.7e3, k), mesh(1.1e4, k)});
    EXPECT_NEAR(result.order, k, 1e-9);
    EXPECT_NEAR(result.limit, 10., 1e-9);
    EXPECT_GT(result.uncertainty, 0.);
  }
}

TEST(Extrapolation, OfTwoMeshesNeedsOnlyTheFallOfTheEstimate)
{
  for (const double factor : {0.1, 1., 4.})
  {
    const auto result = extrapolate({mesh(1e3, 1., 1000., factor), mesh(4e3, 1., 1000., factor)});
    EXPECT_NEAR(result.limit, 10., 1e-9);
    EXPECT_TRUE(std::isnan(result.order));
    EXPECT_NEAR(result.uncertainty, 0.25 / 10., 1e-9) << "the whole step";
  }
}

TEST(Extrapolation, OfTwoMeshesThatAreNearByChanceIsAsUncertainAsHalfTheEstimateSays)
{
  const auto result = extrapolate({{1e3, 10.01, 0.09}, {2e3, 10., 0.06}});
  EXPECT_LT(result.limit, 10.);
  EXPECT_GT(10. - result.limit + result.uncertainty * result.limit, 0.5 * 10. * 0.06 / 1.06 - 1e-9);
}

TEST(Extrapolation, CoversTheLimitWhereTwoPowersAreMixed)
{
  const auto value  = [](double n) { return 10. + 200. * std::pow(n, -0.6) + 4e4 * std::pow(n, -1.5); };
  const auto point  = [&](double n) { return MeshValue{n, value(n), 0.5 * (value(n) / 10. - 1.)}; };
  const auto result = extrapolate({point(2e3), point(5e3), point(1.2e4)});
  EXPECT_LT(std::abs(result.limit - 10.), 10. * result.uncertainty);
}

TEST(Extrapolation, OfFourMeshesTrustsTheirValuesMoreThanAnEstimateThatFallsTooSlowly)
{
  // The estimate stands still, as that of one layer of cells through a wall nearly does; the values show k = 1.2.
  std::vector<MeshValue> meshes;
  for (const double n : {1e3, 2e3, 4e3, 8e3})
    meshes.push_back({n, mesh(n, 1.2).value, 0.05});
  const auto   result = extrapolate(meshes);
  const double error  = meshes.back().value / 10. - 1.;
  EXPECT_NEAR(result.limit, 10., 1e-9);
  EXPECT_NEAR(result.uncertainty, 0.5 * error, 1e-9) << "half of the correction";
  meshes.pop_back();
  EXPECT_GT(extrapolate(meshes).uncertainty, 5. * error) << "three meshes have the estimate alone to compare with";
}

TEST(Extrapolation, OfValuesThatSettleFasterThanAnyOrderDoubtsAsMuchAsTheyStillMove)
{
  const auto result = extrapolate({{1e3, 12., 0.2}, {2e3, 10.01, 0.002}, {4e3, 10., 0.001}});
  EXPECT_TRUE(std::isnan(result.order));
  EXPECT_NEAR(result.limit, 9.99, 1e-9) << "k = 1: what is left is the last step";
  EXPECT_NEAR(result.uncertainty, 0.01 / 9.99, 1e-9);
}

/// The third frequency of the chassis in hexahedra, 52.890 Hz: one layer of cells has an estimate three times too
/// large.
TEST(Extrapolation, OfFourMeshesThatSettleDoubtsNoMoreThanTheRest)
{
  const auto result = extrapolate(
      {{54855., 55.9588, 0.12}, {91359., 54.3173, 0.08}, {141633., 53.3236, 0.055}, {275319., 53.1758, 0.036}});
  const double bound = 53.1758 / result.limit - 1. + result.uncertainty;
  EXPECT_LT(53.1758 / 52.890 - 1., bound);
  EXPECT_LT(bound, 0.01);
}

TEST(Extrapolation, OfValuesThatLeaveTheirLimitIsNotRegularAndStaysBelowAllOfThem)
{
  const auto result = extrapolate({{1e3, 12., 0.2}, {2e3, 11., 0.1}, {4e3, 11.5, 0.01}});
  EXPECT_FALSE(result.regular);
  EXPECT_TRUE(std::isnan(result.order));
  EXPECT_NEAR(result.limit, 11., 1e-12) << "the lowest of what comes from above";
  EXPECT_NEAR(result.uncertainty, 0.5 / 11., 1e-12) << "the step back, which is the correction, too";

  const auto estimated = extrapolate({{1e3, 12., 0.2}, {2e3, 11., 0.2}, {4e3, 11.5, 0.15}});
  EXPECT_NEAR(estimated.limit, 11.5 / 1.15, 1e-12) << "which lies below all";
}

TEST(Extrapolation, HasNoLimitBelowZero)
{
  const auto result = extrapolate({{1e3, 1.5, 0.5}, {2e3, 1., 0.48}}); // the step over 1 - 0.9: ten times as much
  EXPECT_FALSE(result.regular);
  EXPECT_NEAR(result.limit, 1. / 1.48, 1e-12) << "by the estimate of the last mesh";
}

TEST(Extrapolation, OfCompliancesThatRiseEndsAboveAllOfThem)
{
  const auto rising = [](double n) { return MeshValue{n, 20. - mesh(n, 1.).value, mesh(n, 1.).estimate}; };
  const auto result = coupling::extrapolate({rising(1e3), rising(2e3), rising(4e3)}, Approach::from_below);
  EXPECT_TRUE(result.regular);
  EXPECT_NEAR(result.limit, 10., 1e-9);
  const auto falling = coupling::extrapolate({mesh(1e3, 1.), mesh(2e3, 1.)}, Approach::from_below);
  EXPECT_FALSE(falling.regular);
  EXPECT_GE(falling.limit, mesh(1e3, 1.).value - 1e-12);
}

TEST(Extrapolation, LeavesMeshesOutThatAreHardlyFiner)
{
  const auto result = extrapolate({mesh(1e3, 1.), {1.9e3, 10.4, 0.1}, mesh(2e3, 1.), mesh(4e3, 1.)}); // 10.53 would fit
  EXPECT_NEAR(result.limit, 10., 1e-9);
  EXPECT_NEAR(result.order, 1., 1e-9);
}

/// What a bracket gave on six meshes of nearly one size: 506 Hz is its frequency.
TEST(Extrapolation, OfMeshesOfNearlyOneSizeIsThatOfOne)
{
  const auto result = extrapolate({{18297., 508.49, 0.018}, {18450., 508.389, 0.0178}});
  EXPECT_EQ(result.limit, 508.389);
  EXPECT_EQ(result.uncertainty, 0.0178);
}

TEST(Extrapolation, OfOneMeshIsAsUncertainAsItsEstimate)
{
  const auto result = extrapolate({{1e3, 12., 0.2}});
  EXPECT_EQ(result.limit, 12.);
  EXPECT_EQ(result.uncertainty, 0.2);
  EXPECT_THROW(extrapolate({}), std::invalid_argument);
}

coupling::MeshLevel level(const std::vector<std::string> &names)
{
  coupling::MeshLevel result;
  for (const std::string &name : names)
  {
    result.names.push_back(name);
    result.values.push_back(double(name.back() - '0')); // what a name belongs to
    result.estimates.push_back(0.1 * result.values.back());
  }
  return result;
}

TEST(MeshLevels, KeepByNameWhatAllOfThemHave)
{
  std::vector<coupling::MeshLevel> levels   = {level({"f1", "f2", "f3", "c4"}), level({"f1", "f2", "c4", "c5"}),
                                               level({"c4", "f1", "f3", "f2"})};
  const auto                       left_out = keep_common(levels);
  EXPECT_EQ(left_out, (std::vector<std::string>{"f3", "c5"}));
  for (const coupling::MeshLevel &mesh : levels)
  {
    EXPECT_EQ(mesh.names, (std::vector<std::string>{"f1", "f2", "c4"}));
    EXPECT_EQ(mesh.values, (std::vector<double>{1., 2., 4.}));
    EXPECT_EQ(mesh.estimates, (std::vector<double>{0.1, 0.2, 0.4}));
  }
  EXPECT_TRUE(keep_common(levels).empty());
}

} // namespace
} // namespace gestell::test
