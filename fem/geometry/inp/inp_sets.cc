#include "fem/geometry/inp/inp_sets.h"

#include <algorithm>
#include <charconv>
#include <stdexcept>

namespace gestell::fem
{

void InpSets::add(const std::string &set, const std::string &entry)
{
  std::size_t number      = 0;
  const auto [end, error] = std::from_chars(entry.data(), entry.data() + entry.size(), number);
  Set &to                 = sets_[set];
  if (error == std::errc() && end == entry.data() + entry.size())
    to.numbers.push_back(number);
  else
    to.others.push_back(entry);
}

void InpSets::close(std::size_t n_there, const std::string &things, std::size_t most)
{
  most_ = most;
  for (const auto &[set, first, last, step, place] : ranges_)
  {
    const std::size_t steps = (last - first) / step;
    if (steps >= n_there)
      throw std::invalid_argument(place + ": GENERATE from " + std::to_string(first) + " to " + std::to_string(last) +
                                  " names more " + things + " than the " + std::to_string(n_there) +
                                  " there are; give first, last and step of the intended ones.");
    n_members_ += steps + 1;
    if (n_members_ > most_)
      throw std::invalid_argument(place + ": sets have more than " + std::to_string(most_) + " " + things +
                                  " in total; remove those that are not needed.");
    for (std::size_t k = 0; k <= steps; ++k)
      add(set, first + k * step);
  }
  ranges_.clear();
}

std::vector<std::string> InpSets::names() const
{
  std::vector<std::string> names;
  for (const auto &set : sets_)
    names.push_back(set.first);
  return names;
}

const std::vector<std::size_t> &InpSets::members(const std::string &set)
{
  static const std::vector<std::size_t> none;
  const auto                            found = sets_.find(set);
  if (found == sets_.end())
    return none;
  if (!found->second.is_known)
    resolve(set, found->second);
  return found->second.numbers;
}

void InpSets::resolve(const std::string &name, Set &set)
{
  if (set.is_open)
  {
    std::string ring;
    for (auto at = std::find(open_.begin(), open_.end(), name); at != open_.end(); ++at)
      ring += "\"" + *at + "\" names ";
    throw std::invalid_argument("set " + ring + "\"" + name +
                                "\", which is a cycle; remove one of these lines from the sets.");
  }
  constexpr std::size_t deepest_sets = 200; // each takes some of the stack
  if (open_.size() >= deepest_sets)
    throw std::invalid_argument("sets are nested more than " + std::to_string(deepest_sets) +
                                " levels deep, down to \"" + name + "\"; list the numbers.");
  set.is_open = true;
  open_.push_back(name);
  for (const std::string &other : set.others)
  {
    const std::vector<std::size_t> &more = members(other);
    n_members_ += more.size();
    if (n_members_ > most_)
      throw std::invalid_argument("its sets have more than " + std::to_string(most_) + " members together, with \"" +
                                  name + "\"; remove sets that are not needed.");
    set.numbers.insert(set.numbers.end(), more.begin(), more.end());
  }
  n_members_ += set.numbers.size();
  std::sort(set.numbers.begin(), set.numbers.end());
  set.numbers.erase(std::unique(set.numbers.begin(), set.numbers.end()), set.numbers.end());
  set.others.clear();
  set.is_known = true;
  set.is_open  = false;
  open_.pop_back();
}

} // namespace gestell::fem
