#pragma once

#include <array>
#include <string>
#include <vector>

namespace gestell::test
{

/// Names of the parameters by which scaled_scene() multiplies, and their exponents in a unit, "N m": metre, kilogram,
/// second.
const std::array<const char *, 3> scales = {"scale_of_length", "scale_of_mass", "scale_of_time"};
std::array<double, 3>             exponents(const std::string &unit);

/**
 * The text of a scene, each of whose values with a unit is multiplied by powers of three new parameters, which are 1:
 * "(40 mm)" becomes "((40 mm)*scale_of_length^1)".  Whatever the machine is, an output y of dimension m^a kg^b s^c is
 * multiplied by L^a M^b T^c if the parameters are L, M and T (Buckingham's theorem), so that dy/dL = a y, dy/dM = b y,
 * dy/dT = c y at 1: the sums of dimension exponent times value times derivative over all values of the scene.
 *
 * Values without a unit are taken for plain numbers, and quantities that only the program knows are not multiplied.
 */
std::string scaled_scene(const std::string &toml);

/// An expression so multiplied, of numbers with a unit and brackets with one.
std::string scaled_expression(const std::string &text);

/// Writes a scene of apps/scenes so, with those that it extends, into a folder.  @return its path
std::string write_scaled_scene(const std::string &name, const std::string &folder);

} // namespace gestell::test
