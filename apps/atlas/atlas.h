#pragma once

#include "apps/output/charts/stability_maps.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// One number, predicted and then measured with the integrators themselves.
struct AtlasComparison
{
  std::string what;
  double      predicted, measured;
  double      tolerance; ///< absolute; explained at its definition
};

/// A case in which a method fails.
struct AtlasEntry
{
  std::string                           id; ///< of its heading and its figures
  std::string                           title;
  std::string                           text; ///< Markdown
  std::vector<AtlasComparison>          comparisons;
  std::vector<std::vector<std::string>> table; ///< first row: headings; empty: none
  std::vector<NamedSvg>                 figures;
};

// Each function builds its system, runs the integrators on it and describes the results.
AtlasEntry bdf3_on_a_frame();
AtlasEntry bdf_of_high_order();
AtlasEntry wilson_below_its_limit();
AtlasEntry wilson_overshoot();
AtlasEntry newmark_outside_its_limits();
AtlasEntry exact_force_at_contact();
AtlasEntry hard_contact();
AtlasEntry order_at_play();
AtlasEntry fixed_point_of_forces();
AtlasEntry drift_of_joints();
AtlasEntry first_multiplier_of_a_joint();
AtlasEntry chatter();

/// All entries, in the order of the document.
std::vector<AtlasEntry> failure_atlas();

/// The document; it links figures in the folder `figures` next to it.
std::string atlas_markdown(const std::vector<AtlasEntry> &entries, const std::string &figures);

} // namespace gestell::apps
