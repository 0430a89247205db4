#include "apps/cli/chart/chart_reference.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace gestell::apps
{
namespace
{

using coupling::MethodOptions;

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

/// An empty reference if a run failed, with the reason in `why`.
Reference attempt(const WorkProblem &problem, const Candidate &candidate, std::string &why)
{
  WorkProblem      patient  = problem;
  constexpr double patience = 20.; // Runs of a reference are worth this many times the limit of a run in the chart.
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

} // namespace

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
      notes.push_back("no reference from " + candidate.how + ": " + why);
    }
    catch (const std::invalid_argument &reason)
    {
      why = reason.what();
      notes.push_back("no reference from " + candidate.how + ": " + why);
    }
  notes.push_back("no reference: errors are unknown and only costs are compared; give a reference by --reference");
  Reference none;
  none.how    = "none, errors are unknown";
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
    reference.how   = file.path + ", assumed exact, because there is no reference run";
    return reference;
  }
  reference.error = scaled_error(own.values, reference.values);
  reference.how   = file.path + ", " + number(reference.error) + " from the reference run (" + own.how + ", error " +
                  number(own.error) + ")";
  return reference;
}

} // namespace gestell::apps
