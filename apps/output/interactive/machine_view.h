#pragma once

#include "apps/output/values/result.h"

#include <optional>
#include <string>

namespace gestell::apps
{

/// Interactive view of the machine with its motion, modes and stresses, as HTML with its data for the script; empty if
/// there is nothing to show.
std::string machine_view(const Result &result);

/// Contents of a picture of the machine in the text.
struct MachinePicture
{
  std::string           show;          ///< "motion", "rest", "coupled-1", "frame-1", "stress-1"
  std::optional<double> t{}, later{};  ///< [s] of the motion; bodies at `later` are drawn in outline
  std::optional<double> enlargement{}; ///< of displacements; none: that of the view
};

/// A figure that the page's script draws from the data of the view, also in print; hidden if the page has no view.
std::string machine_picture(const MachinePicture &picture, const std::string &caption);

} // namespace gestell::apps
