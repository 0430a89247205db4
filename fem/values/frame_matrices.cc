#include "fem/values/frame_matrices.h"

#include <algorithm>

namespace gestell::fem
{

std::vector<int> FrameMatrices::interface_coordinates() const
{
  std::vector<int> q1;
  for (const Interface &interface : interfaces)
    for (const int i : interface.coordinate)
      if (i >= 0)
        q1.push_back(i);
  std::sort(q1.begin(), q1.end());
  return q1;
}

} // namespace gestell::fem
