#include "apps/output/interactive/machine_view.h"

#include "apps/output/interactive/machine_animation.h"
#include "apps/output/interactive/page_scripts.h"
#include "apps/output/interactive/short_motion.h"
#include "apps/output/pictures/skin.h"
#include "apps/output/text/base64.h"
#include "apps/output/text/html.h"
#include "apps/output/text/json.h"
#include "apps/output/values/colours.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

constexpr std::size_t most_instants = 100; ///< states of an animation; more make the page too large
/// largest displacement of an enlarged motion, of the machine's size: bodies must not pass through each other
constexpr double motion_size = 0.02;
constexpr double exactness   = 1e-4; ///< of the drawn positions, of the machine's size

/// Parts of an object at rest.
Json parts_json(const MachineAnimation &machine)
{
  Json parts = Json::array();
  for (const Shape &part : machine.parts())
  {
    std::vector<float>         points;
    std::vector<std::uint32_t> triangles, edges;
    for (const Eigen::Vector3d &x : part.points)
      points.insert(points.end(), {float(x[0]), float(x[1]), float(x[2])});
    for (const auto &t : part.triangles)
      triangles.insert(triangles.end(), t.begin(), t.end());
    constexpr double edge_degrees = 35.; // facets of discs enclose 10 to 30, walls 90
    for (const auto &e : sharp_edges({part.points, part.displacement, part.triangles}, edge_degrees))
      edges.insert(edges.end(), e.begin(), e.end());
    parts.push_back(
        {{"name", part.name}, {"points", base64(points)}, {"triangles", base64(triangles)}, {"edges", base64(edges)}});
  }
  return parts;
}

/// The tolerance applies to the largest displacement of a point; the norm of a column is at least that.
Json field_json(const Eigen::MatrixXd &motion, double tolerance)
{
  const ShortMotion field = short_motion(motion, tolerance);
  Json              json  = {{"weights", base64(field.weights)}, {"shapes", Json::array()}};
  for (const auto &shape : field.shapes)
    json["shapes"].push_back(base64(shape));
  return field.n_shapes() == 0 ? Json() : json;
}

double largest_displacement(const Eigen::MatrixXd &displacement)
{
  double largest = 0.;
  for (Eigen::Index k = 0; k < displacement.cols(); ++k)
    for (Eigen::Index i = 0; i < displacement.rows(); i += 3)
      largest = std::max(largest, displacement.col(k).segment<3>(i).norm());
  return largest;
}

template <typename Displacements>
double largest_of(const Displacements &all)
{
  double largest = 0.;
  for (const auto &one : all)
    largest = std::max(largest, largest_displacement(one));
  return largest;
}

/// Whether linear interpolation between adjacent instants is accurate.
bool is_smooth(const std::vector<PartMotion> &motions, const std::vector<double> &times,
               const MachineAnimation &machine)
{
  for (std::size_t i = 0; i < motions.size(); ++i)
  {
    const Shape     &part        = machine.parts()[i];
    constexpr double smooth_turn = 0.1; // deviation from linear interpolation, relative to the size of the part
    if (!is_straight(motions[i].ideal, times, smooth_turn * Skin{part.points, part.displacement, {}}.size()))
      return false;
  }
  return true;
}

/// An enlargement of two digits that people can read.
double round_enlargement(double x)
{
  if (!(x >= 1.))
    return 1.;
  const double digit = std::floor(std::log10(x)) - 1.;
  return digit >= 0. ? std::round(x / std::pow(10., digit)) * std::pow(10., digit) : std::round(10. * x) / 10.;
}

/// Fewer instants for many parts, to limit the size of the page; motion between them is then not interpolated.
std::size_t instants_of(std::size_t n_parts)
{
  constexpr std::size_t most_positions = 40000; // parts times instants: some MB
  constexpr std::size_t fewest         = 24;    // a film of one swing or two
  return std::clamp(most_positions / n_parts, fewest, most_instants);
}

Json motion_json(const MachineAnimation &machine, const Result &result)
{
  const std::size_t             most    = instants_of(machine.parts().size());
  const AnimationInstants       seen    = animation_instants(result, most);
  const bool                    thinned = most < most_instants && seen.times.size() < result.run->picture_times.size();
  const std::vector<float>      times(seen.times.begin(), seen.times.end());
  const std::vector<PartMotion> motions = machine.motion(seen.states);
  double                        top     = 0.;
  for (const PartMotion &part : motions)
    top = std::max(top, largest_displacement(part.displacement));
  const double enlargement = top > 0. ? round_enlargement(motion_size * machine.size() / top) : 1.;

  Json show = {{"kind", "motion"},
               {"id", "motion"},
               {"name", "motion"},
               {"times", base64(times)},
               {"smooth", !thinned && is_smooth(motions, seen.times, machine)},
               {"top", top},
               {"enlarge", enlargement},
               {"parts", Json::array()}};
  for (const PartMotion &part : motions)
    show["parts"].push_back({{"ideal", field_json(part.ideal, exactness * machine.size())},
                             {"moved", field_json(part.displacement, exactness * machine.size() / enlargement)}});
  return show;
}

/// @param id    see MachinePicture::show
/// @param size  [m] of the largest displacement as drawn
Json still_json(const std::string &kind, const std::string &id, const std::string &name,
                const std::vector<Eigen::VectorXd> &displacements, double size)
{
  const double most = largest_of(displacements);
  Json         show = {
              {"kind", kind},          {"id", id}, {"name", name}, {"top", most}, {"enlarge", most > 0. ? size / most : 1.},
              {"parts", Json::array()}};
  for (const Eigen::VectorXd &one : displacements)
    show["parts"].push_back({{"ideal", Json()}, {"moved", field_json(one, 1e-3 * most)}});
  return show;
}

std::string mode_name(const char *of, std::size_t j, const coupling::Mode &mode)
{
  return std::string(of) + " mode " + std::to_string(j + 1) + ": " + short_text(mode.frequency_hz) + " Hz";
}

/// Positions of the bodies at an instant, interpolated between the adjacent saved states; empty: no state is near.
Eigen::VectorXd state_at(const Result &result, double t)
{
  if (!result.run || result.run->picture_states.empty())
    return {};
  const auto &times  = result.run->picture_times;
  const auto &states = result.run->picture_states;
  const auto  after  = std::size_t(std::lower_bound(times.begin(), times.end(), t) - times.begin());
  if (after == 0 || after == times.size())
    return states[std::min(after, times.size() - 1)];
  const double share = (t - times[after - 1]) / (times[after] - times[after - 1]);
  return states[after - 1] + share * (states[after] - states[after - 1]);
}

/// Adds the bodies at the instant of a stress to the frame.
void put_bodies(Json &show, const MachineAnimation &machine, const Eigen::VectorXd &q)
{
  if (q.size() == 0)
    return;
  const std::vector<PartMotion> motions = machine.motion({q});
  for (std::size_t i = 1; i < motions.size(); ++i)
    show["parts"][i] = {{"ideal", field_json(motions[i].ideal, exactness * machine.size())},
                        {"moved", field_json(motions[i].displacement, exactness * machine.size())}};
}

/// The drawn point closest to a location.
std::size_t nearest_point(const Shape &shape, const Eigen::Vector3d &place)
{
  const auto nearer = [&](const Eigen::Vector3d &a, const Eigen::Vector3d &b)
  { return (a - place).squaredNorm() < (b - place).squaredNorm(); };
  return std::size_t(std::min_element(shape.points.begin(), shape.points.end(), nearer) - shape.points.begin());
}

Json stress_json(const MachineAnimation &machine, const StressAt &at, const std::string &id, double top,
                 const Eigen::VectorXd &q)
{
  std::vector<Eigen::VectorXd> displacements = machine.at_rest();
  std::vector<std::uint8_t>    colours;
  for (std::size_t i = 0; i < machine.frame_points().size(); ++i)
  {
    const int point                                               = machine.frame_points()[i];
    displacements[0].segment<3>(3 * static_cast<Eigen::Index>(i)) = at.displacement.col(point);
    colours.push_back(static_cast<std::uint8_t>(std::clamp(255. * at.field.von_mises(point) / top, 0., 255.)));
  }
  const DisplayUnit unit = display_unit("Pa", top);
  Json              show = still_json("stress", id,
                                      "stress" + (at.label.empty() ? "" : ", " + at.label) + ", t = " + short_text(at.t, 5) + " s",
                                      displacements, motion_size * machine.size());
  put_bodies(show, machine, q);
  show["colours"] = base64(colours);
  show["t"]       = at.t;
  if (at.peak)
    show["mark"] = nearest_point(machine.parts().front(), at.peak->at);
  show["scale"] = "equivalent stress 0 to " + short_text(top * unit.factor, 3) + " " + unit.unit;
  return show;
}

void add_stresses(Json &shows, const MachineAnimation &machine, const Result &result)
{
  if (!result.stress || !machine.has_frame() || result.stress->points.size() != result.scenery.points.size())
    return;
  double top = 0.;
  for (const StressAt &at : result.stress->instants)
    top = std::max(top, at.peak ? at.peak->von_mises : 0.);
  for (std::size_t k = 0; k < result.stress->instants.size(); ++k)
    if (const StressAt &at = result.stress->instants[k];
        top > 0. && at.field.von_mises.size() == at.displacement.cols())
      shows.push_back(stress_json(machine, at, "stress-" + std::to_string(k + 1), top, state_at(result, at.t)));
}

void add_fields(Json &shows, const MachineAnimation &machine, const Result &result)
{
  for (const SkinField &field : result.scenery.fields)
  {
    Json                      show = still_json("rest", "frame-" + field.id, field.name, machine.at_rest(), 0.);
    std::vector<std::uint8_t> colours;
    for (const int point : machine.frame_points())
      colours.push_back(static_cast<std::uint8_t>(std::clamp(255. * field.shades[std::size_t(point)], 0., 255.)));
    show.update({{"colours", base64(colours)}, {"scale", field.scale}});
    show["mark"] = nearest_point(machine.parts().front(), field.mark);
    shows.push_back(show);
  }
}

Json shows_json(const MachineAnimation &machine, const Result &result)
{
  Json shows = Json::array();
  if (result.run && !result.run->picture_states.empty())
    shows.push_back(motion_json(machine, result));
  // relative to the size of the machine: large enough to see, small enough that walls do not cross
  constexpr double      mode_size  = 0.05;
  const double          size       = mode_size * machine.size();
  constexpr std::size_t most_modes = 9; // buttons of one row
  for (std::size_t j = 0; j < std::min(result.coupled_modes.size(), most_modes); ++j)
    shows.push_back(still_json("mode", "coupled-" + std::to_string(j + 1),
                               mode_name("coupled", j, result.coupled_modes[j]),
                               machine.machine_mode(result.coupled_modes[j].shape), size));
  for (std::size_t j = 0; j < std::min(result.frame_modes.size(), most_modes) && machine.has_frame(); ++j)
    shows.push_back(still_json("mode", "frame-" + std::to_string(j + 1), mode_name("frame", j, result.frame_modes[j]),
                               machine.frame_mode(result.frame_modes[j].shape), size));
  add_stresses(shows, machine, result);
  add_fields(shows, machine, result);
  if (!result.run || result.run->picture_states.empty())
    shows.push_back(still_json("rest", "rest", "at rest", machine.at_rest(), size));
  return shows;
}

} // namespace

std::string machine_view(const Result &result)
{
  const MachineAnimation machine(result);
  if (machine.parts().empty() || page_libraries().empty())
    return "";
  const Json               shows = shows_json(machine, result);
  std::vector<std::string> colours, of_bodies;
  for (int i = 0; i < 32; ++i)
    colours.push_back(hex(scale_colour((i + 0.5) / 32.)));
  for (const Colour &colour : body_colours)
    of_bodies.push_back(hex(colour));
  const Json        data = {{"size", machine.size()},
                            {"has_frame", machine.has_frame()},
                            {"colours", colours},
                            {"frame_colour", hex(frame_colour)},
                            {"body_colours", of_bodies},
                            {"parts", parts_json(machine)},
                            {"shows", shows}};
  const std::string json = data.dump(-1, ' ', false, Json::error_handler_t::replace);
  return "<div class=\"machine\"><script type=\"application/json\">" + inside_script(json) +
         "</script></div>\n<noscript><p class=\"soft\">The 3-D view needs JavaScript. <code>gestell show</code> writes "
         "its pictures as files.</p></noscript>\n";
}

std::string machine_picture(const MachinePicture &picture, const std::string &caption)
{
  const auto attribute = [](const char *name, const std::optional<double> &x)
  { return x ? std::string(" data-") + name + "=\"" + exact_text(*x) + '"' : ""; };
  return "<figure class=\"machine-picture\" data-show=\"" + picture.show + '"' + attribute("t", picture.t) +
         attribute("later", picture.later) + attribute("enlarge", picture.enlargement) + "><figcaption>" + caption +
         "</figcaption></figure>\n";
}

} // namespace gestell::apps
