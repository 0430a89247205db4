#include "coupling/frame/stress_search.h"

#include "coupling/integration/system/dense_solvers.h"

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

/// z = sum_r b_r c_r for every state: the b_r, and the largest |c_r| of each.
struct Components
{
  MatrixXd basis;
  VectorXd largest;
};

/// The largest of each coordinate over all states, 1 where it never moves: units drop out.
VectorXd largest_of(const MatrixXd &states)
{
  return states.cwiseAbs().rowwise().maxCoeff().unaryExpr([](double z) { return z > 0. ? z : 1.; });
}

/// Principal components of the states in the norm of `gram`, followed by the directions that are rounding there, so
/// that together they are a basis of all states.
Components principal_components(const MatrixXd &gram, const MatrixXd &states)
{
  const SymmetricEigenSolver norm(gram);
  const VectorXd             root   = norm.eigenvalues().cwiseMax(0.).cwiseSqrt();
  const double               top    = root.size() > 0 ? root.maxCoeff() : 0.;
  constexpr double           noise  = 1e-12; // of the largest eigenvalue: below it rounding hides it
  Index                      hidden = 0;     // ascending
  while (hidden < root.size() && root[hidden] <= std::sqrt(noise) * top)
    ++hidden;
  const Index                n      = root.size() - hidden;
  const auto                 modes  = norm.eigenvectors();
  const MatrixXd             X      = modes.rightCols(n);
  const MatrixXd             whole  = root.tail(n).asDiagonal() * (X.transpose() * states); // |column|^2 = z^T S^T S z
  const MatrixXd             nearby = modes.leftCols(hidden).transpose() * states;
  const SymmetricEigenSolver principal(whole * whole.transpose());
  const MatrixXd            &U = principal.eigenvectors();
  Components                 result{MatrixXd(root.size(), root.size()), VectorXd(root.size())};
  result.basis << X * root.tail(n).cwiseInverse().asDiagonal() * U, modes.leftCols(hidden);
  result.largest << (U.transpose() * whole).cwiseAbs().rowwise().maxCoeff(), nearby.cwiseAbs().rowwise().maxCoeff();
  return result;
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
  const VectorXd scale = largest_of(states);
  MatrixXd       gram  = MatrixXd::Zero(stress.mean.cols(), stress.mean.cols());
  in_blocks(points,
            [&](const std::vector<int> &some)
            {
              const MatrixXd A = scaled_rows(stress, some) * scale.asDiagonal();
              gram.noalias() += A.transpose() * A;
              return true;
            });
  const Components components = principal_components(gram, scale.cwiseInverse().asDiagonal() * states);
  const MatrixXd   basis      = scale.asDiagonal() * components.basis;
  VectorXd         bound      = VectorXd::Zero(stress.n_points());
  in_blocks(points,
            [&](const std::vector<int> &some)
            {
              const MatrixXd B = scaled_rows(stress, some) * basis;
              // of a bound, for numbers in single precision: some hundred times 6e-8
              constexpr double rounded = 1. + 1e-5;
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
