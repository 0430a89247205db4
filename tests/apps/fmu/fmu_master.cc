#include "tests/apps/fmu/fmu_master.h"

#include "tests/support/program.h"
#include "tests/support/test.h"

#include <boost/property_tree/ptree.hpp>
#include <boost/property_tree/xml_parser.hpp>

#include <cstdarg>
#include <dlfcn.h>

namespace gestell::tests
{

using Tree = boost::property_tree::ptree;

struct FmuFunctions
{
  explicit FmuFunctions(void *library) : library_(library) {}

  template <typename Function>
  Function *of(const char *name) const
  {
    void *const found = dlsym(library_, name);
    if (!found)
      throw std::runtime_error(std::string("the FMU has no function ") + name);
    return reinterpret_cast<Function *>(found);
  }

private:
  void *library_;
};

namespace
{

std::map<std::string, std::string> attributes(const Tree &node)
{
  std::map<std::string, std::string> all;
  if (const auto found = node.get_child_optional("<xmlattr>"))
    for (const auto &[name, value] : *found)
      all[name] = value.data();
  return all;
}

std::string attribute(const Tree &node, const std::string &name)
{
  return node.get<std::string>("<xmlattr>." + name, "");
}

void log_message(fmi2ComponentEnvironment environment, fmi2String instance, fmi2Status status, fmi2String category,
                 fmi2String format, ...)
{
  char    text[2000];
  va_list values;
  va_start(values, format);
  std::vsnprintf(text, sizeof text, format, values);
  va_end(values);
  static_cast<std::vector<FmuMessage> *>(environment)->push_back({status, instance, category, text});
}

} // namespace

Fmu::Fmu(const std::filesystem::path &file, const std::filesystem::path &folder) : folder_(folder)
{
  std::filesystem::create_directories(folder);
  if (std::system(("unzip -q -o '" + file.string() + "' -d '" + folder.string() + "'").c_str()) != 0)
    throw std::runtime_error(file.string() + " is no archive");
  read_description();
  const auto library = folder / "binaries" / "linux64" / (ability_.at("modelIdentifier") + ".so");
  library_           = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (!library_)
    throw std::runtime_error(dlerror());
  functions_ = std::make_unique<FmuFunctions>(library_);
}

Fmu::~Fmu()
{
  if (library_)
    dlclose(library_);
}

void Fmu::read_description()
{
  Tree tree;
  boost::property_tree::read_xml((folder_ / "modelDescription.xml").string(), tree);
  const Tree &model = tree.get_child("fmiModelDescription");
  head_             = attributes(model);
  ability_          = attributes(model.get_child("CoSimulation"));
  for (const auto &[kind, unit] : model.get_child("UnitDefinitions", Tree()))
    if (kind == "Unit")
      units_.push_back(attribute(unit, "name"));
  for (const auto &[kind, scalar] : model.get_child("ModelVariables"))
  {
    if (kind != "ScalarVariable")
      continue;
    const Tree &real = scalar.get_child("Real");
    FmuScalar   found{attribute(scalar, "name"),    attribute(scalar, "causality"), attribute(scalar, "variability"),
                    attribute(scalar, "initial"), attribute(real, "unit"),        0};
    found.reference = unsigned(std::stoul(attribute(scalar, "valueReference")));
    if (const std::string start = attribute(real, "start"); !start.empty())
    {
      found.starts = true;
      found.start  = std::stod(start);
    }
    scalars_.push_back(found);
  }
  for (const auto &[kind, unknown] : model.get_child("ModelStructure").get_child("Outputs", Tree()))
    if (kind == "Unknown")
      outputs_.push_back(std::stoi(attribute(unknown, "index")));
}

std::vector<std::string> Fmu::named(const std::string &causality) const
{
  std::vector<std::string> names;
  for (const FmuScalar &scalar : scalars_)
    if (scalar.causality == causality)
      names.push_back(scalar.name);
  return names;
}

fmi2ValueReference Fmu::reference(const std::string &name) const
{
  for (const FmuScalar &scalar : scalars_)
    if (scalar.name == name)
      return scalar.reference;
  throw std::invalid_argument("the FMU has no variable " + name);
}

FmuInstance::FmuInstance(const Fmu &fmu, const std::string &name, const std::string &guid, const std::string &resources)
    : fmu_(fmu), messages_(std::make_unique<std::vector<FmuMessage>>()),
      callbacks_(std::make_unique<fmi2CallbackFunctions>(
          fmi2CallbackFunctions{log_message, std::calloc, std::free, nullptr, messages_.get()}))
{
  const auto instantiate =
      fmu.functions()
          .of<fmi2Component(fmi2String, fmi2Type, fmi2String, fmi2String, const fmi2CallbackFunctions *, int, int)>(
              "fmi2Instantiate");
  const std::string own    = guid.empty() ? fmu.head().at("guid") : guid;
  const std::string folder = resources.empty() ? "file://" + (fmu.folder() / "resources").string() : resources;
  component_ = instantiate(name.c_str(), fmi2CoSimulation, own.c_str(), folder.c_str(), callbacks_.get(), 0, 1);
}

FmuInstance::~FmuInstance()
{
  if (component_)
    fmu_.functions().of<void(fmi2Component)>("fmi2FreeInstance")(component_);
}

fmi2Status FmuInstance::start(const std::map<std::string, double> &values, double begin, double stop)
{
  const FmuFunctions &f = fmu_.functions();
  EXPECT_EQ(f.of<fmi2Status(fmi2Component, int, double, double, int, double)>("fmi2SetupExperiment")(
                component_, 0, 0., begin, stop > 0., stop),
            fmi2OK);
  for (const auto &[name, value] : values)
    EXPECT_EQ(set(name, value), fmi2OK) << name;
  EXPECT_EQ(f.of<fmi2Status(fmi2Component)>("fmi2EnterInitializationMode")(component_), fmi2OK);
  return f.of<fmi2Status(fmi2Component)>("fmi2ExitInitializationMode")(component_);
}

double FmuInstance::get(const std::string &name) const
{
  const fmi2ValueReference reference = fmu_.reference(name);
  double                   value     = 0.;
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, const fmi2ValueReference *, std::size_t, double *)>(
                "fmi2GetReal")(component_, &reference, 1, &value),
            fmi2OK)
      << name << ": " << last_message();
  return value;
}

fmi2Status FmuInstance::get_reference(fmi2ValueReference reference) const
{
  double value = 0.;
  return fmu_.functions().of<fmi2Status(fmi2Component, const fmi2ValueReference *, std::size_t, double *)>(
      "fmi2GetReal")(component_, &reference, 1, &value);
}

fmi2Status FmuInstance::set(const std::string &name, double value) const
{
  const fmi2ValueReference reference = fmu_.reference(name);
  return fmu_.functions().of<fmi2Status(fmi2Component, const fmi2ValueReference *, std::size_t, const double *)>(
      "fmi2SetReal")(component_, &reference, 1, &value);
}

fmi2Status FmuInstance::set_rate(const std::string &input, double rate) const
{
  const fmi2ValueReference reference = fmu_.reference(input);
  const int                order     = 1;
  return fmu_.functions()
      .of<fmi2Status(fmi2Component, const fmi2ValueReference *, std::size_t, const int *, const double *)>(
          "fmi2SetRealInputDerivatives")(component_, &reference, 1, &order, &rate);
}

fmi2Status FmuInstance::step(double t, double length) const
{
  return fmu_.functions().of<fmi2Status(fmi2Component, double, double, int)>("fmi2DoStep")(component_, t, length, 0);
}

fmi2FMUstate FmuInstance::keep() const
{
  fmi2FMUstate state = nullptr;
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, fmi2FMUstate *)>("fmi2GetFMUstate")(component_, &state),
            fmi2OK);
  return state;
}

fmi2Status FmuInstance::back_to(fmi2FMUstate state) const
{
  return fmu_.functions().of<fmi2Status(fmi2Component, fmi2FMUstate)>("fmi2SetFMUstate")(component_, state);
}

void FmuInstance::forget(fmi2FMUstate state) const
{
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, fmi2FMUstate *)>("fmi2FreeFMUstate")(component_, &state),
            fmi2OK);
  EXPECT_EQ(state, nullptr);
}

std::string FmuInstance::bytes(fmi2FMUstate state) const
{
  std::size_t size = 0;
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, fmi2FMUstate, std::size_t *)>("fmi2SerializedFMUstateSize")(
                component_, state, &size),
            fmi2OK);
  std::string all(size, '\0');
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, fmi2FMUstate, char *, std::size_t)>("fmi2SerializeFMUstate")(
                component_, state, all.data(), size),
            fmi2OK);
  return all;
}

fmi2Status FmuInstance::from_bytes(const std::string &bytes, fmi2FMUstate &state) const
{
  return fmu_.functions().of<fmi2Status(fmi2Component, const char *, std::size_t, fmi2FMUstate *)>(
      "fmi2DeSerializeFMUstate")(component_, bytes.data(), bytes.size(), &state);
}

fmi2Status FmuInstance::reset() const
{
  return fmu_.functions().of<fmi2Status(fmi2Component)>("fmi2Reset")(component_);
}

fmi2Status FmuInstance::terminate() const
{
  return fmu_.functions().of<fmi2Status(fmi2Component)>("fmi2Terminate")(component_);
}

bool FmuInstance::has_ended() const
{
  int ended = 0;
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, fmi2StatusKind, int *)>("fmi2GetBooleanStatus")(
                component_, fmi2Terminated, &ended),
            fmi2OK);
  return ended != 0;
}

double FmuInstance::last_time() const
{
  double t = 0.;
  EXPECT_EQ(fmu_.functions().of<fmi2Status(fmi2Component, fmi2StatusKind, double *)>("fmi2GetRealStatus")(
                component_, fmi2LastSuccessfulTime, &t),
            fmi2OK);
  return t;
}

} // namespace gestell::tests
