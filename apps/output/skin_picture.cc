#include "apps/output/skin_picture.h"

#include "apps/output/projection.h"
#include "apps/output/svg.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

constexpr std::size_t most_triangles = 14000; ///< of a closed skin; about a third of them is seen
constexpr double      shown_size     = 0.05;  ///< largest displacement as part of the frame's size
constexpr double      picture_size   = 400.;  ///< units of the picture's longer side
constexpr double      sharp          = 35.;   ///< degrees

/// Facets of the skin, moved by enlargement times displacement; `colour_of` gives the colour of a triangle.
template <typename ColourOf>
std::vector<Facet> facets_of(const Skin &skin, double enlargement, const View &view, const ColourOf &colour_of)
{
  std::vector<Facet> facets;
  for (const auto &t : skin.triangles)
  {
    std::array<Vector3d, 3> x;
    for (int i = 0; i < 3; ++i)
      x[i] = skin.points[t[i]] + enlargement * skin.displacement[t[i]];
    const Vector3d normal = (x[1] - x[0]).cross(x[2] - x[0]).normalized();
    if (!view.faces_viewer(normal))
      continue;
    facets.push_back({{view(x[0]), view(x[1]), view(x[2])}, hex(colour_of(t), view.light_on(normal))});
  }
  return facets;
}

/// Edges as one path; with a raster only those not hidden.
std::string edge_path(const Skin &skin, double enlargement, const View &view, const DepthRaster *raster)
{
  std::string svg;
  const auto  place = [&](int i) { return view(skin.points[i] + enlargement * skin.displacement[i]); };
  for (const auto &[a, b] : sharp_edges(skin, sharp))
  {
    const Vector3d p = place(a), q = place(b), middle = 0.5 * (p + q);
    if (raster != nullptr && !raster->sees(middle, 2.5))
      continue;
    append_coordinate(svg += 'M', p[0]);
    append_coordinate(svg += ' ', p[1]);
    append_coordinate(svg += 'L', q[0]);
    append_coordinate(svg += ' ', q[1]);
  }
  return svg;
}

/// The skin with so few points that the picture stays small.
Skin fit_for_picture(const Skin &skin)
{
  Skin   coarse = skin;
  double edge   = skin.size() / 150.;
  for (; coarse.triangles.size() > most_triangles; edge *= 1.2)
    coarse = coarsened(skin, edge);
  return coarse;
}

const char *const face_style = "<style>.gst .faces path{fill:currentColor;stroke:currentColor;stroke-width:1.2;"
                               "stroke-linejoin:round}.gst .edges{fill:none;stroke:#10151a;stroke-width:.5;"
                               "stroke-opacity:.55;stroke-linecap:round}</style>\n";

std::string shifted(double x, double y, const std::string &content)
{
  std::string svg = "<g transform=\"translate(";
  append_coordinate(svg, x);
  append_coordinate(svg += ' ', y);
  return svg + ")\">\n" + content + "</g>\n";
}

std::vector<Vector3d> moved_points(const Skin &skin, double enlargement)
{
  std::vector<Vector3d> points = skin.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] += enlargement * skin.displacement[i];
  return points;
}

} // namespace

Skin skin_of(const Scenery &scenery, const Eigen::VectorXd &p)
{
  Skin skin;
  for (const auto &x : scenery.points)
    skin.points.emplace_back(x[0], x[1], x[2]);
  skin.displacement.assign(skin.points.size(), Vector3d::Zero());
  skin.triangles = scenery.triangles;
  if (skin.points.empty())
    return skin;
  const Eigen::VectorXd u = scenery.displacement(p.head(scenery.n_frame));
  for (std::size_t i = 0; i < skin.points.size(); ++i)
    skin.displacement[i] = u.segment<3>(3 * static_cast<long>(i));
  return skin;
}

std::string mode_picture_svg(const Skin &skin, const std::string &title, const std::string &subtitle)
{
  const Skin   coarse      = fit_for_picture(skin);
  const double largest     = skin.largest_displacement();
  const double enlargement = largest > 0. ? shown_size * skin.size() / largest : 0.;

  std::vector<Vector3d>       seen     = coarse.points;
  const std::vector<Vector3d> deformed = moved_points(coarse, enlargement);
  seen.insert(seen.end(), deformed.begin(), deformed.end());
  const View view(seen, picture_size);

  const auto colour = [&](const std::array<int, 3> &t)
  {
    const double mean =
        (coarse.displacement[t[0]].norm() + coarse.displacement[t[1]].norm() + coarse.displacement[t[2]].norm()) / 3.;
    return scale_colour(largest > 0. ? mean / largest : 0.);
  };
  const std::vector<Facet> facets = facets_of(coarse, enlargement, view, colour);
  const DepthRaster        raster(facets, view);

  const double width = std::max(view.width() + 24., 190.), height = view.height() + 62.;
  return svg_head(width, height, title) + face_style + svg_text(12., 19., title, "title") +
         svg_text(12., 35., subtitle, "small") +
         shifted(0.5 * (width - view.width()), 48.,
                 "<path class=\"outline\" d=\"" + edge_path(coarse, 0., view, nullptr) + "\"/>\n<g class=\"faces\">" +
                     facet_paths(raster.visible(facets)) + "</g>\n<path class=\"edges\" d=\"" +
                     edge_path(coarse, enlargement, view, &raster) + "\"/>\n") +
         "</svg>\n";
}

std::string scene_picture_svg(const Skin &skin, const std::vector<Shape> &shapes, const std::string &title)
{
  static const std::array<Colour, 4> body_colours = {{{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {176, 80, 143}}};
  const Skin                         coarse       = fit_for_picture(skin);

  std::vector<Vector3d> seen = coarse.points;
  for (const Shape &shape : shapes)
    seen.insert(seen.end(), shape.points.begin(), shape.points.end());
  if (seen.empty())
    return "";
  const View view(seen, picture_size);

  const auto               pale   = [](const std::array<int, 3> &) { return Colour{205, 211, 218}; };
  const std::vector<Facet> facets = facets_of(coarse, 0., view, pale);
  const DepthRaster        raster(facets, view);
  std::vector<Facet>       bodies;
  std::string              names;
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    const Colour colour = body_colours[i % body_colours.size()];
    const auto   own    = facets_of(Skin{shapes[i].points, shapes[i].displacement, shapes[i].triangles}, 0., view,
                                    [&](const std::array<int, 3> &) { return colour; });
    bodies.insert(bodies.end(), own.begin(), own.end());
    const double y = 26. + 18. * static_cast<double>(i);
    names += "<g class=\"faces\"><path color=\"" + hex(colour, 1.) + "\" d=\"M0 " +
             std::to_string(static_cast<int>(y)) + "h12v-9h-12z\"/></g>" + svg_text(18., y, shapes[i].name, "label");
  }
  const std::vector<Facet> seen_bodies = DepthRaster(bodies, view).visible(bodies);

  const double width = view.width() + 160., height = view.height() + 24.;
  return svg_head(width, height, title) + face_style +
         shifted(12., 12.,
                 "<g class=\"faces\">" + facet_paths(raster.visible(facets)) + "</g>\n<path class=\"edges\" d=\"" +
                     edge_path(coarse, 0., view, &raster) + "\"/>\n<g class=\"faces\" opacity=\".82\">" +
                     facet_paths(seen_bodies) + "</g>\n") +
         shifted(view.width() + 28., 12., names) + "</svg>\n";
}

} // namespace gestell::apps
