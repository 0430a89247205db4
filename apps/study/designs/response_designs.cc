#include "apps/study/designs/response_designs.h"

#include "fem/values/message_text.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

using Blocks = std::vector<std::vector<int>>;

/// Every pair of k variables.
Blocks all_pairs(int k)
{
  Blocks pairs;
  for (int i = 0; i < k; ++i)
    for (int j = i + 1; j < k; ++j)
      pairs.push_back({i, j});
  return pairs;
}

/// Which variables leave their centres together.
Blocks behnken_blocks(int k)
{
  if (k == 6)
    return {{0, 1, 3}, {1, 2, 4}, {2, 3, 5}, {0, 3, 4}, {1, 4, 5}, {0, 2, 5}};
  if (k == 7) // the lines of the plane of seven points: every pair once
    return {{3, 4, 5}, {0, 5, 6}, {1, 4, 6}, {0, 1, 3}, {2, 3, 6}, {0, 2, 4}, {1, 2, 5}};
  return all_pairs(k);
}

void check_centre_points(int centre_points, const std::string &design)
{
  if (centre_points < 0)
    throw std::invalid_argument("study: design " + design + ": centre_points is " + std::to_string(centre_points) +
                                "; it must be zero or more");
}

/// All digits while a whole number has them.
std::string count_of(double runs)
{
  return runs < 1e15 ? std::to_string(static_cast<long long>(runs)) : fem::text(runs);
}

Eigen::MatrixXd corners_of(int k)
{
  return full_factorial(std::vector<std::vector<double>>(k, {-1., 1.})).points;
}

} // namespace

std::vector<double> even_levels(int n)
{
  if (n < 2)
    throw std::invalid_argument("study: a variable of a full factorial design has " + std::to_string(n) +
                                " levels; give it two or more");
  std::vector<double> levels(n);
  for (int i = 0; i < n; ++i)
    levels[i] = -1. + 2. * i / (n - 1);
  return levels;
}

Design full_factorial(const std::vector<std::vector<double>> &levels)
{
  double runs = levels.empty() ? 0. : 1.;
  for (const auto &of_one : levels)
    runs *= static_cast<double>(of_one.size());
  if (runs < 1.)
    throw std::invalid_argument("study: a full factorial design needs variables, each with levels");
  if (runs > most_runs)
    throw std::invalid_argument("study: the full factorial design has " + count_of(runs) +
                                " runs, more than a million; use fewer levels, or a Latin hypercube");

  Design design;
  design.type = "full factorial";
  design.points.resize(static_cast<Eigen::Index>(runs), static_cast<Eigen::Index>(levels.size()));
  for (Eigen::Index run = 0; run < design.points.rows(); ++run)
  {
    Eigen::Index rest = run;
    for (Eigen::Index j = design.points.cols() - 1; j >= 0; --j)
    {
      const auto n          = static_cast<Eigen::Index>(levels[j].size());
      design.points(run, j) = levels[j][rest % n];
      rest /= n;
    }
  }
  return design;
}

double star_distance(Star star, int n_variables, int centre_points)
{
  const double F = std::pow(2., n_variables), N = F + 2. * n_variables + centre_points;
  switch (star)
  {
  case Star::rotatable:
    return std::pow(F, 0.25);
  case Star::orthogonal:
    return std::sqrt(0.5 * (std::sqrt(N * F) - F));
  case Star::spherical:
    return std::sqrt(static_cast<double>(n_variables));
  default:
    return 1.;
  }
}

Design central_composite(int n_variables, double alpha, int centre_points)
{
  check_centre_points(centre_points, "central composite");
  constexpr int most_composite = 12; // variables: 4096 corners
  if (n_variables < 1 || n_variables > most_composite)
    throw std::invalid_argument("study: a central composite design of " + std::to_string(n_variables) +
                                " variables; it takes 1 to 12. For more take a Latin hypercube or Sobol points");
  if (!(alpha > 0.) || !std::isfinite(alpha))
    throw std::invalid_argument("study: design central composite: alpha is " + std::to_string(alpha) +
                                "; it must be positive, or one of rotatable, face-centred, orthogonal, spherical");

  const Eigen::MatrixXd corners = corners_of(n_variables);
  const Eigen::Index    F       = corners.rows();
  Design                design;
  design.type              = "central composite";
  design.alpha             = alpha;
  design.centre_points     = centre_points;
  design.points            = Eigen::MatrixXd::Zero(F + 2 * n_variables + centre_points, n_variables);
  design.points.topRows(F) = corners;
  for (int j = 0; j < n_variables; ++j)
  {
    design.points(F + 2 * j, j)     = -alpha;
    design.points(F + 2 * j + 1, j) = alpha;
  }
  return design;
}

Design box_behnken(int n_variables, int centre_points)
{
  check_centre_points(centre_points, "Box-Behnken");
  if (n_variables < 3 || n_variables > 7)
    throw std::invalid_argument("study: a Box-Behnken design of " + std::to_string(n_variables) +
                                " variables; it takes 3 to 7. Take a central composite design");

  const Blocks          blocks  = behnken_blocks(n_variables);
  const auto            width   = static_cast<int>(blocks.front().size());
  const Eigen::MatrixXd corners = corners_of(width);
  Design                design;
  design.type          = "Box-Behnken";
  design.centre_points = centre_points;
  design.points =
      Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(blocks.size()) * corners.rows() + centre_points, n_variables);
  Eigen::Index row = 0;
  for (const auto &block : blocks)
  {
    for (int i = 0; i < width; ++i)
      design.points.block(row, block[i], corners.rows(), 1) = corners.col(i);
    row += corners.rows();
  }
  return design;
}

} // namespace gestell::apps
