#include "apps/output/pictures/projection.h"

#include "apps/output/text/svg.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tuple>

namespace gestell::apps
{
namespace
{

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double fineness      = 2.; ///< points of the depth raster per unit
constexpr double n_scale_steps = 24., n_light_steps = 12.;

/// Twice the area of the triangle a, b, c in the picture, positive if clockwise as seen.
double cross(const Vector3d &a, const Vector3d &b, const Vector3d &c)
{
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

Vector3d on_raster(const Vector3d &x)
{
  return {fineness * x[0], fineness * x[1], x[2]};
}

double in_steps(double s, double n)
{
  return std::round(n * s) / n;
}

/// The path of one facet in half units, relative, as short as can be.
std::string triangle_path(const Facet &facet)
{
  std::string         svg;
  std::array<long, 2> previous = {0, 0};
  for (int i = 0; i < 3; ++i)
  {
    const std::array<long, 2> place = {std::lround(2. * facet.corners[i][0]), std::lround(2. * facet.corners[i][1])};
    const std::string         x = std::to_string(place[0] - previous[0]), y = std::to_string(place[1] - previous[1]);
    const char *const         before = i == 0 ? "M" : i == 1 ? "l" : x[0] == '-' ? "" : " ";
    svg += before + x + (y[0] == '-' ? "" : " ") + y;
    previous = place;
  }
  return svg + 'z';
}

} // namespace

View::View(const std::vector<Vector3d> &seen, double picture_size, const ViewPoint &from)
{
  towards_ = from.towards.normalized();
  right_   = from.upwards.cross(towards_).normalized();
  up_      = towards_.cross(right_);
  low_     = Vector2d::Constant(1e300);
  high_    = -low_;
  for (const Vector3d &x : seen)
  {
    const Vector2d flat(right_.dot(x), up_.dot(x));
    low_  = low_.cwiseMin(flat);
    high_ = high_.cwiseMax(flat);
  }
  scale_ = picture_size / std::max((high_ - low_).maxCoeff(), 1e-12);
}

Vector3d View::operator()(const Vector3d &x) const
{
  return {scale_ * (right_.dot(x) - low_[0]), scale_ * (high_[1] - up_.dot(x)), scale_ * towards_.dot(x)};
}

double View::width() const
{
  return scale_ * (high_[0] - low_[0]);
}

double View::height() const
{
  return scale_ * (high_[1] - low_[1]);
}

double View::light_on(const Vector3d &normal) const
{
  const Vector3d lamp = (towards_ + 0.6 * up_ + 0.5 * right_).normalized();
  return 0.62 + 0.42 * in_steps(std::max(0., normal.dot(lamp)), n_light_steps);
}

DepthRaster::DepthRaster(const std::vector<Facet> &facets, const View &view)
    : columns_(static_cast<int>(fineness * view.width()) + 2), rows_(static_cast<int>(fineness * view.height()) + 2),
      depth_(static_cast<std::size_t>(columns_) * rows_, -1e300), facet_(depth_.size(), -1)
{
  for (std::size_t i = 0; i < facets.size(); ++i)
    draw(facets[i].corners, static_cast<int>(i));
}

void DepthRaster::draw(const std::array<Vector3d, 3> &corners, int facet)
{
  const Vector3d a = on_raster(corners[0]), b = on_raster(corners[1]), c = on_raster(corners[2]);
  const double   area = cross(a, b, c);
  if (std::abs(area) < 1e-12)
    return;
  const auto bound = [](double x, int n) { return std::clamp(static_cast<int>(x), 0, n - 1); };
  const int  left = bound(std::min({a[0], b[0], c[0]}), columns_), top = bound(std::min({a[1], b[1], c[1]}), rows_);
  const int  right  = bound(std::max({a[0], b[0], c[0]}) + 1., columns_);
  const int  bottom = bound(std::max({a[1], b[1], c[1]}) + 1., rows_);
  for (int j = top; j <= bottom; ++j)
    for (int i = left; i <= right; ++i)
    {
      // Shares of the corners in the raster point.
      const Vector3d x(i, j, 0.);
      const double   u = cross(x, b, c) / area, v = cross(a, x, c) / area, w = 1. - u - v;
      const double   z = u * a[2] + v * b[2] + w * c[2];
      if (std::min({u, v, w}) < -1e-9 || z <= depth_[index(i, j)])
        continue;
      depth_[index(i, j)] = z;
      facet_[index(i, j)] = facet;
    }
}

bool DepthRaster::sees(const Vector3d &x, double slack) const
{
  const int i = std::clamp(static_cast<int>(std::lround(fineness * x[0])), 0, columns_ - 1);
  const int j = std::clamp(static_cast<int>(std::lround(fineness * x[1])), 0, rows_ - 1);
  return x[2] + slack >= depth_[index(i, j)];
}

std::vector<Facet> DepthRaster::visible(const std::vector<Facet> &facets) const
{
  std::vector<bool> seen(facets.size(), false);
  for (const int i : facet_)
    if (i >= 0)
      seen[static_cast<std::size_t>(i)] = true;
  std::vector<Facet> kept;
  for (std::size_t i = 0; i < facets.size(); ++i)
    if (seen[i])
      kept.push_back(facets[i]);
  std::stable_sort(kept.begin(), kept.end(), [](const Facet &a, const Facet &b) { return a.depth() < b.depth(); });
  return kept;
}

Colour scale_colour(double s)
{
  static const std::array<Colour, 5> stops = {
      {{64, 67, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
  const double place = 4. * in_steps(std::clamp(s, 0., 1.), n_scale_steps);
  const int    i     = std::min(static_cast<int>(place), 3);
  Colour       mixed;
  for (int k = 0; k < 3; ++k)
    mixed[k] = stops[i][k] + (place - i) * (stops[i + 1][k] - stops[i][k]);
  return mixed;
}

std::string hex(const Colour &colour, double light)
{
  const auto part = [&](int k) { return std::clamp(static_cast<int>(light * colour[k]), 0, 255); };
  char       text[8];
  std::snprintf(text, sizeof text, "#%02x%02x%02x", part(0), part(1), part(2));
  return text;
}

std::string facet_paths(std::vector<Facet> facets)
{
  constexpr std::size_t slice = 160;
  const auto            look  = [](const Facet &facet) { return std::tie(facet.face, facet.colour); };
  for (std::size_t i = 0; i < facets.size(); i += slice)
    std::stable_sort(facets.begin() + static_cast<long>(i),
                     facets.begin() + static_cast<long>(std::min(i + slice, facets.size())),
                     [&](const Facet &a, const Facet &b) { return look(a) < look(b); });

  std::string  svg  = "<g transform=\"scale(.5)\">";
  const Facet *open = nullptr;
  for (const Facet &facet : facets)
  {
    if (open == nullptr || look(*open) != look(facet))
      svg += (open != nullptr ? "\"/><path " : "<path ") +
             (facet.face >= 0 ? "data-f=\"" + std::to_string(facet.face) + "\" " : "") + "color=\"" + facet.colour +
             "\" d=\"";
    open = &facet;
    svg += triangle_path(facet);
  }
  return svg + (open != nullptr ? "\"/></g>" : "</g>");
}

std::string edge_lines(const std::vector<std::array<int, 2>> &edges, const std::vector<Vector3d> &points,
                       const View &view, const DepthRaster *raster)
{
  constexpr double slack = 2.5; // [units] by which the raster rounds
  std::string      svg;
  for (const auto &[a, b] : edges)
  {
    const Vector3d p = view(points[a]), q = view(points[b]);
    if (raster != nullptr && !raster->sees(0.5 * (p + q), slack))
      continue;
    append_coordinate(svg += 'M', p[0]);
    append_coordinate(svg += ' ', p[1]);
    append_coordinate(svg += 'L', q[0]);
    append_coordinate(svg += ' ', q[1]);
  }
  return svg;
}

} // namespace gestell::apps
