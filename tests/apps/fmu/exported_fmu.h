#pragma once

#include "tests/apps/fmu/fmu_master.h"
#include "tests/support/csv_table.h"
#include "tests/support/program.h"
#include "tests/support/test.h"

namespace gestell::tests
{

/// An FMU of a scene, exported and unpacked.
struct Exported
{
  Exported(const Folder &folder, const std::string &name, const std::string &scene, const std::string &options = "")
  {
    const auto answer =
        gestell("export " + scene + " --quiet --fmu '" + (folder / (name + ".fmu")).string() + "' " + options);
    EXPECT_EQ(answer.exit_code, 0) << answer.text;
    fmu = std::make_unique<Fmu>(folder / (name + ".fmu"), folder / name);
  }

  std::unique_ptr<Fmu> fmu;
};

/// Range of a column of a history.
inline double range_of(const CsvTable &table, const std::string &column)
{
  double least = table.number(0, column), most = least;
  for (int row = 1; row < table.rows(); ++row)
  {
    least = std::min(least, table.number(row, column));
    most  = std::max(most, table.number(row, column));
  }
  return most - least;
}

/// By how much two values of a signal differ, by its range; of one that is constant by its size.  Infinite where one of
/// them is no finite number, so that no bound holds.
inline double share_of_difference(double one, double other, double range)
{
  const double scale = range > 0. ? range : std::max(std::abs(one), std::abs(other));
  if (!std::isfinite(one) || !std::isfinite(other) || !std::isfinite(range))
    return std::numeric_limits<double>::infinity();
  return scale > 0. ? std::abs(one - other) / scale : 0.;
}

/// The largest difference between an FMU that communicates at the rows of a history and that history, by the range of
/// each signal.
/// @param values  of parameters and inputs at the start
/// @param jumps   of the input F, by the number of the row where it takes another value
inline double difference_from_run(const Fmu &fmu, const std::filesystem::path &history,
                                  const std::map<std::string, double> &values = {},
                                  const std::map<int, double>         &jumps  = {})
{
  const CsvTable table(history.string());
  FmuInstance    instance(fmu);
  EXPECT_EQ(instance.start(values, table.number(0, "t [s]")), fmi2OK) << instance.last_message();
  std::map<std::string, std::string> columns;
  std::map<std::string, double>      ranges;
  for (const FmuScalar &scalar : fmu.scalars())
    if (scalar.causality == "output")
    {
      columns[scalar.name] = scalar.name + " [" + scalar.unit + "]";
      ranges[scalar.name]  = range_of(table, columns[scalar.name]);
    }
  double worst = 0.;
  for (int row = 0; row < table.rows(); ++row)
  {
    const double t = table.number(row, "t [s]");
    if (row > 0)
      if (const double before = table.number(row - 1, "t [s]"); instance.step(before, t - before) != fmi2OK)
        ADD_FAILURE() << t << ": " << instance.last_message();
    for (const auto &[name, column] : columns)
      worst = std::max(worst, share_of_difference(instance.get(name), table.number(row, column), ranges[name]));
    if (const auto jump = jumps.find(row); jump != jumps.end())
    {
      EXPECT_EQ(instance.set("F", jump->second), fmi2OK);
    }
  }
  return worst;
}

/// m x'' + b x' + c x = F on a slider, integrated much finer than it communicates.
inline std::string oscillator(const std::string &name, double mass, double stiffness, double start)
{
  return "name = \"" + name + "\"\n[parameters]\nM = \"" + std::to_string(mass) + " kg\"\nc = \"" +
         std::to_string(stiffness) +
         " N/m\"\n[body.mass]\ntype = \"slider\"\naxis = [1, 0, 0]\nmass = \"M\"\n"
         "[element.spring]\ntype = \"spring-damper\"\nfrom = \"mass\"\nstiffness = \"c\"\ndamping = \"2 N s/m\"\n"
         "[element.push]\ntype = \"force profile\"\nfrom = \"mass\"\nprofile = { input = \"F\" }\n"
         "[start]\nrule = \"given\"\nq = { mass = " +
         std::to_string(start) +
         " }\n[run]\nmethod = \"newmark\"\nstep = \"0.05 ms\"\nend = \"0.4 s\"\n"
         "[output.signals]\nx = \"mass.displacement\"\nv = \"mass.velocity\"\n";
}

} // namespace gestell::tests
