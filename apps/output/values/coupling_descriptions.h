#pragma once

#include "coupling/modes/excitation_orders.h"
#include "coupling/modes/modes.h"
#include "coupling/periodic/basins.h"
#include "coupling/periodic/periodic_solution.h"
#include "coupling/periodic/recurrence.h"
#include "coupling/periodic/response/response_peaks.h"
#include "coupling/simulation/run_result.h"
#include "fem/values/frame_matrices.h"
#include "fem/values/two_pi.h"

/// Members of values that are computed below apps; see apps/output/describe/described.h.
namespace gestell::coupling
{

template <class Visitor>
void describe(Visitor &v, const Event &x)
{
  v("t", x.t, "s", "instant");
  v("name", x.name, "", "name of the object");
  v("kind", x.kind, "", "transition");
}

template <class Visitor>
void describe(Visitor &v, const Finding &x)
{
  v("severity", x.severity == Severity::error ? "error" : "warning", "",
    "`warning`: the result is valid, but perhaps not what was meant; `error`: the run ended there");
  v("id", x.id, "", "kind of finding, the same in all versions; empty: of the frame or an analysis");
  v("place", x.place, "", "element, joint, switch, signal or key; empty: the run as a whole");
  v("text", x.text, "", "problem, location and remedy");
}

template <class Visitor>
void describe(Visitor &v, const IntegrationWork &x)
{
  v("steps", x.steps, "", "accepted steps");
  v("rejected", x.rejected, "", "steps that were divided or repeated");
  v("newton", x.newton, "", "Newton iterations");
  v("factorisations", x.factorisations, "", "factorizations");
  v("solves", x.solves, "", "solutions with these factorizations");
  v("evaluations", x.evaluations, "", "evaluations of the forces of all elements");
}

template <class Visitor>
void describe(Visitor &v, const SignalSummary &x)
{
  v("unit", x.unit, "", "of `min`, `max` and `final`");
  v("min", x.min, x.unit, "smallest value over all steps and between them");
  v("t_min", x.t_min, "s", "its time");
  v("max", x.max, x.unit, "largest value");
  v("t_max", x.t_max, "s", "its time");
  v("final", x.final, x.unit, "value at the end of the run");
}

template <class Visitor>
void describe(Visitor &v, const WorkCounts &x)
{
  describe(v, static_cast<const IntegrationWork &>(x));
  v("chatter", x.chatter, "", "steps in which events were too many to be located");
}

template <class Visitor>
void describe(Visitor &v, const EnergySummary &x)
{
  v("input", x.input, "J", "work of the drives");
  v("stored", x.stored, "J", "change since the start");
  v("dissipated", x.dissipated, "J", "energy dissipated by dampers, friction, contacts and tools");
  v("residual", x.residual, "J", "largest magnitude of input - stored - dissipated over time");
  v("exchanged", x.exchanged, "J", "reference energy of the residual");
}

template <class Visitor>
void describe(Visitor &v, const Pole &x)
{
  v("real", x.s.real(), "1/s", "real part");
  v("imaginary", x.s.imag(), "1/s", "imaginary part");
  v("frequency_hz", x.frequency_hz(), "Hz", "damped frequency");
  v("damping_ratio", x.damping_ratio(), "1", "-Re(s)/abs(s); negative: growing");
  v("moves_most", x.moves, "", "coordinate with the largest share of kinetic energy");
}

template <class Visitor>
void describe(Visitor &v, const OrderMeeting &x)
{
  v("order", x.order, "", "multiple of the speed");
  v("line", x.line + 1, "", "number of the line");
  v("from", x.begin, "", "start of the range of the coordinate");
  v("to", x.end, "", "end");
  v("nearest_at", x.x, "", "coordinate of the smallest distance");
  v("frequency_hz", x.frequency_hz, "Hz", "natural frequency at this position");
}

template <class Visitor>
void describe(Visitor &v, const ResponsePeak &x)
{
  v("frequency_hz", x.frequency_hz, "Hz", "of the maximum");
  v("amplitude", x.amplitude, "", "amplitude in the unit of the pair; null: infinite (undamped mode)");
  v("damping_ratio", x.damping_ratio, "1", "damping ratio from the width of the peak; null: unknown");
}

template <class Visitor>
void describe(Visitor &v, const ModeAccuracy &x)
{
  v("modes_of", x.origin == ModeOrigin::base ? "base" : "closed", "",
    "`base`: machine with open contacts, in the DOFs left free by its joints; `closed`: all contacts closed");
  v("number", x.number, "", "number in order of frequency, starting at 1");
  v("frequency_hz", x.mode.omega / two_pi, "Hz", "frequency of the damped mode, abs(s)/(2 pi)");
  v("damping_ratio", x.mode.zeta, "1", "-Re(s)/abs(s)");
  v("omega_h", x.omega_h, "1", "circular frequency times step");
  v("spectral_radius", x.spectral_radius, "1", "growth per step");
  v("numerical_damping", x.numerical_damping, "1", "damping ratio that the method adds");
  v("period_error", x.period_error, "1", "relative period error; positive: too slow");
  v("unstable", x.unstable, "", "whether the mode grows");
}

template <class Visitor>
void describe(Visitor &v, const RunVerification &x)
{
  v("periods", x.periods, "", "periods of the run");
  v("departure", x.departure, "1", "departure from the solution, relative");
  v("starts_anew", x.starts_anew, "", "whether the run restarted in each period");
}

template <class Visitor>
void describe(Visitor &v, const PeriodicWork &x)
{
  v("iterations", x.iterations, "", "iterations of the search");
  v("periods", x.periods, "", "periods integrated");
  v("steps", x.integration.steps, "", "steps of the integration");
  v("newton", x.integration.newton, "", "Newton iterations");
  v("factorisations", x.integration.factorisations, "", "factorizations");
  v("evaluations", x.integration.evaluations, "", "evaluations of the forces of all elements");
}

template <class Visitor>
void describe(Visitor &v, const Recurrence &x)
{
  v("kind", x.kind, "", "periodic, sub-harmonic, settling, drifting, quasi-periodic or chaotic");
  v("repeats", x.repeats, "", "periods until repetition; 0: none up to 16");
  v("exponent", x.exponent, "1/s", "largest Lyapunov exponent");
  v("error", x.error, "1/s", "standard error of the exponent");
  v("periods", x.periods, "", "number of periods examined");
}

} // namespace gestell::coupling

namespace gestell::fem
{

template <class Visitor>
void describe(Visitor &v, const FrameFacts::SolidMass &x)
{
  v("name", x.name, "", "of the solid");
  v("material", x.material, "", "material; empty for an attached mass");
  v("mass", x.mass, "kg", "mass of the solid");
}

} // namespace gestell::fem
