#include "coupling/factors/make_factor.h"

#include "coupling/factors/cholmod_factor.h"
#include "coupling/factors/distributed_factor.h"
#include "coupling/factors/own_factor.h"
#include "coupling/factors/petsc_factor.h"

#include <stdexcept>
#include <utility>

namespace gestell::coupling
{

namespace
{

struct Kind
{
  const char *name;
  std::unique_ptr<StiffnessFactor> (*in_one_process)(FactorMatrices); ///< null: by PETSc, on any number of ranks
};
constexpr Kind kinds[] = {{"gestell", own_stiffness_factor}, {"cholmod", cholmod_stiffness_factor}, {"mumps", nullptr}};

} // namespace

std::unique_ptr<StiffnessFactor> make_factor(const std::string &name, FactorMatrices matrices)
{
  const fem::Ranks &ranks  = ranks_of_factors();
  const std::string chosen = !name.empty() ? name : ranks.size() > 1 ? "mumps" : "gestell";
  for (const auto &[kind, in_one_process] : kinds)
  {
    if (kind != chosen)
      continue;
    if (in_one_process && ranks.size() > 1)
      throw std::invalid_argument("reduction.factor = \"" + chosen +
                                  "\" is a factor of one process, but mpirun started " + std::to_string(ranks.size()) +
                                  " ranks; remove it (several ranks use \"mumps\"), or start without mpirun");
    if (in_one_process && !options_choose_solver())
      return in_one_process(std::move(matrices));
    return petsc_stiffness_factor(ranks, std::move(matrices));
  }
  throw std::invalid_argument("reduction.factor: there is no factor \"" + chosen + "\"; use gestell, cholmod or mumps");
}

} // namespace gestell::coupling
