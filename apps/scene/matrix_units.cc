#include "apps/scene/matrix_units.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

namespace gestell::apps
{
namespace
{

constexpr double air = 1.2, heaviest_metal = 22600.;              // [kg/m^3]
constexpr double largest_frame   = 1e3;                           // [m]
constexpr double longest_bending = 100., shortest_bending = 1e-4; // [m]
constexpr double thinnest = 1. / 20.;                             // of the longest side

/// Sides of the box of all nodes, or of all interfaces where there are no others [m].
std::array<double, 3> box_of(const fem::FrameMatrices &frame)
{
  auto points = frame.picture.points;
  for (const auto &interface : frame.interfaces)
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

} // namespace

std::vector<std::string> suspect_units(const fem::FrameMatrices &frame, bool translations_known)
{
  std::vector<std::string> suspicions;
  const auto               sides = box_of(frame);
  const double             size  = *std::max_element(sides.begin(), sides.end());
  if (size > largest_frame)
    suspicions.push_back(text_of({"the nodes spread over ", " m: if their positions are in millimetres, write 'x [mm], "
                                                            "y [mm], z [mm]' in the head of the table"},
                                 size));
  else if (size > 0. && translations_known)
  {
    double volume = 1.;
    for (const double side : sides)
      volume *= std::max(side, thinnest * size);
    if (const double density = frame.mass / volume; density < air)
      suspicions.push_back(text_of({"the frame is lighter than the air in its box, ",
                                    " kg/m^3: are masses in tonnes? They must be in kg, so that stiffness in N/m fits"},
                                   density));
    else if (density > heaviest_metal && !frame.picture.points.empty()) // interfaces alone bound no frame
      suspicions.push_back(text_of({"the frame is heavier than any metal that fills its box, ",
                                    " kg/m^3: check the units of mass (kg) and of positions (m)"},
                                   density));
  }
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
