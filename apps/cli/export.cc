#include "apps/analysis/result_folder.h"
#include "apps/cli/command.h"
#include "apps/cli/progress.h"
#include "apps/cli/results_path.h"
#include "apps/output/exchange/zip_file.h"
#include "apps/output/folder/own_folder.h"
#include "apps/output/text/svg.h"
#include "apps/output/values/fmu_description.h"
#include "apps/scene/scene.h"
#include "apps/session/exchange/fmu_answer.h"
#include "apps/session/exchange/scene_inputs.h"
#include "coupling/plugin/plugin.h"
#include "fem/values/number_text.h"

#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

namespace gestell::apps
{
namespace
{

std::string attribute(const std::string &name, const std::string &value)
{
  return " " + name + "=\"" + escape_xml(value) + "\"";
}

std::string attribute(const std::string &name, double value)
{
  return attribute(name, exact_text(value));
}

/// Every unit once; one whose dimension is not known has none.
std::string unit_definitions(const FmuInterface &variables)
{
  std::map<std::string, std::array<int, 4>> units;
  for (const auto *group : {&variables.parameters, &variables.inputs, &variables.outputs})
    for (const FmuVariable &variable : *group)
      if (!variable.unit.empty())
        units[variable.unit] = variable.base;
  if (units.empty())
    return "";
  std::string text = "  <UnitDefinitions>\n";
  for (const auto &[unit, base] : units)
  {
    text += "    <Unit" + attribute("name", unit) + "><BaseUnit";
    for (int i = 0; i < 4; ++i)
      if (base[i] != 0)
        text += attribute(std::array{"kg", "m", "s", "rad"}[i], std::to_string(base[i]));
    text += "/></Unit>\n";
  }
  return text + "  </UnitDefinitions>\n";
}

/// The variables of one causality; `words` are its attributes including variability and initial.
std::string scalar_variables(const std::vector<FmuVariable> &variables, std::size_t first, const std::string &words,
                             bool starts)
{
  std::string text;
  for (const FmuVariable &variable : variables)
  {
    text += "    <ScalarVariable" + attribute("name", variable.name) +
            attribute("valueReference", std::to_string(first++)) + words + "><Real" +
            (variable.unit.empty() ? "" : attribute("unit", variable.unit)) +
            (starts ? attribute("start", variable.start) : "") + "/></ScalarVariable>\n";
  }
  return text;
}

/// Indices of the outputs among all variables, from 1.
std::string unknowns(const FmuInterface &variables, const std::string &element)
{
  const std::size_t first = variables.parameters.size() + variables.inputs.size();
  std::string       text  = "    <" + element + ">\n";
  for (std::size_t i = 1; i <= variables.outputs.size(); ++i)
    text += "      <Unknown" + attribute("index", std::to_string(first + i)) + "/>\n";
  return text + "    </" + element + ">\n";
}

/// modelDescription.xml of FMI 2.0 for co-simulation.
std::string model_description(const FmuDescription &fmu)
{
  const FmuInterface &variables = fmu.variables;
  const std::size_t   inputs = variables.parameters.size(), outputs = inputs + variables.inputs.size();
  std::ostringstream  text;
  text << "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<fmiModelDescription" << attribute("fmiVersion", "2.0")
       << attribute("modelName", fmu.name) << attribute("guid", fmu.guid)
       << (fmu.description.empty() ? "" : attribute("description", fmu.description))
       << attribute("generationTool", "Gestell " + fmu.version) << attribute("variableNamingConvention", "flat")
       << attribute("numberOfEventIndicators", "0") << ">\n"
       << "  <CoSimulation" << attribute("modelIdentifier", fmu.identifier);
  for (const char *able : {"canHandleVariableCommunicationStepSize", "canInterpolateInputs", "canGetAndSetFMUstate",
                           "canSerializeFMUstate", "canNotUseMemoryManagementFunctions"})
    text << attribute(able, "true");
  text << attribute("maxOutputDerivativeOrder", "0") << "/>\n"
       << unit_definitions(variables) << "  <LogCategories>\n"
       << "    <Category name=\"logStatusWarning\"/>\n    <Category name=\"logStatusDiscard\"/>\n"
       << "    <Category name=\"logStatusError\"/>\n    <Category name=\"logEvents\"/>\n  </LogCategories>\n"
       << "  <DefaultExperiment" << attribute("startTime", fmu.begin) << attribute("stopTime", fmu.end)
       << attribute("stepSize", fmu.step) << "/>\n  <ModelVariables>\n"
       << scalar_variables(variables.parameters, 0, " causality=\"parameter\" variability=\"fixed\" initial=\"exact\"",
                           true)
       << scalar_variables(variables.inputs, inputs, " causality=\"input\" variability=\"continuous\"", true)
       << scalar_variables(variables.outputs, outputs,
                           " causality=\"output\" variability=\"continuous\" initial=\"calculated\"", false)
       << "  </ModelVariables>\n  <ModelStructure>\n";
  if (!variables.outputs.empty())
    text << unknowns(variables, "Outputs") << unknowns(variables, "InitialUnknowns");
  text << "  </ModelStructure>\n</fmiModelDescription>\n";
  return text.str();
}

constexpr const char *fmu_library = "libgestell_fmu.so";

struct ExportOptions
{
  std::string              fmu;
  std::vector<std::string> inputs;
};

std::string library_of_fmus()
{
  const auto file = coupling::find_plugin(fmu_library);
  if (file.empty())
    throw std::invalid_argument(
        std::string("gestell export: ") + fmu_library +
        " not found next to the program; build the target gestell_fmu, or set GESTELL_PLUGIN_DIR to its folder");
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// How it is used, for who opens the archive.
std::string page_of(const FmuAnswer &answer)
{
  std::string text = "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><title>FMU by Gestell</title></head><body>"
                     "<p>Machine of a scene of Gestell, FMI 2.0 for co-simulation. The scene is resources/scene.toml. "
                     "All values are in SI. Inputs are constant over a communication step, or linear if their "
                     "derivative is given.</p>";
  for (const std::string &note : answer.notes)
    text += "<p>" + note + ".</p>";
  return text + "</body></html>\n";
}

void write_fmu(const std::string &path, const FmuAnswer &answer)
{
  const std::string library = library_of_fmus();
  ZipFile           zip(path);
  zip.add("modelDescription.xml", model_description(answer.fmu));
  zip.add("binaries/linux64/" + answer.fmu.identifier + ".so", library);
  for (const auto &[name, bytes] : answer.files)
    zip.add(name, bytes);
  zip.add("documentation/index.html", page_of(answer));
  zip.finish();
}

void print_variables(const std::string &kind, const std::vector<FmuVariable> &variables)
{
  constexpr std::size_t most = 40; // names of a screen's paragraph; modelDescription.xml has all
  std::cout << "  " << variables.size() << ' ' << kind << (variables.empty() ? "" : ":");
  for (std::size_t i = 0; i < variables.size() && i < most; ++i)
    std::cout << (i > 0 ? ", " : " ") << variables[i].name
              << (variables[i].unit.empty() ? "" : " [" + variables[i].unit + "]");
  std::cout << (variables.size() > most ? " ...\n" : "\n");
}

/// Path of the FMU.
std::filesystem::path place_of_fmu(const CommonOptions &options, const ExportOptions &requested, const Scene &scene)
{
  if (!requested.fmu.empty() && !options.folder.empty())
    throw std::invalid_argument("gestell export: --fmu names the file, -o only the folder; use one of the two options");
  return requested.fmu.empty() ? results_path(options, scene) / (scene.name + ".fmu")
                               : std::filesystem::path(requested.fmu);
}

/// A file that is named is replaced if it is an FMU; a scene that was named by mistake is not.
void require_archive(const std::filesystem::path &file)
{
  std::ifstream   in(file, std::ios::binary);
  char            begin[2] = {};
  std::error_code none;
  if (std::filesystem::exists(std::filesystem::symlink_status(file, none)) &&
      !(in.read(begin, 2) && begin[0] == 'P' && begin[1] == 'K'))
    throw std::invalid_argument("--fmu: " + file.string() +
                                " already exists and is not an FMU, so it is not replaced; choose another name");
}

int export_scene(const CommonOptions &options, const ExportOptions &requested)
{
  library_of_fmus();
  ProgressLine progress(options.quiet);
  Variant      scene  = Variant::of_file(options.input, options.overrides, options.scripts);
  const Scene  plain  = scene.scene();
  const auto   file   = place_of_fmu(options, requested, plain);
  const auto   folder = std::filesystem::absolute(file).parent_path();
  require_writable(folder);
  if (requested.fmu.empty())
    OwnFolder(folder).require_free({file.filename().string()}, inputs_of(options));
  else
    require_archive(file);
  add_scene_inputs(requested.inputs, plain, scene.root);
  Session         session(std::move(scene), {progress.callback()});
  const FmuAnswer answer = fmu_of(session);
  progress.done();
  if (requested.fmu.empty())
    OwnFolder(folder).claim(file.filename().string());
  else
    std::filesystem::create_directories(folder);
  write_fmu(file.string(), answer);
  std::cout << "FMU 2.0 for co-simulation: " << file.string() << '\n';
  print_variables("inputs", answer.fmu.variables.inputs);
  print_variables("outputs", answer.fmu.variables.outputs);
  print_variables("parameters", answer.fmu.variables.parameters);
  for (const std::string &note : answer.notes)
    std::cout << "  " << note << '\n';
  return exit_done;
}

} // namespace

Command export_command()
{
  const auto own = std::make_shared<ExportOptions>();
  return {"export",
          "export the machine as an FMU 2.0 for co-simulation",
          {"gestell export apps/scenes/press_minimal.toml --fmu press.fmu --inputs F=slide,frame.crown.uz"},
          CommandInput::scene,
          {{"--fmu", &own->fmu,
            "FMU to write, such as press.fmu (default: in the folder of results, with the name of the scene)"},
           {"--inputs", &own->inputs,
            "inputs (forces and speeds) in addition to those in the scene: slide, crank, frame.crown.uz, drive.speed, "
            "or with another name F=slide"}},
          [own](const CommonOptions &options) { return export_scene(options, *own); }};
}

} // namespace gestell::apps
