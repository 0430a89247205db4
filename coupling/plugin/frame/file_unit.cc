#include "coupling/plugin/frame/file_unit.h"

#include "fem/geometry/cad_file.h"
#include "fem/values/number_text.h"

#include <cmath>
#include <fstream>
#include <iterator>
#include <utility>

namespace gestell::coupling
{

namespace
{

const std::pair<const char *, double> prefixes[]    = {{".MICRO.", 1e-6}, {".MILLI.", 1e-3}, {".CENTI.", 1e-2},
                                                       {".DECI.", 1e-1},  {".KILO.", 1e3},   {"", 1.}};
const std::pair<const char *, double> conversions[] = {{"INCH", 0.0254}, {"FOOT", 0.3048}, {"FEET", 0.3048}, {"", 1.}};
const std::pair<const char *, double> names[]       = {{"mm", 1e-3}, {"cm", 1e-2},     {"m", 1.},
                                                       {"µm", 1e-6}, {"inch", 0.0254}, {"foot", 0.3048}};

template <std::size_t n>
double first_in(const std::string &text, const std::pair<const char *, double> (&words)[n])
{
  for (const auto &[word, value] : words)
    if (text.find(word) != std::string::npos)
      return value;
  return 1.;
}

std::string upper(std::string text)
{
  for (char &c : text)
    c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  return text;
}

/// [m] as the last entity with LENGTH_UNIT says that is not one inside a conversion: `( CONVERSION_BASED_UNIT('INCH',
/// #5) LENGTH_UNIT() ... )` refers to metres, which stand in an entity of their own.
double length_in_step(const std::string &path)
{
  std::ifstream     in(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  double            length = 1e-3;
  for (std::size_t at = text.find("LENGTH_UNIT"); at != std::string::npos; at = text.find("LENGTH_UNIT", at + 1))
  {
    const std::size_t begin = text.rfind(';', at) + 1, end = text.find(';', at);
    const std::string entity = upper(text.substr(begin, end - begin));
    if (entity.find("CONVERSION_BASED_UNIT") != std::string::npos)
      return first_in(entity, conversions);
    if (entity.find("SI_UNIT") != std::string::npos)
      length = first_in(entity, prefixes);
  }
  return length;
}

} // namespace

LengthUnit file_unit(const fem::FrameSpecification &frame)
{
  double length = frame.unit > 0. ? frame.unit : 1.;
  if (fem::is_step(frame.cad)) // whose unit the specification's overrides: the length of its millimetre
    length = length_in_step(frame.cad) * (frame.unit > 0. ? frame.unit / 1e-3 : 1.);
  for (const auto &[name, value] : names)
    if (std::abs(length - value) < 1e-9 * value)
      return {value, name};
  return {length, "x " + short_text(length) + " m"};
}

} // namespace gestell::coupling
