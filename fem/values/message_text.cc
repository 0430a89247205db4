#include "fem/values/message_text.h"

#include <cmath>
#include <sstream>

namespace gestell::fem
{

std::string text(double value)
{
  std::ostringstream out;
  out.precision(5);
  out << (std::abs(value) < 1e-9 ? 0. : value);
  return out.str();
}

std::string text(const Vector3 &v)
{
  std::string words = "(";
  for (int d = 0; d < 3; ++d) // OpenCASCADE widens boxes by 1e-7
    words += text(std::round(v[d] * 1e6) * 1e-6) + (d < 2 ? " " : ")");
  return words;
}

} // namespace gestell::fem
