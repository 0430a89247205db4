#include "fem/assembly/elasticity.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace gestell::fem
{

namespace
{

// Rules of Witherden and Vincent with parameter n integrate degree 2 n - 1 exactly: n = 3 carries the masses (degree
// 4).
constexpr unsigned int rule = 3;

ReferenceIntegrals integrate()
{
  ReferenceIntegrals result;
  result.mass.setZero();
  result.triangle_mass.setZero();
  for (auto &row : result.gradients)
    for (auto &block : row)
      block.setZero();

  const dealii::FE_SimplexP<3>              tetrahedron(2);
  const dealii::QWitherdenVincentSimplex<3> volume(rule);
  for (unsigned int p = 0; p < volume.size(); ++p)
    for (int a = 0; a < 10; ++a)
      for (int b = 0; b < 10; ++b)
      {
        const auto x = volume.point(p);
        result.mass(a, b) += volume.weight(p) * tetrahedron.shape_value(a, x) * tetrahedron.shape_value(b, x);
        for (int i = 0; i < 3; ++i)
          for (int j = 0; j < 3; ++j)
            result.gradients[a][b](i, j) +=
                volume.weight(p) * tetrahedron.shape_grad(a, x)[i] * tetrahedron.shape_grad(b, x)[j];
      }

  for (unsigned int p = 0; p < volume.size(); ++p)
  {
    result.tetrahedron.emplace_back().weight = volume.weight(p);
    for (int a = 0; a < 10; ++a)
    {
      result.tetrahedron.back().N[a] = tetrahedron.shape_value(a, volume.point(p));
      for (int i = 0; i < 3; ++i)
        result.tetrahedron.back().dN(a, i) = tetrahedron.shape_grad(a, volume.point(p))[i];
    }
  }

  const auto &corners = tetrahedron.get_unit_support_points(); // the first four
  for (int k = 0; k < 4; ++k)
    for (int a = 0; a < 10; ++a)
      for (int i = 0; i < 3; ++i)
        result.corner_gradients[k](a, i) = tetrahedron.shape_grad(a, corners[k])[i];

  const dealii::FE_SimplexP<2>              triangle(2);
  const dealii::QWitherdenVincentSimplex<2> area(rule);
  for (unsigned int p = 0; p < area.size(); ++p)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        result.triangle_mass(a, b) +=
            area.weight(p) * triangle.shape_value(a, area.point(p)) * triangle.shape_value(b, area.point(p));

  for (unsigned int p = 0; p < area.size(); ++p)
  {
    result.triangle.emplace_back().weight = area.weight(p);
    for (int a = 0; a < 6; ++a)
    {
      result.triangle.back().N[a] = triangle.shape_value(a, area.point(p));
      for (int i = 0; i < 2; ++i)
        result.triangle.back().dN(a, i) = triangle.shape_grad(a, area.point(p))[i];
    }
  }

  // Symmetric to the last bit, as the solvers of symmetric matrices read one triangle only.
  result.mass          = 0.5 * (result.mass + result.mass.transpose()).eval();
  result.triangle_mass = 0.5 * (result.triangle_mass + result.triangle_mass.transpose()).eval();
  return result;
}

} // namespace

const ReferenceIntegrals &reference_integrals()
{
  static const ReferenceIntegrals integrals = integrate();
  return integrals;
}

} // namespace gestell::fem
