#include "apps/output/tables/frequency_response_table.h"

#include "fem/values/number_text.h"

#include <cmath>

namespace gestell::apps
{

double phase_degrees(std::complex<double> value)
{
  return std::arg(value) * 180. / M_PI;
}

std::string frequency_response_csv(const FrequencyResponse &response)
{
  std::string csv = "frequency [Hz]";
  for (const ResponsePair &pair : response.pairs)
    for (const std::string part : {"re", "im", "abs"})
      csv += ',' + pair.name() + ' ' + part + " [" + pair.unit + ']' +
             (part == "abs" ? "," + pair.name() + " phase [deg]" : "");
  csv += '\n';
  for (std::size_t i = 0; i < response.frequencies_hz.size(); ++i)
  {
    append_exact(csv, response.frequencies_hz[i]);
    for (const ResponsePair &pair : response.pairs)
      for (const double value :
           {pair.values[i].real(), pair.values[i].imag(), std::abs(pair.values[i]), phase_degrees(pair.values[i])})
        append_exact(csv += ',', value);
    csv += '\n';
  }
  return csv;
}

} // namespace gestell::apps
