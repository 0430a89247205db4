#include "tests/support/thin_frames.h"

#include <gmsh.h>

#include <array>
#include <cmath>

namespace gestell::fem::test
{

namespace
{

namespace occ = gmsh::model::occ;

using Point = std::array<double, 3>;

int wall(const Point &from, const Point &size)
{
  return occ::addBox(from[0], from[1], from[2], size[0], size[1], size[2]);
}

int rod(const Point &from, const Point &along, double diameter)
{
  return occ::addCylinder(from[0], from[1], from[2], along[0], along[1], along[2], 0.5 * diameter);
}

int without(int solid, const std::vector<int> &tools)
{
  gmsh::vectorpair              left, cutters;
  std::vector<gmsh::vectorpair> map;
  for (const int tool : tools)
    cutters.emplace_back(3, tool);
  occ::cut({{3, solid}}, cutters, left, map);
  return left.front().second;
}

/// A wall with these corners in the plane of x and z.
void oblique(const std::array<std::array<double, 2>, 4> &corners, double y, double width)
{
  std::vector<int> points, sides;
  for (const auto &[x, z] : corners)
    points.push_back(occ::addPoint(x, y, z));
  for (int i = 0; i < 4; ++i)
    sides.push_back(occ::addLine(points[i], points[(i + 1) % 4]));
  gmsh::vectorpair solid;
  occ::extrude({{2, occ::addPlaneSurface({occ::addCurveLoop(sides)})}}, 0., width, 0., solid);
}

/// A tube or a bushing, open at both ends.
int tube(const Point &from, const Point &along, double diameter, double thickness)
{
  return without(rod(from, along, diameter), {rod(from, along, diameter - 2. * thickness)});
}

/// A hollow section along x with sharp edges.
int box_section(const Point &from, double length, double width, double height, double thickness)
{
  const auto &[x, y, z] = from;
  return without(wall(from, {length, width, height}),
                 {wall({x, y + thickness, z + thickness}, {length, width - 2. * thickness, height - 2. * thickness})});
}

void plate_with_tube()
{
  wall({-300., -200., 0.}, {600., 400., 15.});
  tube({0., 0., 15.}, {0., 0., 400.}, 120., 8.);
}

void tube_through_plate()
{
  without(wall({-300., -200., 0.}, {600., 400., 15.}), {rod({0., 0., -1.}, {0., 0., 20.}, 120.)});
  tube({0., 0., -100.}, {0., 0., 400.}, 120., 8.);
}

void beams_with_holes()
{
  for (const double y : {0., 800.})
  {
    wall({0., y - 100., 0.}, {2000., 200., 15.});
    wall({0., y - 100., 285.}, {2000., 200., 15.});
    std::vector<int> holes;
    for (int i = 0; i < 6; ++i)
      holes.push_back(rod({250. + 300. * i, y - 50., 150.}, {0., 100., 0.}, i % 2 ? 120. : 200.));
    without(wall({0., y - 5., 15.}, {2000., 10., 270.}), holes);
  }
  for (const double x : {400., 1600.})
    tube({x, 5., 150.}, {0., 790., 0.}, 101.6, 5.);
}

void box_with_bosses()
{
  without(box_section({0., 0., 0.}, 1500., 200., 200., 10.),
          {rod({300., 100., 150.}, {0., 0., 60.}, 30.), rod({700., 100., 150.}, {0., 0., 60.}, 30.),
           rod({1100., -5., 100.}, {0., 30., 0.}, 30.)});
  tube({300., 100., 200.}, {0., 0., 40.}, 60., 15.);
  tube({700., 100., 200.}, {0., 0., 80.}, 90., 30.);
  tube({1100., 0., 100.}, {0., -60., 0.}, 60., 15.);
}

void crossing_tubes()
{
  tube({-600., 0., 0.}, {1200., 0., 0.}, 168.3, 6.3);
  without(tube({0., 0., 0.}, {0., 700., 0.}, 114.3, 5.), {rod({-600., 0., 0.}, {1200., 0., 0.}, 168.3)});
  without(tube({200., 0., 0.}, {300., 0., 500.}, 88.9, 4.), {rod({-600., 0., 0.}, {1600., 0., 0.}, 168.3)});
}

void oblique_wall()
{
  wall({0., 0., 0.}, {800., 500., 15.});
  wall({0., 0., 15.}, {15., 500., 600.});
  const double h = 12. * M_SQRT2; // of a wall of 12 mm from the foot to the upright
  oblique({{{515. + h, 15.}, {15., 515. + h}, {15., 515.}, {515., 15.}}}, 150., 200.);
  // an oblique tube beside it
  without(tube({700., 80., -200.}, {-800., 0., 800.}, 60.3, 5.),
          {wall({-300., -100., -400.}, {1400., 700., 415.}), wall({-300., -100., -400.}, {315., 700., 1400.})});
}

void plate_with_holes()
{
  std::vector<int> holes;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 3; ++j)
      holes.push_back(rod({100. + 200. * i, 80. + 200. * j, -1.}, {0., 0., 40.}, 40. + 20. * ((i + j) % 4)));
  holes.push_back(rod({500., 590., -1.}, {0., 0., 40.}, 10.)); // 5 mm from the edge
  holes.push_back(rod({300., 12., -1.}, {0., 0., 40.}, 14.));
  without(wall({0., 0., 0.}, {1000., 600., 15.}), holes);
}

void shell_with_nozzle()
{
  without(tube({0., 0., 0.}, {0., 0., 900.}, 610., 5.), {rod({0., 0., 500.}, {400., 0., 0.}, 52.3)});
  without(rod({0., 0., -20.}, {0., 0., 20.}, 700.), {rod({0., 0., -30.}, {0., 0., 40.}, 500.)});
  without(rod({0., 0., 900.}, {0., 0., 20.}, 700.), {rod({0., 0., 890.}, {0., 0., 40.}, 600.)});
  without(tube({200., 0., 500.}, {300., 0., 0.}, 60.3, 4.), {rod({0., 0., 0.}, {0., 0., 900.}, 610.)});
}

/// A rectangular hollow section with rounded edges along x.
int rounded_section(const Point &from, double length, double width, double height, double thickness)
{
  const auto section = [&](double inset, double radius)
  {
    const int face =
        occ::addRectangle(from[1] + inset, from[2] + inset, 0., width - 2. * inset, height - 2. * inset, -1, radius);
    gmsh::vectorpair solid;
    occ::extrude({{2, face}}, 0., 0., length, solid);
    for (const auto &[dim, tag] : solid)
      if (dim == 3)
        return tag;
    return -1;
  };
  const int              solid = without(section(0., 2. * thickness), {section(thickness, thickness)});
  const gmsh::vectorpair all   = {{3, solid}};
  occ::rotate(all, 0., 0., 0., 1., 1., 1., 2. * M_PI / 3.); // y z x to x y z
  occ::translate(all, from[0], 0., 0.);
  return solid;
}

void rounded_sections()
{
  rounded_section({0., 0., 0.}, 1200., 150., 100., 6.);
  wall({-20., -50., -50.}, {20., 250., 200.});
  wall({1200., -50., -50.}, {20., 250., 200.});
  without(wall({500., 60., 100.}, {200., 15., 150.}), {rod({600., 50., 180.}, {0., 40., 0.}, 50.)});
  tube({600., 75., 180.}, {0., 30., 0.}, 80., 15.);
}

/// A frame of a loom: side walls of 15 mm with bearing bosses, cross walls, tubes, feet and an oblique breast beam.
void loom()
{
  for (const double y : {0., 1185.}) // side walls with an opening
  {
    std::vector<int> cuts = {wall({300., y - 10., 300.}, {300., 40., 250.}),
                             rod({150., y - 10., 700.}, {0., 40., 0.}, 60.),
                             rod({800., y - 10., 650.}, {0., 40., 0.}, 80.)};
    without(wall({0., y, 0.}, {1000., 15., 900.}), cuts);
    const double outside = y > 0. ? 15. : 0., away = y > 0. ? 1. : -1.;
    tube({150., y + outside, 700.}, {0., 40. * away, 0.}, 110., 25.);
    tube({800., y + outside, 650.}, {0., 50. * away, 0.}, 130., 25.);
  }
  wall({20., 15., 100.}, {15., 1170., 200.});  // front
  wall({965., 15., 100.}, {15., 1170., 200.}); // rear
  wall({400., 15., 60.}, {250., 1170., 15.});  // floor
  wall({400., 592.5, 75.}, {250., 15., 150.}); // rib on it
  for (const auto &[x, z] :
       {std::pair(100., 830.), std::pair(900., 830.), std::pair(700., 400.), std::pair(300., 250.)})
    tube({x, 15., z}, {0., 1170., 0.}, 76.1, 6.);
  for (const double x : {50., 850.})
    for (const double y : {-50., 1150.})
      wall({x, y, -20.}, {100., 100., 20.}); // feet
  oblique({{{200., 560.}, {210.6, 549.4}, {320., 658.8}, {309.4, 669.4}}}, 15., 1170.);
}

} // namespace

std::vector<ThinFrame> thin_frames()
{
  return {{"plate_with_tube", plate_with_tube},   {"tube_through_plate", tube_through_plate},
          {"beams_with_holes", beams_with_holes}, {"box_with_bosses", box_with_bosses},
          {"crossing_tubes", crossing_tubes},     {"oblique_wall", oblique_wall},
          {"plate_with_holes", plate_with_holes}, {"shell_with_nozzle", shell_with_nozzle},
          {"rounded_sections", rounded_sections}, {"loom", loom}};
}

} // namespace gestell::fem::test
