#pragma once

#include <Eigen/Core>

#include <array>

namespace gestell::coupling
{

/**
 * Backward differences of a vector z(t) at instants t_n, t_n - h, t_n - 2 h, ...
 *
 *     D_0 = z_n,   D_j = nabla^j z_n,   z(t_n + s h) = sum_j D_j s (s + 1) .. (s + j - 1) / j!
 *
 * In these differences BDF of order k, sum_{j=1..k} nabla^j z / j = h z', with gamma_j = 1 + 1/2 + ... + 1/j, is
 *
 *     h_b z'_{n+1} = z_{n+1} - h^z,   h_b = h / gamma_k,   h^z = sum_{j<k} (1 - gamma_j / gamma_k) D_j,
 *
 * and with the prediction z^ = sum_{j<=k} D_j its local error is  (z_{n+1} - z^) / (gamma_k (k + 1)), as
 * z_{n+1} - z^ = nabla^{k+1} z_{n+1}.
 */
class BackwardDifferences
{
public:
  static constexpr int highest = 8; ///< highest difference stored, for order 6

  void resize(Eigen::Index size);

  /// Three instants h apart.
  void start(const Eigen::VectorXd &oldest, const Eigen::VectorXd &middle, const Eigen::VectorXd &newest);

  auto operator[](int j) const { return D_.col(j); }
  /// Highest difference known.
  int known() const { return known_; }

  /// z^ and h^z.
  void predict(int order, Eigen::VectorXd &predicted, Eigen::VectorXd &history) const;
  /// z(t_n + s h) by the polynomial of a degree, components first .. first + x.size() - 1.
  void at(double s, int degree, Eigen::Index first, Eigen::Ref<Eigen::VectorXd> x) const;

  /// Adds the next instant, with nabla^{order+1} z there.
  void push(int order, const Eigen::VectorXd &difference);
  /// Resamples the polynomial of a degree <= known() at instants `ratio` h apart; afterwards only this degree is known.
  void rescale(double ratio, int degree);

  template <typename Archive>
  void exchange(Archive &archive)
  {
    archive(D_, known_);
  }

private:
  Eigen::MatrixXd D_; ///< [size x highest + 1]
  int             known_ = 0;
};

/// gamma_k = 1 + 1/2 + ... + 1/k.
constexpr double bdf_gamma(int k)
{
  double sum = 0.;
  for (int j = 1; j <= k; ++j)
    sum += 1. / j;
  return sum;
}

} // namespace gestell::coupling
