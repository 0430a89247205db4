#include "apps/study/optimum/robust.h"

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/normal_distribution.hpp>
#include <boost/random/uniform_real_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

/// Order statistics r and s with r = np - z sqrt(np(1-p)), s = np + z sqrt(np(1-p)), rounded up, counted from 1.
Quantile quantile_of(const std::vector<double> &sorted, double p)
{
  constexpr double normal_95 = 1.959963984540054; // quantile 0.975 of the standard normal distribution
  const double     n = static_cast<double>(sorted.size()), spread = normal_95 * std::sqrt(n * p * (1. - p));
  const double     r = std::ceil(n * p - spread), s = std::ceil(n * p + spread);
  const double     place    = p * (n - 1.);
  const auto       below    = static_cast<std::size_t>(place);
  const auto       above    = std::min(below + 1, sorted.size() - 1);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {p, sorted[below] + (place - std::floor(place)) * (sorted[above] - sorted[below]),
          r >= 1. ? sorted[static_cast<std::size_t>(r) - 1] : -infinity,
          s <= n ? sorted[static_cast<std::size_t>(s) - 1] : infinity};
}

RobustFigures figures_of(const StudyOutput &output, const Eigen::VectorXd &values)
{
  const double         n         = static_cast<double>(values.size());
  const Eigen::ArrayXd deviation = values.array() - values.mean();
  const double         s2 = deviation.square().sum() / (n - 1.), m4 = deviation.square().square().mean();
  std::vector<double>  sorted(values.data(), values.data() + values.size());
  std::sort(sorted.begin(), sorted.end());

  RobustFigures figures;
  figures.output          = output;
  figures.nominal         = std::numeric_limits<double>::quiet_NaN();
  figures.mean            = values.mean();
  figures.deviation       = std::sqrt(s2);
  figures.mean_error      = std::sqrt(s2 / n);
  figures.deviation_error = s2 > 0. ? std::sqrt(std::max(0., m4 - s2 * s2 * (n - 3.) / (n - 1.)) / n / (4. * s2)) : 0.;
  figures.min             = sorted.front();
  figures.max             = sorted.back();
  constexpr double shares[] = {0.01, 0.05, 0.5, 0.95, 0.99}; // median, 90 % and 98 % between two
  for (const double share : shares)
    figures.quantiles.push_back(quantile_of(sorted, share));
  return figures;
}

bool scatters(const StudyVariable &variable)
{
  return variable.scatter != Scatter::none;
}

double share_outside(const Eigen::MatrixXd &points)
{
  return static_cast<double>((points.cwiseAbs().rowwise().maxCoeff().array() > 1. + same_level).count()) /
         static_cast<double>(points.rows());
}

} // namespace

Eigen::MatrixXd scattered_points(const Eigen::VectorXd &nominal, const std::vector<StudyVariable> &variables, int n,
                                 std::uint64_t seed)
{
  if (n < 2)
    throw std::invalid_argument("study: robust: " + std::to_string(n) + " draws; it needs two at least");
  if (nominal.size() != static_cast<Eigen::Index>(variables.size()))
    throw std::invalid_argument("study: robust: the nominal point does not have one value per variable");
  if (std::none_of(variables.begin(), variables.end(), scatters))
    throw std::invalid_argument("study: robust: no variable scatters; give one at least a tolerance");

  boost::random::mt19937_64                        generator(seed);
  boost::random::normal_distribution<double>       normal;
  boost::random::uniform_real_distribution<double> uniform(-1., 1.);
  Eigen::MatrixXd                                  points = nominal.transpose().replicate(n, 1);
  for (Eigen::Index row = 0; row < n; ++row)
    for (Eigen::Index j = 0; j < points.cols(); ++j)
      if (const StudyVariable &variable = variables[j]; scatters(variable))
        points(row, j) += variable.width / variable.half_range() *
                          (variable.scatter == Scatter::normal ? normal(generator) : uniform(generator));
  return points;
}

RobustResult robust_figures(const Eigen::MatrixXd &values, const std::vector<StudyOutput> &outputs,
                            const std::vector<Limit> &limits, const Eigen::VectorXd &undisturbed)
{
  std::vector<Eigen::Index> reported, finite;
  for (Eigen::Index i = 0; i < values.cols(); ++i)
    if (values.col(i).array().isFinite().any())
      reported.push_back(i);
  int kept = 0;
  for (Eigen::Index row = 0; row < values.rows(); ++row)
  {
    const Eigen::VectorXd one = values.row(row).transpose();
    if (reported.empty() || !one(reported).allFinite())
      continue;
    finite.push_back(row);
    kept += violation_of(limits, one) <= 0.;
  }
  if (finite.size() < 2)
    throw std::invalid_argument("study: robust: of " + std::to_string(values.rows()) + " draws " +
                                std::to_string(finite.size()) + " have results; two are needed at least");

  RobustResult result;
  result.draws      = static_cast<int>(values.rows());
  result.failed     = result.draws - static_cast<int>(finite.size());
  result.kept       = static_cast<double>(kept) / result.draws;
  result.kept_error = std::sqrt(result.kept * (1. - result.kept) / result.draws);
  for (const Eigen::Index i : reported)
  {
    result.figures.push_back(figures_of(outputs.at(i), values(finite, i)));
    if (undisturbed.size() > 0)
      result.figures.back().nominal = undisturbed[i];
  }
  return result;
}

RobustResult robust_on(const OutputModel &model, const Eigen::VectorXd &nominal,
                       const std::vector<StudyVariable> &variables, const std::vector<StudyOutput> &outputs, int draws,
                       std::uint64_t seed, const std::vector<Limit> &limits)
{
  const Eigen::MatrixXd points = scattered_points(nominal, variables, draws, seed);
  Eigen::MatrixXd       values(points.rows(), static_cast<Eigen::Index>(outputs.size()));
  for (Eigen::Index row = 0; row < points.rows(); ++row)
    values.row(row) = model(points.row(row).transpose(), Derivatives::none).values.transpose();

  RobustResult result = robust_figures(values, outputs, limits, model(nominal, Derivatives::none).values);
  result.source       = "surface";
  result.nominal      = nominal;
  result.seed         = seed;
  result.outside      = share_outside(points);
  return result;
}

} // namespace gestell::apps
