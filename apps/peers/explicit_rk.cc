// ARKODE's explicit Runge-Kutta methods as a Stepper.

#include "apps/peers/sundials.h"

#include <arkode/arkode_erkstep.h>

namespace gestell::peers
{
namespace
{

/// Embedded pairs: Bogacki-Shampine 3(2), Zonneveld 4(3), Dormand-Prince 5(4), Verner 6(5), Fehlberg 8(7).
ARKODE_ERKTableID table(int order)
{
  switch (order)
  {
  case 3:
    return ARKODE_BOGACKI_SHAMPINE_4_2_3;
  case 4:
    return ARKODE_ZONNEVELD_5_3_4;
  case 6:
    return ARKODE_VERNER_8_5_6;
  case 8:
    return ARKODE_FEHLBERG_13_7_8;
  default:
    return ARKODE_DORMAND_PRINCE_7_4_5;
  }
}

constexpr SundialsCalls calls = {ERKStepGetDky, ERKStepGetRootInfo, ERKStepSetRootDirection,
                                 ERKStepSetNoInactiveRootWarn};

class ExplicitRk : public SundialsStepper
{
public:
  ExplicitRk(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
      : SundialsStepper(calls, callbacks, problem, options, false)
  {
    memory_ = ERKStepCreate(state_rate, problem.t, parts_.y, parts_.context);
#if SUNDIALS_VERSION_MAJOR < 7 // later ones have messages of the context
    ERKStepSetErrHandlerFn(memory_, keep_message, &parts_.failure);
#endif
    ERKStepSetUserData(memory_, &callbacks);
    ERKStepSetTableNum(memory_, table(options.order));
    ERKStepSetMaxNumSteps(memory_, -1);
    ERKStepSetMaxHnilWarns(memory_, -1);
    expect(ERKStepSVtolerances(memory_, options.tolerance, parts_.weights), "ERKStepSVtolerances");
  }
  ~ExplicitRk() override { ERKStepFree(&memory_); }

  Outcome step() override
  {
    const int code = ERKStepEvolve(memory_, end_, parts_.y, &t_, ARK_ONE_STEP);
    return code < 0 ? Outcome::failed : code == ARK_ROOT_RETURN ? Outcome::root : Outcome::step;
  }

private:
  void begin_again() override { expect(ERKStepReInit(memory_, state_rate, t_, parts_.y), "ERKStepReInit"); }
  int  watch_guards(int n) override { return ERKStepRootInit(memory_, n, n > 0 ? guard_values : nullptr); }
  coupling::IntegrationWork work_since_begin() const override
  {
    coupling::IntegrationWork work;
    ERKStepGetNumSteps(memory_, &work.steps);
    ERKStepGetNumErrTestFails(memory_, &work.rejected);
    return work;
  }
};

} // namespace

std::unique_ptr<Stepper> make_explicit_rk(Callbacks &callbacks, const PeerProblem &problem, const PeerOptions &options)
{
  return std::make_unique<ExplicitRk>(callbacks, problem, options);
}

} // namespace gestell::peers
