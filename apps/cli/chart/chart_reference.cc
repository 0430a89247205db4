#include "apps/cli/chart/chart_reference.h"

#include "fem/values/nearest_name.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>

namespace gestell::apps
{
namespace
{

using coupling::MethodOptions;

/// Runs of a reference are worth this many times the limit of a run in the chart.
constexpr double patience = 20.;

std::string number(double x)
{
  char text[32];
  std::snprintf(text, sizeof text, "%.2g", x);
  return text;
}

MethodOptions controlled(const WorkProblem &problem, const std::string &method, int order, double tolerance)
{
  MethodOptions options;
  options.method    = method;
  options.order     = order;
  options.tolerance = tolerance;
  options.step      = longest_step(problem);
  return options;
}

/// BDF 2 with fixed steps, where no control gets through.
MethodOptions fixed(const WorkProblem &problem, double steps)
{
  MethodOptions options;
  options.step = (problem.samples.back() - problem.begin) / steps;
  return options;
}

/// The finest of several runs, with its distance from the others as error.
struct Candidate
{
  MethodOptions finest;
  MethodOptions others[2];
  std::string   how;
};

/// An empty reference if a run failed; `why` then tells.
Reference attempt(const WorkProblem &problem, const Candidate &candidate, std::string &why)
{
  WorkProblem patient = problem;
  patient.cpu_limit *= patience;
  patient.repeat_s = 0.;
  Reference  reference;
  const auto run = [&](const MethodOptions &method)
  {
    const WorkRun result = measure(patient, method, true);
    reference.cpu_s += result.cpu_s;
    if (!result.failure.empty())
      why = coupling::method_name(method) +
            (method.tolerance > 0. ? ", tolerance " + number(method.tolerance) : ", step " + number(method.step)) +
            ": " + result.failure;
    return result.values;
  };
  reference.values = run(candidate.finest);
  for (const MethodOptions &other : candidate.others)
  {
    if (reference.values.size() == 0)
      return reference;
    const SignalSamples values = run(other);
    if (values.size() == 0)
      reference.values.resize(0, 0);
    else
      reference.error = std::max(reference.error, scaled_error(values, reference.values));
  }
  reference.method = candidate.others[0];
  reference.how    = candidate.how;
  return reference;
}

std::string name_without_unit(const std::string &head)
{
  std::string name = head.substr(0, head.find('['));
  name.erase(0, name.find_first_not_of(" \""));
  name.erase(name.find_last_not_of(" \"\r") + 1);
  return name;
}

} // namespace

ReferenceFile::ReferenceFile(const std::string &file_path) : path(file_path)
{
  std::ifstream file(path);
  const auto    refuse = [&](long line, const std::string &reason)
  { throw std::invalid_argument("--reference: " + path + ":" + std::to_string(line) + ": " + reason); };
  std::string line;
  if (!file || !std::getline(file, line))
    throw std::invalid_argument("--reference: " + path + " cannot be read; give a CSV file with a header line");
  std::istringstream head(line);
  for (std::string cell; std::getline(head, cell, ',');)
    names_.push_back(name_without_unit(cell));
  if (names_.size() < 2 || names_.front() != "t")
    refuse(1, "the header must name t and at least one signal, such as \"t [s],F_P [N]\"");
  columns_.resize(names_.size());
  for (long row = 2; std::getline(file, line); ++row)
  {
    std::istringstream cells(line);
    std::size_t        i = 0;
    for (std::string cell; std::getline(cells, cell, ','); ++i)
    {
      char        *end   = nullptr;
      const double value = std::strtod(cell.c_str(), &end);
      while (end != cell.c_str() && std::isspace(static_cast<unsigned char>(*end)))
        ++end;
      if (i >= names_.size() || end == cell.c_str() || *end != '\0' || !std::isfinite(value))
        refuse(row, "\"" + cell + "\" is no number of one of the " + std::to_string(names_.size()) + " columns");
      columns_[i].push_back(value);
    }
    if (i != names_.size())
      refuse(row, std::to_string(i) + " numbers, but " + std::to_string(names_.size()) + " columns");
    if (columns_[0].size() > 1 && !(columns_[0].back() > columns_[0][columns_[0].size() - 2]))
      refuse(row, "the times must ascend");
  }
  if (columns_[0].size() < 2)
    refuse(1, "no rows of numbers follow");
  times = columns_[0];
}

bool ReferenceFile::has(const std::string &name) const
{
  return std::find(names_.begin() + 1, names_.end(), name) != names_.end();
}

const std::vector<double> &ReferenceFile::column(const std::string &name) const
{
  return columns_[std::find(names_.begin() + 1, names_.end(), name) - names_.begin()];
}

Reference own_reference(const WorkProblem &problem, std::vector<std::string> &notes)
{
  const auto      exact = [&](int order, double tolerance) { return controlled(problem, "exact", order, tolerance); };
  const auto      bdf   = [&](double tolerance) { return controlled(problem, "bdf", 5, tolerance); };
  const Candidate candidates[] = {
      {exact(8, 1e-12), {exact(8, 1e-11), exact(6, 1e-12)}, "exact, collocation 8, tolerance 1e-12, events located"},
      {exact(8, 1e-10), {exact(8, 1e-9), exact(6, 1e-10)}, "exact, collocation 8, tolerance 1e-10, events located"},
      {bdf(1e-10), {bdf(1e-9), bdf(1e-8)}, "BDF 5, tolerance 1e-10, events located"},
      {bdf(1e-8), {bdf(1e-7), bdf(1e-6)}, "BDF 5, tolerance 1e-8, events located"},
      {bdf(1e-6), {bdf(1e-5), bdf(1e-4)}, "BDF 5, tolerance 1e-6, events located"},
      {fixed(problem, 4e5), {fixed(problem, 2e5), fixed(problem, 1e5)}, "BDF 2, 400 000 fixed steps, events located"}};
  std::string why;
  for (const Candidate &candidate : candidates)
    try
    {
      const Reference reference = attempt(problem, candidate, why);
      if (reference.values.size() > 0)
        return reference;
      notes.push_back("no reference by " + candidate.how + ": " + why);
    }
    catch (const std::invalid_argument &reason)
    {
      why = reason.what();
      notes.push_back("no reference by " + candidate.how + ": " + why);
    }
  notes.push_back("no reference: errors are not known, only what each run costs; give one by --reference");
  Reference none;
  none.how    = "none, errors are not known";
  none.method = fixed(problem, 1e4);
  return none;
}

Reference compared(const ReferenceFile &file, const std::vector<coupling::Signal> &signals, const Reference &own)
{
  Reference reference = own;
  for (std::size_t i = 0; i < signals.size(); ++i)
    reference.values.row(Eigen::Index(i)) =
        Eigen::Map<const Eigen::RowVectorXd>(file.column(signals[i].name).data(), Eigen::Index(file.times.size()));
  if (own.values.size() == 0)
  {
    reference.error = 0.;
    reference.how   = file.path + ", taken as exact: there is no reference of our own";
    return reference;
  }
  reference.error = scaled_error(own.values, reference.values);
  reference.how =
      file.path + ", " + number(reference.error) + " from our own (" + own.how + ", error " + number(own.error) + ")";
  return reference;
}

} // namespace gestell::apps
