#pragma once

#include "apps/fmu/fmi2_types.h"

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <vector>

namespace gestell::tests
{

/// A scalar as modelDescription.xml tells it.
struct FmuScalar
{
  std::string        name, causality, variability, initial, unit;
  fmi2ValueReference reference = 0;
  bool               starts    = false;
  double             start     = 0.;
};

/// What a log told: "error: fmi2DoStep: ...".
struct FmuMessage
{
  fmi2Status  status;
  std::string instance, category, text;
};

struct FmuFunctions;

/// An FMU unpacked into a folder of its own, its library loaded; a master of our own, which knows nothing of Gestell
/// but what the standard says.
class Fmu
{
public:
  /// @param file  of the FMU; unpacked into `folder`, by `unzip`
  Fmu(const std::filesystem::path &file, const std::filesystem::path &folder);
  ~Fmu();
  Fmu(const Fmu &) = delete;

  const std::map<std::string, std::string> &head() const { return head_; }             ///< of fmiModelDescription
  const std::map<std::string, std::string> &co_simulation() const { return ability_; } ///< its attributes
  const std::vector<FmuScalar>             &scalars() const { return scalars_; }
  const std::vector<std::string>           &units() const { return units_; }
  const std::vector<int>                   &outputs() const { return outputs_; } ///< indices of ModelStructure
  const std::filesystem::path              &folder() const { return folder_; }
  const FmuFunctions                       &functions() const { return *functions_; }

  std::vector<std::string> named(const std::string &causality) const;
  fmi2ValueReference       reference(const std::string &name) const;

private:
  void read_description();

  std::filesystem::path              folder_;
  std::map<std::string, std::string> head_, ability_;
  std::vector<FmuScalar>             scalars_;
  std::vector<std::string>           units_;
  std::vector<int>                   outputs_;
  void                              *library_ = nullptr;
  std::unique_ptr<FmuFunctions>      functions_;
};

/// One instance of it; calls that are to succeed are EXPECTed to.
class FmuInstance
{
public:
  explicit FmuInstance(const Fmu &fmu, const std::string &name = "one", const std::string &guid = "",
                       const std::string &resources = "");
  ~FmuInstance();
  FmuInstance(const FmuInstance &) = delete;

  bool alive() const { return component_ != nullptr; }
  /// From its start to where it steps, with these parameters and inputs.
  /// @param stop  [s] beyond which no step goes; 0: none
  fmi2Status start(const std::map<std::string, double> &values = {}, double begin = 0., double stop = 0.);

  double     get(const std::string &name) const;
  fmi2Status set(const std::string &name, double value) const;
  fmi2Status set_rate(const std::string &input, double rate) const;
  fmi2Status step(double t, double length) const;

  fmi2FMUstate keep() const;
  fmi2Status   back_to(fmi2FMUstate state) const;
  void         forget(fmi2FMUstate state) const;
  std::string  bytes(fmi2FMUstate state) const;
  fmi2Status   from_bytes(const std::string &bytes, fmi2FMUstate &state) const;
  fmi2Status   reset() const;
  fmi2Status   terminate() const;
  bool         has_ended() const;
  double       last_time() const;
  fmi2Status   get_reference(fmi2ValueReference reference) const;

  const std::vector<FmuMessage> &messages() const { return *messages_; }
  std::string                    last_message() const { return messages_->empty() ? "" : messages_->back().text; }

private:
  const Fmu                               &fmu_;
  std::unique_ptr<std::vector<FmuMessage>> messages_; ///< address of the callbacks' environment
  std::unique_ptr<fmi2CallbackFunctions>   callbacks_;
  fmi2Component                            component_ = nullptr;
};

} // namespace gestell::tests
