#include "tests/fuzz/target.h"

#include "apps/analysis/frf/measured_response.h"
#include "apps/cli/chart/reference_file.h"
#include "apps/scene/file/csv_file.h"
#include "apps/scene/file/universal_file.h"

#include <cmath>

namespace gestell::fuzz
{
namespace
{

using namespace gestell::apps;

/// Every cell, as a number and as a whole one.
void table(const std::string &bytes)
{
  const CsvFile file = read_csv(file_of("fed.csv", bytes));
  for (const CsvFile::Line &line : file.lines)
    for (std::size_t column = 0; column < line.cells.size(); ++column)
    {
      promise(line.cells.size() == file.head.size(), "a line of a table with more cells than its head");
      try
      {
        promise(std::isfinite(file.number(line, column)), "a number of a table is not finite");
      }
      catch (const std::invalid_argument &)
      {
      }
      file.integer(line, column);
    }
}

void reference(const std::string &bytes)
{
  const ReferenceFile file(file_of("history.csv", bytes));
  for (std::size_t i = 0; i < file.times.size(); ++i)
    promise(std::isfinite(file.times[i]) && (i == 0 || file.times[i] > file.times[i - 1]), "times do not ascend");
}

void require_finite(const std::vector<MeasuredResponse> &curves)
{
  for (const MeasuredResponse &curve : curves)
  {
    promise(curve.frequencies_hz.size() == curve.values.size(), "a curve with frequencies and no values");
    for (std::size_t i = 0; i < curve.values.size(); ++i)
      promise(std::isfinite(curve.frequencies_hz[i]) && std::isfinite(curve.values[i].real()) &&
                  std::isfinite(curve.values[i].imag()),
              "a measured value is not finite");
  }
}

FrequencyResponse requested()
{
  FrequencyResponse response;
  response.pairs.resize(2);
  for (ResponsePair &pair : response.pairs)
    pair.unit = "m/N";
  return response;
}

void measured(const std::string &bytes)
{
  require_finite(measured_responses({file_of("measured.csv", bytes)}, requested()));
}

void universal(const std::string &bytes)
{
  require_finite(measured_responses({file_of("measured.uff", bytes)}, requested()));
}

} // namespace

std::vector<Target> table_targets()
{
  return {{"table", table}, {"reference", reference}, {"measured", measured}, {"universal", universal}};
}

} // namespace gestell::fuzz
