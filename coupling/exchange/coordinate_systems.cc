#include "coupling/exchange/coordinate_systems.h"

#include "coupling/exchange/bulk_cards.h"

#include <Eigen/Geometry>

#include <algorithm>

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
  {
    std::vector<long> on_the_way;
    resolve(file, number, on_the_way);
  }
  file.restart();
}

const CoordinateSystems::System *CoordinateSystems::find(long number) const
{
  const auto found = systems_.find(number);
  return found == systems_.end() ? nullptr : &found->second;
}

void CoordinateSystems::resolve(const TextFile &file, long number, std::vector<long> &on_the_way)
{
  const auto card = cards_.find(number);
  if (systems_.count(number) > 0 || card == cards_.end())
    return;
  if (std::find(on_the_way.begin(), on_the_way.end(), number) != on_the_way.end())
    file.fail_at(card->second.line, "coordinate system " + std::to_string(number) + " refers to itself");
  on_the_way.push_back(number);
  resolve(file, card->second.reference, on_the_way);
  const System *reference = find(card->second.reference);
  if (!reference)
    return; // of one that is not rectangular
  const auto basic = [&](int i)
  { return Eigen::Vector3d(reference->origin + reference->axes * card->second.points[std::size_t(i)]); };
  const Eigen::Vector3d a = basic(0), z = (basic(1) - a).normalized(), y = z.cross((basic(2) - a).normalized());
  if (!(y.norm() > on_a_line))
    file.fail_at(card->second.line, "the three points of coordinate system " + std::to_string(number) +
                                        " lie on a line, which says nothing of its axes");
  System system;
  system.origin      = a;
  system.axes.col(2) = z;
  system.axes.col(1) = y.normalized();
  system.axes.col(0) = system.axes.col(1).cross(z);
  systems_[number]   = system;
}

} // namespace gestell::coupling
