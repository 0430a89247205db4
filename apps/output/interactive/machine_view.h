#pragma once

#include "apps/output/values/result.h"

#include <optional>
#include <string>

namespace gestell::apps
{

/// The machine to be turned and seen in motion, in its modes and under its stresses, as HTML with its data for the
/// script; empty where there is nothing to be seen.
std::string machine_view(const Result &result);

/// What of the view a picture beside the text shows.
struct MachinePicture
{
  std::string           show;          ///< "motion", "rest", "coupled-1", "frame-1", "stress-1"
  std::optional<double> t{}, later{};  ///< [s] of the motion; at `later` bodies stand in outline
  std::optional<double> enlargement{}; ///< of displacements; none: that of the view
};

/// A figure that the page's script draws with the view's data, on paper too; without the view it is not seen.
std::string machine_picture(const MachinePicture &picture, const std::string &caption);

} // namespace gestell::apps
