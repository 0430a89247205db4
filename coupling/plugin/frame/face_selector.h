#pragma once

#include "coupling/plugin/mesh_report.h"
#include "fem/geometry/face.h"

#include <string>
#include <vector>

namespace gestell::coupling
{

/// Keys of a `[frame.surface.NAME]` that select one face.
struct FaceSelector
{
  std::string      text;   ///< lines such as `plane = { normal = [0, 0, 1], through = [0, 0, 0.9] }`
  std::vector<int> others; ///< tags of faces that no selector distinguishes from it; `faces` in the text counts them
};

/**
 * The simplest selector, with numbers rounded as printed, with which fem::select_faces() finds only this face.
 * Candidates in this order: its plane or cylinder; that with its box; that through another of its points; its box; its
 * name; the same with narrower tolerances.
 *
 * @param faces     all faces of the model
 * @param diagonal  of the model [m]
 */
FaceSelector selector_of(const fem::Face &face, const std::vector<fem::Face> &faces, double diagonal);

/// Of the face of a cylinder: the whole bore, if it has several faces, and all bores about its axis with its radius.
std::vector<FaceGroup> bores_of(const fem::Face &face, const std::vector<fem::Face> &faces, double diagonal);

} // namespace gestell::coupling
