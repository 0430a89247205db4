#include "apps/scene/read/measure_order.h"

#include <algorithm>

namespace gestell::apps
{

namespace
{

/// Names that a measure takes its motions from; places and bodies of the other types are no measures.
std::vector<std::string> named_by(const SceneTable &measure)
{
  std::vector<std::string> names;
  const auto               add = [&](const SceneTable &table, const char *key)
  {
    if (table.is_text(key))
      names.push_back(table.text(key));
  };
  if (!measure.is_text("type"))
    return names;
  if (const std::string type = measure.text("type"); type == "position function")
  {
    add(measure, "from");
    add(measure, "to");
  }
  else if (type == "sum")
    for (const SceneTable &term : measure.table_array("terms"))
      add(term, "of");
  return names;
}

/// Depth first, so that what is named comes first.
class Order
{
public:
  explicit Order(const std::vector<SceneTable> &measures) : measures_(measures), done_(measures.size(), false)
  {
    for (std::size_t i = 0; i < measures.size(); ++i)
      visit(i);
  }

  const std::vector<std::size_t> &indices() const { return indices_; }

private:
  void visit(std::size_t i)
  {
    if (done_[i])
      return;
    if (const auto begin = std::find(path_.begin(), path_.end(), i); begin != path_.end())
      refuse_cycle(begin);
    path_.push_back(i);
    for (const std::string &name : named_by(measures_[i]))
      for (std::size_t j = 0; j < measures_.size(); ++j)
        if (measures_[j].name() == name)
          visit(j);
    path_.pop_back();
    done_[i] = true;
    indices_.push_back(i);
  }

  [[noreturn]] void refuse_cycle(std::vector<std::size_t>::const_iterator begin) const
  {
    std::string cycle;
    for (auto i = begin; i != path_.end(); ++i)
      cycle += "'" + measures_[*i].name() + "' -> ";
    throw measures_[*begin].error("is defined by itself: " + cycle + "'" + measures_[*begin].name() +
                                  "'; define one of these by coordinates, or by measures of type \"along\", "
                                  "\"distance\", \"angle\" or \"inclination\"");
  }

  const std::vector<SceneTable> &measures_;
  std::vector<bool>              done_;
  std::vector<std::size_t>       path_, indices_;
};

} // namespace

std::vector<std::size_t> reading_order(const std::vector<SceneTable> &measures)
{
  return Order(measures).indices();
}

} // namespace gestell::apps
