#include "apps/output/faces/face_pictures.h"

#include "apps/output/pictures/picture_margin.h"
#include "apps/output/pictures/skin.h"
#include "apps/output/text/svg.h"

#include <Eigen/Geometry>

#include <cmath>
#include <map>

namespace gestell::apps
{
namespace
{

using Eigen::Vector3d;

constexpr std::size_t most_triangles = 55000, most_bytes = 1200000;
constexpr double      picture_size = 480.;
constexpr double      least_room   = 160.; ///< of a face for its number [units^2]

struct Side
{
  const char *caption;
  ViewPoint   from;
};

const Side sides[] = {{"from front, right and above", {}},
                      {"from behind, left and below", {{-0.55, 0.75, -0.36}, Vector3d::UnitZ()}},
                      {"front, seen along y", {{0., -1., 0.}, Vector3d::UnitZ()}},
                      {"right, seen against x", {{1., 0., 0.}, Vector3d::UnitZ()}},
                      {"rear, seen against y", {{0., 1., 0.}, Vector3d::UnitZ()}},
                      {"left, seen along x", {{-1., 0., 0.}, Vector3d::UnitZ()}},
                      {"top, seen against z", {{0., 0., 1.}, Vector3d::UnitY()}},
                      {"bottom, seen along z", {{0., 0., -1.}, Vector3d::UnitY()}}};

Skin skin_of_picture(const coupling::FacePicture &picture)
{
  Skin skin;
  for (const auto &x : picture.points)
    skin.points.emplace_back(x[0], x[1], x[2]);
  skin.displacement.assign(skin.points.size(), Vector3d::Zero());
  skin.triangles = picture.triangles;
  return skin;
}

std::vector<Facet> facets_of_faces(const Skin &skin, const std::vector<int> &face, const View &view)
{
  std::vector<Facet> facets;
  for (std::size_t t = 0; t < skin.triangles.size(); ++t)
  {
    const auto &[a, b, c] = skin.triangles[t];
    const Vector3d normal = (skin.points[b] - skin.points[a]).cross(skin.points[c] - skin.points[a]).normalized();
    if (view.faces_viewer(normal))
      facets.push_back({{view(skin.points[a]), view(skin.points[b]), view(skin.points[c])},
                        hex(face_colour(face[t]), view.light_on(normal)),
                        face[t]});
  }
  return facets;
}

/// What is seen of a face: area, centre, and its triangles' centres.
struct SeenFace
{
  double                area = 0.;
  Vector3d              sum  = Vector3d::Zero();
  std::vector<Vector3d> centres;
};

std::map<int, SeenFace> seen_faces(const std::vector<Facet> &visible, const DepthRaster &raster)
{
  std::map<int, SeenFace> seen;
  for (const Facet &facet : visible)
  {
    const auto &[a, b, c] = facet.corners;
    const Vector3d centre = (a + b + c) / 3.;
    const double   area   = 0.5 * std::abs((b - a).head<2>().x() * (c - a).y() - (b - a).y() * (c - a).x());
    if (!raster.sees(centre, 1.5))
      continue;
    SeenFace &face = seen[facet.face];
    face.area += area;
    face.sum += area * centre;
    face.centres.push_back(centre);
  }
  return seen;
}

/// Numbers on the faces, at the triangle nearest to the middle of what is seen; none upon another.
std::string numbers(const coupling::MeshReport &report, const std::map<int, SeenFace> &seen)
{
  std::string           svg;
  std::vector<Vector3d> taken;
  for (const auto &[index, face] : seen)
  {
    if (face.area < least_room)
      continue;
    const Vector3d mean = face.sum / face.area;
    Vector3d       at   = face.centres.front();
    for (const Vector3d &x : face.centres)
      if ((x - mean).head<2>().norm() < (at - mean).head<2>().norm())
        at = x;
    bool free = true;
    for (const Vector3d &x : taken)
      free = free && (std::abs(x[0] - at[0]) > 18. || std::abs(x[1] - at[1]) > 11.);
    if (!free)
      continue;
    taken.push_back(at);
    svg += svg_text(at[0], at[1] + 3.5, std::to_string(report.surfaces[index].tag), "number", "middle");
  }
  return svg;
}

const char *const number_style =
    "<style>.gst .faces path{fill:currentColor;stroke:currentColor;stroke-width:1.2;stroke-linejoin:round}"
    ".gst .number{font-size:10px;font-weight:600;fill:#10151a;stroke:#fff;stroke-width:2.4;paint-order:stroke;"
    "pointer-events:none}.gst .edges{fill:none;stroke:#10151a;stroke-width:.6;stroke-opacity:.7;"
    "pointer-events:none}</style>\n";

std::string side_svg(const coupling::MeshReport &report, const Skin &skin, const std::vector<int> &face,
                     const Side &side)
{
  const View               view(skin.points, picture_size, side.from);
  const std::vector<Facet> facets = facets_of_faces(skin, face, view);
  const DepthRaster        raster(facets, view);
  const std::vector<Facet> visible = raster.visible(facets);
  const double             width = std::max(view.width(), 60.) + 16., height = view.height() + 88.;
  return svg_head(width, height, std::string("Faces, ") + side.caption) + number_style +
         "<g transform=\"translate(8 8)\"><g class=\"faces\">" + facet_paths(visible) +
         "</g><path class=\"edges\" d=\"" + edge_lines(sharp_edges(skin), skin.points, view, &raster) + "\"/>" +
         numbers(report, seen_faces(visible, raster)) + "</g>\n" + axes_triad(view, 44., height - 30.) + "</svg>\n";
}

} // namespace

Colour face_colour(int index)
{
  // Hues a golden ratio apart, in three lightnesses.
  const double hue   = std::fmod(0.11 + 0.618033988749895 * index, 1.);
  const double light = 0.62 + 0.1 * (index % 3), chroma = 0.42;
  Colour       colour;
  for (int k = 0; k < 3; ++k)
  {
    const double at = std::fmod(hue + (3. - k) / 3., 1.), ramp = std::abs(6. * at - 3.) - 1.;
    colour[static_cast<std::size_t>(k)] =
        255. * (light + chroma * (std::min(std::max(ramp, 0.), 1.) - 0.5) * (1. - std::abs(2. * light - 1.)) * 1.6);
  }
  return colour;
}

coupling::FacePicture light_picture(const coupling::FacePicture &picture)
{
  if (picture.triangles.size() <= most_triangles)
    return picture;
  const Skin skin   = skin_of_picture(picture);
  double     edge   = skin.size() / 1000.;
  CoarseMesh coarse = coarse_mesh(skin, edge);
  while (coarse.triangles.size() > most_triangles)
    coarse = coarse_mesh(skin, edge *= 1.3);
  coupling::FacePicture light;
  light.triangles = coarse.triangles;
  for (const int point : coarse.points)
    light.points.push_back(picture.points[static_cast<std::size_t>(point)]);
  for (const int triangle : coarse.source)
    light.face.push_back(picture.face[static_cast<std::size_t>(triangle)]);
  return light;
}

std::vector<std::pair<std::string, std::string>> face_pictures(const coupling::MeshReport &report)
{
  const coupling::FacePicture                      picture = light_picture(report.picture);
  const Skin                                       skin    = skin_of_picture(picture);
  std::vector<std::pair<std::string, std::string>> pictures;
  if (skin.triangles.empty())
    return pictures;
  std::size_t bytes = 0;
  for (const Side &side : sides)
    if (bytes < most_bytes)
    {
      pictures.emplace_back(side.caption, side_svg(report, skin, picture.face, side));
      bytes += pictures.back().second.size();
    }
  return pictures;
}

} // namespace gestell::apps
