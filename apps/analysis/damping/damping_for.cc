#include "apps/analysis/analysis_entry.h"
#include "apps/scene/file/override_rules.h"
#include "apps/session/option_value.h"
#include "apps/session/prepared_machine.h"
#include "coupling/modes/modes.h"
#include "coupling/reduction/mode_ratios.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace gestell::apps
{

/// The frame's damping ratio for a wanted one of a coupled mode.
struct DampingFor
{
  int    mode         = 0; ///< of the coupled machine, from 1
  double frequency_hz = 0., wanted = 0., frame_ratio = 0., reached = 0., without = 0.;
};

template <class Visitor>
void describe(Visitor &v, const DampingFor &x)
{
  v("mode", x.mode, "", "number of the coupled mode");
  v("frequency_hz", x.frequency_hz, "Hz", "its undamped frequency");
  v("wanted", x.wanted, "1", "target damping ratio");
  v("frame_ratio", x.frame_ratio, "1", "frame.damping.ratio that gives the target");
  v("reached", x.reached, "1", "damping ratio of the mode with this value");
  v("without", x.without, "1", "damping ratio of the mode with frame.damping.ratio = 0");
}

template <class Visitor>
void describe_answer(Visitor &v, const DampingFor &x)
{
  v.maybe(true, "damping_for", x, "", "`modes --damping-for`");
}

std::vector<Section> sections_of(const Result &, const DampingFor &x)
{
  return {{"damping-for",
           "Damping ratio of the frame",
           "Damping",
           Section::Place::frequencies,
           false,
           {Section::Sentences{"With frame.damping.ratio = " + short_text(x.frame_ratio, 8) + " mode " +
                               std::to_string(x.mode) + " of the coupled machine, " + short_text(x.frequency_hz, 6) +
                               " Hz, has the damping ratio " + short_text(x.reached, 6) + "; without it, " +
                               short_text(x.without, 4) + "."}}}};
}

namespace
{

/// The frame of a scene with another damping ratio, coupled to its machine.
class RatioOfFrame
{
public:
  RatioOfFrame(const Scene &scene, const coupling::ReducedFrame &frame, coupling::Linearisation how, int mode)
      : scene_(scene), how_(std::move(how)), mode_(mode), undamped_(frame), ratios_(*ratios_of(scene.frame))
  {
    coupling::ReducedFrame own = frame;
    own.B.setZero();
    coupling::add_modal_damping(own, ratios_);
    undamped_.B -= own.B;
    undamped_.B = (0.5 * (undamped_.B + undamped_.B.transpose())).eval(); // what rounding leaves is symmetric, too
  }

  static const fem::ModalRatios *ratios_of(const FrameRequest &frame)
  {
    return frame.source == FrameSource::geometry   ? &frame.geometry.modal_damping_ratio
           : frame.source == FrameSource::parts    ? &frame.parts.modal_damping_ratio
           : frame.source == FrameSource::matrices ? &frame.matrices.modal_damping_ratio
                                                   : nullptr;
  }

  /// The coupled mode with the damping ratio zeta in all modes of the frame that the scene does not name.
  coupling::Mode mode(double zeta) const
  {
    coupling::ReducedFrame frame  = undamped_;
    fem::ModalRatios       ratios = zeta;
    ratios.named                  = ratios_.named;
    coupling::add_modal_damping(frame, ratios);
    PreparedMachine prepared = prepare_machine(scene_, {}, &frame);
    const auto      modes =
        coupling::linearised_modes(prepared.small(), modes_configuration(scene_, prepared.small()), how_, mode_);
    if (int(modes.size()) < mode_)
      throw std::invalid_argument("--damping-for: mode " + std::to_string(mode_) + " does not exist; the machine has " +
                                  count_text(modes.size(), "mode"));
    if (std::isnan(modes.back().damping_ratio))
      throw std::invalid_argument("--damping-for: mode " + std::to_string(mode_) +
                                  " has no damping ratio if frame.damping.ratio is " + percent(zeta) +
                                  ": it is overdamped, or dampers couple it with other modes; choose another mode");
    return modes.back();
  }

private:
  const Scene            &scene_;
  coupling::Linearisation how_;
  int                     mode_;
  coupling::ReducedFrame  undamped_;
  fem::ModalRatios        ratios_;
};

/// Whether the scene defines damping of the whole frame that `ratio` would replace.
bool replaces_other_damping(const FrameRequest &frame)
{
  return frame.source == FrameSource::geometry
             ? frame.geometry.rayleigh_mass > 0. || frame.geometry.rayleigh_stiffness > 0.
             : frame.source == FrameSource::matrices && frame.matrices.B.nonZeros() > 0;
}

/// Root of an increasing function in [a, b] with f(a) < 0 < f(b): secant, and bisection where it leaves the interval.
double root_of(const std::function<double(double)> &f, double a, double fa, double b, double fb, double tolerance)
{
  double        x = b, fx = fb, before = a, f_before = fa;
  constexpr int most = 60; // bisection alone halves an interval of one down to rounding
  for (int i = 0; i < most && std::abs(fx) > tolerance; ++i)
  {
    double next = x - fx * (x - before) / (fx - f_before);
    if (!(next > a) || !(next < b))
      next = 0.5 * (a + b);
    before = x, f_before = fx;
    x = next, fx = f(x);
    (fx < 0. ? a : b) = x;
  }
  return x;
}

/**
 * The ratio z of the frame for which a mode of the coupled machine, linearised where `gestell modes` takes its modes,
 * has the damping ratio zeta:  zeta_j(z) = zeta, by secants; every evaluation solves the damped eigenvalue problem with
 * the same reduced frame.  Modes named in frame.damping.modes and all dampers of the scene keep theirs.
 */
class DampingForMode : public Analysis
{
public:
  std::vector<CommandOption> options() override
  {
    return {{"--damping-for", &wanted_,
             "find the frame.damping.ratio that gives a mode of the coupled machine this damping ratio: \"3=0.02\""}};
  }
  bool requested(const Scene &) const override { return !wanted_.empty(); }
  void check(Session &session) override
  {
    const Scene &scene = session.scene();
    (void)parsed();
    const fem::ModalRatios *ratios = RatioOfFrame::ratios_of(scene.frame);
    if (!ratios)
      throw std::invalid_argument("--damping-for: " + scene.file +
                                  " has no frame whose damping it determines; a [frame] from CAD, parts or matrices is "
                                  "needed");
    if (!ratios->by_frequency.empty())
      throw std::invalid_argument(place_of_key(scene.frame.place, "damping.ratio") +
                                  ": depends on the frequency; --damping-for finds one ratio for the "
                                  "modes of the frame: give a number, or single modes in `modes`");
    if (replaces_other_damping(scene.frame))
      throw std::invalid_argument(place_of_key(scene.frame.place, "damping") +
                                  ": is Rayleigh damping or a matrix; --damping-for finds the `ratio` that "
                                  "takes its place: give { ratio = 0 } instead");
  }

  AnalysisOutcome compute(Session &session, Result &result) const override
  {
    const auto [mode, wanted]           = parsed();
    const Scene                  &scene = session.scene();
    const coupling::ReducedFrame *frame = session.machine().small().model().reduced_frame();
    coupling::Linearisation       how{scene.modes.open};
    how.geometric = result.requested.geometric;
    const RatioOfFrame   ratio(scene, *frame, how, mode);
    DampingFor           found;
    const coupling::Mode bare = ratio.mode(0.);
    found.mode = mode, found.wanted = wanted;
    found.frequency_hz = bare.frequency_hz, found.without = bare.damping_ratio;
    constexpr double given_back = 1e-12, largest = 0.999; // of a ratio, rounding; of a frame that still vibrates
    if (found.without > wanted + given_back)
      throw std::invalid_argument(wanted_text() + ": the mode has a damping ratio of " + percent(found.without) +
                                  " without damping of the frame, whose ratio would have to be negative; weaken other "
                                  "dampers, or request a higher ratio");
    found.reached     = found.without;
    const auto excess = [&, wanted = wanted](double z)
    {
      found.reached = ratio.mode(z).damping_ratio;
      return found.reached - wanted;
    };
    if (found.without < wanted - given_back)
    {
      double high = std::min(largest, std::max(2. * wanted, 1e-3)), above = excess(high);
      while (above < 0. && high < largest)
      {
        high  = std::min(largest, 2. * high);
        above = excess(high);
      }
      if (above < 0.)
        throw std::invalid_argument(
            wanted_text() + ": even a ratio of " + short_text(largest) + " gives only " + percent(wanted + above) +
            ", because the frame contributes too little to this mode, or has a ratio of its own there "
            "(frame.damping.modes); add dampers that act on it, or remove this ratio");
      found.frame_ratio = root_of(excess, 0., found.without - wanted, high, above, given_back);
    }
    result.answers.push_back(as_answer(std::move(found)));
    return AnalysisOutcome::done;
  }

private:
  std::string wanted_text() const { return "--damping-for " + wanted_; }

  std::pair<int, double> parsed() const
  {
    const auto   sign = wanted_.find('=');
    const double mode =
        sign == std::string::npos ? 0. : option_value("--damping-for", wanted_.substr(0, sign), kind::number);
    const double ratio = mode >= 1. ? option_value("--damping-for", wanted_.substr(sign + 1), kind::number) : 0.;
    if (!(mode >= 1.) || mode != std::floor(mode) || mode > 1e6 || !(ratio > 0.) || !(ratio < 1.))
      throw std::invalid_argument(wanted_text() +
                                  ": needs the number of a mode of the coupled machine, from 1, and its "
                                  "damping ratio between 0 and 1, such as 3=0.02");
    return {int(mode), ratio};
  }

  std::string wanted_;
};

} // namespace

AnalysisEntry damping_for_analysis()
{
  return analysis_entry<DampingForMode, DampingFor>("damping_for", "", {}, {}, "modes");
}

} // namespace gestell::apps
