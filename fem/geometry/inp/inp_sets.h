#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace gestell::fem
{

/// Named sets of numbers, which may contain other sets by name.
class InpSets
{
public:
  void add(const std::string &set, std::size_t number) { sets_[set].numbers.push_back(number); }

  /// first, first + step, ..., last: of *NSET or *ELSET with GENERATE
  struct Range
  {
    std::string set;
    std::size_t first, last, step;
    std::string place; ///< prefix of messages
  };
  void add(Range range) { ranges_.push_back(std::move(range)); }

  /// @param entry  a number or the name of a set
  void add(const std::string &set, const std::string &entry);

  /**
   * The numbers of a set, including those of the sets that it names: ascending, each once; none for an unknown set.
   * Later additions are not included.
   *
   * @throws std::invalid_argument for a set that contains itself, directly or through others, for sets nested more than
   * 200 levels deep, and for more members than allowed.
   */
  const std::vector<std::size_t> &members(const std::string &set);

  /**
   * Resolves the ranges when all nodes and elements are known.
   *
   * @param n_there  number of `things`, nodes or elements
   * @param most     limit of the members of all sets together, counted at every occurrence: a short file can have very
   *   many
   * @throws std::invalid_argument for a range that exceeds this number, and beyond `most`.
   */
  void close(std::size_t n_there, const std::string &things, std::size_t most);

  std::vector<std::string> names() const;

private:
  struct Set
  {
    std::vector<std::size_t> numbers;
    std::vector<std::string> others;
    bool                     is_known = false, is_open = false;
  };

  void resolve(const std::string &name, Set &set);

  std::map<std::string, Set> sets_;
  std::vector<Range>         ranges_;
  std::vector<std::string>   open_; ///< names of sets being resolved
  std::size_t                most_ = static_cast<std::size_t>(-1), n_members_ = 0;
};

} // namespace gestell::fem
