#include "coupling/periodic/collocation/collocation_method.h"

#include "coupling/periodic/collocation/mesh_search.h"
#include "coupling/periodic/settling.h"

namespace gestell::coupling
{

namespace
{

class CollocationMethod final : public PeriodicMethod
{
public:
  std::string name() const override { return "collocation"; }
  std::string meaning() const override
  {
    return "Orthogonal collocation on an adaptive mesh with points at the events; condensed to the forces of the "
           "elements by the periodic base system.";
  }
  std::string refuses(const PeriodicProblem &problem) const override
  {
    return why_not_propagated(*problem.system, "settling");
  }
  std::vector<PeriodicOption>   options() const override { return {lead_in_option()}; }
  bool                          integrates() const override { return true; }
  std::vector<PeriodicSolution> solve(const PeriodicProblem &problem, const PeriodicGuess &guess,
                                      const PeriodicOptions &options) const override
  {
    MeshSearch    search(problem, options);
    PeriodicGuess near = guess;
    lead_in(search.flow(), problem, options, near);
    search.run(near);
    return {search.solution()};
  }
};

} // namespace

const PeriodicMethod &collocation_method()
{
  static const CollocationMethod method;
  return method;
}

} // namespace gestell::coupling
