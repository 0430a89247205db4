#include "mechanism/functions/cubic_spline.h"

#include "mechanism/require.h"

#include <Eigen/LU>

#include <algorithm>
#include <cmath>

namespace gestell::mechanism
{
namespace
{

void check(const std::vector<CubicSpline::Point> &points)
{
  const std::string name = "table";
  require(points.size() >= 3, name, "number of rows", double(points.size()), "3 or more");
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    const std::string row = "row " + std::to_string(i + 1);
    require(std::isfinite(points[i].x), name, row + ", abscissa", points[i].x, "finite");
    require(std::isfinite(points[i].f), name, row + ", value", points[i].f, "finite");
    if (i == 0)
      continue;
    std::ostringstream before;
    before << "above " << points[i - 1].x << " of the previous row; sort the rows in ascending order";
    require(points[i].x > points[i - 1].x, name, row + ", abscissa", points[i].x, before.str());
  }
}

} // namespace

CubicSpline::CubicSpline(const std::vector<Point> &points, Ends ends)
    : points_(points), periodic_(ends == Ends::periodic)
{
  check(points);
  const int  n     = int(points.size()) - 1;
  const auto h     = [&](int i) { return points_[i + 1].x - points_[i].x; };
  const auto slope = [&](int i) { return (points_[i + 1].f - points_[i].f) / h(i); };
  // Dense: tables have some hundred rows, and it is done once.
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(n + 1, n + 1);
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n + 1);
  for (int i = 1; i < n; ++i)
  {
    A(i, i - 1) = h(i - 1);
    A(i, i)     = 2. * (h(i - 1) + h(i));
    A(i, i + 1) = h(i);
    b[i]        = 6. * (slope(i) - slope(i - 1));
  }
  if (periodic_)
  {
    A(0, n - 1) += h(n - 1);
    A(0, 0) += 2. * (h(n - 1) + h(0));
    A(0, 1) += h(0);
    b[0]    = 6. * (slope(0) - slope(n - 1));
    A(n, 0) = 1.;
    A(n, n) = -1.;
  }
  else if (n == 2) // three points: one parabola
  {
    A(0, 0) = A(n, n) = 1.;
    A(0, 1) = A(n, 1) = -1.;
  }
  else
  {
    A(0, 0)     = h(1);
    A(0, 1)     = -(h(0) + h(1));
    A(0, 2)     = h(0);
    A(n, n - 2) = h(n - 1);
    A(n, n - 1) = -(h(n - 2) + h(n - 1));
    A(n, n)     = h(n - 2);
  }
  const Eigen::VectorXd m = A.partialPivLu().solve(b);
  m_.assign(m.data(), m.data() + m.size());
}

CubicSpline::Value CubicSpline::at(double x) const
{
  double raised = 0.;
  if (periodic_)
  {
    const double turns = std::floor((x - begin()) / (end() - begin()));
    x -= turns * (end() - begin());
    raised = turns * (points_.back().f - points_.front().f);
  }
  const auto   above = std::upper_bound(points_.begin() + 1, points_.end() - 1, x,
                                        [](double value, const Point &point) { return value < point.x; });
  const auto   i     = std::size_t(above - points_.begin()) - 1;
  const double h = points_[i + 1].x - points_[i].x, a = (points_[i + 1].x - x) / h, b = 1. - a;
  return {raised + a * points_[i].f + b * points_[i + 1].f +
              ((a * a * a - a) * m_[i] + (b * b * b - b) * m_[i + 1]) * h * h / 6.,
          (points_[i + 1].f - points_[i].f) / h + ((3. * b * b - 1.) * m_[i + 1] - (3. * a * a - 1.) * m_[i]) * h / 6.,
          a * m_[i] + b * m_[i + 1]};
}

} // namespace gestell::mechanism
