// Designs of studies: orthogonal, rotatable, Latin, of low discrepancy.

#include "apps/study/designs/make_design.h"
#include "apps/study/designs/response_designs.h"
#include "apps/study/designs/space_filling.h"
#include "apps/study/surface/least_squares.h"
#include "apps/study/surface/surface_term.h"
#include "tests/support/refusal.h"
#include "tests/support/test.h"

namespace
{

using namespace gestell::apps;
using gestell::tests::expect_refusal;

Eigen::MatrixXd quadratic_columns(const Design &design)
{
  return model_matrix(design.points, surface_terms(design.n_variables(), SurfaceOrder::quadratic));
}

/// t^T (X^T X)^-1 t at a point: variance of the fit there, per variance of a run.
double variance_at(const Design &design, const Eigen::VectorXd &xi)
{
  const auto                     terms = surface_terms(design.n_variables(), SurfaceOrder::quadratic);
  const std::vector<std::string> names(terms.size());
  const LeastSquares             squares(quadratic_columns(design), names);
  const Eigen::VectorXd          t = model_matrix(xi.transpose(), terms).row(0);
  return t.dot(squares.inverse_normal() * t);
}

std::set<std::vector<double>> different_points(const Eigen::MatrixXd &points)
{
  std::set<std::vector<double>> all;
  for (Eigen::Index run = 0; run < points.rows(); ++run)
  {
    const Eigen::VectorXd row = points.row(run);
    all.emplace(row.data(), row.data() + row.size());
  }
  return all;
}

std::vector<StudyVariable> variables(int k)
{
  std::vector<StudyVariable> all(k);
  for (int i = 0; i < k; ++i)
    all[i].name = "x" + std::to_string(i + 1);
  return all;
}

/// Number of points in [-1, x), less the volume of it times n, per n: the largest over corners at the points
/// themselves.
double star_discrepancy(const Eigen::MatrixXd &points)
{
  double worst = 0.;
  for (Eigen::Index a = 0; a < points.rows(); ++a)
    for (Eigen::Index b = 0; b < points.rows(); ++b)
    {
      const Eigen::Array2d corner(points(a, 0), points(b, 1));
      const double         inside =
          static_cast<double>((points.col(0).array() < corner(0) && points.col(1).array() < corner(1)).count());
      worst = std::max(
          worst, std::abs(inside / static_cast<double>(points.rows()) - 0.25 * (corner(0) + 1.) * (corner(1) + 1.)));
    }
  return worst;
}

} // namespace

TEST(FullFactorial, OfTwoLevelsIsOrthogonalInAllProducts)
{
  const Design          design = full_factorial(std::vector<std::vector<double>>(5, even_levels(2)));
  const Eigen::MatrixXd X      = model_matrix(design.points, surface_terms(5, SurfaceOrder::interactions));

  EXPECT_EQ(design.n_runs(), 32);
  EXPECT_TRUE((X.transpose() * X).isApprox(32. * Eigen::MatrixXd::Identity(16, 16), 1e-15));
}

TEST(FullFactorial, HoldsEveryCombinationOfAnyLevelsOnce)
{
  const Design design = full_factorial({{-1., 1.}, {-1., 0., 1.}, {-1., -0.5, 0.25, 1.}});

  EXPECT_EQ(design.n_runs(), 24);
  EXPECT_EQ(different_points(design.points).size(), 24u);
  EXPECT_EQ(design.points.row(1).transpose(), Eigen::Vector3d(-1., -1., -0.5)) << "the last variable goes fastest";
}

TEST(CentralComposite, OfFourVariablesHasTheTwentyFourRunsOfTheBook)
{
  const double alpha  = star_distance(Star::orthogonal, 4, 0);
  const Design design = central_composite(4, alpha, 0);

  EXPECT_EQ(design.n_runs(), 24);
  EXPECT_NEAR(alpha, 1.3408799242037712, 1e-15) << "of the reference's table";
}

TEST(CentralComposite, OfOrthogonalStarsHasSquaresThatAreOrthogonalAboutTheirMeans)
{
  for (const int k : {2, 3, 4, 5})
    for (const int centre : {0, 1, 6})
    {
      const Design    design  = central_composite(k, star_distance(Star::orthogonal, k, centre), centre);
      Eigen::MatrixXd squares = design.points.cwiseAbs2();
      squares.rowwise() -= squares.colwise().mean().eval();
      Eigen::MatrixXd products = squares.transpose() * squares;
      products.diagonal().setZero();
      EXPECT_LT(products.cwiseAbs().maxCoeff(), 1e-12) << k << " variables, " << centre << " centre points";
    }
}

TEST(CentralComposite, IsRotatableIfAlphaIsTheFourthRootOfItsCorners)
{
  const Design rotatable = central_composite(3, star_distance(Star::rotatable, 3, 4), 4);
  const Design faces     = central_composite(3, star_distance(Star::face_centred, 3, 4), 4);
  const auto   spread    = [](const Design &design)
  {
    const double on_axis     = variance_at(design, Eigen::Vector3d(0.8, 0., 0.)),
                 on_diagonal = variance_at(design, Eigen::Vector3d::Constant(0.8 / std::sqrt(3.)));
    return std::abs(on_axis / on_diagonal - 1.);
  };

  EXPECT_LT(spread(rotatable), 1e-12);
  EXPECT_GT(spread(faces), 0.01) << "the measure sees what is not rotatable";
}

TEST(CentralComposite, OnOneSphereWithoutCentreCannotTellTheSumOfSquaresFromAConstant)
{
  const Design design = central_composite(4, star_distance(Star::rotatable, 4, 0), 0); // alpha = 2 = sqrt(4)

  expect_refusal([&] { variance_at(design, Eigen::Vector4d::Zero()); }, "singular");
  EXPECT_NO_THROW(variance_at(central_composite(4, 2., 1), Eigen::Vector4d::Zero()));
}

TEST(BoxBehnken, HasNoCornersAndDeterminesTheQuadraticSurface)
{
  const std::vector<std::pair<int, int>> sizes = {{3, 12}, {4, 24}, {5, 40}, {6, 48}, {7, 56}};
  for (const auto &[k, edges] : sizes)
  {
    const Design design = box_behnken(k, 3);
    EXPECT_EQ(design.n_runs(), edges + 3);
    EXPECT_EQ(different_points(design.points).size(), edges + 1u);
    EXPECT_LT(design.points.cwiseAbs().rowwise().sum().maxCoeff(), k - 0.5) << "no run at a corner";
    EXPECT_EQ(design.points.colwise().sum().cwiseAbs().maxCoeff(), 0.);
    EXPECT_NO_THROW(variance_at(design, Eigen::VectorXd::Zero(k)));
  }
}

TEST(LatinHypercube, TakesEachCellOfEachVariableOnce)
{
  for (const int n : {2, 7, 40})
  {
    const Design design = latin_hypercube(3, n, 5);
    for (int j = 0; j < 3; ++j)
    {
      std::set<long> cells;
      for (int run = 0; run < n; ++run)
        cells.insert(std::lround((design.points(run, j) + 1.) * n / 2. - 0.5));
      EXPECT_EQ(cells.size(), static_cast<std::size_t>(n));
      EXPECT_EQ(*cells.begin(), 0);
      EXPECT_EQ(*cells.rbegin(), n - 1);
    }
  }
}

TEST(LatinHypercube, KeepsItsPointsFurtherApartThanChanceDoes)
{
  for (const int seed : {1, 2, 3})
    EXPECT_GT(smallest_distance(latin_hypercube(2, 20, seed).points),
              1.5 * smallest_distance(random_latin_hypercube(2, 20, seed).points));
}

TEST(LatinHypercube, IsTheSameForTheSameSeed)
{
  EXPECT_EQ(latin_hypercube(3, 10, 7).points, latin_hypercube(3, 10, 7).points);
  EXPECT_NE(latin_hypercube(3, 10, 7).points, latin_hypercube(3, 10, 8).points);
}

TEST(SobolPoints, FillEveryDyadicBoxEqually)
{
  for (const int seed : {0, 3})
  {
    const Eigen::MatrixXd points = sobol_points(2, 64, seed).points;
    for (int m = 0; m <= 6; ++m) // boxes 2^-m wide and 2^(m-6) high hold one point each
    {
      std::set<std::pair<int, int>> boxes;
      for (Eigen::Index run = 0; run < 64; ++run)
        boxes.emplace(static_cast<int>(std::floor(std::ldexp(points(run, 0) + 1., m - 1))),
                      static_cast<int>(std::floor(std::ldexp(points(run, 1) + 1., 5 - m))));
      EXPECT_EQ(boxes.size(), 64u) << "seed " << seed << ", boxes 2^-" << m << " wide";
    }
  }
}

TEST(SobolPoints, HaveLowDiscrepancy)
{
  // About log(n)^2 / n against 1 / sqrt(n) by chance.
  EXPECT_LT(star_discrepancy(sobol_points(2, 256).points), 0.02);
  EXPECT_GT(star_discrepancy(random_latin_hypercube(2, 256, 1).points), 0.02);
}

TEST(SobolPoints, OfALongerStudyBeginWithThoseOfAShorterOne)
{
  EXPECT_EQ(sobol_points(5, 100, 2).points.topRows(40), sobol_points(5, 40, 2).points);
  EXPECT_EQ(sobol_points(3, 2).points.row(0).transpose(), Eigen::Vector3d::Constant(-1.));
  EXPECT_EQ(sobol_points(3, 2).points.row(1).transpose(), Eigen::Vector3d::Zero());
}

TEST(CodedValues, ReturnToThePhysicalOnesAndReachTheEndsOfTheRange)
{
  std::vector<StudyVariable> two = variables(2);
  two[0].from = 7.2e8, two[0].to = 1.08e9;
  two[1].from = 2e-4, two[1].to = 6e-4;
  const Eigen::MatrixXd physical = physical_points(full_factorial({{-1., 0., 1.}, {-1., 1.}}).points, two);

  EXPECT_EQ(physical(0, 0), 7.2e8);
  EXPECT_EQ(physical(5, 0), 1.08e9);
  EXPECT_NEAR(physical(5, 1), 6e-4, 1e-19);
  EXPECT_TRUE(physical_points(coded_points(physical, two), two).isApprox(physical, 1e-15));
}

TEST(MakeDesign, TakesTheLevelsOfAVariableAndEvenOnesOtherwise)
{
  std::vector<StudyVariable> two = variables(2);
  two[0]                         = variable_of_levels(two[0], {10., 4., 5.});
  const Design design            = make_design({"full factorial"}, two);

  EXPECT_EQ(design.n_runs(), 6);
  EXPECT_NEAR(physical_points(design.points, two)(2, 0), 5., 1e-14);
}

TEST(MakeDesign, RefusesWhatNoDesignTakes)
{
  const auto    make = [](const DesignRequest &request, int k) { return [=] { make_design(request, variables(k)); }; };
  DesignRequest factorial{"full factorial"};
  factorial.levels = 1;
  DesignRequest huge{"full factorial"};
  huge.levels = 11;
  DesignRequest many_levels{"full factorial"}, many_runs{"Latin hypercube"}, many_points{"Sobol"},
      many_centres{"Box-Behnken"};
  many_levels.levels         = 2000000000;
  many_runs.runs             = 2000000000;
  many_points.runs           = 2000000000;
  many_centres.centre_points = 2000000000;
  DesignRequest composite{"central composite"};
  composite.alpha = -1.;
  DesignRequest star{"central composite"};
  star.star = "rotable";
  StudyVariable empty;
  empty.from = empty.to = 3.;

  expect_refusal(make({"central composit"}, 2), "central composite");
  expect_refusal(make({"list"}, 2), "no runs");
  expect_refusal(make(factorial, 2), "1 levels");
  expect_refusal(make(huge, 6), "more than a million");
  expect_refusal(make(many_levels, 12), "design.levels is 2000000000");
  expect_refusal(make(many_runs, 2), "design.runs is 2000000000");
  expect_refusal(make(many_points, 2), "design.runs is 2000000000");
  expect_refusal(make(many_centres, 3), "design.centre_points is 2000000000");
  expect_refusal(make(composite, 2), "alpha is -1");
  expect_refusal(make(star, 2), "rotatable");
  expect_refusal(make({"central composite"}, 13), "it takes 1 to 12");
  expect_refusal(make({"Box-Behnken"}, 2), "it takes 3 to 7");
  expect_refusal(make({"Latin hypercube"}, 2), "two runs");
  expect_refusal(make({"Sobol"}, 2), "0 runs");
  expect_refusal(make({"list"}, 0), "no variables");
  expect_refusal([&] { make_design({"Sobol"}, {empty}); }, "from must be less than to");
  expect_refusal([&] { variable_of_levels(empty, {2., 2.}); }, "two different values");
}
