#pragma once

#include "fem/values/cell_shape.h"

#include <deal.II/base/quadrature.h>
#include <deal.II/fe/fe.h>
#include <deal.II/grid/tria.h>

namespace gestell::fem
{

/// The cells as deal.II knows them, numbered as in QuadraticMesh.  Include in files that are built with deal.II's
/// flags.
struct Grid
{
  dealii::Triangulation<3> cells;
};

/// FE_SimplexP(2), FE_Q(2) or FE_WedgeP(2).
const dealii::FiniteElement<3> &finite_element(CellKind kind);

/// Rules of 2, 3 or 4 points along a line; see CellPoints: samples, rule, finer.
dealii::Quadrature<3> quadrature(CellKind kind, unsigned int n_along);

} // namespace gestell::fem
