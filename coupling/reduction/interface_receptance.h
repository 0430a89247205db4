#pragma once

#include "coupling/reduction/supported_modes.h"
#include "fem/modal_ratios.h"

#include <Eigen/Core>

#include <complex>
#include <vector>

namespace gestell::coupling
{

/**
 * How far the receptance of the interface, H(omega) = D^-1 [n1 x n1], of a reduced model is from that of the full
 * frame.
 *
 * With g_j = M*_12 e_j the inertia by which fixed-interface mode j couples to the interface, the dynamic stiffness of
 * the full frame is, condensed to q1,
 *
 *     D(s) = C*_11 - s M*_11 - s^2 sum_j g_j g_j^T / (omega_0j^2 - s),       s = omega^2 / (1 + 2 i zeta),
 *
 * times 1 + 2 i zeta: damping by which a mode has the ratio zeta at resonance.  The model has the first m terms.  Those
 * beyond the modes known need no modes, for their moments are static: with X = C22^-1 (M Psi)_2 of InteriorResponse,
 *
 *     P1 = sum_(j > m) g g^T / omega_0^2 = Psi^T M X - sum_(j <= m) ..,    P2 = sum_(j > m) g g^T / omega_0^4 = X^T M X
 * - .., P1 + s P2  <=  sum_(j > m) g g^T / (omega_0^2 - s)  <=  P1 + s P2 / (1 - s / omega_0m^2)     (s real).
 *
 * The error at a frequency is |H_m - H| / |H| in Frobenius' norm, each coordinate scaled by the root of its own inertia
 * M*_11,ii, so that displacements and rotations can be added.  The largest is looked for at frequencies spread over the
 * range and gathered around its resonances.
 */
class InterfaceReceptance
{
public:
  /// @param zeta     of the modes; 0.01 where there is none.
  /// @param highest  end of the range [rad/s], below the highest fixed-interface mode known unless all are.
  InterfaceReceptance(const ReductionBasis &basis, const ReducedMatrices &star, const InteriorResponse &response,
                      const SupportedModes &refined, const fem::ModalRatios &zeta, double highest);

  /// Largest error of the model with the first m modes, m up to those known.
  double error(int m) const;

  /// Fewest modes with an error within the tolerance, or -1 if all that are known do not do.
  int fewest(double tolerance) const;

  /// Error that the bounds of what lies beyond the modes known leave in D itself.
  double uncertainty() const;

private:
  struct Frequency
  {
    std::complex<double> s;
    Eigen::MatrixXcd     H; // of the full frame, scaled
    double               size, doubt;
  };
  Eigen::MatrixXcd stiffness(std::complex<double> s, int m) const;
  double           error_at(const Frequency &frequency, int m) const;

  Eigen::MatrixXd        C11_, M11_, G_; // scaled; G = [g_1, g_2, ...]
  Eigen::VectorXd        omega0_;
  std::vector<Frequency> frequencies_;
};

} // namespace gestell::coupling
