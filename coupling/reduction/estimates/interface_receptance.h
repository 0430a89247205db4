#pragma once

#include "coupling/reduction/estimates/refined_modes.h"
#include "fem/values/modal_ratios.h"

#include <Eigen/Core>

#include <array>
#include <complex>
#include <vector>

namespace gestell::coupling
{

/// A frequency at which receptances are compared.
struct ReceptanceFrequency
{
  double omega, ratio; ///< [rad/s]; damping zeta of the modes there
};

/**
 * Frequencies up to `highest` [rad/s] spread over the range, and gathered around its resonances.
 *
 * @param zeta  of the modes; 0.01 if there is none.
 */
std::vector<ReceptanceFrequency> receptance_frequencies(const RefinedModes &refined, const fem::ModalRatios &zeta,
                                                        double highest);

/// Coordinates of one interface, counted in q1.
using Groups = std::vector<std::vector<int>>;

/// |H_model - H| / |H|, infinite instead of nan.
double relative_error(const Eigen::MatrixXcd &H_model, const Eigen::MatrixXcd &H);

/// Raises `errors` to the relative_error() of the coordinates of each group g.
void raise_errors(const Groups &groups, const Eigen::MatrixXcd &H_model, const Eigen::MatrixXcd &H,
                  std::vector<double> &errors);

/// Internal DOFs of a reduced model.
enum class Inside
{
  modes,           ///< the first m fixed-interface modes
  modes_and_shapes ///< these and the rest of X = C22^-1 (M Psi)_2, M-orthogonal to them
};

/// Number of internal DOFs.
struct InsideCount
{
  int modes  = -1; ///< < 0: the known modes are not sufficient
  int shapes = 0;

  bool enough() const { return modes >= 0; }
  int  total() const { return modes + shapes; }
};

/**
 * Error of the interface receptance H(omega) = D^-1 [n1 x n1] of a reduced model relative to the full frame.
 *
 * With the coupling mass g_j = M*_12 e_j of fixed-interface mode j, the dynamic stiffness of the full frame, condensed
 * to q1, is
 *
 *     D(s) = C*_11 - s M*_11 - s^2 sum_j g_j g_j^T / (omega_0j^2 - s),       s = omega^2 / (1 + 2 i zeta),
 *
 * times 1 + 2 i zeta: damping for which a mode has the ratio zeta at resonance.  The model has the first m terms.
 * Terms beyond the known modes need no modes: their moments are static, with X and X2 of ResidualFlexibility
 *
 *     P_k = sum_(j > m) g_j g_j^T / omega_0j^(2k),    P_1 = Psi^T M X - ..,  P_2 = X^T M X - ..,  P_3 = X^T M X2 - ..,
 *
 * and their sum R(s) is between two quadratures of Gauss and Radau that have these moments (reduction.md (16b)).  A
 * model of modes and shapes has the Gaussian quadrature of P_1 and P_2 in place of R.
 *
 * The error at a frequency is |H_m - H| / |H| in the Frobenius norm, each coordinate scaled by the root of its own
 * inertia M*_11,ii, so that displacements and rotations can be added.  The largest error is searched at frequencies
 * spread over the range and concentrated around its resonances.
 *
 * Source: Golub & Meurant, Matrices, Moments and Quadrature with Applications, Princeton 2010, chapters 4 and 6.
 */
class InterfaceReceptance
{
public:
  /// @param zeta     of the modes; 0.01 if there is none.
  /// @param highest  end of the range [rad/s], below the highest fixed-interface mode known unless all are.
  InterfaceReceptance(const ReductionBasis &basis, const ReducedMatrices &star, const ResidualFlexibility &response,
                      const RefinedModes &refined, const fem::ModalRatios &zeta, double highest);

  /// Largest error of the model with the first m modes, m up to the number of known modes.
  double error(int m, Inside inside) const;

  /// The same for each interface separately: of its own block of H, relative to that block.
  std::vector<double> errors_of(const Groups &groups, int m, Inside inside) const;

  /// Fewest modes with an error within the tolerance.
  InsideCount fewest(double tolerance, Inside inside) const;

  /// Uncertainty of D due to the bounds for the unknown modes.
  double uncertainty() const;

  /// sum_i f_i f_i^T / (1 - s nu_i)
  struct Fractions
  {
    Eigen::MatrixXd F;
    Eigen::VectorXd nu; // [s^2]

    Eigen::MatrixXcd at(std::complex<double> s) const;
  };

private:
  struct Frequency
  {
    std::complex<double> s;
    Eigen::MatrixXcd     H; // of the full frame, scaled
    double               doubt;
  };
  Eigen::MatrixXd moment(int k, int m) const;
  double          negligible(int k) const;
  Fractions       of_modes(int m) const;
  Fractions       of_shapes(int m) const;
  Fractions       of_model(int m, Inside inside) const;

  Eigen::MatrixXcd receptance(std::complex<double> s, const Eigen::MatrixXcd &R) const;
  double           error_at(const Frequency &frequency, const Fractions &model) const;

  Eigen::MatrixXd                C11_, M11_, G_; // scaled; G = [g_1, g_2, ...]
  std::array<Eigen::MatrixXd, 3> moments_;       // of all modes
  Eigen::VectorXd                omega0_;
  std::vector<Frequency>         frequencies_;
};

} // namespace gestell::coupling
