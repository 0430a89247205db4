#include "apps/analysis/frf/measured_response.h"

#include "apps/scene/file/csv_file.h"
#include "apps/scene/file/universal_file.h"
#include "apps/scene/language/parse_quantity.h"
#include "fem/values/named_file.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"
#include "fem/values/trimmed.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>

namespace gestell::apps
{

namespace
{

using Complex = std::complex<double>;

/// A curve from a file, before its pair is known.
struct ReadCurve
{
  MeasuredResponse   curve;
  std::string        unit;        ///< "": as the pair has it
  std::optional<int> derivatives; ///< of a displacement, if the file contains this number
  std::string        place;       ///< for messages
};

// --- tables

/// "tip.ux/motor.uy re [m/N]"
struct Column
{
  std::string name, part, unit;
};

Column column_of(const std::string &head)
{
  Column      column;
  std::string text = head;
  if (const auto open = text.rfind('['), close = text.rfind(']');
      open != std::string::npos && close != std::string::npos && close > open)
  {
    column.unit = trimmed(text.substr(open + 1, close - open - 1));
    text        = trimmed(text.substr(0, open));
  }
  const auto blank = text.rfind(' ');
  column.name      = blank == std::string::npos ? "" : trimmed(text.substr(0, blank));
  column.part      = blank == std::string::npos ? text : text.substr(blank + 1);
  std::transform(column.part.begin(), column.part.end(), column.part.begin(),
                 [](unsigned char c) { return char(std::tolower(c)); });
  return column;
}

/// Columns of the parts of a curve.
struct Columns
{
  std::string name, unit, phase_unit;
  int         re = -1, im = -1, amplitude = -1, phase = -1;
};

void place_column(int i, const Column &column, std::vector<Columns> &curves)
{
  int Columns::*where = nullptr;
  const auto    is    = [&](std::initializer_list<const char *> words)
  { return std::any_of(words.begin(), words.end(), [&](const char *word) { return column.part == word; }); };
  if (is({"re", "real"}))
    where = &Columns::re;
  else if (is({"im", "imag", "imaginary"}))
    where = &Columns::im;
  else if (is({"abs", "amplitude", "magnitude"}))
    where = &Columns::amplitude;
  else if (is({"phase"}))
    where = &Columns::phase;
  else
    return;
  auto own = std::find_if(curves.begin(), curves.end(), [&](const Columns &c) { return c.name == column.name; });
  if (own == curves.end())
    own = curves.insert(own, {column.name, "", "", -1, -1, -1, -1});
  (*own).*where                                            = i;
  (where == &Columns::phase ? own->phase_unit : own->unit) = column.unit;
}

Complex value_of(const CsvFile &file, const CsvFile::Line &line, const Columns &columns)
{
  if (columns.re >= 0)
    return {file.number(line, std::size_t(columns.re)), file.number(line, std::size_t(columns.im))};
  const double amplitude = file.number(line, std::size_t(columns.amplitude));
  const double phase     = columns.phase >= 0 ? file.number(line, std::size_t(columns.phase)) : 0.;
  return std::polar(1., columns.phase_unit == "rad" ? phase : phase * M_PI / 180.) * amplitude;
}

std::vector<ReadCurve> of_table(const std::string &name)
{
  const CsvFile        file = read_csv(name);
  std::vector<Columns> found;
  for (std::size_t i = 1; i < file.head.size(); ++i)
    place_column(int(i), column_of(file.head[i]), found);
  const std::string place = file.place(file.head_number);
  if (found.empty() || file.head[0].find("requency") == std::string::npos)
    throw std::invalid_argument(place + "needs a first column \"frequency [Hz]\", and columns \"re\" and \"im\", or "
                                        "\"amplitude\" and perhaps \"phase [deg]\"");
  std::vector<ReadCurve> curves;
  for (const Columns &columns : found)
  {
    const bool parts = columns.re >= 0 && columns.im >= 0;
    if (!parts && columns.amplitude < 0)
      throw std::invalid_argument(place + "column \"re\" or \"im\" is missing" +
                                  (columns.name.empty() ? "" : " for \"" + columns.name + "\""));
    Columns own = columns;
    own.re      = parts ? columns.re : -1;
    ReadCurve curve;
    curve.place           = place;
    curve.unit            = columns.unit;
    curve.curve.file      = name;
    curve.curve.name      = columns.name;
    curve.curve.has_phase = parts || columns.phase >= 0;
    for (const CsvFile::Line &line : file.lines)
    {
      const double f = file.number(line, 0);
      if (!(f >= 0.) || (!curve.curve.frequencies_hz.empty() && !(f > curve.curve.frequencies_hz.back())))
        throw std::invalid_argument(file.place(line.number) + "frequencies must ascend from 0");
      curve.curve.frequencies_hz.push_back(f);
      curve.curve.values.push_back(value_of(file, line, own));
    }
    curves.push_back(curve);
  }
  return curves;
}

// --- universal files

std::vector<ReadCurve> of_universal(const std::string &name)
{
  std::vector<ReadCurve> curves;
  for (const UniversalFunction &function : read_universal_functions(name))
  {
    ReadCurve curve;
    curve.place = name + ":" + std::to_string(function.line) + ": ";
    curve.curve = {name, function.name, 0, function.is_complex, function.abscissa, function.values};
    if (function.derivatives >= 0)
      curve.derivatives = function.derivatives;
    curves.push_back(curve);
  }
  return curves;
}

std::vector<ReadCurve> curves_of(const std::string &name)
{
  std::string ending = std::filesystem::path(name).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return char(std::tolower(c)); });
  if (ending == ".csv")
    return of_table(name);
  if (ending == ".uff" || ending == ".unv" || ending == ".uf")
    return of_universal(name);
  throw std::invalid_argument("--measured " + name + ": needs a table (.csv) or a universal file (.uff, .unv)");
}

// --- for a pair

Quantity unit_quantity(const std::string &place, const std::string &unit)
{
  try
  {
    return parse_quantity("1 " + unit, [](const std::string &) { return std::nullopt; });
  }
  catch (const std::invalid_argument &error)
  {
    throw std::invalid_argument(place + "the unit [" + unit + "]: " + error.what());
  }
}

/// Values in the unit of the pair: scaled, and differentiated or integrated where another derivative was measured.
void convert(ReadCurve &read, const ResponsePair &pair)
{
  double factor = 1.;
  int    times  = read.derivatives ? pair.derivatives - *read.derivatives : 0;
  if (!read.unit.empty() && read.unit != pair.unit)
  {
    const Quantity own = unit_quantity(read.place, read.unit), wanted = unit_quantity(read.place, pair.unit);
    Dimension      reached = own.dimension;
    times                  = int(std::lround(own.dimension[2] - wanted.dimension[2])); // 1/s per derivative
    reached[2] -= times;
    constexpr int highest_derivative = 2; // from displacement to acceleration
    if (!equal(reached, wanted.dimension) || std::abs(times) > highest_derivative)
      throw std::invalid_argument(read.place + "the unit [" + read.unit + "] does not match " + pair.name() +
                                  ", which is in [" + pair.unit + "]");
    factor = own.value / wanted.value;
  }
  MeasuredResponse &curve = read.curve;
  if (times < 0 && !curve.frequencies_hz.empty() && curve.frequencies_hz.front() == 0.)
  {
    curve.frequencies_hz.erase(curve.frequencies_hz.begin()); // no value is defined at rest
    curve.values.erase(curve.values.begin());
  }
  for (std::size_t i = 0; i < curve.values.size(); ++i)
  {
    curve.values[i] *= factor * std::pow(Complex(0., two_pi * curve.frequencies_hz[i]), times);
    if (!std::isfinite(curve.values[i].real()) || !std::isfinite(curve.values[i].imag()))
      throw std::invalid_argument(read.place + "the value at " + rounded(curve.frequencies_hz[i]) +
                                  " Hz overflows in [" + pair.unit + "]; check the value and its unit");
  }
}

/// The pair of a name; -1: none.
int pair_of(const std::string &name, const FrequencyResponse &response)
{
  for (std::size_t i = 0; i < response.pairs.size(); ++i)
    if (response.pairs[i].name() == name)
      return int(i);
  return -1;
}

/// "PAIR=FILE" in its parts; -1: no pair is named.
std::pair<int, std::string> requested(const std::string &text, const FrequencyResponse &response)
{
  const auto equals = text.find('=');
  if (equals == std::string::npos || fem::names_something(text))
    return {-1, text};
  const std::string        name = text.substr(0, equals);
  std::vector<std::string> names;
  for (const ResponsePair &pair : response.pairs)
    names.push_back(pair.name());
  if (const int pair = pair_of(name, response); pair >= 0)
    return {pair, text.substr(equals + 1)};
  throw std::invalid_argument("--measured " + text + ": there is no pair \"" + name + "\"" + suggestion(name, names));
}

} // namespace

std::vector<MeasuredResponse> measured_responses(const std::vector<std::string> &files,
                                                 const FrequencyResponse        &response)
{
  std::vector<MeasuredResponse> measured;
  int                           next = 0;
  for (const std::string &text : files)
  {
    const auto [named, file]      = requested(text, response);
    std::vector<ReadCurve> curves = curves_of(file);
    if (named >= 0 && curves.size() > 1)
      throw std::invalid_argument("--measured " + text + ": the file contains " + std::to_string(curves.size()) +
                                  " curves; omit the pair to assign them in order");
    for (ReadCurve &read : curves)
    {
      const int own   = named >= 0 ? named : pair_of(read.curve.name, response);
      read.curve.pair = own >= 0 ? own : next++;
      if (read.curve.pair >= int(response.pairs.size()))
        throw std::invalid_argument(read.place + "is an extra curve: the number of pairs of --from and --to is " +
                                    std::to_string(response.pairs.size()) +
                                    "; select a pair with --measured PAIR=FILE");
      read.curve.pair_name = response.pairs[std::size_t(read.curve.pair)].name();
      convert(read, response.pairs[std::size_t(read.curve.pair)]);
      measured.push_back(read.curve);
    }
  }
  return measured;
}

} // namespace gestell::apps
