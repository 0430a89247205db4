#include "coupling/frame/stress_search.h"

#include "coupling/frame/principal_states.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

/// S = L^T-scaled rows so that |.| of the six is sigma_v:  sigma_v^2 = 3/2 |dev|^2, shears counted twice.
MatrixXd scaled_rows(const ReducedStress &stress, const std::vector<int> &points)
{
  MatrixXd A(6 * Index(points.size()), stress.mean.cols());
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    auto rows        = A.middleRows<6>(6 * Index(i));
    rows             = stress.mean.middleRows<6>(6 * Index(points[i])).cast<double>();
    const auto hydro = (rows.topRows<3>().colwise().sum() / 3.).eval();
    rows.topRows<3>().rowwise() -= hydro;
    rows.topRows<3>() *= std::sqrt(1.5);
    rows.bottomRows<3>() *= std::sqrt(3.);
  }
  return A;
}

template <typename Visit>
void in_blocks(const std::vector<int> &points, const Visit &visit)
{
  constexpr Index block = 256; // points that are multiplied together
  for (std::size_t first = 0; first < points.size(); first += block)
  {
    const std::size_t end = std::min(points.size(), first + block);
    if (!visit(std::vector<int>(points.begin() + Index(first), points.begin() + Index(end))))
      return;
  }
}

/// Upper bounds of sigma_v over all states, [points].
VectorXd bounds(const ReducedStress &stress, const std::vector<int> &points, const MatrixXd &states)
{
  MatrixXd gram = MatrixXd::Zero(stress.mean.cols(), stress.mean.cols());
  in_blocks(points,
            [&](const std::vector<int> &some)
            {
              const MatrixXd A = scaled_rows(stress, some);
              gram.noalias() += A.transpose() * A;
              return true;
            });
  const PrincipalStates principal = principal_states(states, gram);
  const VectorXd        largest   = principal.components.cwiseAbs().colwise().maxCoeff().transpose();
  VectorXd              bound     = VectorXd::Zero(stress.n_points());
  in_blocks(points,
            [&](const std::vector<int> &some)
            {
              const MatrixXd B = scaled_rows(stress, some) * principal.basis;
              // of a bound, for numbers in single precision: some hundred times 6e-8
              constexpr double rounded = 1. + 1e-5;
              for (std::size_t i = 0; i < some.size(); ++i)
                bound[some[i]] = rounded * B.middleRows<6>(6 * Index(i)).colwise().norm().dot(largest.transpose());
              return true;
            });
  return bound;
}

} // namespace

StressSearch largest_von_mises(const ReducedStress &stress, const MatrixXd &states, const std::vector<char> &counts)
{
  assert(states.rows() == stress.mean.cols() && states.cols() > 0);
  std::vector<int> points;
  for (int i = 0; i < stress.n_points(); ++i)
    if (counts[i])
      points.push_back(i);
  if (points.empty())
    return {};
  const VectorXd bound = bounds(stress, points, states);
  std::sort(points.begin(), points.end(), [&](int a, int b) { return bound[a] > bound[b]; });

  StressSearch result;
  in_blocks(points,
            [&](const std::vector<int> &some)
            {
              if (result.peak.point >= 0 && bound[some.front()] <= result.peak.von_mises)
                return false;
              const MatrixXd sigma = scaled_rows(stress, some) * states;
              for (std::size_t i = 0; i < some.size(); ++i)
              {
                Index        state;
                const double largest =
                    std::sqrt(sigma.middleRows<6>(6 * Index(i)).colwise().squaredNorm().maxCoeff(&state));
                if (result.peak.point < 0 || largest > result.peak.von_mises)
                  result.peak = {some[i], static_cast<int>(state), largest};
              }
              result.looked_at += static_cast<int>(some.size());
              return true;
            });
  return result;
}

} // namespace gestell::coupling
