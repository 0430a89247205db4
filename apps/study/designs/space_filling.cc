#include "apps/study/designs/space_filling.h"

#include <boost/random/mersenne_twister.hpp>
#include <boost/random/sobol.hpp>
#include <boost/random/uniform_int_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace gestell::apps
{
namespace
{

using Generator =
    boost::random::mt19937_64; ///< its numbers are the same everywhere, those of std's distributions are not

int random_below(int n, Generator &generator)
{
  return boost::random::uniform_int_distribution<int>(0, n - 1)(generator);
}

/// The numbers 0 ... n-1 in an order by chance.
std::vector<int> shuffled(int n, Generator &generator)
{
  std::vector<int> order(n);
  std::iota(order.begin(), order.end(), 0);
  for (int i = n - 1; i > 0; --i)
    std::swap(order[i], order[random_below(i + 1, generator)]);
  return order;
}

/// Cells of a Latin hypercube, variables x runs: 0 ... n-1.
Eigen::MatrixXd random_cells(int k, int n, Generator &generator)
{
  Eigen::MatrixXd cells(k, n);
  for (int j = 0; j < k; ++j)
  {
    const std::vector<int> order = shuffled(n, generator);
    for (int run = 0; run < n; ++run)
      cells(j, run) = order[run];
  }
  return cells;
}

/// What the point at column `run`, were it `point`, adds to phi, but for its distance to the column `but`.
double crowding(const Eigen::MatrixXd &cells, const Eigen::VectorXd &point, Eigen::Index run, Eigen::Index but)
{
  double sum = 0.;
  for (Eigen::Index other = 0; other < cells.cols(); ++other)
    if (other != run && other != but)
    {
      const double d2 = (cells.col(other) - point).squaredNorm(), d4 = d2 * d2;
      sum += 1. / (d4 * d4 * d4 * d2);
    }
  return sum;
}

/// Exchanges the values of a variable of two points if that lowers phi.  Their own distance stays as it is.
void exchange(Eigen::MatrixXd &cells, Generator &generator)
{
  const int n = static_cast<int>(cells.cols()), j = random_below(static_cast<int>(cells.rows()), generator);
  const int a = random_below(n, generator), b = (a + 1 + random_below(n - 1, generator)) % n;

  Eigen::VectorXd at_a = cells.col(a), at_b = cells.col(b);
  const double    before = crowding(cells, at_a, a, b) + crowding(cells, at_b, b, a);
  std::swap(at_a(j), at_b(j));
  if (crowding(cells, at_a, a, b) + crowding(cells, at_b, b, a) < before)
  {
    cells.col(a) = at_a;
    cells.col(b) = at_b;
  }
}

Design hypercube_of(const Eigen::MatrixXd &cells)
{
  Design design;
  design.type   = "Latin hypercube";
  design.points = ((2. * cells.array() + 1.) / static_cast<double>(cells.cols()) - 1.).matrix().transpose();
  return design;
}

void check_hypercube(int n_variables, int n_runs)
{
  if (n_variables < 1 || n_runs < 2)
    throw std::invalid_argument("study: a Latin hypercube of " + std::to_string(n_variables) + " variables and " +
                                std::to_string(n_runs) + " runs; it needs a variable and two runs at least");
}

} // namespace

Design random_latin_hypercube(int n_variables, int n_runs, std::uint64_t seed)
{
  check_hypercube(n_variables, n_runs);
  Generator generator(seed);
  return hypercube_of(random_cells(n_variables, n_runs, generator));
}

Design latin_hypercube(int n_variables, int n_runs, std::uint64_t seed)
{
  check_hypercube(n_variables, n_runs);
  Generator        generator(seed);
  Eigen::MatrixXd  cells             = random_cells(n_variables, n_runs, generator);
  constexpr double work_of_exchanges = 3e8;    // differences of two levels, some tenths of a second
  constexpr int    most_exchanges    = 100000; // bounds small designs, in which exchanges soon find nothing better
  const int        exchanges         = static_cast<int>(
      std::min<double>(most_exchanges, work_of_exchanges / (4. * n_runs * static_cast<double>(n_variables))));
  if (n_variables > 1 && n_runs > 2)
    for (int i = 0; i < exchanges; ++i)
      exchange(cells, generator);
  return hypercube_of(cells);
}

double smallest_distance(const Eigen::MatrixXd &points)
{
  double smallest = std::numeric_limits<double>::infinity();
  for (Eigen::Index a = 0; a < points.rows(); ++a)
    for (Eigen::Index b = a + 1; b < points.rows(); ++b)
      smallest = std::min(smallest, (points.row(a) - points.row(b)).norm());
  return smallest;
}

Design sobol_points(int n_variables, int n_runs, std::uint64_t seed)
{
  if (n_variables < 1 || n_variables > 1000 || n_runs < 1 || n_runs > (1 << 30))
    throw std::invalid_argument("study: Sobol points of " + std::to_string(n_variables) + " variables and " +
                                std::to_string(n_runs) + " runs; there are up to 1000 variables and 2^30 runs");
  Design design;
  design.type = "Sobol";
  design.points.resize(n_runs, n_variables);

  Generator                  generator(seed);
  std::vector<std::uint64_t> shift(n_variables, 0);
  if (seed != 0)
    for (auto &of_one : shift)
      of_one = generator();

  const auto coded = [](std::uint64_t digits) { return std::ldexp(static_cast<double>(digits >> 11), -52) - 1.; };
  boost::random::sobol sequence(n_variables);
  for (int j = 0; j < n_variables; ++j) // Boost's sequence begins behind the first point, which is zero
    design.points(0, j) = coded(shift[j]);
  for (int run = 1; run < n_runs; ++run)
    for (int j = 0; j < n_variables; ++j)
      design.points(run, j) = coded(sequence() ^ shift[j]);
  return design;
}

} // namespace gestell::apps
