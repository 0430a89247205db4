#pragma once

#include "apps/output/pictures/projection.h"
#include "coupling/plugin/mesh_report.h"

#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

/// Colour of a face by its index, far from those of the indices beside it.
Colour face_colour(int index);

/// The picture on so few triangles (55 000) that a page with it stays small; what is finer than some thousandths of the
/// frame is drawn together where there are more.
coupling::FacePicture light_picture(const coupling::FacePicture &picture);

/// The frame from eight sides, or as many of them as 1.2 MB hold, as caption and SVG: paths bear the index of their
/// face as `data-f`, and where there is room its number stands on it.
std::vector<std::pair<std::string, std::string>> face_pictures(const coupling::MeshReport &report);

} // namespace gestell::apps
