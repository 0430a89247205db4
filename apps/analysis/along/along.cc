#include "apps/analysis/along/along_section.h"
#include "apps/analysis/along/modes_along.h"
#include "apps/analysis/analysis_entry.h"
#include "apps/output/text/csv.h"

#include <chrono>
#include <cmath>

namespace gestell::apps
{

template <class Visitor>
void describe_answer(Visitor &v, const AlongResult &x)
{
  v.maybe(true, "modes_along", x, "", "`modes --along`");
}

std::string subject_of(const AlongResult &x)
{
  return "Natural frequencies along " + x.modes.coordinate.name;
}

namespace
{

using coupling::ModesAt;

std::string position_head(const coupling::ModesAlong &along)
{
  return along.coordinate.name + " [" + along.coordinate.unit + "]";
}

/// One row per position and line, full precision, SI.
CsvTable along_frequencies(const AlongResult &along)
{
  CsvTable csv({position_head(along.modes), "line", "frequency [Hz]", "damped frequency [Hz]", "damping ratio", "mac",
                "configuration", "growth [1/s]"});
  for (const ModesAt &at : along.modes.positions)
    for (std::size_t i = 0; i < at.modes.size(); ++i)
    {
      const coupling::Mode &mode = at.modes[i];
      csv.add(at.x, i + 1, mode.frequency_hz, mode.damped_frequency_hz, mode.damping_ratio,
              i < at.assurance.size() ? at.assurance[i] : std::nan(""),
              at.configuration == coupling::Configuration::equilibrium ? "equilibrium" : "undeformed", mode.growth);
    }
  return csv;
}

/// The shapes to these rows, mass normalised, one column per coordinate of the machine.
std::string along_shapes(const Result &result)
{
  const auto *along = answer_in<AlongResult>(result.answers);
  if (!along)
    return "";
  std::vector<std::string> heads{position_head(along->modes), "line"};
  heads.insert(heads.end(), result.coordinate_names.begin(), result.coordinate_names.end());
  CsvTable csv(heads);
  for (const ModesAt &at : along->modes.positions)
    for (std::size_t i = 0; i < at.modes.size(); ++i)
      csv.add(at.x, i + 1, at.modes[i].shape);
  return csv;
}

class ModesAlongCoordinate : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    return {
        {"--along", &own_.along, "follow the modes along a coordinate: a body, a measure or a driven joint"},
        CommandOption{"--from", &own_.from, "first position, such as \"100 deg\" or \"2.4 m\" (default 0 for angles)"}
            .with("--along"),
        CommandOption{"--to", &own_.to, "last position (default: one revolution after the first)"}.with("--along"),
        CommandOption{"--positions", &own_.positions,
                      "number of positions, including both ends (default 73: every 5 deg of a revolution)"}
            .at_most(1e5)
            .with("--along"),
        CommandOption{
            "--configuration", &own_.configuration,
            "configuration that is linearised: equilibrium (default) under weights and springs, or undeformed"}
            .one_of({"equilibrium", "undeformed"})
            .with("--along"),
        CommandOption{"--hold", &own_.hold, "coordinates that are fixed, such as a locked drive"}.with("--along"),
        CommandOption{"--speed", &own_.speed,
                      "speed that defines the orders, such as \"30 1/min\" (default: initial speed)"}
            .with("--along"),
        CommandOption{"--orders", &own_.orders, "highest order (default 10)"}.above_zero().at_most(1e4).with("--along"),
        CommandOption{"--band", &own_.band, "relative distance within which an order is listed (default \"5 %\")"}.with(
            "--along")};
  }
  bool            requested(const Scene &) const override { return !own_.along.empty(); }
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    ModesOptions own  = own_;
    own.geometric     = result.requested.geometric;
    const auto  begin = std::chrono::steady_clock::now();
    AlongResult found = modes_along_result(session.scene(), session.machine(), own, session.progress());
    result.wall_s.emplace_back("modes along " + found.modes.coordinate.name,
                               std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count());
    for (std::string &warning : along_warnings(found))
      result.warnings.push_back(std::move(warning));
    result.answers.push_back(as_answer(std::move(found)));
    return AnalysisOutcome::done;
  }

private:
  ModesOptions own_;
};

} // namespace

AnalysisEntry along_analysis()
{
  return analysis_entry<ModesAlongCoordinate, AlongResult>(
      "along", "", {},
      {{"modes_along.csv", "frequencies and damping at each position, with `modes --along`",
        content_of<AlongResult, along_frequencies>},
       {"modes_along_shapes.csv", "shapes of these modes", along_shapes}},
      "modes");
}

} // namespace gestell::apps
