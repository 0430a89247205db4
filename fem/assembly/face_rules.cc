#include "fem/assembly/face_rules.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/fe_q.h>
#include <deal.II/fe/fe_simplex_p.h>

#include <vector>

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

constexpr int parts = 4; // of a side

/// On the triangles between lines parallel to the sides.
dealii::Quadrature<2> divided(const dealii::Quadrature<2> &rule)
{
  std::vector<dealii::Point<2>> points;
  std::vector<double>           weights;
  for (int i = 0; i < parts; ++i)
    for (int j = 0; i + j < parts; ++j)
      for (const bool turned : {false, true})
        for (unsigned int p = 0; p < rule.size() && !(turned && i + j + 1 == parts); ++p)
        {
          const double x = turned ? 1. - rule.point(p)[0] : rule.point(p)[0],
                       y = turned ? 1. - rule.point(p)[1] : rule.point(p)[1];
          points.emplace_back((i + x) / parts, (j + y) / parts);
          weights.push_back(rule.weight(p) / (parts * parts));
        }
  return {points, weights};
}

FaceRules rules_of(const dealii::Quadrature<2> &triangle, const dealii::Quadrature<2> &quadrilateral)
{
  return {face_rule<6>(dealii::FE_SimplexP<2>(2), triangle), face_rule<9>(dealii::FE_Q<2>(2), quadrilateral)};
}

} // namespace

const FaceRules &face_rules()
{
  static const FaceRules rules = rules_of(dealii::QWitherdenVincentSimplex<2>(3), dealii::QGauss<2>(3));
  return rules;
}

const FaceRules &fine_face_rules()
{
  static const FaceRules rules =
      rules_of(divided(dealii::QWitherdenVincentSimplex<2>(3)), dealii::QIterated<2>(dealii::QGauss<1>(3), parts));
  return rules;
}

} // namespace gestell::fem
