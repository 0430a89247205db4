#pragma once

#include "tests/support/csv_table.h"
#include "tests/support/scene_run.h"
#include "tests/support/test.h"

namespace gestell::tests
{

inline const CsvTable &benchmark_reference()
{
  static const CsvTable table(std::string(GESTELL_SOURCE_DIR) +
                              "/tests/reference/numerics/benchmark/m20_reference.csv");
  return table;
}

/// Root mean square over the rows 1 ms, 2 ms ... and q1 .. q12, each scaled by its largest magnitude in the reference.
inline double benchmark_error(const SceneRun &run)
{
  double sum = 0.;
  for (int j = 1; j <= 12; ++j)
  {
    const std::string name  = "q" + std::to_string(j);
    double            scale = 0.;
    for (int i = 0; i < benchmark_reference().rows(); ++i)
      scale = std::fmax(scale, std::abs(benchmark_reference().number(i, name)));
    for (std::size_t row = 1; row < run.n_rows(); ++row)
    {
      const int i = static_cast<int>(row) - 1;
      EXPECT_NEAR(run.at(row, 0), benchmark_reference().number(i, "t [s]"), 1e-12);
      sum += std::pow((run.at(row, j) - benchmark_reference().number(i, name)) / scale, 2);
    }
  }
  return std::sqrt(sum / (12. * double(run.n_rows() - 1)));
}

} // namespace gestell::tests
