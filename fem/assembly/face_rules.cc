#include "fem/assembly/face_rules.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

namespace gestell::fem
{

namespace
{

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

} // namespace

const FaceRules &face_rules()
{
  static const FaceRules rules{face_rule<6>(dealii::FE_SimplexP<2>(2), dealii::QWitherdenVincentSimplex<2>(3)),
                               face_rule<9>(dealii::FE_Q<2>(2), dealii::QGauss<2>(3))};
  return rules;
}

} // namespace gestell::fem
