#pragma once

#include <cstddef>
#include <vector>

namespace gestell::mechanism
{

/**
 * Cubic spline through points (x_i, f_i), i = 0..n: f, f' and f'' are continuous, the error of smooth f is of order
 * h^4.  The second derivatives m_i at the knots, with h_i = x_{i+1} - x_i, satisfy
 *
 *     h_{i-1} m_{i-1} + 2 (h_{i-1} + h_i) m_i + h_i m_{i+1}
 *         = 6 [(f_{i+1} - f_i)/h_i - (f_i - f_{i-1})/h_{i-1}].
 *
 * At the ends f''' is continuous at the first and last inner knot ("not a knot"), or the spline is periodic: after x_n
 * it repeats from x_0, increased by f_n - f_0.
 *
 * Source: C. de Boor, A Practical Guide to Splines, 1978, chapter IV.
 */
class CubicSpline
{
public:
  struct Point
  {
    double x, f;
  };
  enum class Ends
  {
    not_a_knot,
    periodic
  };
  struct Value
  {
    double value, first, second;
  };

  /// @throws std::invalid_argument for fewer than 3 points, or x that are not ascending, with the row
  CubicSpline(const std::vector<Point> &points, Ends ends);

  /// f, f', f''; beyond the ends the polynomial there is continued; for a periodic spline see above.
  Value at(double x) const;

  double begin() const { return points_.front().x; }
  double end() const { return points_.back().x; }
  bool   is_periodic() const { return periodic_; }

private:
  std::vector<Point>  points_;
  std::vector<double> m_; ///< f'' at the knots
  bool                periodic_;
};

} // namespace gestell::mechanism
