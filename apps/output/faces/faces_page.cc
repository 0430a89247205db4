#include "apps/output/faces/faces_page.h"

#include "apps/output/faces/faces_script.h"
#include "apps/output/pictures/skin.h"
#include "apps/output/text/base64.h"
#include "apps/output/text/html.h"
#include "apps/output/text/json.h"
#include "apps/output/text/svg.h"
#include "apps/output/values/colours.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace gestell::apps
{
namespace
{

using coupling::MeshReport;
using coupling::SurfaceReport;
using Triple = std::array<double, 3>;

/// "(0, -520, 2560) mm"; OpenCASCADE widens boxes by 1e-7 m, which is not shown.
std::string place(const Triple &x, const coupling::LengthUnit &unit)
{
  std::string text = "(";
  for (int d = 0; d < 3; ++d)
    text += (d > 0 ? ", " : "") + short_text(std::round(x[d] * 1e6) * 1e-6 / unit.length + 0., 6);
  return text + ") " + unit.name;
}

const coupling::LengthUnit metre;

Triple edges_of(const SurfaceReport &face)
{
  return {face.max[0] - face.min[0], face.max[1] - face.min[1], face.max[2] - face.min[2]};
}

/// A length in the unit of the file, and in metres if that unit is another one.
template <typename Words>
std::string twice(const coupling::LengthUnit &unit, const Words &words)
{
  return words(unit) + (unit.length == 1. ? "" : " = " + words(metre));
}

/// The number, without an exponent up to 10^9.
std::string plain(double x)
{
  return std::abs(x) >= 1e6 && std::abs(x) < 1e9 ? std::to_string(std::lround(x)) : short_text(x, 5);
}

std::string area(const SurfaceReport &face, const coupling::LengthUnit &unit)
{
  return plain(face.area / (unit.length * unit.length)) + " " + unit.name + "²";
}

/// "cylinder, radius 120 mm = 0.12 m".
std::string kind_words(const SurfaceReport &face, const coupling::LengthUnit &unit)
{
  const auto radius = [&](const auto &u) { return short_text(face.radius / u.length, 6) + " " + u.name; };
  return face.kind + (face.radius > 0. ? ", radius " + twice(unit, radius) : "");
}

std::string direction_words(const Triple &e)
{
  std::string text = "(";
  for (int d = 0; d < 3; ++d)
    text += (d > 0 ? ", " : "") + short_text(std::round(e[d] * 1e6) * 1e-6 + 0., 5);
  return text + ")";
}

/// Label and value pairs for the page, shown when the face is selected; the first is its kind.
Json facts_of(const SurfaceReport &face, const coupling::LengthUnit &unit)
{
  const auto at    = [&](const Triple &x) { return twice(unit, [&](const auto &u) { return place(x, u); }); };
  Json       facts = Json::array();
  facts.push_back({"kind", kind_words(face, unit)});
  if (face.kind == "plane")
    facts.push_back({"outward normal", direction_words(face.direction)});
  if (face.kind == "cylinder")
    facts.push_back({"axis", direction_words(face.direction) + " through " + at(face.through)});
  facts.push_back({"area", twice(unit, [&](const auto &u) { return area(face, u); })});
  facts.push_back({"centre", at(face.centre)});
  facts.push_back({"box from", at(face.min)});
  facts.push_back({"to", at(face.max)});
  facts.push_back({"box dimensions", at(edges_of(face))});
  return facts;
}

/// A note if no selector distinguishes a face from others.
std::string others_of(const SurfaceReport &face)
{
  if (face.found_with.empty())
    return "";
  std::string list;
  for (const int tag : face.found_with)
    list += (list.empty() ? "" : ", ") + std::to_string(tag);
  return "No selector distinguishes this face from " + count_text(face.found_with.size(), "other") + ": face " + list +
         ". Name it in the CAD program, or split it.";
}

/// What an entry can select: the face, then the larger surfaces that it belongs to; faces by their place in the list.
Json choices_of(const SurfaceReport &face, const MeshReport &report)
{
  Json choices = {{{"name", ""}, {"faces", Json::array()}, {"selector", face.selector}}};
  for (const coupling::FaceGroup &group : face.groups)
  {
    Json        faces = Json::array();
    std::string tags;
    for (std::size_t i = 0; i < report.surfaces.size(); ++i)
      if (const int tag = report.surfaces[i].tag; std::binary_search(group.faces.begin(), group.faces.end(), tag))
      {
        faces.push_back(i);
        tags += (tags.empty() ? "" : ", ") + std::to_string(tag);
      }
    choices.push_back({{"name", "all " + count_text(faces.size(), "face") + " of " + group.name + ": " + tags},
                       {"faces", faces},
                       {"selector", group.selector}});
  }
  return choices;
}

Json list_of(const MeshReport &report)
{
  Json list = Json::array();
  for (std::size_t i = 0; i < report.surfaces.size(); ++i)
  {
    const SurfaceReport &face   = report.surfaces[i];
    const Colour         colour = face_colour(static_cast<int>(i));
    list.push_back({{"tag", face.tag},
                    {"name", face.name},
                    {"rgb", {std::lround(colour[0]), std::lround(colour[1]), std::lround(colour[2])}},
                    {"facts", facts_of(face, report.unit)},
                    {"others", others_of(face)},
                    {"choices", choices_of(face, report)}});
  }
  return list;
}

/// The picture with few enough triangles for a small page; details below some thousandths of the frame are merged if it
/// has more.
coupling::FacePicture light_picture(const coupling::FacePicture &picture)
{
  constexpr std::size_t most_triangles = 55000; // four numbers of four bytes each, in base64 1.2 MB of the page
  if (picture.triangles.size() <= most_triangles)
    return picture;
  Skin skin;
  for (const auto &x : picture.points)
    skin.points.emplace_back(x[0], x[1], x[2]);
  skin.triangles    = picture.triangles;
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

/// The mesh in few bytes: points in steps of 1/65535 of the box.
Json frame_json(const MeshReport &report)
{
  const coupling::FacePicture picture = light_picture(report.picture);
  Triple                      low{1e300, 1e300, 1e300}, high{-1e300, -1e300, -1e300};
  for (const Triple &x : picture.points)
    for (int d = 0; d < 3; ++d)
    {
      low[d]  = std::min(low[d], x[d]);
      high[d] = std::max(high[d], x[d]);
    }
  std::vector<std::uint16_t> points;
  std::vector<std::uint32_t> triangles, face;
  for (const Triple &x : picture.points)
    for (int d = 0; d < 3; ++d)
      points.push_back(static_cast<std::uint16_t>(
          std::lround(high[d] > low[d] ? 65535. * (x[d] - low[d]) / (high[d] - low[d]) : 0.)));
  for (const auto &t : picture.triangles)
    for (const int point : t)
      triangles.push_back(static_cast<std::uint32_t>(point));
  for (const int index : picture.face)
    face.push_back(static_cast<std::uint32_t>(index));
  return {{"unit", report.unit.length},
          {"unitName", report.unit.name},
          {"min", low},
          {"max", high},
          {"points", base64(points)},
          {"triangles", base64(triangles)},
          {"face", base64(face)},
          {"list", list_of(report)}};
}

std::string faces_table(const MeshReport &report)
{
  const std::string unit = report.unit.name;
  HtmlTable         table({"face", "name", "kind", "direction", "#radius [" + unit + "]", "#area [" + unit + "²]",
                           "#centre [" + unit + "]", "#box dimensions [" + unit + "]"});
  const auto        bare = [&](const Triple &x) { return place(x, {report.unit.length, ""}); };
  for (const SurfaceReport &face : report.surfaces)
    table.add({std::to_string(face.tag), face.name, face.kind,
               face.kind == "plane" || face.kind == "cylinder" ? direction_words(face.direction) : "",
               face.radius > 0. ? short_text(face.radius / report.unit.length, 6) : "",
               plain(face.area / (report.unit.length * report.unit.length)), bare(face.centre), bare(edges_of(face))});
  return table.scrolled_html();
}

const char *const board =
    "<div id=\"board\"><div class=\"view\"><div class=\"tools\" id=\"views\"></div>"
    "<canvas id=\"turn\" width=\"1000\" height=\"760\"></canvas><div id=\"tip\"></div>"
    "<p class=\"soft\">Drag to rotate, Shift+drag to move, wheel to zoom, click to select a face.</p></div>"
    "<div class=\"card\"><p id=\"hint\" class=\"soft\">Click a face in a picture or a row of the table to see its "
    "selector for the scene.</p><div id=\"card\" hidden><h2 id=\"head\"></h2><table id=\"facts\"></table>"
    "<p id=\"others\"></p><p id=\"choices\"></p><p><label>name in the scene <input type=\"text\" id=\"name\"></label> "
    "<button id=\"copy\">copy</button></p><pre id=\"entry\"></pre></div></div></div>\n";

std::string lead_of(const MeshReport &report)
{
  return count_text(report.surfaces.size(), "face") + " on " +
         count_text(std::max<std::size_t>(report.solids.size(), 1), "solid") + "; the file's length unit is " +
         report.unit.name + ". Scene values are in m.";
}

} // namespace

std::string face_entry(const SurfaceReport &surface)
{
  return "[frame.surface.\"face " + std::to_string(surface.tag) + "\"]\n" + surface.selector;
}

std::string faces_page(const MeshReport &report, const std::string &file, const std::string &version)
{
  std::string entries;
  for (const SurfaceReport &face : report.surfaces)
    entries += face_entry(face) + "\n";
  const std::string body =
      note_box(report.notes) + board + section("sides", "Views from all sides", "<div class=\"sides\"></div>") +
      section("faces", "All faces",
              "<p class=\"filter\"><label>filter <input type=\"search\" id=\"filter\" placeholder=\"plane, "
              "cylinder, a name, a number\"></label></p>" +
                  faces_table(report)) +
      "<noscript><h2>Selectors for the scene</h2><pre>" + escape_xml(entries) +
      "</pre></noscript>\n<script>const frame = " +
      inside_script(frame_json(report).dump(-1, ' ', false, Json::error_handler_t::replace)) + ";\n" + faces_script +
      "</script>\n";
  return page_html({"Faces of " + file, lead_of(report), body,
                    "Created with gestell " + escape_xml(version) + ". ParaView: faces.vtp.", faces_style});
}

} // namespace gestell::apps
