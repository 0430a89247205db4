#pragma once

#include <array>

namespace gestell::coupling
{

/// BDF formula of order p, (5.5.2/6):  h beta0 y'_k = y_k + sum_{i=1..p} alpha[i-1] y_{k-i}. With h_beta = beta0 h the
/// matrix of a step is A = M + h_beta B + h_beta^2 C, (5.5.2/13).
struct BdfFormula
{
  double                beta0;
  std::array<double, 6> alpha;
};

constexpr std::array<BdfFormula, 6> bdf_formulas = {
    {{1., {-1.}},
     {2. / 3., {-4. / 3., 1. / 3.}},
     {6. / 11., {-18. / 11., 9. / 11., -2. / 11.}},
     {12. / 25., {-48. / 25., 36. / 25., -16. / 25., 3. / 25.}},
     {60. / 137., {-300. / 137., 300. / 137., -200. / 137., 75. / 137., -12. / 137.}},
     {60. / 147., {-360. / 147., 450. / 147., -400. / 147., 225. / 147., -72. / 147., 10. / 147.}}}};

} // namespace gestell::coupling
