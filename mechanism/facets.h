#pragma once

#include "mechanism/branches.h"
#include "mechanism/commands.h"
#include "mechanism/constraint.h"
#include "mechanism/force_law.h"
#include "mechanism/structure.h"

namespace gestell::mechanism
{

// Queries of the facets of any element, with defaults where it has none.

int n_history(const Element &element);
/// History at the start of a motion; one extra number, so that it is never empty.
std::vector<double> started(const Element &element, const LocalMotion &motion);

int n_constraints(const Element &element);

std::vector<std::string> command_names(const Element &element);

/// K and D [k x k, column major] of Structure.
void engaged(const Element &element, const double *u, double *K, double *D);
void stiffest(const Element &element, const double *u, double *K, double *D);
void open_branch(const Element &element, const double *u, double *K, double *D);
/// K [k x k, column major]
void geometric(const Element &element, const LocalMotion &motion, const double *history, double *K);
bool stiffens(const Element &element);

} // namespace gestell::mechanism
