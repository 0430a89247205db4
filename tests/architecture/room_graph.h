#pragma once

#include "tests/architecture/source_tree.h"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace gestell::tests
{

/// Who includes whom.  A room is a header with the source of the same name: "coupling/frame/reduced_frame".
class RoomGraph
{
public:
  /// Of the sources of the project below these top folders.
  RoomGraph(const std::vector<SourceFile> &files, const std::vector<std::string> &tops);

  const std::map<std::string, std::set<std::string>> &includes() const { return includes_; }

  /// Rooms that reach each other, a line per knot.
  std::vector<std::string> cycles() const;
  /// Rooms by folder.
  std::map<std::string, std::vector<std::string>> folders() const;
  /// Rooms on the longest way of includes inside a folder; without cycles.
  int levels(const std::string &folder) const;
  /// Includes of a room in one of the folders `order` by one in a folder that stands before it: "a -> b".  A folder
  /// stands for those below it that are not in the list themselves.
  std::vector<std::string> against(const std::vector<std::string> &order) const;

private:
  std::map<std::string, std::set<std::string>> includes_;
};

/// "coupling/frame" of "coupling/frame/reduced_frame".
std::string folder_of(const std::string &room);

} // namespace gestell::tests
