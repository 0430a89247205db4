#include "apps/study/report/surface_sections.h"

#include "apps/output/text/html.h"
#include "apps/study/report/contour_picture.h"
#include "apps/study/report/effect_picture.h"
#include "apps/study/report/shown_axis.h"
#include "apps/study/report/study_charts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_outputs = 12; ///< with pictures: a screen or two each

std::string number_or_dash(double x, int digits = 4)
{
  return std::isnan(x) ? "–" : std::isinf(x) ? "∞" : short_text(x, digits);
}

/// A picture on the page and as a file of its own.
std::string drawn(const std::string &name, const std::string &svg, Pictures &pictures)
{
  pictures.emplace_back(name, svg);
  return figure(svg);
}

std::string unchanged_note(const ResponseSurface &surface)
{
  return "<p>" + escape_xml(surface.output.name) + " does not change over the runs.</p>\n";
}

std::size_t n_pictured(const StudyFindings &findings)
{
  return std::min(findings.surfaces.size(), most_outputs);
}

std::string left_out_note(const StudyFindings &findings)
{
  return findings.surfaces.size() > most_outputs
             ? "<p class=\"soft\">Pictures of the first " + std::to_string(most_outputs) +
                   " outputs; the others are in surface.csv.</p>\n"
             : "";
}

/// Shares below it are rounding.
std::string share_text(double share)
{
  return share < 1e-12 ? "0 %" : percent(share);
}

std::string shares_table(const StudyFindings &findings)
{
  std::vector<std::string> titles = {"effect", "kind"};
  for (const ResponseSurface &surface : findings.surfaces)
    titles.push_back("#" + escape_xml(surface.output.name));
  HtmlTable                        table(titles);
  std::vector<std::vector<Effect>> effects;
  for (const ResponseSurface &surface : findings.surfaces)
    effects.push_back(effects_of(surface));
  for (std::size_t i = 0; i < effects.front().size(); ++i)
  {
    std::vector<HtmlTable::Cell> row = {effects.front()[i].name, kind_word(effects.front()[i].kind)};
    for (const auto &of_output : effects)
      row.push_back(peak(share_text(of_output[i].share), of_output[i].share >= 0.1));
    table.add(row);
  }
  return "<h3>Shares of the variance over the ranges</h3>" + table.scrolled_html();
}

std::string quality_table(const StudyFindings &findings)
{
  HtmlTable table({"output", "#runs", "#coefficients", "#R²", "#adjusted R²", "#predicted R²", "#standard error",
                   "#lack of fit, F", "#p"});
  for (const ResponseSurface &surface : findings.surfaces)
  {
    if (!surface.changes())
    {
      table.add_note(surface.output.name + " does not change over the runs");
      continue;
    }
    const FitQuality &q       = surface.quality;
    const ShownAxis   axis    = shown_axis(surface.output, q.standard_error);
    constexpr double  poor_r2 = 0.9; // of what is predicted: with less, a third of the deviation is left
    table.add({surface.output.name, std::to_string(q.n_runs), std::to_string(q.n_coefficients), number_or_dash(q.r2, 5),
               number_or_dash(q.adjusted_r2, 5), peak(number_or_dash(q.predicted_r2, 5), q.predicted_r2 < poor_r2),
               std::isnan(q.standard_error) ? "–" : axis.text_with_unit(q.standard_error),
               number_or_dash(q.lack_of_fit_F), number_or_dash(q.lack_of_fit_p_value, 2)});
  }
  return table.html();
}

std::string quality_words(const StudyFindings &findings)
{
  const bool repeats = findings.surfaces.front().quality.pure_error_dof > 0;
  return std::string(
             "<p class=\"soft\">Predicted R²: each run is predicted by the surface fitted to all other runs. ") +
         (repeats ? "Lack of fit compares the residual of the surface with the scatter of repeated runs. Repeated "
                    "simulations are identical (F = ∞), so the whole residual is lack of fit."
                  : "Without repeated runs there is no pure error for a test of the lack of fit.") +
         "</p>\n";
}

/// Pairs of variables that make a part of the variance, the larger first.
std::vector<std::pair<int, int>> pairs_by_weight(const ResponseSurface &surface)
{
  const int           k = static_cast<int>(surface.variables.size());
  std::vector<double> weight(static_cast<std::size_t>(k) * k, 0.), own(k, 0.);
  for (const Effect &effect : effects_of(surface))
    if (effect.kind == EffectKind::interaction)
      weight[effect.term.first * k + effect.term.second] += effect.share;
    else
      own[effect.term.first] += effect.share;
  std::vector<std::pair<int, int>> pairs;
  for (int i = 0; i < k; ++i)
    for (int j = i + 1; j < k; ++j)
    {
      weight[i * k + j] += own[i] + own[j];
      pairs.emplace_back(i, j);
    }
  constexpr double least_weight = 1e-3; // of the variance, for a picture: 3 % of the deviation
  const auto       slight       = [&](const auto &pair) { return weight[pair.first * k + pair.second] < least_weight; };
  pairs.erase(std::remove_if(pairs.begin(), pairs.end(), slight), pairs.end());
  std::stable_sort(pairs.begin(), pairs.end(),
                   [&](const auto &a, const auto &b)
                   { return weight[a.first * k + a.second] > weight[b.first * k + b.second]; });
  constexpr std::size_t most_contours = 6; // of an output: two rows
  pairs.resize(std::min(pairs.size(), most_contours));
  return pairs;
}

const Eigen::VectorXd *optimum_point(const StudyFindings &findings)
{
  return findings.optimum ? &findings.optimum->found.coded : nullptr;
}

std::string contours(const StudyFindings &findings, const ResponseSurface &surface, Pictures &pictures)
{
  const Eigen::VectorXd *optimum = optimum_point(findings);
  const auto             k       = static_cast<Eigen::Index>(surface.variables.size());
  const Eigen::MatrixXd  runs    = findings.table.coded()(surface.runs, Eigen::all);
  const Eigen::VectorXd  at      = optimum ? *optimum : Eigen::VectorXd::Zero(k);
  const auto             pairs   = pairs_by_weight(surface);
  std::string            first, others;
  for (std::size_t n = 0; n < pairs.size(); ++n)
  {
    const auto [i, j]     = pairs[n];
    const std::string svg = contour_picture(surface, findings.table.variables, runs, {i, j, at, optimum != nullptr});
    (n < 3 ? first : others) += drawn(
        "contour_" + surface.output.name + "_" + surface.variables[i] + "_" + surface.variables[j], svg, pictures);
  }
  if (first.empty())
    return "";
  return std::string("<p>Contours over two variables, with the others ") +
         (optimum ? "at the optimum" : "at the midpoints of their ranges") + "; rings: runs" +
         (optimum ? "; diamond: optimum" : "") + ".</p>\n<div class=\"modes\">" + first + "</div>\n" +
         (others.empty() ? "" : folded("other pairs", "<div class=\"modes\">" + others + "</div>\n"));
}

std::string coefficients_table(const ResponseSurface &surface)
{
  const ShownAxis axis = shown_axis(surface.output, surface.coefficients.cwiseAbs().maxCoeff());
  HtmlTable       table(
            {"term", "#coefficient [" + escape_xml(axis.unit.empty() ? "1" : axis.unit) + "]", "#interval, ±", "#t"});
  for (int j = 0; j < surface.coefficients.size(); ++j)
  {
    const double b = surface.coefficients(j), half = surface.confidence(j);
    table.add({surface.term_name(j), peak(axis.text(b, 6), std::abs(b) > half),
               std::isnan(half) ? "–" : axis.text(half, 3), number_or_dash(b / surface.standard_errors(j), 3)});
  }
  return table.scrolled_html() +
         "<p class=\"soft\">Coefficients of coded variables (-1 at from, +1 at to); bold: zero is outside the "
         "confidence interval of " +
         percent(surface.level) + ".</p>\n";
}

std::string residuals_table(const ResponseSurface &surface, const std::vector<int> &run_numbers)
{
  const ShownAxis  axis          = shown_axis(surface.output, magnitude_of(surface.computed));
  const double     mean          = static_cast<double>(surface.quality.n_coefficients) / surface.quality.n_runs;
  constexpr double high_leverage = 2.;   // times the mean p / n, as usual
  constexpr double nearly_one    = 0.95; // leverage beyond which a run stands alone
  const double     high          = std::min(high_leverage * mean, nearly_one);
  HtmlTable        table({"#run", "#computed [" + escape_xml(axis.unit.empty() ? "1" : axis.unit) + "]", "#surface",
                          "#residual", "#surface of the other runs", "#leverage"});
  constexpr int    most_residuals = 300; // rows that a reader scrolls through; runs.csv has all
  for (Eigen::Index run = 0; run < std::min<Eigen::Index>(surface.computed.size(), most_residuals); ++run)
    table.add({std::to_string(run_numbers[static_cast<std::size_t>(run)] + 1), axis.text(surface.computed(run), 6),
               axis.text(surface.fitted(run), 6), axis.text(surface.computed(run) - surface.fitted(run), 3),
               std::isnan(surface.left_out(run)) ? "–" : axis.text(surface.left_out(run), 6),
               peak(short_text(surface.leverage(run), 3), surface.leverage(run) > high)});
  if (surface.computed.size() > most_residuals)
    table.add_note("and more runs");
  return table.scrolled_html() + "<p class=\"soft\">Leverages are " + short_text(mean, 3) +
         " on average; a run above " + short_text(high, 3) + " (bold) dominates the surface near it.</p>\n";
}

std::string of_output(const StudyFindings &findings, const ResponseSurface &surface, Pictures &pictures)
{
  if (!surface.changes())
    return unchanged_note(surface);
  const std::vector<int> &runs = surface.runs;
  const std::string      &name = surface.output.name;
  return "<h3>" + escape_xml(name) + "</h3>\n" + contours(findings, surface, pictures) +
         drawn("slices_" + name, slices_chart(surface, findings.table.variables, optimum_point(findings)), pictures) +
         drawn("foretold_" + name, predicted_chart(surface, runs), pictures) +
         folded("Coefficients", coefficients_table(surface)) + folded("Run by run", residuals_table(surface, runs));
}

/// What the run in the middle of all ranges computed; nan: none was made.
double middle_of(const StudyFindings &findings, const ResponseSurface &surface)
{
  const Eigen::MatrixXd coded = findings.table.coded();
  for (std::size_t i = 0; i < surface.runs.size(); ++i)
    if (coded.row(surface.runs[i]).cwiseAbs().maxCoeff() < same_level)
      return surface.computed[Eigen::Index(i)];
  if (findings.optimum && findings.optimum->nominal)
    for (std::size_t i = 0; i < findings.table.outputs.size(); ++i)
      if (findings.table.outputs[i].name == surface.output.name)
        return (*findings.optimum->nominal)[Eigen::Index(i)];
  return std::numeric_limits<double>::quiet_NaN();
}

} // namespace

std::string effects_section(const StudyFindings &findings, Pictures &pictures)
{
  if (findings.surfaces.empty())
    return "";
  std::vector<std::string> drawn_effects;
  for (std::size_t i = 0; i < n_pictured(findings); ++i)
    drawn_effects.push_back(findings.surfaces[i].changes()
                                ? drawn("effects_" + findings.surfaces[i].output.name,
                                        effect_picture(findings.surfaces[i], middle_of(findings, findings.surfaces[i])),
                                        pictures)
                                : unchanged_note(findings.surfaces[i]));
  return section(
      "effects", "Effects",
      "<p>Effects from the surfaces: each variable varies over its range, with the others at their midpoints. The "
      "title gives the value of the surface at the midpoint and, if available, that of the run.</p>\n" +
          first_figures(drawn_effects) + left_out_note(findings) + shares_table(findings));
}

std::string surfaces_section(const StudyFindings &findings, Pictures &pictures)
{
  if (findings.surfaces.empty())
    return "";
  std::string html = quality_table(findings) + quality_words(findings);
  for (std::size_t i = 0; i < n_pictured(findings); ++i)
    html += of_output(findings, findings.surfaces[i], pictures);
  const SurfaceOrder order = findings.surfaces.front().order;
  const std::string  kind  = order == SurfaceOrder::interactions ? "linear with interactions" : order_word(order);
  return section("surfaces", "Response surfaces, " + kind, html + left_out_note(findings), Shown::folded);
}

} // namespace gestell::apps
