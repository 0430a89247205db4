#pragma once

#include <limits>
#include <string>
#include <vector>

namespace gestell::apps
{

/// How a variable scatters about its nominal value, for robust figures.
enum class Scatter
{
  none,
  uniform, ///< within nominal +- width
  normal   ///< with width as its standard deviation
};

/**
 * An entry of the scene that a study varies.  Coded values have no unit:
 *
 *     xi = (x - (from + to) / 2) / ((to - from) / 2),        xi = -1 at from, +1 at to.
 */
struct StudyVariable
{
  std::string              name{};
  std::string              key{};  ///< of the scene, such as parameters.c_P
  std::string              unit{}; ///< of all values below; empty: none
  double                   from = -1., to = 1.;
  std::vector<double>      levels{}; ///< of a full factorial design, ascending; empty: as many as it asks for, evenly
  Scatter                  scatter = Scatter::none;
  double                   width   = 0.;    ///< of the scatter, in the unit of the variable
  std::vector<std::string> words{};         ///< of a variable that takes words: level k is the k-th of them
  bool                     stepped = false; ///< it has nothing between its levels: words, or values of files
  std::vector<std::string> more_keys{};     ///< of the scene, that take its value, too

  double centre() const { return 0.5 * (from + to); }
  double half_range() const { return 0.5 * (to - from); }
  double coded(double physical) const { return (physical - centre()) / half_range(); }
  double physical(double coded) const { return centre() + half_range() * coded; }

  /// A level as it is written: 900 kN/mm, linear.
  std::string text(double level) const;

  /// Name with its unit, as columns and axes are headed.
  std::string head() const { return unit.empty() ? name : name + " [" + unit + "]"; }
};

/// The variable that takes these levels: from the smallest to the largest, ascending.
/// @throws std::invalid_argument for fewer than two different levels, or one that is not a number
StudyVariable variable_of_levels(StudyVariable variable, std::vector<double> levels);

/// @throws std::invalid_argument unless from < to, both numbers, and the scatter is none or has a positive width
void check_variable(const StudyVariable &variable);

} // namespace gestell::apps
