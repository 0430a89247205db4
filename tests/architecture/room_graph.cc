#include "tests/architecture/room_graph.h"

#include <algorithm>
#include <functional>
#include <regex>

namespace gestell::tests
{
namespace
{

/// "coupling/frame/reduced_frame" of its .h or .cc; empty for other files.
std::string room_of(const std::string &path)
{
  std::smatch             match;
  static const std::regex source("(.*)\\.(h|cc)");
  return std::regex_match(path, match, source) ? match[1].str() : "";
}

bool lies_below(const std::string &room, const std::vector<std::string> &tops)
{
  return std::any_of(tops.begin(), tops.end(), [&](const auto &top) { return room.rfind(top + "/", 0) == 0; });
}

/// The longest entry of `order` that the room's folder is or lies below; -1: none.
int place_in(const std::vector<std::string> &order, const std::string &room)
{
  int place = -1;
  for (std::size_t i = 0; i < order.size(); ++i)
    if (room.rfind(order[i] + "/", 0) == 0 && (place < 0 || order[i].size() > order[place].size()))
      place = int(i);
  return place;
}

} // namespace

std::string folder_of(const std::string &room)
{
  return room.substr(0, room.rfind('/'));
}

RoomGraph::RoomGraph(const std::vector<SourceFile> &files, const std::vector<std::string> &tops)
{
  static const std::regex include("\\s*#\\s*include\\s*\"([^\"]+)\".*");
  for (const auto &[path, lines] : files)
    if (const std::string room = room_of(path); !room.empty() && lies_below(room, tops))
      for (const std::string &line : lines)
      {
        auto       &included = includes_[room];
        std::smatch match;
        if (!std::regex_match(line, match, include))
          continue;
        if (const std::string other = room_of(match[1]); other != room && lies_below(other, tops))
          included.insert(other);
      }
}

std::vector<std::string> RoomGraph::cycles() const
{
  // Tarjan's strongly connected components
  std::vector<std::string>                       knots, stack;
  std::map<std::string, int>                     number, lowest;
  std::set<std::string>                          on_stack;
  const std::function<void(const std::string &)> visit = [&](const std::string &room)
  {
    number[room] = lowest[room] = int(number.size()) + 1;
    stack.push_back(room);
    on_stack.insert(room);
    if (const auto found = includes_.find(room); found != includes_.end())
    {
      for (const std::string &next : found->second)
        if (!number.count(next))
        {
          visit(next);
          lowest[room] = std::min(lowest[room], lowest[next]);
        }
        else if (on_stack.count(next))
          lowest[room] = std::min(lowest[room], number[next]);
    }
    if (lowest[room] != number[room])
      return;
    std::string knot;
    int         rooms = 0;
    for (bool more = true; more; ++rooms)
    {
      more = stack.back() != room;
      knot += (knot.empty() ? "" : ", ") + stack.back();
      on_stack.erase(stack.back());
      stack.pop_back();
    }
    if (rooms > 1)
      knots.push_back(knot);
  };
  for (const auto &entry : includes_)
    if (!number.count(entry.first))
      visit(entry.first);
  return knots;
}

std::map<std::string, std::vector<std::string>> RoomGraph::folders() const
{
  std::map<std::string, std::vector<std::string>> folders;
  for (const auto &entry : includes_)
    folders[folder_of(entry.first)].push_back(entry.first);
  return folders;
}

int RoomGraph::levels(const std::string &folder) const
{
  std::map<std::string, int>                    depth;
  const std::function<int(const std::string &)> depth_of = [&](const std::string &room)
  {
    if (const auto known = depth.find(room); known != depth.end())
      return known->second;
    int below   = 0;
    depth[room] = 1; // a cycle ends here
    if (const auto found = includes_.find(room); found != includes_.end())
      for (const std::string &next : found->second)
        if (folder_of(next) == folder)
          below = std::max(below, depth_of(next));
    return depth[room] = below + 1;
  };
  int levels = 0;
  for (const auto &entry : includes_)
    if (folder_of(entry.first) == folder)
      levels = std::max(levels, depth_of(entry.first));
  return levels;
}

std::vector<std::string> RoomGraph::against(const std::vector<std::string> &order) const
{
  std::vector<std::string> findings;
  for (const auto &[room, included] : includes_)
    if (const int own = place_in(order, room); own >= 0)
      for (const std::string &other : included)
        if (place_in(order, other) > own)
          findings.push_back(room + " -> " + other);
  return findings;
}

} // namespace gestell::tests
