#pragma once

#include <functional>
#include <string>
#include <vector>

namespace gestell::fem::test
{

/// A frame of thin walls, tubes and bosses, drawn in mm with gmsh::model::occ; its solids touch, as if welded.
struct ThinFrame
{
  std::string           name;
  std::function<void()> draw;
};

/// Ten of them: walls of 5 to 20 mm, tubes of 4 to 10 mm. The first is a tube on a plate, the last a frame of 19
/// solids.
std::vector<ThinFrame> thin_frames();

} // namespace gestell::fem::test
