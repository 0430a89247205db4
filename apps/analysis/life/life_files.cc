#include "apps/analysis/life/life_result.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

CsvTable life_places_csv(const LifeResult &found)
{
  CsvTable csv({"of", "x [m]", "y [m]", "z [m]", "damage", "life", "strokes", "hours", "cycles", "largest range [Pa]",
                "mean [Pa]", "disagreement", "factor mesh", "factor modes", "factor time"});
  for (const LifePlace &x : found.places)
    csv.add(x.of, x.at, x.damage, x.life, x.strokes, x.hours, x.cycles, x.range, x.mean, x.disagreement, x.error.mesh,
            x.error.modes, x.error.time);
  return csv;
}

CsvTable life_cycles_csv(const LifeResult &found)
{
  CsvTable csv({"range [Pa]", "mean [Pa]", "count", "damage", "first turning point [s]", "second turning point [s]"});
  for (const LifeCycle &x : found.cycles)
    csv.add(x.range, x.mean, x.count, x.damage, x.begin, x.end);
  return csv;
}

namespace
{

template <class Items, class Write>
std::string vtp_array(const std::string &attributes, const Items &items, const Write &write)
{
  std::string text = "<DataArray " + attributes + " format=\"ascii\">\n";
  for (const auto &item : items)
    write(text, item);
  return text + "\n</DataArray>\n";
}

template <class Point>
void vtp_three(std::string &text, const Point &x)
{
  for (const auto &one : x)
    text += exact_text(double(one)) + ' ';
}

} // namespace

std::string life_vtp(const LifeResult &found)
{
  const LifeField &field = found.field;
  constexpr double most  = 1e30; // for an infinite damage: files have numbers
  double           least = most;
  for (const double damage : field.damage)
    least = damage > 0. ? std::min(least, damage) : least;
  if (least == most)
    return "";
  const auto logarithm = [&](double sign)
  {
    return [sign, least, most](std::string &text, double damage) // no damage: a tenth of the smallest
    { text += short_text(sign * std::log10(std::clamp(damage, 0.1 * least, most)), 6) + ' '; };
  };
  std::vector<std::size_t> ends;
  for (std::size_t k = 1; k <= field.triangles.size(); ++k)
    ends.push_back(3 * k);
  const auto number = [](std::string &text, std::size_t n) { text += std::to_string(n) + ' '; };
  const auto count  = [](std::size_t n) { return '"' + std::to_string(n) + '"'; };
  return "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"0.1\" byte_order=\"LittleEndian\">\n"
         "<PolyData>\n<Piece NumberOfPoints=" +
         count(field.points.size()) + " NumberOfPolys=" + count(field.triangles.size()) +
         ">\n<PointData Scalars=\"log10 damage\">\n" +
         vtp_array("type=\"Float32\" Name=\"log10 damage\"", field.damage, logarithm(1.)) +
         vtp_array("type=\"Float32\" Name=\"log10 life\"", field.damage, logarithm(-1.)) + "</PointData>\n<Points>\n" +
         vtp_array("type=\"Float32\" NumberOfComponents=\"3\"", field.points, vtp_three<std::array<double, 3>>) +
         "</Points>\n<Polys>\n" +
         vtp_array("type=\"Int32\" Name=\"connectivity\"", field.triangles, vtp_three<std::array<int, 3>>) +
         vtp_array("type=\"Int32\" Name=\"offsets\"", ends, number) + "</Polys>\n</Piece>\n</PolyData>\n</VTKFile>\n";
}

} // namespace gestell::apps
