#include "apps/output/pictures/painting_order.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <map>
#include <queue>
#include <set>
#include <string>
#include <utility>

namespace gestell::apps
{
namespace
{

bool by_facets(const Hiding &a, const Hiding &b)
{
  return std::pair(a.behind, a.front) < std::pair(b.behind, b.front);
}

/// Of two opposite ones that of more points; of as many one of both all the same.
HidingCounts prevailing(const HidingCounts &hiding)
{
  HidingCounts result;
  for (const Hiding &pair : hiding)
  {
    const Hiding opposite{pair.front, pair.behind, 0};
    const auto   place = std::lower_bound(hiding.begin(), hiding.end(), opposite, by_facets);
    const bool   both  = place != hiding.end() && !by_facets(opposite, *place);
    if (!both || std::pair(place->count, place->behind) < std::pair(pair.count, pair.behind))
      result.push_back(pair);
  }
  return result;
}

/// Facets that hide each other in rings, and those on ways between rings: what is left when all that hides nothing, or
/// that nothing left is hidden by, has been taken away.
std::vector<int> rings(const std::vector<int> &seen, const HidingCounts &hiding, std::size_t n)
{
  std::vector<bool> left(n, false);
  for (const int facet : seen)
    left[facet] = true;
  for (const bool forwards : {true, false})
  {
    std::vector<std::vector<int>> after(n);
    std::vector<int>              n_before(n, 0), open;
    for (const auto &[behind, front, count] : hiding)
      if (left[behind] && left[front])
      {
        after[forwards ? behind : front].push_back(forwards ? front : behind);
        ++n_before[forwards ? front : behind];
      }
    for (const int facet : seen)
      if (left[facet] && n_before[facet] == 0)
        open.push_back(facet);
    while (!open.empty())
    {
      const int facet = open.back();
      open.pop_back();
      left[facet] = false;
      for (const int next : after[facet])
        if (--n_before[next] == 0)
          open.push_back(next);
    }
  }
  std::vector<int> result;
  std::copy_if(seen.begin(), seen.end(), std::back_inserter(result), [&](int facet) { return left[facet]; });
  return result;
}

/// Kahn's topological order, that stays with one look as long as something of it can be painted.
class Painter
{
public:
  Painter(const std::vector<Facet> &facets, const std::vector<int> &seen, HidingCounts hiding)
      : facets_(facets), hiding_(std::move(hiding)), n_before_(facets.size(), 0)
  {
    for (const Hiding &pair : hiding_)
      ++n_before_[pair.front];
    for (const int facet : seen)
      if (n_before_[facet] == 0)
        offer(facet);
      else
        waiting_.insert(place(facet));
  }

  std::vector<int> order()
  {
    std::vector<int> order;
    for (auto look = largest(); look != ready_.end(); look = largest())
    {
      while (!look->second.empty())
      {
        order.push_back(look->second.top().second);
        look->second.pop();
        release_what_hides(order.back());
      }
      ready_.erase(look);
    }
    return order;
  }

private:
  using Place  = std::pair<double, int>; // depth of a facet, its number
  using Places = std::priority_queue<Place, std::vector<Place>, std::greater<>>;
  using Ready  = std::map<std::pair<int, std::string>, Places>; // by face and colour

  Place place(int facet) const { return {facets_[facet].depth(), facet}; }
  void  offer(int facet) { ready_[{facets_[facet].face, facets_[facet].colour}].push(place(facet)); }

  /// The look of which most can be painted; end() when all is painted.
  Ready::iterator largest()
  {
    if (ready_.empty() && waiting_.empty())
      return ready_.end();
    if (ready_.empty())
    {
      const int facet = waiting_.begin()->second; // of a ring
      waiting_.erase(waiting_.begin());
      n_before_[facet] = 0;
      offer(facet);
    }
    return std::max_element(ready_.begin(), ready_.end(),
                            [](const auto &a, const auto &b) { return a.second.size() < b.second.size(); });
  }

  void release_what_hides(int facet)
  {
    for (auto pair = std::lower_bound(hiding_.begin(), hiding_.end(), Hiding{facet, -1, 0}, by_facets);
         pair != hiding_.end() && pair->behind == facet; ++pair)
      if (n_before_[pair->front] > 0 && --n_before_[pair->front] == 0)
      {
        waiting_.erase(place(pair->front));
        offer(pair->front);
      }
  }

  const std::vector<Facet> &facets_;
  HidingCounts              hiding_;
  std::vector<int>          n_before_; // that are hidden by a facet and not yet painted
  Ready                     ready_;
  std::set<Place>           waiting_;
};

} // namespace

PaintingOrder painting_order(const std::vector<Facet> &facets, const std::vector<int> &seen, const HidingCounts &hiding)
{
  std::vector<int> ring = rings(seen, hiding, facets.size());
  return {Painter(facets, seen, ring.empty() ? hiding : prevailing(hiding)).order(), std::move(ring)};
}

} // namespace gestell::apps
