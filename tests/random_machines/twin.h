#pragma once

#include "tests/random_machines/jet.h"

#include <functional>
#include <string>
#include <vector>

namespace gestell::tests
{

/**
 * The equations of a machine once more, by another formulation: minimal coordinates q, in which ideal joints and
 * prescribed motions are substituted, instead of coordinates of bodies with multipliers.  Every motion is a measure
 * s(q, t).  Kinetic energy is a sum of m/2 a' b', forces F act on measures u, and with d'Alembert in Lagrange's form
 *
 *     sum m/2 (G_a^T b'' + G_b^T a'') = sum G_u^T F(t, u, u', z),     s'' = G q'' + gamma,     z' = f(t, u, u', z).
 *
 * Nothing of the program is used: gradients and gamma come from jets, time steps from Boost's Cash-Karp of
 * order 5(4), whose estimate of the error sees contacts inside a step.
 */
class Twin
{
public:
  using Measure = std::function<Jet(const Jet *q, const Jet &t)>;

  /// What a law sees: time, its measures and their rates, its states.
  struct Seen
  {
    double        t = 0.;
    const double *u = nullptr, *v = nullptr, *z = nullptr;
  };
  /// Writes the forces on its measures and the rates of its states.
  using Law = std::function<void(const Seen &seen, double *F, double *dz)>;

  enum class Quantity
  {
    value,
    rate,
    acceleration
  };

  /// @param size  that its motions have; with `speed` it scales the errors  @return the coordinate as a measure
  Measure add_coordinate(double q, double v, double size, double speed);
  void    add_inertia(double m, Measure a, Measure b);
  void    add_mass(double m, const Measure &s) { add_inertia(m, s, s); }
  /// @param states  values at the start  @param sizes  of states
  void add_law(std::vector<Measure> u, Law law, std::vector<double> states = {}, std::vector<double> sizes = {});
  /// A force F(t, u, v) on one measure.
  void add_force(Measure u, std::function<double(double t, double u, double v)> force);
  /// Laws jump at this time.
  void add_break(double t) { breaks_.push_back(t); }
  void tell(const std::string &signal, Measure s, Quantity quantity);

  int                             n_coordinates() const { return int(q_.size()); }
  const std::vector<std::string> &signals() const { return names_; }
  /// Value and rate of a measure at the start.
  Jet at_start(const Measure &s) const;

  /// Values of all signals at the times 0, end/rows ... end, row by row; empty if the steps become too many.
  std::vector<double> history(double end, int rows, double tolerance) const;

private:
  struct Inertia
  {
    double  m;
    Measure a, b;
  };
  struct Load
  {
    std::vector<Measure> u;
    Law                  law;
    int                  first_state, n_states;
  };
  struct Told
  {
    Measure  s;
    Quantity quantity;
  };
  using State = std::vector<double>; ///< q, q', z, each by its size

  std::vector<Jet>    coordinates(const State &y) const;
  void                rates(const State &y, State &dy, double t) const;
  std::vector<double> accelerations(const std::vector<Jet> &q, const State &y, State &dy, double t) const;
  void                sample(const State &y, double t, std::vector<double> &rows) const;

  std::vector<double>      q_, v_, size_, speed_, z_, z_size_;
  std::vector<Inertia>     inertias_;
  std::vector<Load>        loads_;
  std::vector<double>      breaks_;
  std::vector<std::string> names_;
  std::vector<Told>        reported_;
};

} // namespace gestell::tests
