#pragma once

#include <array>
#include <cstddef>
#include <string>

namespace gestell::apps
{

using Colour = std::array<double, 3>; ///< red, green, blue, 0 to 255

/// Colours of the bodies in every picture, in their order; they repeat after the last.
constexpr std::array<Colour, 8> body_colours = {{{0, 114, 178},
                                                 {213, 94, 0},
                                                 {0, 158, 115},
                                                 {176, 80, 143},
                                                 {200, 150, 0},
                                                 {70, 160, 215},
                                                 {120, 90, 70},
                                                 {110, 115, 125}}};

constexpr const Colour &body_colour(std::size_t i)
{
  return body_colours[i % body_colours.size()];
}

/// Colour of a frame without a field.
constexpr Colour frame_colour = {184, 191, 201};

/// Colour for a share s in [0, 1] of a field: dark blue to yellow, with evenly increasing lightness.
Colour scale_colour(double s);

/// Colour of a face by its index, very different from those of adjacent indices.
Colour face_colour(int index);

/// "#rrggbb"
std::string hex(const Colour &colour);

} // namespace gestell::apps
