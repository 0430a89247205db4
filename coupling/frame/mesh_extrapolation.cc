#include "coupling/frame/mesh_extrapolation.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

constexpr double rounding = 1e-9; // relative: values of this difference are equal

/// (v1 - v2) / (v2 - v3) for error = n^(-k); grows with k.
double quotient(const MeshValue &a, const MeshValue &b, const MeshValue &c, double k)
{
  const double n1 = 1., n2 = std::pow(b.coordinates / a.coordinates, -k),
               n3 = std::pow(c.coordinates / a.coordinates, -k);
  return (n1 - n2) / (n2 - n3);
}

/// The order from the three meshes that end with number `last`; NaN if there is none, infinite if the values converge
/// faster than any order.
double observed_order(const std::vector<MeshValue> &meshes, std::size_t last)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  if (last < 2)
    return none;
  const MeshValue &a = meshes[last - 2], &b = meshes[last - 1], &c = meshes[last];
  const double     wanted = (a.value - b.value) / (b.value - c.value);
  // k in n^(-k): edges that re-enter, and smooth cubic fields
  constexpr double least_order = 0.2, greatest_order = 4.;
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

/// The meshes that are distinctly finer than the previous one, including the last one.
std::vector<MeshValue> distinct_ones(const std::vector<MeshValue> &meshes)
{
  std::vector<MeshValue> kept = {meshes.back()};
  for (auto mesh = meshes.rbegin(); mesh != meshes.rend(); ++mesh)
    if (distinctly_finer * mesh->coordinates <= kept.back().coordinates)
      kept.push_back(*mesh);
  return {kept.rbegin(), kept.rend()};
}

/// Largest change of the last two steps away from the limit.
double largest_step_back(const std::vector<MeshValue> &meshes, double side)
{
  double largest = 0.;
  for (std::size_t i = meshes.size() < 3 ? 1 : meshes.size() - 2; i < meshes.size(); ++i)
    largest = std::max(largest, side * (meshes[i].value - meshes[i - 1].value));
  return largest > rounding * std::abs(meshes.back().value) ? largest : 0.;
}

/// Distance by which another mesh was nearer to the limit than the last one.
double overtaken(const std::vector<MeshValue> &meshes, double side)
{
  double most = 0.;
  for (const MeshValue &mesh : meshes)
    most = std::max(most, side * (meshes.back().value - mesh.value));
  return most;
}

/// |v_last - v| from the estimate of the last mesh only.
double estimated_rest(const MeshValue &last)
{
  const double estimate = std::min(last.estimate, 1.); // it may be infinite
  return estimate / (1. + estimate) * last.value;
}

struct Rest
{
  double correction = 0.; ///< v_last - v
  double doubt      = 0.;
  double order      = std::numeric_limits<double>::quiet_NaN();
};

/// Remaining error of at least two meshes whose values change in one direction.
Rest regular_rest(const std::vector<MeshValue> &meshes)
{
  const MeshValue &last = meshes.back(), &before = meshes[meshes.size() - 2];
  const double     step = before.value - last.value;
  // ratio of estimates from mesh to mesh: outside, two meshes show no order
  constexpr double least_fall = 0.05, greatest_fall = 0.9;
  const double     fall        = std::clamp(last.estimate / before.estimate, least_fall, greatest_fall);
  const double     r           = std::isfinite(fall) ? fall : greatest_fall;
  const double     by_estimate = step * r / (1. - r);

  const std::size_t end = meshes.size() - 1;
  Rest              rest;
  rest.order      = observed_order(meshes, end);
  rest.correction = by_estimate;
  rest.doubt      = std::abs(by_estimate);
  if (std::isinf(rest.order))
  {
    constexpr double settled_order = 1.; // for values that settle faster: h^2 of walls, h^3 of blocks
    rest.correction                = correction_of(meshes, end, settled_order);
    rest.doubt                     = std::abs(rest.correction);
    rest.order                     = std::numeric_limits<double>::quiet_NaN();
  }
  else if (!std::isnan(rest.order))
  {
    rest.correction           = correction_of(meshes, end, rest.order);
    const double order_before = observed_order(meshes, end - 1);
    const double by_values = before.value - correction_of(meshes, end - 1, order_before); // limit of the three before
    const double other     = std::abs(by_estimate - rest.correction);
    const double disagreement =
        std::isfinite(order_before) ? std::min(other, std::abs(last.value - rest.correction - by_values)) : other;
    constexpr double share_of_step = 0.5; // least uncertainty of three meshes: the order itself changes with the mesh
    rest.doubt                     = std::max(disagreement, share_of_step * std::abs(rest.correction));
  }
  constexpr double least_share = 0.5; // of the estimate that is true at least, where nothing better is known
  if (meshes.size() < 4)              // fewer may agree by chance
    rest.doubt = std::max(rest.doubt, least_share * estimated_rest(last) - std::abs(rest.correction));
  return rest;
}

} // namespace

Extrapolated extrapolate(const std::vector<MeshValue> &all, Approach approach)
{
  if (all.empty())
    throw std::invalid_argument("extrapolate: no mesh; at least one is needed.");
  const std::vector<MeshValue> meshes = distinct_ones(all);
  const MeshValue             &last   = meshes.back();
  Extrapolated                 result;
  result.n_meshes = int(meshes.size());
  result.order    = std::numeric_limits<double>::quiet_NaN();
  if (meshes.size() == 1)
  {
    result.limit       = last.value;
    result.uncertainty = last.estimate;
    return result;
  }
  const double side = approach == Approach::from_above ? 1. : -1.;
  const double back = largest_step_back(meshes, side), nearer = overtaken(meshes, side);
  Rest         rest = regular_rest(meshes);
  result.regular    = back == 0. && side * rest.correction >= nearer - rounding * std::abs(last.value) &&
                   rest.correction < last.value; // no limit at zero or below
  if (!result.regular)
  {
    rest.correction = side * std::max(estimated_rest(last), nearer);
    rest.doubt      = std::max(std::abs(rest.correction), back);
    rest.order      = std::numeric_limits<double>::quiet_NaN();
  }
  result.order       = rest.order;
  result.limit       = last.value - rest.correction;
  result.uncertainty = std::abs(rest.doubt / result.limit);
  return result;
}

} // namespace gestell::coupling
