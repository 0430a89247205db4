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
constexpr double settled_order = 1.;                     // for values that settle faster: h^2 of walls, h^3 of blocks
constexpr double least_fall = 0.05, greatest_fall = 0.9; // of the estimate from mesh to mesh
constexpr double share_of_step = 0.5; // least uncertainty of three meshes: the order itself changes with the mesh

/// (v1 - v2) / (v2 - v3) for error = n^(-k); grows with k.
double quotient(const MeshValue &a, const MeshValue &b, const MeshValue &c, double k)
{
  const double n1 = 1., n2 = std::pow(b.coordinates / a.coordinates, -k),
               n3 = std::pow(c.coordinates / a.coordinates, -k);
  return (n1 - n2) / (n2 - n3);
}

/// The order that three meshes, of which the last is number `last`, show; NaN if none, infinite if the values settle
/// faster than any order would.
double observed_order(const std::vector<MeshValue> &meshes, std::size_t last)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (last < 2)
    return none;
  const MeshValue &a = meshes[last - 2], &b = meshes[last - 1], &c = meshes[last];
  const double     wanted = (a.value - b.value) / (b.value - c.value);
  double           low = least_order, high = greatest_order;
  if (!(wanted > quotient(a, b, c, low)))
    return none;
  if (wanted > quotient(a, b, c, high))
    return std::numeric_limits<double>::infinity();
  for (int i = 0; i < 60; ++i)
  {
    const double middle                               = 0.5 * (low + high);
    (quotient(a, b, c, middle) < wanted ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// v_last - v by the order k.
double correction_of(const std::vector<MeshValue> &meshes, std::size_t last, double k)
{
  const MeshValue &before = meshes[last - 1];
  const double     r      = std::pow(before.coordinates / meshes[last].coordinates, k);
  return (before.value - meshes[last].value) * r / (1. - r);
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

  const std::size_t end = meshes.size() - 1;
  result.order          = observed_order(meshes, end);
  double correction = by_estimate, doubt = std::abs(by_estimate);
  if (std::isinf(result.order))
  {
    correction   = correction_of(meshes, end, settled_order);
    doubt        = std::abs(correction);
    result.order = std::numeric_limits<double>::quiet_NaN();
  }
  else if (!std::isnan(result.order))
  {
    correction                = correction_of(meshes, end, result.order);
    const double order_before = observed_order(meshes, end - 1);
    const double other        = !std::isfinite(order_before) ? last.value - by_estimate
                                                             : before.value - correction_of(meshes, end - 1, order_before);
    doubt = std::max(std::abs(last.value - correction - other), share_of_step * std::abs(correction));
  }
  result.limit       = last.value - correction;
  result.uncertainty = std::abs(doubt / result.limit);
  return result;
}

} // namespace gestell::coupling
