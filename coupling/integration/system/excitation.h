#pragma once

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace gestell::coupling
{

/**
 * External load  f_t(t) = f_0 + sum_j Re(F_j exp(i omega_j t)) + f_r(t)      [n]
 *
 * Constant and harmonic parts are stored separately, because integrators in modes of the base system integrate them
 * exactly.  Harmonic loads are sparse: only coordinates with a load are listed.
 */
class Excitation
{
public:
  /// Re(F exp(i omega t)) = cosine cos(omega t) + sine sin(omega t), by coordinate.
  struct Entry
  {
    int    coordinate;
    double cosine, sine; ///< [N] or [N m]
  };
  struct Harmonic
  {
    double             omega; ///< [rad/s], > 0
    std::vector<Entry> load;
  };

  explicit Excitation(int n = 0) : constant_(Eigen::VectorXd::Zero(n)) {}

  void add_constant(int coordinate, double value) { constant_[coordinate] += value; }
  /// Adds cosine cos(omega t) + sine sin(omega t) on a coordinate; harmonics of equal frequency share their evaluation.
  /// @throws std::invalid_argument if omega is not positive
  void add_harmonic(int coordinate, double omega, double cosine, double sine);
  /// Any other load, added to f; at most one.
  void set_rest(std::function<void(double t, Eigen::VectorXd &f)> rest) { rest_ = std::move(rest); }

  /// f_t(t) [n]; does not allocate.
  void at(double t, Eigen::VectorXd &f) const;

  bool                         is_constant() const { return harmonics_.empty() && !rest_; }
  bool                         has_rest() const { return static_cast<bool>(rest_); }
  const Eigen::VectorXd       &constant() const { return constant_; }
  const std::vector<Harmonic> &harmonics() const { return harmonics_; }

private:
  Eigen::VectorXd                                constant_;
  std::vector<Harmonic>                          harmonics_;
  std::function<void(double, Eigen::VectorXd &)> rest_;
};

} // namespace gestell::coupling
