#pragma once

#include "coupling/modes/mode_comparison.h"
#include "coupling/modes/modes.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// A measure that both machines have.
struct SharedMeasure
{
  std::string path, unit; ///< "crank.angle", "rad"
};

/// One of two machines whose modes are compared.
struct ComparedModes
{
  std::string                 scene; ///< its name
  std::vector<coupling::Mode> modes;
  Eigen::MatrixXd             shapes; ///< [measures x modes] mass normalised
};

/// Modes of the scene and of another one, matched by their shapes.
struct ComparedShapes
{
  std::vector<SharedMeasure> measures;
  ComparedModes              a, b;
  coupling::ModeComparison   match;
};

} // namespace gestell::apps
