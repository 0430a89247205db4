#include "coupling/stress_search.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>

namespace gestell::coupling
{

namespace
{

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr Index  block   = 256;       // points that are multiplied together
constexpr double noise   = 1e-12;     // of the largest eigenvalue: below it directions stress nothing
constexpr double rounded = 1. + 1e-5; // of a bound, for numbers in single precision

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

/// A basis of the states [n x r] whose components are their principal ones, and the largest |c_r| of each.
struct Components
{
  MatrixXd basis;
  VectorXd largest;
};

Components principal_components(const MatrixXd &gram, const MatrixXd &states)
{
  const Eigen::SelfAdjointEigenSolver<MatrixXd> norm(gram);
  const VectorXd                                root  = norm.eigenvalues().cwiseMax(0.).cwiseSqrt();
  const double                                  top   = root.size() > 0 ? root.maxCoeff() : 0.;
  Index                                         first = 0; // ascending
  while (first < root.size() && root[first] <= std::sqrt(noise) * top)
    ++first;
  const Index    n     = root.size() - first;
  const MatrixXd X     = norm.eigenvectors().rightCols(n);
  const MatrixXd whole = root.tail(n).asDiagonal() * (X.transpose() * states); // |column|^2 = z^T S^T S z
  const Eigen::SelfAdjointEigenSolver<MatrixXd> principal(whole * whole.transpose());
  const MatrixXd                               &U = principal.eigenvectors();
  Components                                    result;
  result.basis   = X * root.tail(n).cwiseInverse().asDiagonal() * U;
  result.largest = (U.transpose() * whole).cwiseAbs().rowwise().maxCoeff();
  return result;
}

template <typename Visit>
void in_blocks(const std::vector<int> &points, const Visit &visit)
{
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
  const Components components = principal_components(gram, states);
  VectorXd         bound      = VectorXd::Zero(stress.n_points());
  in_blocks(points,
            [&](const std::vector<int> &some)
            {
              const MatrixXd B = scaled_rows(stress, some) * components.basis;
              for (std::size_t i = 0; i < some.size(); ++i)
                bound[some[i]] =
                    rounded * B.middleRows<6>(6 * Index(i)).colwise().norm().dot(components.largest.transpose());
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
