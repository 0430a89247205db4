#pragma once

#include "coupling/integration/stability/characteristic_roots.h"
#include "coupling/integration/stability/test_oscillator.h"

#include <Eigen/Core>

namespace gestell::coupling
{

/// The parameters of Newmark's family:
///
///     M ((1-alpha_m) a_1 + alpha_m a_0) + (1-alpha_f) (B v + C q)_1 + alpha_f (B v + C q)_0 = f,
///     v_1 = v_0 + h ((1-gamma) a_0 + gamma a_1),    q_1 = q_0 + h v_0 + h^2 ((1/2-beta) a_0 + beta a_1).
struct NewmarkFamily
{
  double alpha_m, alpha_f, beta, gamma;
};

/// Its step of the test oscillator on (x, h x', h^2 x'').
Eigen::Matrix3d     newmark_matrix(const NewmarkFamily &f, const TestOscillator &o);
CharacteristicRoots newmark_roots(const NewmarkFamily &f, const TestOscillator &o);

} // namespace gestell::coupling
