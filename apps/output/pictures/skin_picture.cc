#include "apps/output/pictures/skin_picture.h"

#include "apps/output/pictures/picture_margin.h"
#include "apps/output/pictures/projection.h"
#include "apps/output/text/svg.h"
#include "apps/output/values/body_colours.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

constexpr std::size_t most_triangles = 9000; ///< of a closed skin; about a third of them is seen
constexpr double      picture_size   = 400.; ///< units of the picture's longer side
constexpr double      fine_piece     = 7.;   ///< longest edge of a body's triangles in a picture [units]
constexpr double      coarse_piece   = 14.;  ///< the same where there are many pictures

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

std::vector<Vector3d> moved_points(const Skin &skin, double enlargement)
{
  std::vector<Vector3d> points = skin.points;
  for (std::size_t i = 0; i < points.size(); ++i)
    points[i] += enlargement * skin.displacement[i];
  return points;
}

std::string edge_path(const Skin &skin, double enlargement, const View &view, const DepthRaster *raster)
{
  return edge_lines(sharp_edges(skin), moved_points(skin, enlargement), view, raster);
}

/// The silhouette, where what is seen borders on what is not, so that round bodies have one, too.
std::string silhouette_path(const Skin &skin, const View &view)
{
  return edge_lines(edges_between(skin, [&](const Vector3d &a, const Vector3d &b)
                                  { return view.faces_viewer(a) != view.faces_viewer(b); }),
                    skin.points, view);
}

const char *const face_style = "<style>.gst .faces path{fill:currentColor;stroke:currentColor;stroke-width:1.2;"
                               "stroke-linejoin:round}.gst .edges{fill:none;stroke:#10151a;stroke-width:.5;"
                               "stroke-opacity:.55;stroke-linecap:round}.gst .later{fill:none;stroke:var(--ink);"
                               "stroke-width:.8;opacity:.5}</style>\n";

/// Facets of the bodies, moved; small, as bodies pass through each other, where no order of large ones is right.
/// @param piece  longest edge of a triangle [units]
std::vector<Facet> body_facets(const std::vector<Shape> &shapes, double enlargement, const View &view,
                               double piece = fine_piece)
{
  std::vector<Facet> facets;
  for (std::size_t i = 0; i < shapes.size(); ++i)
  {
    const Skin small = refined({shapes[i].points, shapes[i].displacement, shapes[i].triangles}, piece / view.scale());
    const auto own   = facets_of(small, enlargement, view, [&](const auto &) { return body_colour(i); });
    facets.insert(facets.end(), own.begin(), own.end());
  }
  return DepthRaster(facets, view).visible(facets);
}

constexpr std::size_t most_names = 30; ///< of bodies beside a picture

double height_of_name(std::size_t i)
{
  return 18. * static_cast<double>(i);
}

std::string body_names(const std::vector<Shape> &shapes)
{
  std::string names;
  if (shapes.size() > most_names)
    names += svg_text(18., 26. + height_of_name(most_names),
                      "and " + std::to_string(shapes.size() - most_names) + " more", "label");
  for (std::size_t i = 0; i < std::min(shapes.size(), most_names); ++i)
  {
    const double y = 26. + height_of_name(i);
    names += "<g class=\"faces\"><path color=\"" + hex(body_colour(i), 1.) + "\" d=\"M0 " +
             std::to_string(static_cast<int>(y)) + "h12v-9h-12z\"/></g>" + svg_text(18., y, shapes[i].name, "label");
  }
  return names;
}

std::string shifted(double x, double y, const std::string &content)
{
  std::string svg = "<g transform=\"translate(";
  append_coordinate(svg, x);
  append_coordinate(svg += ' ', y);
  return svg + ")\">\n" + content + "</g>\n";
}

/// The field on so few points that a picture stays small.
SkinField light_field(const SkinField &field)
{
  if (field.skin.triangles.size() <= most_triangles)
    return field;
  double     edge   = field.skin.size() / 100.;
  CoarseMesh coarse = coarse_mesh(field.skin, edge);
  while (coarse.triangles.size() > most_triangles)
    coarse = coarse_mesh(field.skin, edge *= 1.4);
  SkinField light = field;
  light.skin      = {{}, {}, coarse.triangles};
  light.values.clear();
  for (const int i : coarse.points)
  {
    light.skin.points.push_back(field.skin.points[i]);
    light.skin.displacement.push_back(field.skin.displacement[i]);
    light.values.push_back(field.values[i]);
  }
  return light;
}

/// The colours from bottom to top with numbers beside them, `height` units high.
std::string colour_bar(double top, const DisplayUnit &unit, double height)
{
  constexpr int steps = 16, ticks = 4;
  std::string   svg = "<g class=\"faces\">";
  for (int i = 0; i < steps; ++i)
  {
    svg += "<path color=\"" + hex(scale_colour((i + 0.5) / steps), 1.) + "\" d=\"M0 ";
    append_coordinate(svg, height * (1. - double(i) / steps));
    append_coordinate(svg += "h12v", -height / steps);
    svg += "h-12z\"/>";
  }
  svg += "</g>";
  for (int i = 0; i <= ticks; ++i)
    svg += svg_text(18., height * (1. - double(i) / ticks) + 4., short_text(top * i / ticks * unit.factor, 3), "tick");
  return svg;
}

} // namespace

std::string mode_picture_svg(const Skin &skin, const std::string &title, const std::string &subtitle)
{
  const double largest     = skin.largest_displacement();
  const double enlargement = largest > 0. ? shown_size * skin.size() / largest : 0.;

  std::vector<Vector3d>       seen     = skin.points;
  const std::vector<Vector3d> deformed = moved_points(skin, enlargement);
  seen.insert(seen.end(), deformed.begin(), deformed.end());
  const View view(seen, picture_size);

  const auto colour = [&](const std::array<int, 3> &t)
  {
    const double mean =
        (skin.displacement[t[0]].norm() + skin.displacement[t[1]].norm() + skin.displacement[t[2]].norm()) / 3.;
    return scale_colour(largest > 0. ? mean / largest : 0.);
  };
  const std::vector<Facet> facets = facets_of(skin, enlargement, view, colour);
  const DepthRaster        raster(facets, view);

  const double width = std::max(view.width() + 24., 190.), height = view.height() + 62.;
  return svg_head(width, height, title) + face_style + svg_text(12., 19., title, "title") +
         svg_text(12., 35., subtitle, "small") +
         shifted(0.5 * (width - view.width()), 48.,
                 "<path class=\"outline\" d=\"" + edge_path(skin, 0., view, nullptr) + "\"/>\n<g class=\"faces\">" +
                     facet_paths(raster.visible(facets)) + "</g>\n<path class=\"edges\" d=\"" +
                     edge_path(skin, enlargement, view, &raster) + "\"/>\n") +
         "</svg>\n";
}

std::string field_picture_svg(const SkinField &full, const std::string &title, const std::string &subtitle)
{
  const SkinField field       = light_field(full);
  const Skin     &skin        = field.skin;
  const double    largest     = skin.largest_displacement();
  const double    enlargement = largest > 0. ? shown_size * skin.size() / largest : 0.;

  const std::vector<Vector3d> deformed = moved_points(skin, enlargement);
  const View                  view(deformed, picture_size);

  const auto colour = [&](const std::array<int, 3> &t)
  {
    const double mean = (field.values[t[0]] + field.values[t[1]] + field.values[t[2]]) / 3.;
    return scale_colour(field.top > 0. ? mean / field.top : 0.);
  };
  const std::vector<Facet> facets = facets_of(skin, enlargement, view, colour);
  const DepthRaster        raster(facets, view);

  std::string ring;
  if (field.mark)
  {
    std::size_t nearest = 0;
    for (std::size_t i = 0; i < skin.points.size(); ++i)
      if ((skin.points[i] - *field.mark).norm() < (skin.points[nearest] - *field.mark).norm())
        nearest = i;
    const Vector3d at     = view(deformed[nearest]);
    const bool     hidden = !raster.sees(at, 2.5);
    append_coordinate(ring += "<circle class=\"mark\" r=\"9\" cx=\"", at[0]);
    append_coordinate(ring += "\" cy=\"", at[1]);
    ring += hidden ? "\" stroke-dasharray=\"3 3\"/>" : "\"/>";
  }
  const double bar   = std::min(view.height(), 200.);
  const double width = view.width() + 100., height = view.height() + 62.;
  return svg_head(width, height, title) + face_style +
         "<style>.gst .mark{fill:none;stroke:#d02030;stroke-width:2}</style>\n" + svg_text(12., 19., title, "title") +
         svg_text(12., 35., subtitle, "small") +
         shifted(12., 48.,
                 "<g class=\"faces\">" + facet_paths(raster.visible(facets)) + "</g>\n<path class=\"edges\" d=\"" +
                     edge_path(skin, enlargement, view, &raster) + "\"/>\n" + ring) +
         shifted(view.width() + 30., 48. + 0.5 * (view.height() - bar), colour_bar(field.top, field.unit, bar)) +
         "</svg>\n";
}

std::string scene_picture_svg(const Skin &skin, const std::vector<Shape> &shapes, const std::string &title,
                              const std::vector<Shape> &later)
{
  std::vector<Vector3d> seen = skin.points;
  for (const std::vector<Shape> *pose : {&shapes, &later})
    for (const Shape &shape : *pose)
      seen.insert(seen.end(), shape.points.begin(), shape.points.end());
  if (seen.empty())
    return "";
  const View  view(seen, picture_size);
  std::string outlines;
  for (const Shape &shape : later)
    outlines += silhouette_path({shape.points, shape.displacement, shape.triangles}, view);

  const auto               pale   = [](const std::array<int, 3> &) { return Colour{205, 211, 218}; };
  const std::vector<Facet> facets = facets_of(skin, 0., view, pale);
  const DepthRaster        raster(facets, view);
  const double             width = view.width() + 160., height = view.height() + 24.;
  return svg_head(width, height, title) + face_style +
         shifted(12., 12.,
                 "<path class=\"later\" d=\"" + outlines + "\"/>\n<g class=\"faces\">" +
                     facet_paths(raster.visible(facets)) + "</g>\n<path class=\"edges\" d=\"" +
                     edge_path(skin, 0., view, &raster) + "\"/>\n<g class=\"faces\" opacity=\".82\">" +
                     facet_paths(body_facets(shapes, 0., view)) + "</g>\n") +
         shifted(view.width() + 28., 12., body_names(shapes)) + "</svg>\n";
}

std::string machine_state_svg(const MachineState &state, double enlargement, const std::string &title,
                              const std::string &subtitle, const DisplayUnit &unit)
{
  const Skin           &skin    = state.skin;
  const double          largest = skin.largest_displacement();
  std::vector<Vector3d> seen    = moved_points(skin, enlargement);
  seen.insert(seen.end(), skin.points.begin(), skin.points.end());
  for (const Shape &shape : state.shapes)
  {
    const auto moved = moved_points({shape.points, shape.displacement, {}}, enlargement);
    seen.insert(seen.end(), moved.begin(), moved.end());
  }
  if (seen.empty())
    return "";
  const View view(seen, picture_size);
  double     top = largest; // of a mode, which has no size, the largest displacement of all
  for (const Shape &shape : unit.unit.empty() ? state.shapes : std::vector<Shape>())
    for (const Vector3d &u : shape.displacement)
      top = std::max(top, u.norm());
  const auto colour = [&](const std::array<int, 3> &t)
  {
    const double mean =
        (skin.displacement[t[0]].norm() + skin.displacement[t[1]].norm() + skin.displacement[t[2]].norm()) / 3.;
    return scale_colour(top > 0. ? mean / top : 0.);
  };
  const std::vector<Facet> facets = facets_of(skin, enlargement, view, colour);
  const DepthRaster        raster(facets, view);
  const double             names = height_of_name(std::min(state.shapes.size(), most_names + 1)) + 34.;
  const double             bar   = std::min(std::max(view.height() - names, 60.), 160.);
  const double             width = view.width() + 170., height = std::max(view.height() + 120., names + bar + 90.);
  const bool               shows_bar = !unit.unit.empty() && largest > 0.;
  return svg_head(width, height, title) + face_style + svg_text(12., 19., title, "title") +
         svg_text(12., 35., subtitle, "small") +
         shifted(12., 48.,
                 "<path class=\"outline\" d=\"" + edge_path(skin, 0., view, nullptr) + "\"/>\n<g class=\"faces\">" +
                     facet_paths(raster.visible(facets)) + "</g>\n<path class=\"edges\" d=\"" +
                     edge_path(skin, enlargement, view, &raster) + "\"/>\n<g class=\"faces\" opacity=\".82\">" +
                     facet_paths(body_facets(state.shapes, enlargement, view, coarse_piece)) + "</g>\n") +
         shifted(view.width() + 28., 36., body_names(state.shapes)) +
         (shows_bar ? shifted(view.width() + 28., 48. + names,
                              svg_text(0., -12., "frame [" + unit.unit + "]", "small") + colour_bar(largest, unit, bar))
                    : "") +
         axes_triad(view, 44., height - 26.) + scale_bar(view, 110., height - 22., 140.) + "</svg>\n";
}

} // namespace gestell::apps
