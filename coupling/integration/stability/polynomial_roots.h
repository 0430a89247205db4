#pragma once

#include <complex>
#include <vector>

namespace gestell::coupling
{

using LongComplex = std::complex<long double>;

/// All roots of  sum coefficients[j] x^j = 0,  degree up to 12, by Laguerre's method with deflation from the smallest
/// root upwards, each polished on the whole polynomial.  Simple roots have a relative error of a few units of long
/// double; for a k-fold root it is the k-th root of that.  Zero leading coefficients lower the degree.
std::vector<LongComplex> polynomial_roots(std::vector<LongComplex> coefficients);

} // namespace gestell::coupling
