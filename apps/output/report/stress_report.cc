#include "apps/output/report/stress_report.h"

#include "apps/output/interactive/machine_view.h"
#include "apps/output/text/html.h"
#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <algorithm>

namespace gestell::apps
{
namespace
{

std::string time_text(double t)
{
  return short_text(t, 6) + " s";
}

std::string table_html(const StressResult &stress, const DisplayUnit &unit)
{
  const auto value = [&](double x) { return short_text(x * unit.factor); };
  HtmlTable  table({"instant", "#time [s]", "#largest σ<sub>v</sub> [" + unit.unit + "]", "x, y, z [m]",
                    "adjacent rigid surface", "#σ<sub>1</sub> [" + unit.unit + "]", "#σ<sub>2</sub>", "#σ<sub>3</sub>",
                    "#disagreement of elements"});
  for (const StressAt &at : stress.instants)
    for (const auto *place : {&at.peak, &at.beside_rigid})
      if (*place)
      {
        const auto &[where, von_mises, principal, disagreement, nearby] = **place;
        table.add({at.label, short_text(at.t, 6), peak(value(von_mises)),
                   "(" + short_text(where[0]) + ", " + short_text(where[1]) + ", " + short_text(where[2]) + ")", nearby,
                   value(principal.values[0]), value(principal.values[1]), value(principal.values[2]),
                   short_text(100. * disagreement, 2) + " %"});
      }
  return table.html();
}

/// Meaning and limits of the stresses.
std::string statement(const StressResult &stress)
{
  std::string html = "<p>Von Mises stress at the skin of the frame: static deflection under interface forces and "
                     "weight, plus vibration in the retained modes.";
  if (stress.n_states > 0)
    html += " The maximum is the largest value at all " + std::to_string(stress.points.size()) +
            " points of the skin in " + std::to_string(stress.n_states) + " states of the run, " +
            short_text(stress.step, 3) + " s apart.";
  const auto nearby = [](const StressAt &at) { return at.beside_rigid.has_value(); };
  if (std::any_of(stress.instants.begin(), stress.instants.end(), nearby))
    html += " Rows with an adjacent rigid surface list the elements next to a support or interface: at its rim the "
            "stress grows without limit as the mesh is refined, so the value depends on the mesh.";
  const auto coarse = [](const StressAt &at) { return at.peak && at.peak->disagreement > resolved_disagreement; };
  html += " The last column is the relative disagreement of neighbouring elements.";
  if (std::any_of(stress.instants.begin(), stress.instants.end(), coarse))
    html += " <strong>Above about 10 % the mesh is too coarse for a stress value: refine it there.</strong>";
  return html + "</p>\n";
}

/// Largest value away from rigid surfaces, where the colours end.
double top_of(const StressAt &at)
{
  return at.peak ? at.peak->von_mises : at.field.von_mises.size() > 0 ? at.field.von_mises.maxCoeff() : 0.;
}

} // namespace

std::string stress_section(const Result &result, bool has_view)
{
  if (!result.stress || result.stress->instants.empty())
    return "";
  const StressResult &stress  = *result.stress;
  double              largest = 0.;
  for (const StressAt &at : stress.instants)
    largest = std::max(largest, top_of(at));
  const DisplayUnit unit = display_unit("Pa", largest);

  std::string           html          = statement(stress) + table_html(stress, unit) + "<div class=\"modes\">";
  constexpr std::size_t most_pictures = 4; // instants, a picture of the frame each
  for (std::size_t k = 0; k < std::min(stress.instants.size(), most_pictures) && has_view; ++k)
    html += machine_picture({"stress-" + std::to_string(k + 1)},
                            escape_xml(stress.instants[k].label.empty() ? "" : stress.instants[k].label + ", ") +
                                "t = " + time_text(stress.instants[k].t));
  return section("stress", "Stress in the frame", html + "</div>\n");
}

} // namespace gestell::apps
