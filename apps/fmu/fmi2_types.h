#pragma once

#include <cstddef>

// The C interface of FMI 2.0: names, order of arguments and numbers of the enumerations are those of the standard.
// Source: Functional Mock-up Interface for Model Exchange and Co-Simulation 2.0.4, sections 2.1 and 4.2.

extern "C"
{
  using fmi2Component            = void *;
  using fmi2ComponentEnvironment = void *;
  using fmi2FMUstate             = void *;
  using fmi2ValueReference       = unsigned int;
  using fmi2Real                 = double;
  using fmi2Integer              = int;
  using fmi2Boolean              = int;
  using fmi2Char                 = char;
  using fmi2String               = const fmi2Char *;
  using fmi2Byte                 = char;

  enum fmi2Status
  {
    fmi2OK,
    fmi2Warning,
    fmi2Discard,
    fmi2Error,
    fmi2Fatal,
    fmi2Pending
  };

  enum fmi2Type
  {
    fmi2ModelExchange,
    fmi2CoSimulation
  };

  enum fmi2StatusKind
  {
    fmi2DoStepStatus,
    fmi2PendingStatus,
    fmi2LastSuccessfulTime,
    fmi2Terminated
  };

  struct fmi2CallbackFunctions
  {
    void (*logger)(fmi2ComponentEnvironment, fmi2String instance, fmi2Status, fmi2String category, fmi2String message,
                   ...);
    void *(*allocateMemory)(std::size_t, std::size_t);
    void (*freeMemory)(void *);
    void (*stepFinished)(fmi2ComponentEnvironment, fmi2Status);
    fmi2ComponentEnvironment componentEnvironment;
  };
}
