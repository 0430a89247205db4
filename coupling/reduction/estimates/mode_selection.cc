#include "coupling/reduction/estimates/mode_selection.h"

#include "coupling/reduction/estimates/damper_attachment_modes.h"
#include "coupling/reduction/estimates/interface_receptance.h"
#include "fem/values/number_text.h"
#include "fem/values/two_pi.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gestell::coupling
{

namespace
{

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr int    most_modes = 200; ///< chosen: the largest count that a search proposes
constexpr double rule       = 3.5; // the book's

} // namespace

double highest_of_interest(const ReductionOptions &options, const RefinedModes &refined)
{
  if (options.frequency > 0. || refined.omega.size() == 0)
    return two_pi * options.frequency;
  return refined.omega(std::min<int>(elastic_of_interest, refined.omega.size()) - 1);
}

namespace
{

/// Largest error of the model's frequencies whose refined value lies within the limit.
double largest_error(const FrequencyEstimate &estimate, const RefinedModes &refined, double limit)
{
  double largest = 0.;
  for (int j = 0; j < refined.omega.size() && refined.omega(j) <= limit; ++j)
  {
    if (j + refined.n_rigid >= estimate.error.size())
      return INFINITY; // the model has no such mode at all
    largest = std::max(largest, estimate.error(j + refined.n_rigid));
  }
  return largest;
}

/// Fewest modes m whose model stays within the tolerance; the error falls with m.
int smallest_number(const ReducedMatrices &star, int n1, const RefinedModes &refined, double tolerance, double limit)
{
  int low = -1, high = int(star.M.rows()) - n1; // high is good, low is not
  while (high - low > 1)
  {
    const int  middle                 = (low + high) / 2;
    const auto error                  = largest_error(frequency_estimate(star, n1, middle, refined), refined, limit);
    (error <= tolerance ? high : low) = middle;
  }
  return high;
}

/// Whether the basis contains enough modes, and how many are needed.
struct Judgement
{
  bool        good = false;
  InsideCount fewest;
  std::string shortcoming; // if not good
};

Judgement judge_frequencies(const ReductionBasis &basis, const ReducedMatrices &star, const RefinedModes &refined,
                            double tolerance, double limit)
{
  const double error = largest_error(frequency_estimate(star, basis.n1(), basis.m(), refined), refined, limit);
  if (error > tolerance)
    return {false, {}, "a frequency error of " + percent(error)};
  return {true, {smallest_number(star, basis.n1(), refined, tolerance, limit)}, "a frequency that may be missing"};
}

/// @param more  whether there are more modes than the m known ones: modes alone may then be fewer than with shapes.
Judgement judge_receptance(const InterfaceReceptance &receptance, int m, bool more, double tolerance)
{
  Judgement    judgement;
  const double doubt = receptance.uncertainty();
  judgement.shortcoming =
      "an error of the interface's receptance of " + percent(receptance.error(m, Inside::modes) + doubt);
  constexpr double allowed_doubt = 0.1; // of the receptance of the full frame, as a share of the tolerance
  if (doubt >= allowed_doubt * tolerance)
    return judgement;
  const InsideCount modes  = receptance.fewest(tolerance - doubt, Inside::modes),
                    shapes = receptance.fewest(tolerance - doubt, Inside::modes_and_shapes);
  const bool by_shapes =
      shapes.enough() && (modes.enough() ? shapes.total() < modes.total() : shapes.total() <= m || !more);
  judgement.fewest = by_shapes ? shapes : modes;
  judgement.good   = judgement.fewest.enough();
  return judgement;
}

} // namespace

namespace
{

/// Coordinates of each interface in q1.
Groups groups_of(const std::vector<fem::Interface> &interfaces, const std::vector<int> &q1)
{
  Groups groups;
  for (const fem::Interface &interface : interfaces)
  {
    groups.emplace_back();
    for (const int i : interface.coordinates())
      groups.back().push_back(int(std::lower_bound(q1.begin(), q1.end(), i) - q1.begin()));
  }
  return groups;
}

/// " ('table' by itself 1.2 %)", the worst of several.
std::string worst_interface(const std::vector<fem::Interface> &interfaces, const std::vector<double> &errors,
                            double uncertainty)
{
  if (interfaces.size() < 2)
    return "";
  const auto worst = std::max_element(errors.begin(), errors.end()) - errors.begin();
  return " ('" + interfaces[worst].name + "' by itself " + percent(errors[worst] + uncertainty) + ")";
}

} // namespace

std::string receptance_statement(const InterfaceReceptance &receptance, const ReductionBasis &basis,
                                 const std::vector<fem::Interface> &interfaces, const InsideCount &inside,
                                 double frequency_hz, const DamperAttachmentModes *dampers)
{
  const auto   within_rule = int((basis.omega0.array() <= two_pi * rule * frequency_hz).count());
  const auto   known       = within_rule < basis.m() || basis.m() == 0;
  const auto   of_dampers  = dampers ? dampers->W.cols() : 0;
  const Inside which       = inside.shapes > 0 ? Inside::modes_and_shapes : Inside::modes;
  const double doubt       = dampers ? 0. : receptance.uncertainty();
  const double error       = dampers ? dampers->left : receptance.error(inside.modes, which) + doubt;
  const auto   each =
      dampers ? dampers->of_groups : receptance.errors_of(groups_of(interfaces, basis.q1), inside.modes, which);
  return "reduction: " + std::to_string(inside.modes) + " fixed-interface modes " +
         (inside.shapes > 0 ? "and " + std::to_string(inside.shapes) + " static shapes of the inertia " : "") +
         (of_dampers > 0 ? "and " + std::to_string(of_dampers) + " of dampers inside the frame " : "") +
         "keep the receptance of the interface up to " + rounded(frequency_hz) + " Hz within " + percent(error) +
         " of the full frame's" + worst_interface(interfaces, each, doubt) + "; the rule of " + rounded(rule) +
         " times the highest frequency would take " + (known ? "" : "at least ") + std::to_string(within_rule);
}

namespace
{

/// Number of internal coordinates with mass; if M is not negative, an upper bound of the number of modes.
int with_mass(const FixedInterfaceFrame &held, const std::vector<int> &q1)
{
  Eigen::VectorXd mass = held.mass_diagonal();
  mass(q1).setZero();
  return int((mass.array() > 0.).count());
}

MatrixXd side_by_side(const MatrixXd &A, const MatrixXd &B)
{
  MatrixXd both(A.rows(), A.cols() + B.cols());
  both << A, B;
  return both;
}

/// The estimate with the modes in the basis, and whether it is sufficient.
struct Look
{
  RefinedModes                       refined;
  double                             within  = 0.; // [rad/s] highest frequency of interest
  double                             highest = 0.; // [rad/s] below it all fixed-interface modes are known
  std::optional<InterfaceReceptance> receptance{}; // if the choice depends on it
  Judgement                          judgement{};

  bool good() const { return judgement.good && highest >= reach_of_basis * within; }
};

bool by_receptance(const ReductionBasis &basis, const ReductionOptions &options)
{
  return options.frequency > 0. && basis.n1() > 0;
}

/// @param n_modes  number of modes of the frame; those in the basis are all that can be computed if `last`.
Look look_at(const ReductionBasis &basis, int n_modes, bool last, const InterfaceStatics &statics,
             const fem::FrameMatrices &frame, const ReductionOptions &options)
{
  const int             m    = basis.m();
  const ReducedMatrices star = reduced_matrices(basis, frame.B);
  Look                  look{refined_modes(basis, star, statics.response, frame)};
  look.within    = highest_of_interest(options, look.refined);
  look.highest   = m > 0 && m < n_modes ? basis.omega0(m - 1) : INFINITY;
  look.judgement = {false, {}, "modes below that frequency out"};
  if (!by_receptance(basis, options))
    look.judgement = judge_frequencies(basis, star, look.refined, options.tolerance, look.within);
  else if (look.highest > look.within)
  {
    look.receptance.emplace(basis, star, statics.response, look.refined, frame.modal_damping_ratio, look.within);
    look.judgement = judge_receptance(*look.receptance, m, !last, options.tolerance);
  }
  return look;
}

ModeSelection too_few(Look look, int m, const ReductionOptions &options)
{
  ModeSelection found{std::move(look.refined)};
  found.notes.push_back("reduction: " + std::to_string(m) + " fixed-interface modes leave " +
                        look.judgement.shortcoming + " up to " + rounded(look.within / two_pi) +
                        " Hz, above the tolerance of " + percent(options.tolerance) +
                        "; reduce the frequency of interest or set the number of modes");
  return found;
}

/// Shapes for dampers inside the frame, where there are any and their effect can be known.
std::optional<DamperAttachmentModes> for_dampers(const Look &look, const ReductionBasis &basis, const MatrixXd &shapes,
                                                 const InterfaceStatics &statics, const fem::FrameMatrices &frame,
                                                 const ReductionOptions &options)
{
  if (!look.receptance || !has_inner_dampers(basis, frame.B))
    return std::nullopt;
  statics.begin("dampers inside the frame");
  const ReceptanceGoal goal{receptance_frequencies(look.refined, frame.modal_damping_ratio, look.within),
                            groups_of(frame.interfaces, basis.q1), options.tolerance, most_modes};
  return damper_attachment_modes(statics.held, frame, {basis, look.highest, look.judgement.fewest.modes, shapes}, goal);
}

ModeSelection enough(const Look &look, ReductionBasis &basis, const InterfaceStatics &statics,
                     const fem::FrameMatrices &frame, const ReductionOptions &options)
{
  const InsideCount &fewest = look.judgement.fewest;
  ModeSelection      found{look.refined, MatrixXd(frame.M.rows(), 0)};
  if (fewest.shapes > 0)
    found.shapes = inertia_shapes(statics.held, basis);
  const auto dampers = for_dampers(look, basis, found.shapes, statics, frame, options);
  if (dampers)
    found.shapes = side_by_side(found.shapes, dampers->W);
  if (look.receptance)
    found.statement = receptance_statement(*look.receptance, basis, frame.interfaces, fewest, options.frequency,
                                           dampers ? &*dampers : nullptr);
  if (dampers && dampers->left > options.tolerance)
    found.notes.push_back(std::exchange(found.statement, "") + "; that is above the tolerance of " +
                          percent(options.tolerance) +
                          (dampers->exhausted ? ", because dampers act where the frame has no mass"
                                              : ", because the dampers inside the frame are strong"));
  basis.truncate(fewest.modes);
  return found;
}

} // namespace

ModeSelection select_modes(ReductionBasis &basis, FixedInterfaceModes &fixed, const InterfaceStatics &statics,
                           const fem::FrameMatrices &frame, const ReductionOptions &options)
{
  const int        n_modes = with_mass(statics.held, basis.q1), most = std::min(n_modes, most_modes);
  constexpr int    first_modes = 30;  // at the first look; five more get to most_modes
  constexpr double growth      = 1.5; // from try to try: all of them together cost three times the last at most
  for (int m = std::min(first_modes, most);; m = std::min(most, int(std::ceil(growth * m))))
  {
    statics.begin("fixed-interface modes", double(m) / most);
    fixed.find(m);
    const LowestModes modes = fixed.lowest(m);
    basis.set_modes(modes.V, modes.omega);
    statics.begin("error estimate");
    Look       look       = look_at(basis, n_modes, m == most, statics, frame, options);
    const bool more_helps = by_receptance(basis, options) || look.highest < rule * look.within;
    if (!look.good() && m < most && more_helps)
      continue;
    ModeSelection found =
        look.good() ? enough(look, basis, statics, frame, options) : too_few(std::move(look), m, options);
    if (basis.m() < m)
      fixed.find(basis.m()); // known by then: that many are to be proved complete
    fixed.finish();
    fixed.forget_shapes();
    return found;
  }
}

} // namespace gestell::coupling
