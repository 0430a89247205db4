#include "apps/scene/read/frame/matrix_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <sstream>

namespace gestell::apps
{
namespace
{

/// Sides of the bounding box of the points and all interfaces [m].
std::array<double, 3> box_of(std::vector<std::array<double, 3>> points, const std::vector<fem::Interface> &interfaces)
{
  for (const auto &interface : interfaces)
    points.push_back(interface.position);
  std::array<double, 3> sides{};
  for (int d = 0; d < 3 && !points.empty(); ++d)
  {
    const auto [min, max] =
        std::minmax_element(points.begin(), points.end(), [d](const auto &a, const auto &b) { return a[d] < b[d]; });
    sides[d] = (*max)[d] - (*min)[d];
  }
  return sides;
}

std::string text_of(std::initializer_list<std::string> words, double value)
{
  std::ostringstream text;
  text.precision(3);
  text << *words.begin() << value << *(words.begin() + 1);
  return text.str();
}

/// The length sqrt(C_rr / C_uu) of an interface, of the stiffest directions; 0 if it has not both.
double bending_length(const fem::FrameMatrices &frame, const fem::Interface &interface)
{
  double shift = 0., turn = 0.;
  for (int motion = 0; motion < 6; ++motion)
    if (const int i = interface.coordinate[motion]; i >= 0)
    {
      double &largest = motion < 3 ? shift : turn;
      largest         = std::max(largest, frame.C.coeff(i, i));
    }
  return shift > 0. && turn > 0. ? std::sqrt(turn / shift) : 0.;
}

/// The highest of sqrt(C_ii / M_ii) [rad/s] of coordinates with mass.
double fastest_coordinate(const fem::FrameMatrices &frame)
{
  const Eigen::VectorXd M = frame.M.diagonal(), C = frame.C.diagonal();
  double                omega2 = 0.;
  for (Eigen::Index i = 0; i < M.size(); ++i)
    if (M[i] > 0.)
      omega2 = std::max(omega2, C[i] / M[i]);
  return std::sqrt(omega2);
}

/// Median over nodes of how fast waves run from each to its nearest neighbour [m/s]; 0 if no node has one.
double wave_speed(const fem::FrameMatrices &frame, const std::vector<fem::Interface> &nodes)
{
  std::vector<int> node_of(frame.M.rows(), -1);
  for (std::size_t k = 0; k < nodes.size(); ++k)
    for (const int row : nodes[k].coordinate)
      if (row >= 0)
        node_of[row] = int(k);
  std::vector<double> speeds;
  for (std::size_t k = 0; k < nodes.size(); ++k)
  {
    double nearest = std::numeric_limits<double>::infinity(), omega2 = 0.;
    for (int motion = 0; motion < 3; ++motion)
    {
      const int row = nodes[k].coordinate[motion];
      if (row < 0)
        continue;
      if (const double mass = frame.M.coeff(row, row); mass > 0.)
        omega2 = std::max(omega2, frame.C.coeff(row, row) / mass);
      for (fem::SparseMatrix::InnerIterator entry(frame.C, row); entry; ++entry)
        if (const int other = node_of[entry.index()]; other >= 0 && entry.value() != 0.)
        {
          const auto  &a = nodes[k].position, &b = nodes[other].position;
          const double distance = std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
          nearest               = distance > 0. ? std::min(nearest, distance) : nearest;
        }
    }
    if (std::isfinite(nearest) && omega2 > 0.)
      speeds.push_back(nearest * std::sqrt(omega2));
  }
  if (speeds.empty())
    return 0.;
  std::nth_element(speeds.begin(), speeds.begin() + speeds.size() / 2, speeds.end());
  return speeds[speeds.size() / 2];
}

} // namespace

std::string suspect_frequency(const coupling::ReducedFrame &frame)
{
  const auto   sides = box_of(frame.points, frame.interfaces);
  const double size  = *std::max_element(sides.begin(), sides.end());
  for (const double f : frame.frequencies_hz)
  {
    if (!(f > 0.))
      continue;
    constexpr double fastest_wave     = 6.5e3; // [m/s] longitudinal waves in aluminium: 6400
    constexpr double highest_of_small = 2e4;   // [Hz] of a frame without size: the end of structure-borne sound
    if (size > 0. ? f * size > fastest_wave : f > highest_of_small)
      return text_of({"the lowest elastic frequency of the frame is ",
                      std::string(" Hz, which no frame ") + (size > 0. ? "of its size" : "of a machine") +
                          " has: are masses in tonnes, or stiffnesses in N/mm? Matrices must be in kg, m and N"},
                     f);
    break;
  }
  return "";
}

std::vector<std::string> suspect_units(const fem::FrameMatrices &frame, const std::vector<fem::Interface> &nodes)
{
  std::vector<std::string> suspicions;
  constexpr double         slowest = 0.1; // [Hz] buildings have some tenths
  if (const double f = fastest_coordinate(frame) / (2. * M_PI); f < slowest)
    suspicions.push_back(text_of({"no coordinate of the frame has a frequency above ",
                                  " Hz, implausibly slow for a frame: are mass and stiffness exchanged?"},
                                 f));
  const auto       sides            = box_of(frame.picture.points, frame.interfaces);
  const double     size             = *std::max_element(sides.begin(), sides.end());
  constexpr double largest_frame    = 1e3; // [m] no frame is larger; one of 1 m in millimetres is at the limit
  constexpr double fastest_of_nodes = 6e4; // [m/s] ten times the wave speed of metals, from node to node
  if (const double speed = wave_speed(frame, nodes); speed > fastest_of_nodes && size <= largest_frame)
    suspicions.push_back(
        text_of({"waves travel from node to node with ",
                 " m/s, far faster than in any metal (5000 m/s): are masses in tonnes? They must be in "
                 "kg, so that stiffness in N/m fits"},
                speed));
  if (size > largest_frame)
    suspicions.push_back(text_of({"the nodes spread over ", " m: if their positions are in millimetres, write 'x [mm], "
                                                            "y [mm], z [mm]' in the head of the table"},
                                 size));
  else if (size > 0. && frame.mass > 0.)
  {
    double           volume   = 1.;
    constexpr double thinnest = 1. / 20.; // of the longest side: plane frames, and bars
    for (const double side : sides)
      volume *= std::max(side, thinnest * size);
    constexpr double air            = 1.2; // [kg/m^3] of the box of a frame: nothing is lighter than what surrounds it
    constexpr double heaviest_metal = 22600.; // [kg/m^3] osmium
    if (const double density = frame.mass / volume; density < air)
      suspicions.push_back(text_of({"the frame is lighter than the air in its box, ",
                                    " kg/m^3: are masses in tonnes? They must be in kg, so that stiffness in N/m fits"},
                                   density));
    else if (density > heaviest_metal &&
             frame.picture.points.size() > frame.interfaces.size()) // interfaces alone do not bound a frame
      suspicions.push_back(text_of({"the frame is heavier than any metal that fills its box, ",
                                    " kg/m^3: check the units of mass (kg) and of positions (m)"},
                                   density));
  }
  constexpr double longest_bending  = 100.; // [m] larger than any frame; moments in N mm make 1000 m of 1 m
  constexpr double shortest_bending = 1e-4; // [m] a tenth of a millimetre: no part is thinner
  for (const auto &interface : frame.interfaces)
    if (const double length = bending_length(frame, interface);
        length > longest_bending || (length > 0. && length < shortest_bending))
    {
      suspicions.push_back(text_of({"at interface " + interface.name + " moments over forces make a length of ",
                                    " m: are moments in N mm? Matrices must be in kg, m and N; rotations in rad"},
                                   length));
      break;
    }
  return suspicions;
}

} // namespace gestell::apps
