#pragma once

#include "apps/output/pictures/facet.h"

#include <Eigen/Core>

#include <array>
#include <string>
#include <vector>

namespace gestell::apps
{

/// Where a picture is seen from.
struct ViewPoint
{
  Eigen::Vector3d towards = {0.55, -0.75, 0.36}; ///< the viewer: from front right and above
  Eigen::Vector3d upwards = Eigen::Vector3d::UnitZ();
};

/// Parallel projection; fits what is to be seen into a picture whose longer side has the given size.
class View
{
public:
  View(const std::vector<Eigen::Vector3d> &seen, double picture_size, const ViewPoint &from = {});

  /// Coordinates in the picture, to the right and down, and depth (larger is nearer) [units].
  Eigen::Vector3d operator()(const Eigen::Vector3d &x) const;

  double width() const;                   ///< [units]
  double height() const;                  ///< [units]
  double scale() const { return scale_; } ///< units per metre
  /// A direction [1] in the picture, to the right and down.
  Eigen::Vector2d direction(const Eigen::Vector3d &e) const { return {right_.dot(e), -up_.dot(e)}; }

  bool faces_viewer(const Eigen::Vector3d &normal) const { return normal.dot(towards_) > 0.; }
  /// Brightness of a face of this outward normal under a lamp above and right of the viewer; of few steps, since few
  /// colours make a small file.
  double light_on(const Eigen::Vector3d &normal) const;

private:
  Eigen::Vector3d right_, up_, towards_; // unit vectors
  Eigen::Vector2d low_, high_;           // of what is to be seen
  double          scale_;
};

/// What is nearest to the viewer at each point of a raster over the picture.
class DepthRaster
{
public:
  DepthRaster(const std::vector<Facet> &facets, const View &view);

  /// Whether nothing is nearer than `slack` [units] before x.
  bool sees(const Eigen::Vector3d &x, double slack) const;

  /// Those facets of which something is seen, in an order in which they can be painted over each other; large ones that
  /// have none, as they cross or hide each other in a ring, in parts.
  std::vector<Facet> visible(const std::vector<Facet> &facets) const;

private:
  DepthRaster(const std::vector<Facet> &facets, int columns, int rows);

  /// Calls visit(column, row, depth) for the points of the raster in a triangle.
  template <typename Visit>
  void for_each_point(const std::array<Eigen::Vector3d, 3> &corners, const Visit &visit) const;
  /// Sorted; among facets that are seen.
  HidingCounts hiding(const std::vector<Facet> &facets, const std::vector<int> &seen) const;
  std::size_t index(int i, int j) const { return static_cast<std::size_t>(j) * columns_ + static_cast<std::size_t>(i); }

  int                 columns_, rows_;
  std::vector<double> depth_;
  std::vector<int>    facet_; // -1: none
};

/// Edges between points as the `d` of one SVG path; with a raster what it sees of them.
std::string edge_lines(const std::vector<std::array<int, 2>> &edges, const std::vector<Eigen::Vector3d> &points,
                       const View &view, const DepthRaster *raster = nullptr);

using Colour = std::array<double, 3>; ///< red, green, blue, 0 to 255

/// Colour for a share s in [0, 1]: dark blue to yellow, lightness rising evenly, in a few steps.
Colour scale_colour(double s);

/// "#rrggbb" of a colour under a light.
std::string hex(const Colour &colour, double light);

/// Facets in the order of DepthRaster::visible() as SVG paths for a style that fills with `currentColor`; those of one
/// colour that follow each other share a path.
std::string facet_paths(const std::vector<Facet> &facets);

} // namespace gestell::apps
