#pragma once

#include "apps/study/surface/response_surface.h"

#include <string>

namespace gestell::apps
{

/// Two variables of a surface, the others held.
struct SurfaceCut
{
  int             first = 0, second = 1; ///< along the abscissa and the ordinate
  Eigen::VectorXd at{};                  ///< coded values of the others; those of the two are marked
  bool            at_optimum = false;    ///< whether the mark is an optimum; else there is none
};

/// Contours of an output over the ranges of two variables, shaded; rings are runs of the study, whatever their other
/// variables.  SVG.
std::string contour_picture(const ResponseSurface &surface, const std::vector<StudyVariable> &variables,
                            const Eigen::MatrixXd &coded_runs, const SurfaceCut &cut);

} // namespace gestell::apps
