#include "apps/output/exchange/model_description.h"

#include "apps/output/text/svg.h"
#include "fem/values/number_text.h"

#include <map>
#include <sstream>

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

/// The variables of one causality, which `words` tells with variability and initial.
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

} // namespace

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

} // namespace gestell::apps
