#include "apps/study/file/output_units.h"

#include "apps/study/file/unit_quantity.h"

#include <stdexcept>

namespace gestell::apps
{
namespace
{

std::string unit_text(const StudyOutput &output)
{
  return output.unit.empty() ? "has no unit" : "is in " + output.unit;
}

void check_value(const OutputValue &claim, const StudyOutput &output)
{
  const Quantity unit = quantity_in_unit(1., output.unit);
  if (!claim.value.checked || !unit.checked || equal(claim.value.dimension, unit.dimension))
    return;
  throw std::invalid_argument(
      claim.place + "is in " + describe(claim.value.dimension) + ", but output " + output.name + ' ' +
      unit_text(output) + "; use a matching unit" +
      (output.unit.empty() ? ", as a plain number" : ", or as a plain number in " + output.unit));
}

void check_sum(const std::vector<SummedGoal> &goals, const std::vector<StudyOutput> &outputs)
{
  for (const SummedGoal &goal : goals)
    for (const SummedGoal &other : goals)
    {
      const StudyOutput &one = outputs.at(std::size_t(goal.output)), &two = outputs.at(std::size_t(other.output));
      const Quantity     a = quantity_in_unit(1., one.unit), b = quantity_in_unit(1., other.is_scaled ? "" : two.unit);
      if (!goal.is_scaled && a.checked && b.checked && !equal(a.dimension, b.dimension))
        throw std::invalid_argument(goal.place + "output " + one.name + ' ' + unit_text(one) +
                                    " and is summed with output " + two.name + ", which " +
                                    (other.is_scaled ? "has a scale" : unit_text(two)) +
                                    "; give each goal a scale, such as its value in the first design");
    }
}

} // namespace

void check_units(const OutputClaims &claims, const std::vector<StudyOutput> &outputs)
{
  for (const OutputValue &claim : claims.values)
    check_value(claim, outputs.at(std::size_t(claim.output)));
  for (const std::vector<SummedGoal> &sum : claims.sums)
    check_sum(sum, outputs);
}

} // namespace gestell::apps
