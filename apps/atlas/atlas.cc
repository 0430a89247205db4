#include "apps/atlas/atlas.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{

std::vector<AtlasEntry> failure_atlas()
{
  return {bdf3_on_a_frame(),
          bdf_of_high_order(),
          wilson_below_its_limit(),
          wilson_overshoot(),
          newmark_outside_its_limits(),
          exact_force_at_contact(),
          hard_contact(),
          order_at_play(),
          fixed_point_of_forces(),
          drift_of_joints(),
          first_multiplier_of_a_joint(),
          chatter()};
}

namespace
{

std::string row(const std::vector<std::string> &cells)
{
  std::string text = "|";
  for (const std::string &cell : cells)
    text += " " + cell + " |";
  return text + "\n";
}

std::string table(const std::vector<std::vector<std::string>> &rows)
{
  std::string text;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    text += row(rows[i]);
    if (i == 0)
      text += row(std::vector<std::string>(rows[0].size(), "---"));
  }
  return text;
}

/// One row for each method: its predictions over omega h, and the largest difference of the measured growth.
std::vector<std::vector<std::string>> rows_of(const std::vector<AtlasComparison> &comparisons)
{
  const std::string                     at = " at omega h = ";
  std::vector<std::vector<std::string>> rows{{"method", "growth per step at ω h", "measured - predicted"}};
  double                                apart = 0.;
  for (const AtlasComparison &c : comparisons)
  {
    const std::size_t cut  = std::min(c.what.find(at), c.what.size());
    const std::string name = c.what.substr(0, cut);
    const std::string point =
        (cut < c.what.size() ? c.what.substr(cut + at.size()) + ": " : "") + short_text(c.predicted, 8);
    if (rows.size() == 1 || rows.back()[0] != name)
    {
      rows.push_back({name, point, ""});
      apart = 0.;
    }
    else
      rows.back()[1] += "; " + point;
    // Differences at the level of rounding vary between computers; only a bound is printed.
    apart          = std::max(apart, std::abs(c.measured - c.predicted));
    rows.back()[2] = apart < 1e-9 ? "< 1e-9" : short_text(apart, 1);
  }
  return rows;
}

} // namespace

std::string atlas_markdown(const std::vector<AtlasEntry> &entries, const std::string &figures)
{
  std::string text =
      "# Failure atlas\n\nWhere each method fails: predicted from the roots of its step "
      "([stability.md](stability.md)), and measured with the integrators of the program. Written by\n\n    gestell "
      "stability --atlas docs/theory/failure_atlas.md\n\nand repeated by `tests/apps/cli/failure_atlas_test.cc`. A run "
      "does not fail in these ways by default: the stability check rejects steps that would grow, events are located, "
      "and Newton's method solves for the forces.\n";
  for (const AtlasEntry &entry : entries)
  {
    text += "\n## " + entry.title + "\n\n" + entry.text + "\n\n";
    for (const NamedSvg &figure : entry.figures)
      text += "![" + entry.title + "](" + figures + "/" + figure.name + ".svg)\n\n";
    if (!entry.table.empty())
    {
      text += table(entry.table);
      continue;
    }
    text += table(rows_of(entry.comparisons));
  }
  return text;
}

} // namespace gestell::apps
