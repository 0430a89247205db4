#pragma once

#include <array>
#include <cstddef>

namespace gestell::apps
{

/// Colours of the bodies in every picture, in their order, again from the first after the last: red, green, blue, 0 to
/// 255.
constexpr std::array<std::array<double, 3>, 8> body_colours = {{{0, 114, 178},
                                                                {213, 94, 0},
                                                                {0, 158, 115},
                                                                {176, 80, 143},
                                                                {200, 150, 0},
                                                                {70, 160, 215},
                                                                {120, 90, 70},
                                                                {110, 115, 125}}};

constexpr const std::array<double, 3> &body_colour(std::size_t i)
{
  return body_colours[i % body_colours.size()];
}

} // namespace gestell::apps
