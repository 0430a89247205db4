#include "coupling/exchange/coordinate_systems.h"

#include "coupling/exchange/bulk_cards.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <set>

namespace gestell::coupling
{

namespace
{

constexpr double on_a_line = 1e-10; ///< sine of the angle at A

} // namespace

CoordinateSystems::CoordinateSystems(TextFile &file)
{
  constexpr std::size_t first_point = 2, last_field = 10;
  systems_[0] = {};
  file.restart();
  BulkCards cards(file, {"CORD2R"});
  while (cards.next())
  {
    auto field = cards.fields();
    field.resize(std::max(field.size(), last_field + 1));
    Card card;
    card.line      = cards.line();
    card.reference = field[1].empty() ? 0 : file.whole(field[1], "the number of a coordinate system");
    for (std::size_t i = 0; i < 9; ++i)
      card.points[i / 3][Eigen::Index(i % 3)] =
          field[first_point + i].empty() ? 0. : file.real(field[first_point + i], "a coordinate");
    cards_[file.whole(field[0], "the number of a coordinate system")] = card;
  }
  for (const auto &[number, card] : cards_)
    resolve(file, number);
  file.restart();
}

const CoordinateSystems::System *CoordinateSystems::find(long number) const
{
  const auto found = systems_.find(number);
  return found == systems_.end() ? nullptr : &found->second;
}

/// Without recursion, as a file may have chains of any length.
void CoordinateSystems::resolve(const TextFile &file, long number)
{
  std::vector<long> chain;
  std::set<long>    in_chain;
  for (auto card = cards_.find(number);
       systems_.count(number) == 0 && card != cards_.end() && without_place_.count(number) == 0;
       card = cards_.find(number))
  {
    if (!in_chain.insert(number).second)
      file.fail_at(card->second.line, "coordinate system " + std::to_string(number) + " refers to itself");
    chain.push_back(number);
    number = card->second.reference;
  }
  for (; !chain.empty(); chain.pop_back())
  {
    const Card &card = cards_.at(chain.back());
    if (const System *reference = find(card.reference))
      add(file, chain.back(), card, *reference);
    else // of one that is not rectangular, or missing
      without_place_.insert(chain.back());
  }
}

void CoordinateSystems::add(const TextFile &file, long number, const Card &card, const System &reference)
{
  const auto basic = [&](int i)
  { return Eigen::Vector3d(reference.origin + reference.axes * card.points[std::size_t(i)]); };
  const Eigen::Vector3d a = basic(0), z = (basic(1) - a).normalized(), y = z.cross((basic(2) - a).normalized());
  if (!a.allFinite() || !z.allFinite() || !y.allFinite())
    file.fail_at(card.line, "the points of coordinate system " + std::to_string(number) +
                                " lie so far out that their distances are no numbers; check its columns");
  if (!(y.norm() > on_a_line))
    file.fail_at(card.line, "the three points of coordinate system " + std::to_string(number) +
                                " lie on a line, which says nothing of its axes");
  System system;
  system.origin      = a;
  system.axes.col(2) = z;
  system.axes.col(1) = y.normalized();
  system.axes.col(0) = system.axes.col(1).cross(z);
  systems_[number]   = system;
}

} // namespace gestell::coupling
