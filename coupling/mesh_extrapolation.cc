#include "coupling/mesh_extrapolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

constexpr double least_order = 0.2, greatest_order = 4.; // k in n^(-k): edges that re-enter, and smooth cubic fields
constexpr double least_fall = 0.05, greatest_fall = 0.9; // of the estimate from mesh to mesh
constexpr double share_of_step = 0.5; // least uncertainty of three meshes: the order itself changes with the mesh

/// (v1 - v2) / (v2 - v3) for error = n^(-k); grows with k.
double quotient(const MeshValue &a, const MeshValue &b, const MeshValue &c, double k)
{
  const double n1 = 1., n2 = std::pow(b.coordinates / a.coordinates, -k),
               n3 = std::pow(c.coordinates / a.coordinates, -k);
  return (n1 - n2) / (n2 - n3);
}

/// The order the last three meshes show, NaN if none.
double observed_order(const std::vector<MeshValue> &meshes)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (meshes.size() < 3)
    return none;
  const MeshValue &a = meshes[meshes.size() - 3], &b = meshes[meshes.size() - 2], &c = meshes.back();
  const double     wanted = (a.value - b.value) / (b.value - c.value);
  double           low = least_order, high = greatest_order;
  if (!(wanted > quotient(a, b, c, low)) || !(wanted < quotient(a, b, c, high)))
    return none;
  for (int i = 0; i < 60; ++i)
  {
    const double middle                               = 0.5 * (low + high);
    (quotient(a, b, c, middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

} // namespace

Extrapolated extrapolate(const std::vector<MeshValue> &meshes)
{
  if (meshes.empty())
    throw std::invalid_argument("extrapolate: no mesh; at least one is needed.");
  const MeshValue &last = meshes.back();
  Extrapolated     result;
  result.order = std::numeric_limits<double>::quiet_NaN();
  if (meshes.size() == 1)
  {
    result.limit       = last.value;
    result.uncertainty = last.estimate;
    return result;
  }
  const MeshValue &before      = meshes[meshes.size() - 2];
  const double     step        = before.value - last.value;
  const auto       rest        = [&](double r) { return step * r / (1. - r); };
  const double     fall        = std::clamp(last.estimate / before.estimate, least_fall, greatest_fall);
  const double     by_estimate = rest(std::isfinite(fall) ? fall : greatest_fall);

  result.order      = observed_order(meshes);
  double correction = by_estimate, doubt = std::abs(by_estimate);
  if (!std::isnan(result.order))
  {
    correction = rest(std::pow(before.coordinates / last.coordinates, result.order));
    doubt      = std::max(std::abs(correction - by_estimate), share_of_step * std::abs(correction));
  }
  result.limit       = last.value - correction;
  result.uncertainty = std::abs(doubt / result.limit);
  return result;
}

} // namespace gestell::coupling
