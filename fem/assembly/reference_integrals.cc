#include "fem/assembly/reference_integrals.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace gestell::fem
{

namespace
{

// Rules of Witherden and Vincent with parameter n integrate degree 2 n - 1 exactly: n = 3 carries the masses (degree
// 4).
constexpr unsigned int rule = 3;

template <int n>
std::vector<FacePoint<n>> face_rule(const dealii::FiniteElement<2> &element, const dealii::Quadrature<2> &rule)
{
  std::vector<FacePoint<n>> points(rule.size());
  for (unsigned int p = 0; p < rule.size(); ++p)
  {
    points[p].weight = rule.weight(p);
    for (int a = 0; a < n; ++a)
    {
      points[p].N[a] = element.shape_value(a, rule.point(p));
      for (int i = 0; i < 2; ++i)
        points[p].dN(a, i) = element.shape_grad(a, rule.point(p))[i];
    }
  }
  return points;
}

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

  const dealii::FE_SimplexP<2>              triangle(2);
  const dealii::QWitherdenVincentSimplex<2> area(rule);
  for (unsigned int p = 0; p < area.size(); ++p)
    for (int a = 0; a < 6; ++a)
      for (int b = 0; b < 6; ++b)
        result.triangle_mass(a, b) +=
            area.weight(p) * triangle.shape_value(a, area.point(p)) * triangle.shape_value(b, area.point(p));

  result.triangle      = face_rule<6>(triangle, area);
  result.quadrilateral = face_rule<9>(dealii::FE_Q<2>(2), dealii::QGauss<2>(3));

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
