#include "apps/analysis/analysis_entry.h"
#include "apps/analysis/frf/response_search.h"
#include "apps/analysis/frf/state_space_answer.h"
#include "apps/output/exchange/mat_file.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/values/state_space_model.h"
#include "coupling/frame/atomic_file.h"
#include "coupling/frame/matrix_market.h"
#include "fem/values/nearest_name.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace gestell::apps
{

std::string subject_of(const FrequencyResponse &)
{
  return "Frequency responses";
}

std::vector<NamedArray> arrays_of(const FrequencyResponse &found)
{
  std::vector<NamedArray> arrays{
      {{"frequencies_hz"}, {found.frequencies_hz.begin(), found.frequencies_hz.end()}, true}};
  for (const ResponsePair &pair : found.pairs)
    arrays.push_back({{pair.from, pair.to}, pair.values});
  return arrays;
}

namespace
{

using NamedMatrices = std::vector<std::pair<std::string, const Eigen::MatrixXd *>>;

NamedMatrices matrices_of(const coupling::StateSpace &system)
{
  return {{"A", &system.A}, {"B", &system.B}, {"C", &system.C}, {"D", &system.D}, {"Z", &system.Z}};
}

std::vector<std::pair<std::string, const std::vector<std::string> *>> names_of(const StateSpaceModel &model)
{
  return {{"states", &model.states},
          {"inputs", &model.inputs},
          {"outputs", &model.outputs},
          {"coordinates", &model.coordinates}};
}

std::vector<std::string> write_matrix_market(OwnFolder &folder, const StateSpaceModel &model)
{
  std::vector<std::string> files;
  for (const auto &[name, matrix] : matrices_of(model.system))
  {
    files.push_back("state_space_" + name + ".mtx");
    coupling::write_matrix_market(folder.claim(files.back()).string(), *matrix,
                                  model.scene + " linearised at " + model.at + ", x' = A x + B u, y = C x + D u");
  }
  files.push_back("state_space.csv");
  coupling::AtomicFile table(folder.claim(files.back()).string());
  table.stream() << "kind, number, name\n";
  for (const auto &[kind, names] : names_of(model))
    for (std::size_t i = 0; i < names->size(); ++i)
      table.stream() << kind << ", " << i + 1 << ", \"" << (*names)[i] << "\"\n";
  table.finish();
  return files;
}

std::vector<std::string> write_mat(OwnFolder &folder, const StateSpaceModel &model)
{
  const std::string name = "state_space.mat";
  MatFile           file(folder.claim(name), "Gestell: " + model.scene + " linearised at " + model.at);
  for (const auto &[matrix_name, matrix] : matrices_of(model.system))
    file.add(matrix_name, *matrix);
  for (const auto &[kind, names] : names_of(model))
    file.add(kind, *names);
  file.finish();
  return {name};
}

/// "mat" (version 5; not in builds without libmatio), "matrix-market".
const std::vector<std::string> &exchange_formats()
{
  static const std::vector<std::string> formats = MatFile::available()
                                                      ? std::vector<std::string>{"mat", "matrix-market"}
                                                      : std::vector<std::string>{"matrix-market"};
  return formats;
}

/// Names of the files of a format, '*' for any letters.
std::vector<std::string> state_space_files(const std::string &format)
{
  return format == "mat" ? std::vector<std::string>{"state_space.mat"}
                         : std::vector<std::string>{"state_space_*.mtx", "state_space.csv"};
}

/**
 * Writes a linear machine into a folder: state_space.mat with A, B, C, D, Z and names, or
 * state_space_A.mtx ... with state_space.csv, which names states, inputs and outputs.
 *
 * @return names of the files
 * @throws std::invalid_argument for another format, coupling::WriteFailure if a file cannot be written
 */
std::vector<std::string> write_state_space(OwnFolder &folder, const StateSpaceModel &model, const std::string &format)
{
  const auto &known = exchange_formats();
  if (std::find(known.begin(), known.end(), format) == known.end())
    throw std::invalid_argument("--export: there is no format '" + format + "'" + suggestion(format, known));
  return format == "mat" ? write_mat(folder, model) : write_matrix_market(folder, model);
}

class Frf : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    return {
        {"--from", &own_.from, "unit forces, by their displacements or angles, such as frame.crown.uz, slide, tip.ux"},
        {"--to", &own_.to, "responses: signals of the scene or paths, such as frame.table.uz, rod.force"},
        CommandOption{"--kind", &own_.kind,
                      "kind of response for displacements: receptance (default), mobility or accelerance"}
            .one_of({"receptance", "mobility", "accelerance"}),
        CommandOption{
            "--at", &own_.at,
            "operating point: start of the run (default), or equilibrium or undeformed configuration of [modes]"}
            .one_of({"start", "equilibrium", "undeformed"}),
        {"--lowest", &own_.lowest, "lowest frequency, such as \"1 Hz\" (default: a quarter of the lowest mode)"},
        {"--highest", &own_.highest, "highest frequency (default: 1.5 times the highest listed mode)"},
        CommandOption{"--points", &own_.points, "number of frequencies, in addition to those at peaks (default 400)"}
            .above_zero()
            .at_most(1e6),
        CommandOption{"--spacing", &own_.spacing, "spacing of the frequencies: log (default) or linear"}.one_of(
            {"log", "linear"}),
        {"--measured", &own_.measured, "measured curves: FILE.csv, FILE.uff, or PAIR=FILE"},
        CommandOption{"--export", &format_,
                      "format for the linear machine x' = A x + B u, y = C x + D u: mat or matrix-market"}
            .one_of(exchange_formats())
            .of_files()};
  }
  void                     check(Session &) override { check_frf_options(own_); }
  std::vector<std::string> reads() const override
  {
    std::vector<std::string> files;
    for (const std::string &text : own_.measured)
      files.insert(files.end(), {text, text.substr(text.find('=') + 1)});
    return files;
  }
  std::vector<std::string> writes() const override
  {
    return format_.empty() ? std::vector<std::string>() : state_space_files(format_);
  }
  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    result.answers.push_back(as_answer(
        frequency_response_of(session.scene(), session.machine(), own_, session.progress(), result.warnings)));
    return AnalysisOutcome::done;
  }
  std::string write(Session &session, OwnFolder &folder) const override
  {
    if (format_.empty())
      return "";
    const auto model = state_space_of(session.scene(), session.machine(), own_);
    const auto files = write_state_space(folder, model, format_);
    return "state space: " + std::to_string(model.states.size()) + " states, " + std::to_string(model.inputs.size()) +
           " inputs, " + std::to_string(model.outputs.size()) +
           " outputs: " + (folder.path() / files.front()).string() + (files.size() > 1 ? " ..." : "");
  }

private:
  FrfOptions  own_;
  std::string format_; ///< of the linear machine; empty: it is not written
};

} // namespace

AnalysisEntry frf_analysis()
{
  const auto exported = [](const std::string &name, const std::string &holds)
  { return ResultFile{name, holds, nullptr, "", "", nullptr, WrittenBy::its_command}; };
  return analysis_entry<Frf, FrequencyResponse>(
      "frf", "frequency responses of the machine linearised at an operating point",
      {"gestell frf apps/scenes/press_minimal.toml --from frame.crown.uz --to frame.crown.uz,F_P"},
      {{"frf.csv", "frequency responses of the linearised machine, by `frf`",
        content_of<FrequencyResponse, frequency_response_csv>},
       exported("state_space.mat", "linearised machine as x' = A x + B u, y = C x + D u, with `frf --export mat`"),
       exported("state_space_*.mtx", "the same, with `frf --export matrix-market`"),
       exported("state_space.csv", "names of states, inputs and outputs")});
}

} // namespace gestell::apps
