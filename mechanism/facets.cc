#include "mechanism/facets.h"

#include <algorithm>

namespace gestell::mechanism
{

int n_history(const Element &element)
{
  const Branches *branches = element.branches();
  return branches ? branches->n_history() : 0;
}

std::vector<double> started(const Element &element, const LocalMotion &motion)
{
  std::vector<double> history(n_history(element) + 1);
  if (const Branches *branches = element.branches())
    branches->start(motion, history.data());
  return history;
}

int n_constraints(const Element &element)
{
  const Constraint *joint = element.ideal_joint();
  return joint ? joint->n_constraints() : 0;
}

std::vector<std::string> command_names(const Element &element)
{
  const Commands *commands = element.commands();
  return commands ? commands->command_names() : std::vector<std::string>{};
}

namespace
{
void zero(const Element &element, double *matrix)
{
  std::fill_n(matrix, element.n_measures() * element.n_measures(), 0.);
}
} // namespace

void engaged(const Element &element, const double *u, double *K, double *D)
{
  zero(element, K);
  zero(element, D);
  if (const Structure *structure = element.structure())
    structure->engaged(u, K, D);
}

void stiffest(const Element &element, const double *u, double *K, double *D)
{
  zero(element, K);
  zero(element, D);
  if (const Structure *structure = element.structure())
    structure->stiffest(u, K, D);
}

void open_branch(const Element &element, const double *u, double *K, double *D)
{
  zero(element, K);
  zero(element, D);
  if (const Structure *structure = element.structure())
    structure->open_branch(u, K, D);
}

void geometric(const Element &element, const LocalMotion &motion, const double *history, double *K)
{
  zero(element, K);
  if (const Structure *structure = element.structure())
    structure->geometric(motion, history, K);
}

bool stiffens(const Element &element)
{
  const Structure *structure = element.structure();
  return structure && structure->stiffens();
}

} // namespace gestell::mechanism
