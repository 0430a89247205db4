#include "fem/assembly/finite_elements.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_wedge_p.h>

namespace gestell::fem
{

namespace
{

using Quadrature = dealii::Quadrature<3>;

/// A rule of the triangle times one of Gauss.
Quadrature across(const dealii::Quadrature<2> &triangle, const dealii::Quadrature<1> &line)
{
  std::vector<dealii::Point<3>> points;
  std::vector<double>           weights;
  for (unsigned int k = 0; k < line.size(); ++k)
    for (unsigned int i = 0; i < triangle.size(); ++i)
    {
      points.emplace_back(triangle.point(i)[0], triangle.point(i)[1], line.point(k)[0]);
      weights.push_back(triangle.weight(i) * line.weight(k));
    }
  return {points, weights};
}

/// Rules of Witherden and Vincent with parameter n integrate degree 2 n - 1 exactly: masses are of degree 4.
template <int dim>
dealii::Quadrature<dim> simplex_rule()
{
  return dealii::QWitherdenVincentSimplex<dim>(3);
}

Quadrature of_tetrahedron(unsigned int n_along)
{
  constexpr double near = 0.58541019662496845, far = 0.1381966011250105; // rule of degree 2
  if (n_along > 2)
    return simplex_rule<3>();
  return {{{far, far, far}, {near, far, far}, {far, near, far}, {far, far, near}}, std::vector<double>(4, 1. / 24.)};
}

/// Gradients of quadratics are linear on a triangle: three points inside carry them.
Quadrature of_prism(unsigned int n_along)
{
  const std::vector<dealii::Point<2>> inside = {{1. / 6., 1. / 6.}, {2. / 3., 1. / 6.}, {1. / 6., 2. / 3.}};
  const dealii::Quadrature<2>         three(inside, std::vector<double>(3, 1. / 6.));
  return across(n_along > 2 ? simplex_rule<2>() : three, dealii::QGauss<1>(n_along));
}

} // namespace

const dealii::FiniteElement<3> &finite_element(CellKind kind)
{
  static const dealii::FE_SimplexP<3> tetrahedron(2);
  static const dealii::FE_Q<3>        hexahedron(2);
  static const dealii::FE_WedgeP<3>   prism(2);
  switch (kind)
  {
  case CellKind::tetrahedron:
    return tetrahedron;
  case CellKind::hexahedron:
    return hexahedron;
  default:
    return prism;
  }
}

Quadrature quadrature(CellKind kind, unsigned int n_along)
{
  switch (kind)
  {
  case CellKind::tetrahedron:
    return of_tetrahedron(n_along);
  case CellKind::hexahedron:
    return dealii::QGauss<3>(n_along);
  default:
    return of_prism(n_along);
  }
}

} // namespace gestell::fem
