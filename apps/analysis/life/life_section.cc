#include "apps/analysis/life/life_charts.h"
#include "apps/analysis/life/life_result.h"
#include "apps/output/describe/described_table.h"
#include "apps/output/values/result.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr double mega = 1e6;

std::string position_words(const LifePlace &x)
{
  return "(" + short_text(x.at[0]) + " " + short_text(x.at[1]) + " " + short_text(x.at[2]) + ")";
}

/// A life, or one until the end of time: three digits, of which single precision of stresses leaves more and S-N curves
/// fewer; without an exponent up to a million millions, with groups from ten thousand on.
std::string life_words(double life)
{
  constexpr int    digits = 3;
  constexpr double most   = 1e12;
  if (!(life >= 1e3 && life < most))
    return std::isfinite(life) ? short_text(life, digits) : "no end";
  const double step = std::pow(10., std::floor(std::log10(life)) + 1. - digits);
  std::string  text = std::to_string(std::llround(life / step) * std::llround(step));
  for (std::size_t left = text.size(); text.size() > 4 && left > 3;)
    text.insert(left -= 3, 1, ' ');
  return text;
}

/// The worst place in a sentence.
std::string worst_words(const LifeResult &found)
{
  const LifePlace &worst = *found.worst();
  if (worst.cycles == 0.)
    return "No cycle, so no damage: the stress is constant, " + short_text(worst.mean / mega) + " MPa at " +
           position_words(worst) + ".";
  if (!(worst.damage > 0.))
    return "No damage: the largest range, " + short_text(worst.range / mega) + " MPa at " + position_words(worst) +
           (worst.utilisation > 0. ? ", is " + percent(worst.utilisation, 3) + " of the cut-off limit of the S-N curve."
                                   : ".");
  return "Damage " + short_text(worst.damage, 3) + " in one repetition of the load at " + position_words(worst) +
         " of " + worst.of + ": " + life_words(worst.life) + " repetitions, " + life_words(worst.strokes) +
         " strokes or " + life_words(worst.hours) + " h until failure.";
}

std::string factor_words(double factor)
{
  return std::isfinite(factor) ? short_text(factor, 3) : "unbounded";
}

std::string error_words(const LifeResult &found)
{
  const LifeError  &error = found.worst()->error;
  const std::string words =
      "Error as a factor on life: " + factor_words(error.total()) + " (mesh " + factor_words(error.mesh);
  return found.refined
             ? words + ", modes " + factor_words(error.modes.value_or(1.)) + ", time " + factor_words(error.time) + ")."
             : words + ", sampling " + factor_words(error.time) +
                   "); --life-error adds those of modes and integration.";
}

std::string rule_words(const LifeResult &found)
{
  return "Curve " + found.rule.curve.name + "; " + found.asked.measure + ", mean stress: " + found.asked.mean_stress +
         ", Palmgren-Miner: " + found.asked.miner + ", residue: " + found.asked.residue + ". " +
         std::to_string(found.n_states) + " states, " + short_text(found.step, 3) + " s apart, at " +
         std::to_string(found.n_points) + " points; cycles were counted at " + std::to_string(found.looked_at) +
         ", the others are excluded by bounds.";
}

std::string rounded_percent(double share)
{
  constexpr double tenths = 1e3; // of a percent: what remains is rounding or of no effect on a life
  return short_text(std::round(tenths * share) / 10.) + " %";
}

std::string steadiness_words(const LifeResult &found)
{
  if (std::isfinite(found.stroke_change))
    return "The damage of the last two windows differs by " + rounded_percent(found.stroke_change) + ".";
  if (std::isfinite(found.closing))
    return "The stress at the end differs from that at the start by " + rounded_percent(found.closing) +
           " of its range.";
  return "";
}

HtmlTable places_table(const LifeResult &found)
{
  HtmlTable  table({"place", "at x, y, z [m]", "#damage", "#strokes", "#hours", "#largest range [MPa]", "#mean [MPa]",
                    "#cycles", "#elements disagree", "#factor of mesh"});
  const auto add = [&](const LifePlace &x)
  {
    table.add({x.nearby.empty() ? x.of : (x.of == skin_name ? "" : x.of + " ") + "beside " + x.nearby, position_words(x),
               peak(short_text(x.damage, 3), &x == found.worst()), life_words(x.strokes), life_words(x.hours),
               short_text(x.range / mega), short_text(x.mean / mega), short_text(x.cycles), percent(x.disagreement, 2),
               factor_words(x.error.mesh)});
  };
  for (const LifePlace &x : found.places)
    add(x);
  if (found.beside_rigid)
    add(*found.beside_rigid);
  return table;
}

HtmlTable shares_table(const LifePlace &worst)
{
  HtmlTable table({"part of the damaging ranges", "#share"});
  for (const auto &[name, share] : worst.shares)
    table.add({name, percent(share, 3)});
  return table;
}

/// The cycles of the largest damage; all of them are in life_cycles.csv.
HtmlTable cycles_table(const LifeResult &found)
{
  HtmlTable             table({"#range [MPa]", "#mean [MPa]", "#count", "#damage", "#from [s]", "#to [s]"});
  constexpr std::size_t shown = 10;
  for (std::size_t k = 0; k < std::min(shown, found.cycles.size()); ++k)
  {
    const LifeCycle &x = found.cycles[k];
    table.add({short_text(x.range / mega), short_text(x.mean / mega), short_text(x.count), short_text(x.damage, 3),
               short_text(x.begin, 6), short_text(x.end, 6)});
  }
  return table;
}

} // namespace

Headline headline_of(const LifeResult &found)
{
  const LifePlace *worst = found.worst();
  if (!worst)
    return {};
  return {worst_words(found),
          {{life_words(worst->strokes), "strokes until failure"},
           {factor_words(worst->error.total()),
            found.refined ? "factor on life, error" : "factor on life, error of mesh and sampling"},
           {short_text(worst->range / mega) + " MPa", "largest range at the worst place"}}};
}

std::vector<Section> sections_of(const Result &, const LifeResult &found)
{
  Section section{"life", "Life of the frame", "Life", Section::Place::results};
  if (!found.worst())
    return {};
  const LifePlace &worst = *found.worst();
  section.parts.push_back(Section::Sentences{worst_words(found)});
  if (worst.damage > 0.)
    section.parts.push_back(Section::Sentences{error_words(found)});
  if (const std::string text = steadiness_words(found); !text.empty())
    section.parts.push_back(Section::Sentences{text});
  section.parts.push_back(places_table(found));
  if (!found.derivatives.empty())
    section.parts.push_back(table_of(found.derivatives).shown());

  section.parts.push_back(Section::Drawing{"life-history", life_history_chart(found), ChartLink::time});
  section.parts.push_back(Section::Picture{"life-matrix", range_mean_picture(found)});
  section.parts.push_back(Section::Drawing{"life-haigh", haigh_chart(found)});
  if (!worst.shares.empty())
    section.parts.push_back(shares_table(worst));
  section.parts.push_back(Section::PageTable{cycles_table(found)});
  section.parts.push_back(Section::Sentences{rule_words(found), false, true});
  return {section};
}

} // namespace gestell::apps
