#include "fem/values/frame_matrices.h"

#include <algorithm>

namespace gestell::fem
{

std::vector<int> Interface::coordinates() const
{
  std::vector<int> all;
  for (const int i : coordinate)
    if (i >= 0)
      all.push_back(i);
  all.insert(all.end(), face.coordinate.begin(), face.coordinate.end());
  return all;
}

std::vector<int> FrameMatrices::interface_coordinates() const
{
  std::vector<int> q1;
  for (const Interface &interface : interfaces)
    for (const int i : interface.coordinates())
      q1.push_back(i);
  std::sort(q1.begin(), q1.end());
  return q1;
}

} // namespace gestell::fem
