#include "apps/output/tables/size_table.h"

#include "fem/values/number_text.h"

#include <cmath>
#include <iomanip>
#include <sstream>

namespace gestell::apps
{

namespace
{

std::optional<int> known_modes(const SizeRung &rung)
{
  return rung.modes >= 0 ? std::optional(rung.modes) : std::nullopt;
}

} // namespace

CsvTable size_csv(const SizeResult &size)
{
  std::vector<std::string> heads{"rung",   "mesh size [m]", "coordinates", "interface", "modes",
                                 "method", "step [s]",      "tolerance",   "cpu_s"};
  for (const BudgetEntry &entry : size.ladder.front().entries)
    for (const char *what : {"value", "mesh", "reduction", "time", "total"})
      heads.push_back(entry.output + ' ' + what + " [" + entry.unit + ']');
  CsvTable csv(heads);
  int      number = 0;
  for (const SizeRung &rung : size.ladder)
  {
    std::vector<std::optional<double>> errors;
    for (const BudgetEntry &entry : rung.entries)
      errors.insert(errors.end(),
                    {entry.value, entry.mesh.error, entry.reduction.error, entry.time.error, entry.total});
    csv.add(++number, unless_zero(rung.mesh_size), rung.coordinates, rung.interface, known_modes(rung), rung.method,
            rung.step, rung.tolerance, rung.cpu_s, errors);
  }
  return csv;
}

CsvTable size_all_csv(const SizeResult &size)
{
  if (size.all.empty())
    return {};
  CsvTable csv({"mesh size [m]", "coordinates", "interface", "modes", "method", "step [s]", "tolerance", "cpu_s",
                "share", "worst"});
  for (const SizeRung &rung : size.all)
    csv.add(unless_zero(rung.mesh_size), rung.coordinates, rung.interface, known_modes(rung), rung.method, rung.step,
            rung.tolerance, rung.cpu_s, rung.share, rung.worst);
  return csv;
}

std::string rung_text(const SizeRung &rung)
{
  std::ostringstream text;
  const std::string  cells = rung.cells.empty() || rung.cells == "straight" ? "" : rung.cells + " ";
  text << std::setw(13) << (rung.mesh_size > 0. ? cells + short_text(rung.mesh_size, 3) : "-") << std::setw(13)
       << (rung.coordinates > 0 ? std::to_string(rung.coordinates) : "-") << std::setw(7)
       << (rung.modes >= 0 ? std::to_string(rung.modes) : "-") << "  " << std::left << std::setw(20)
       << (rung.method +
           (rung.tolerance > 0. ? " " + short_text(rung.tolerance, 2) : " " + short_text(rung.step, 3) + " s"))
       << std::right << std::setw(9) << short_text(rung.cpu_s, 2) << std::setw(12)
       << (std::isfinite(rung.share) ? short_text(rung.share, 2) : "unknown") << "  " << rung.worst;
  return text.str();
}

std::string forecast_text(const SizeForecast &forecast)
{
  std::ostringstream text;
  text << "forecast:";
  if (forecast.coordinates > 0.)
    text << " a model with " << short_text(forecast.coordinates, 2) << " DOFs,";
  text << ' ' << short_text(forecast.model_cpu_s, 2) << " CPU s from CAD to the end of its run; "
       << short_text(forecast.cpu_s, 2) << " CPU s including its error estimates, of which "
       << short_text(forecast.spent_cpu_s, 2) << " CPU s are used so far";
  return text.str();
}

const SizeRung *cheapest_of(const SizeResult &size)
{
  const SizeRung *cheapest = nullptr;
  for (const SizeRung &rung : size.all)
    if (rung.share <= 1. && (!cheapest || rung.cpu_s < cheapest->cpu_s))
      cheapest = &rung;
  return cheapest;
}

std::string size_text(const SizeResult &size)
{
  std::ostringstream text;
  text << "chosen: model " << size.chosen + 1 << " of " << size.ladder.size() << ", every output "
       << (size.met ? "within " : "NOT within ") << short_text(100. * size.tolerance, 3) << " %"
       << (size.met ? "" : ": " + size.stopped) << '\n';
  if (const SizeRung &rung = size.ladder[size.chosen]; rung.cells != size.ladder.front().cells)
    text << (rung.cells == "swept"    ? "plates are meshed by sweeping: frame.mesh.plates = \"swept\"\n"
             : rung.cells == "curved" ? "element edges follow the geometry: frame.mesh.curved = true\n"
                                      : "");
  if (!size.proof.empty())
    text << "verification: compared with " << size.finer << '\n';
  else if (!size.finer.empty())
    text << "no verification: " << size.finer << '\n';
  for (const SizeProof &proof : size.proof)
    text << "  " << proof.output << ' ' << short_text(proof.value, 6) << ", finer " << short_text(proof.finer, 6) << ' '
         << proof.unit << '\n';
  if (!size.all.empty())
  {
    text << "all " << size.all.size() << " models examined: ";
    if (const SizeRung *cheapest = cheapest_of(size))
    {
      const double chosen = size.all[size.chosen_of_all].cpu_s;
      text << "the cheapest model within the tolerance, compared with the finer model, takes "
           << short_text(cheapest->cpu_s, 3) << " CPU s, the chosen one " << short_text(chosen, 3) << " CPU s ("
           << short_text(chosen / cheapest->cpu_s, 3) << " times as much); see size_all.csv\n";
    }
    else
      text << "no model is within the tolerance, compared with the finer model; see size_all.csv\n";
  }
  for (const std::string &what : size.skipped)
    text << "not computed: " << what << '\n';
  for (const std::string &what : size.left_out)
    text << "can be omitted: " << what << '\n';
  for (const std::string &what : size.missing)
    text << "possibly missing: " << what << '\n';
  if (!size.unasked.empty())
  {
    text << "not examined, because the cost would exceed ten runs of the chosen model (use --exhaustive): ";
    for (std::size_t i = 0; i < size.unasked.size(); ++i)
      text << (i > 0 ? ", " : "") << size.unasked[i];
    text << '\n';
  }
  text << "cost: " << short_text(size.cpu_s, 3) << " CPU s, equal to " << short_text(size.runs(), 2)
       << " runs of the chosen model including preparation\n";
  return text.str();
}

} // namespace gestell::apps
