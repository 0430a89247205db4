#include "apps/output/report/frame_text.h"

#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

/// Zeros that are only rounding are said to be zero.
std::string triple(const Eigen::Vector3d &x, double scale)
{
  std::string text = "[";
  for (int d = 0; d < 3; ++d)
    text += (d > 0 ? ", " : "") + short_text(std::abs(x[d]) > 1e-9 * scale ? x[d] : 0., 6);
  return text + "]";
}

std::string mass_line(const fem::FrameFacts &frame)
{
  std::string           line         = "mass " + short_text(frame.whole.mass, 6) + " kg";
  constexpr std::size_t parts_listed = 20; // to fit on a screen with the other lines
  for (std::size_t i = 0; i < std::min(frame.parts.size(), parts_listed); ++i)
  {
    const auto &[name, material, mass] = frame.parts[i];
    line += (i == 0 ? ": " : ", ") + name + " " + short_text(mass, 6) + " kg " +
            (material.empty() ? "attached" : "of " + material);
  }
  return line + (frame.parts.size() > parts_listed ? ", ..." : "");
}

std::string inertia_line(const fem::MassProperties &whole)
{
  const Eigen::Matrix3d &J      = whole.inertia;
  const double           radius = std::sqrt(J.trace() / whole.mass);
  return "centre of mass " + triple(whole.centre, radius) + " m, moments of inertia about it " +
         triple(J.diagonal(), J.trace()) + " kg m^2, products Jxy, Jxz, Jyz " +
         triple({J(0, 1), J(0, 2), J(1, 2)}, J.trace()) + " kg m^2";
}

std::string free_line(const ModelFacts &model)
{
  const auto &names = model.frame.free_motions;
  const int   n     = std::max(model.free_motions, static_cast<int>(names.size()));
  std::string line  = std::to_string(n) + (n == 1 ? " rigid-body mode" : " rigid-body modes");
  for (std::size_t i = 0; i < names.size(); ++i)
    line += (i == 0 ? ": " : ", ") + names[i];
  if (const int more = n - static_cast<int>(names.size()); more > 0)
    line += names.empty()
                ? ""
                : ", and " + std::to_string(more) + " more in which parts of the frame move relative to each other";
  return line;
}

} // namespace

bool any_refined(const std::vector<coupling::Mode> &modes)
{
  return std::any_of(modes.begin(), modes.end(), [](const auto &mode) { return !std::isnan(mode.refined_hz); });
}

const char *const refined_words =
    "The machine uses the reduced frame, whose frequencies are upper bounds of those of the full mesh. Refined "
    "frequencies, from one more step of inverse iteration, are closer upper bounds.";

const char *const static_residual_words =
    "The static load not represented by the modes is the share of the deflection energy under the frame's own weight "
    "that the retained modes miss. The static response at the interfaces is exact. Signals and stresses are corrected "
    "for "
    "constant weight; the missing share matters only if the whole frame accelerates rapidly. To reduce it, retain more "
    "modes or set reduction.inertia_relief.";

std::string words_above(double limit, double before, double frequency)
{
  const double reach = 1.02 * limit; // the limit may be a mode's frequency, now known more accurately
  if (!(before <= reach && frequency > reach))
    return "";
  return "above " + short_text(limit, 4) +
         " Hz, the frequency limit of the reduced frame, frequencies are inaccurate (raise reduction.frequency)";
}

std::vector<std::string> frame_text(const ModelFacts &model)
{
  std::vector<std::string> lines;
  if (model.frame.whole.mass > 0.)
  {
    lines.push_back(mass_line(model.frame));
    lines.push_back(inertia_line(model.frame.whole));
  }
  else if (model.frame_mass > 0.)
    lines.push_back("mass " + short_text(model.frame_mass, 6) + " kg");
  constexpr double rounding = 1e-11; // of the energies that cancel in a rigid motion
  if (const double share = model.frame.rigid_energy; !std::isnan(share))
    lines.push_back("elastic energy of rigid-body displacements without supports: " + short_text(share, 2) +
                    " of the terms that cancel" +
                    (share < rounding ? " (rounding error)" : " (above rounding error; check the mesh)"));
  if (model.free_motions > 0 || !model.frame.free_motions.empty())
    lines.push_back(free_line(model));
  if (!model.damping.empty())
    lines.push_back("damping: " + model.damping);
  if (!model.mesh.empty())
    lines.push_back("mesh: " + model.mesh);
  lines.insert(lines.end(), model.statements.begin(), model.statements.end());
  return lines;
}

} // namespace gestell::apps
