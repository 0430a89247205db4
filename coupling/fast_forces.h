#pragma once

#include "coupling/integration/time_integrator.h"
#include "coupling/machine.h"

#include <array>
#include <string>
#include <vector>

namespace gestell::coupling
{

/**
 * High-pass filter of fourth order (Butterworth) with the corner omega, for input that is linear between instants:
 * two sections  x'' + 2 zeta omega x' + omega^2 x = omega^2 u,  y = x'' / omega^2,  integrated exactly.
 *
 * What lies a factor of two below the corner is left to 6 %, a jump passes as a whole.
 */
class HighPass
{
public:
  static constexpr int n_sections = 2;

  /// exp(A h) of both sections over a step h.
  struct Step
  {
    Step(double omega, double h);

    double                                        omega, h;
    std::array<std::array<double, 4>, n_sections> E; ///< row by row
  };

  void   begin(double u);                     ///< has been u for ever
  double advance(const Step &step, double u); ///< the output behind the step
  double jump(double u);                      ///< the input jumps at this instant

private:
  struct Section
  {
    double x = 0., rate = 0., u = 0.; ///< x' / omega

    double output(double zeta) const { return u - x - 2. * zeta * rate; }
  };
  std::array<Section, n_sections> sections_;
};

/**
 * Looks at what the forces on a reduced frame contain above the frequency f that it is made for.
 *
 * Under a unit force along w the frame, as it is supported, yields along w' by  H(w, w') = sum_k (w.phi_k) (w'.phi_k) /
 * omega_k^2.  Static deflections are exact.  To what is fast, the modes above f answer with frequencies of their own,
 * which the model does not know; so of the deflection along w the part
 *
 *     d = H_above(w, w) S / sum_j |H(w, w_j)| R_j
 *
 * is in doubt, S the swing of the force's part above f (HighPass) and R_j the ranges of all forces on the frame.
 *
 * Source: docs/theory/reduction.md (16f).
 */
class FastForces
{
public:
  FastForces(const Machine &machine, const TimeIntegrator &integrator);

  void begin(); ///< what acts from the start on is taken as at rest
  void step();
  void jump(); ///< an event has changed forces at this instant

  /// One for all forces that leave more than a twentieth of a deflection in doubt; empty if none does.
  std::string warning() const;

private:
  static constexpr int n_corners = 4; ///< f, 2 f, 4 f, 8 f: what a larger range would leave

  struct Range
  {
    double least = 0., most = 0.;

    void   add(double x);
    double length() const { return most - least; }
  };
  struct Force
  {
    std::string                     element;
    int                             measure;
    double                          above = 0., whole = 0.; ///< H(w, w) of the modes above f, and of all
    Range                           value{};
    std::array<HighPass, n_corners> filters{};
    std::array<Range, n_corners>    fast{};
  };

  double doubt(std::size_t force, int corner) const;

  const TimeIntegrator       &integrator_;
  double                      limit_ = 0.; ///< f [Hz]
  double                      t_     = 0.;
  std::vector<Force>          forces_;
  Eigen::MatrixXd             flexibility_; ///< |H(w_i, w_j)|
  std::vector<HighPass::Step> steps_;       ///< of the corners, for the last step
};

} // namespace gestell::coupling
