#include "apps/fmu/fmi2_component.h"
#include "coupling/simulation/checks/contacts_and_switches.h"
#include "fem/values/nearest_name.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <stdexcept>

namespace gestell::apps
{

void FmuComponent::log(fmi2Status status, const std::string &category, const std::string &message) const
{
  const bool wanted = status == fmi2Warning || status >= fmi2Error ||
                      (logging && (categories.empty() || categories.count(category) > 0));
  if (wanted && callbacks.logger)
    callbacks.logger(callbacks.componentEnvironment, name.c_str(), status, category.c_str(), "%s", message.c_str());
}

void FmuComponent::tell_findings()
{
  for (const coupling::Finding &finding : model->take_findings())
    log(fmi2Warning, "logStatusWarning", finding.text);
  for (const coupling::Event &event : model->take_events())
    log(fmi2OK, "logEvents", "event at " + exact_text(event.t) + " s: " + event.name + ": " + event.kind);
}

namespace
{

using Phase = FmuComponent::Phase;

constexpr const char *log_categories[] = {"logStatusWarning", "logStatusDiscard", "logStatusError", "logEvents"};

/// The folder that a URI "file:///..." names.
std::filesystem::path folder_of(const std::string &uri)
{
  std::string path = uri;
  if (uri.rfind("file:", 0) == 0)
  {
    path = uri.substr(5);
    if (path.rfind("//", 0) == 0)
      path = path.substr(std::min(path.find('/', 2), path.size())); // whatever host it names is this one
  }
  else if (uri.find("://") != std::string::npos)
    throw std::invalid_argument("the resources are at '" + uri + "'; only file:// can be read");
  std::string decoded;
  for (std::size_t i = 0; i < path.size(); ++i)
    if (path[i] == '%' && i + 2 < path.size() && std::isxdigit(static_cast<unsigned char>(path[i + 1])) &&
        std::isxdigit(static_cast<unsigned char>(path[i + 2])))
    {
      decoded += char(std::stoi(path.substr(i + 1, 2), nullptr, 16));
      i += 2;
    }
    else
      decoded += path[i];
  return decoded;
}

std::unique_ptr<FmuModel> model_at(const char *guid, const char *resources)
{
  if (!resources || !*resources)
    throw std::invalid_argument("the location of the resources is missing; they contain the scene and its frame");
  const std::filesystem::path folder = folder_of(resources);
  if (!std::filesystem::exists(folder / "scene.toml"))
    throw std::invalid_argument("there is no scene.toml in " + folder.string() + "; unpack the whole FMU");
  auto model = std::make_unique<FmuModel>(folder);
  if (!guid || model->resources().guid != guid)
    throw std::invalid_argument("the model description has the guid '" + std::string(guid ? guid : "") +
                                "', the resources '" + model->resources().guid + "'; they belong to different FMUs");
  return model;
}

/// The library is built for processors like the one it was built on, or for all.
void require_processor()
{
#if defined(__AVX2__) && defined(__FMA__)
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma"))
    throw std::runtime_error(
        "the library of this FMU needs a processor with AVX2; export it from a build with GESTELL_NATIVE=OFF");
#endif
}

/// The variable of a value reference: its group and its number there.
struct Variable
{
  enum Group
  {
    parameter,
    input,
    output
  } group;
  std::size_t        number;
  const FmuVariable &variable;
};

Variable variable_of(const FmuModel &model, fmi2ValueReference reference)
{
  const FmuInterface &all   = model.interface();
  std::size_t         i     = reference;
  int                 group = 0;
  for (const auto *variables : {&all.parameters, &all.inputs, &all.outputs})
  {
    if (i < variables->size())
      return {Variable::Group(group), i, (*variables)[i]};
    i -= variables->size();
    ++group;
  }
  throw std::invalid_argument("there is no variable with the value reference " + std::to_string(reference) +
                              "; valid: 0 to " + std::to_string(all.size() - 1));
}

fmi2Status refuse_type(fmi2Component c, const char *function, std::size_t n) noexcept
{
  return answered(c, function, always,
                  [n](FmuComponent &)
                  {
                    if (n > 0)
                      throw std::invalid_argument("all variables of this FMU are real");
                    return fmi2OK;
                  });
}

/// The value of a variable; for a failed FMU, at the last instant it reached.
double value_of(FmuComponent &own, fmi2ValueReference reference)
{
  FmuModel      &model    = *own.model;
  const Variable variable = variable_of(model, reference);
  switch (variable.group)
  {
  case Variable::parameter:
    return model.parameter(variable.number);
  case Variable::input:
    return model.input(variable.number);
  default:
    break;
  }
  if (own.phase == Phase::instantiated)
    throw std::invalid_argument("'" + variable.variable.name + "' has no value before the initialisation");
  return model.output(variable.number);
}

void set_value(FmuComponent &own, fmi2ValueReference reference, double value)
{
  const Variable variable = variable_of(*own.model, reference);
  if (variable.group == Variable::output)
    throw std::invalid_argument("'" + variable.variable.name + "' is an output, which cannot be set");
  if (own.phase == Phase::initialising)
    own.model->forget_start();
  if (variable.group == Variable::input)
    own.model->set_input(variable.number, value);
  else
    own.model->set_parameter(variable.number, value);
}

fmi2Status step_to(FmuComponent &own, double t, double length)
{
  FmuModel &model = *own.model;
  if (!model.ended().empty())
    throw std::invalid_argument("the run has ended: " + model.ended());
  if (own.stops && t + length > own.stop + 1e-9 * std::max(std::abs(own.stop), length))
    throw std::invalid_argument("the step ends at " + exact_text(t + length) + " s, beyond the stop time " +
                                exact_text(own.stop) + " s");
  try
  {
    model.step(t, length);
    if (own.stops && t + length >= own.stop - 1e-9 * std::max(std::abs(own.stop), length))
      model.verify();
  }
  catch (const coupling::ConvergenceFailure &failure)
  {
    own.phase = Phase::failed;
    model.finish(failure.what(), failure.id());
    own.tell_findings();
    throw;
  }
  if (!model.ended().empty())
    model.finish(model.ended(), coupling::ended_by_switch);
  own.tell_findings();
  if (model.ended().empty())
    return fmi2OK;
  own.log(fmi2Discard, "logStatusDiscard", "the run has ended at " + exact_text(model.time()) + " s: " + model.ended());
  return fmi2Discard;
}

} // namespace
} // namespace gestell::apps

using namespace gestell::apps;

FMI2_SHOWN const char *fmi2GetTypesPlatform()
{
  return "default";
}

FMI2_SHOWN const char *fmi2GetVersion()
{
  return "2.0";
}

FMI2_SHOWN fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid, fmi2String resources,
                                         const fmi2CallbackFunctions *callbacks, fmi2Boolean, fmi2Boolean logging)
{
  try
  {
    auto own       = std::make_unique<FmuComponent>();
    own->name      = name ? name : "";
    own->callbacks = callbacks ? *callbacks : fmi2CallbackFunctions{};
    own->logging   = logging != 0;
    try
    {
      require_processor();
      if (own->name.empty())
        throw std::invalid_argument("the instance has no name; give it one");
      if (type != fmi2CoSimulation)
        throw std::invalid_argument("this FMU is for co-simulation, not for model exchange");
      own->model = model_at(guid, resources);
    }
    catch (const std::exception &error)
    {
      own->log(fmi2Error, "logStatusError", std::string("fmi2Instantiate: ") + error.what());
      return nullptr;
    }
    return own.release();
  }
  catch (...)
  {
    return nullptr;
  }
}

FMI2_SHOWN void fmi2FreeInstance(fmi2Component c)
{
  delete component_of(c);
}

FMI2_SHOWN fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t n, const fmi2String *categories)
{
  return answered(c, "fmi2SetDebugLogging", always,
                  [&](FmuComponent &own)
                  {
                    const std::set<std::string> chosen(categories, categories + n);
                    for (const std::string &category : chosen)
                      if (std::find(std::begin(log_categories), std::end(log_categories), category) ==
                          std::end(log_categories))
                        throw std::invalid_argument("there is no log category '" + category + "'");
                    own.logging    = on != 0;
                    own.categories = chosen;
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start, fmi2Boolean stops,
                                          fmi2Real stop)
{
  return answered(c, "fmi2SetupExperiment", {Phase::instantiated},
                  [&](FmuComponent &own)
                  {
                    const double begin = own.model->time();
                    if (start != begin)
                      throw std::invalid_argument("the start time is " + gestell::exact_text(start) +
                                                  " s, but the scene begins at " + gestell::exact_text(begin) + " s");
                    if (stops && !(stop > begin))
                      throw std::invalid_argument("the stop time is " + gestell::exact_text(stop) +
                                                  " s; it must be after the start time " + gestell::exact_text(begin) +
                                                  " s");
                    own.stops = stops != 0;
                    own.stop  = stop;
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2EnterInitializationMode(fmi2Component c)
{
  return answered(c, "fmi2EnterInitializationMode", {Phase::instantiated},
                  [](FmuComponent &own)
                  {
                    own.phase = Phase::initialising;
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2ExitInitializationMode(fmi2Component c)
{
  return answered(c, "fmi2ExitInitializationMode", {Phase::initialising},
                  [](FmuComponent &own)
                  {
                    own.phase = Phase::failed;
                    own.model->start();
                    own.phase = Phase::stepping;
                    own.tell_findings();
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2Terminate(fmi2Component c)
{
  return answered(c, "fmi2Terminate", {Phase::stepping},
                  [](FmuComponent &own)
                  {
                    own.phase                 = Phase::terminated;
                    const std::string failure = own.model->ended().empty() ? own.model->finish() : "";
                    own.tell_findings();
                    if (!failure.empty())
                      throw gestell::coupling::ConvergenceFailure(failure);
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2Reset(fmi2Component c)
{
  return answered(c, "fmi2Reset", always,
                  [](FmuComponent &own)
                  {
                    own.model->reset();
                    own.phase = Phase::instantiated;
                    own.stops = false;
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference *references, std::size_t n,
                                  fmi2Real *values)
{
  return answered(c, "fmi2GetReal", always,
                  [&](FmuComponent &own)
                  {
                    for (std::size_t i = 0; i < n; ++i)
                      values[i] = value_of(own, references[i]);
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference *references, std::size_t n,
                                  const fmi2Real *values)
{
  return answered(c, "fmi2SetReal", {Phase::instantiated, Phase::initialising, Phase::stepping},
                  [&](FmuComponent &own)
                  {
                    for (std::size_t i = 0; i < n; ++i)
                      set_value(own, references[i], values[i]);
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference *references, std::size_t n,
                                                  const fmi2Integer *orders, const fmi2Real *values)
{
  return answered(c, "fmi2SetRealInputDerivatives", {Phase::initialising, Phase::stepping},
                  [&](FmuComponent &own)
                  {
                    for (std::size_t i = 0; i < n; ++i)
                    {
                      const Variable variable = variable_of(*own.model, references[i]);
                      if (variable.group != Variable::input)
                        throw std::invalid_argument("'" + variable.variable.name + "' is not an input");
                      if (orders[i] != 1)
                        throw std::invalid_argument("the derivative of order " + std::to_string(orders[i]) + " of '" +
                                                    variable.variable.name +
                                                    "' is not used; inputs are linear (order 1)");
                      own.model->set_input_rate(variable.number, values[i]);
                    }
                    return fmi2OK;
                  });
}

FMI2_SHOWN fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real length, fmi2Boolean)
{
  return answered(c, "fmi2DoStep", {Phase::stepping}, [&](FmuComponent &own) { return step_to(own, t, length); });
}

// --- variables of other types, which this FMU does not have

FMI2_SHOWN fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference *, std::size_t n, fmi2Integer *)
{
  return refuse_type(c, "fmi2GetInteger", n);
}

FMI2_SHOWN fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference *, std::size_t n, fmi2Boolean *)
{
  return refuse_type(c, "fmi2GetBoolean", n);
}

FMI2_SHOWN fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference *, std::size_t n, fmi2String *)
{
  return refuse_type(c, "fmi2GetString", n);
}

FMI2_SHOWN fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference *, std::size_t n, const fmi2Integer *)
{
  return refuse_type(c, "fmi2SetInteger", n);
}

FMI2_SHOWN fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference *, std::size_t n, const fmi2Boolean *)
{
  return refuse_type(c, "fmi2SetBoolean", n);
}

FMI2_SHOWN fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference *, std::size_t n, const fmi2String *)
{
  return refuse_type(c, "fmi2SetString", n);
}
