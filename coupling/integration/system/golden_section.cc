#include "coupling/integration/system/golden_section.h"

namespace gestell::coupling
{

double highest(const std::function<long double(double)> &f, double a, double b)
{
  const double golden = 0.6180339887498949;
  double       x = b - golden * (b - a), y = a + golden * (b - a);
  long double  fx = f(x), fy = f(y);
  for (int i = 0; i < 45; ++i)
    if (fx > fy)
    {
      b = y, y = x, fy = fx;
      fx = f(x = b - golden * (b - a));
    }
    else
    {
      a = x, x = y, fx = fy;
      fy = f(y = a + golden * (b - a));
    }
  return 0.5 * (a + b);
}

} // namespace gestell::coupling
