#include "apps/output/interactive/machine_animation.h"

#include "apps/output/pictures/chosen_pictures.h"
#include "apps/output/pictures/machine_state.h"
#include "apps/output/pictures/mechanism_shapes.h"
#include "apps/output/pictures/scenery_skin.h"

#include <algorithm>
#include <cmath>

namespace gestell::apps
{
namespace
{

double area(const Skin &skin)
{
  double sum = 0.;
  for (const auto &[a, b, c] : skin.triangles)
    sum += 0.5 * (skin.points[b] - skin.points[a]).cross(skin.points[c] - skin.points[a]).norm();
  return sum;
}

/// A plane has two triangles in each cell of the grid, an edge more: a skin with too many begins there.  Their number
/// falls with a power of the cell's edge; each step takes that of the one before, at first the square of planes.
CoarseMesh coarse(const Skin &skin, std::size_t most)
{
  double edge = skin.size() / 150., inverse_power = 0.5;
  if (skin.triangles.size() > most)
    edge = std::max(edge, std::sqrt(2. * area(skin) / double(most)));
  CoarseMesh mesh = coarse_mesh(skin, edge);
  while (mesh.triangles.size() > most)
  {
    const double n      = double(mesh.triangles.size());
    const double factor = std::clamp(std::pow(n / double(most), inverse_power), 1.15, 2.);
    mesh                = coarse_mesh(skin, edge *= factor);
    inverse_power       = std::log(factor) / std::log(n / double(mesh.triangles.size()));
  }
  return mesh;
}

/// A CAD body on fewer triangles; shapes of our own have few.
void lighten(DrawnPart &part)
{
  constexpr std::size_t most_body_triangles = 3000; // bodies move as rigid ones: less detail than the frame
  if (part.triangles.size() <= most_body_triangles)
    return;
  Skin skin;
  for (const auto &x : part.points)
    skin.points.emplace_back(x[0], x[1], x[2]);
  skin.displacement.resize(skin.points.size(), Eigen::Vector3d::Zero());
  skin.triangles                          = part.triangles;
  const CoarseMesh                   mesh = coarse(skin, most_body_triangles);
  std::vector<std::array<double, 3>> few;
  for (const int i : mesh.points)
    few.push_back(part.points[static_cast<std::size_t>(i)]);
  part.points    = few;
  part.triangles = mesh.triangles;
}

Eigen::VectorXd column(const std::vector<Eigen::Vector3d> &points)
{
  Eigen::VectorXd all(3 * static_cast<Eigen::Index>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i)
    all.segment<3>(3 * static_cast<Eigen::Index>(i)) = points[i];
  return all;
}

/// Configuration of the linearised modes; without modes the first saved state of the run.
Eigen::VectorXd rest_of(const Result &result)
{
  if (result.modes_at.size() > 0 || !result.run || result.run->picture_states.empty())
    return result.modes_at;
  return result.run->picture_states.front();
}

void add_instant(AnimationInstants &seen, double t, const Eigen::VectorXd &q)
{
  const auto at = std::lower_bound(seen.times.begin(), seen.times.end(), t);
  if (at != seen.times.end() && *at == t)
    return;
  seen.states.insert(seen.states.begin() + (at - seen.times.begin()), q);
  seen.times.insert(at, t);
}

} // namespace

AnimationInstants animation_instants(const Result &result, std::size_t most)
{
  AnimationInstants seen;
  for (const std::size_t k : chosen_pictures(result, most))
  {
    seen.times.push_back(result.run->picture_times[k]);
    seen.states.push_back(result.run->picture_states[k]);
  }
  if (const auto &peak = result.peak; peak && !seen.states.empty() && peak->q.size() == seen.states.front().size())
    add_instant(seen, peak->t, peak->q);
  return seen;
}

MachineAnimation::MachineAnimation(const Result &result)
    : scenery_(result.scenery), rest_(rest_of(result)), size_(result.scenery.size())
{
  for (DrawnPart &part : scenery_.parts)
    lighten(part);
  if (scenery_.has_skin())
  {
    const Skin            skin                 = skin_of(scenery_, Eigen::VectorXd::Zero(scenery_.n_frame));
    constexpr std::size_t most_frame_triangles = 6500; // displacements of their corners fill most of the page
    CoarseMesh            mesh                 = coarse(skin, most_frame_triangles);
    Shape                 frame{"frame", {}, {}, mesh.triangles};
    chosen_ = mesh.points;
    for (const int i : chosen_)
      frame.points.push_back(skin.points[static_cast<std::size_t>(i)]);
    frame.displacement.resize(frame.points.size(), Eigen::Vector3d::Zero());
    parts_.push_back(frame);
    constexpr int most_columns = 400; // of a reduced frame: displacements of each point for each of them
    if (scenery_.n_frame <= most_columns)
      displacements_ = displacements_of_coordinates();
  }
  for (const Shape &body : bodies(rest_))
    parts_.push_back(body);
}

std::vector<Shape> MachineAnimation::bodies(const Eigen::VectorXd &q) const
{
  return q.size() > 0 ? mechanism_shapes(scenery_, q) : std::vector<Shape>();
}

Eigen::MatrixXd MachineAnimation::displacements_of_coordinates() const
{
  return frame_displacements(Eigen::MatrixXd::Identity(scenery_.n_frame, scenery_.n_frame));
}

Eigen::MatrixXd MachineAnimation::frame_displacements(const Eigen::MatrixXd &p) const
{
  if (displacements_.size() > 0)
    return displacements_ * p;
  Eigen::MatrixXd u(3 * static_cast<Eigen::Index>(chosen_.size()), p.cols());
  for (Eigen::Index k = 0; k < p.cols(); ++k)
    u.col(k) = displacement_of(p.col(k));
  return u;
}

Eigen::VectorXd MachineAnimation::displacement_of(const Eigen::VectorXd &p) const
{
  const Eigen::VectorXd all = scenery_.displacement(p);
  Eigen::VectorXd       few(3 * static_cast<Eigen::Index>(chosen_.size()));
  for (std::size_t i = 0; i < chosen_.size(); ++i)
    few.segment<3>(3 * static_cast<Eigen::Index>(i)) = all.segment<3>(3 * chosen_[i]);
  return few;
}

std::vector<PartMotion> MachineAnimation::motion(const std::vector<Eigen::VectorXd> &states) const
{
  const auto              n = static_cast<Eigen::Index>(states.size());
  std::vector<PartMotion> motions;
  for (const Shape &part : parts_)
  {
    const auto size = 3 * static_cast<Eigen::Index>(part.points.size());
    motions.push_back({Eigen::MatrixXd::Zero(size, n), Eigen::MatrixXd::Zero(size, n)});
  }
  const std::size_t first_body = has_frame() ? 1 : 0;
  Eigen::MatrixXd   of_frame(scenery_.n_frame, n);
  for (Eigen::Index k = 0; k < n; ++k)
  {
    const Eigen::VectorXd   &q  = states[static_cast<std::size_t>(k)];
    const std::vector<Shape> at = bodies(q);
    if (has_frame())
      of_frame.col(k) = q.head(scenery_.n_frame);
    for (std::size_t i = 0; i < at.size() && first_body + i < parts_.size(); ++i)
      if (const Shape &rest = parts_[first_body + i]; rest.points.size() == at[i].points.size())
      {
        motions[first_body + i].ideal.col(k)        = column(at[i].points) - column(rest.points);
        motions[first_body + i].displacement.col(k) = column(at[i].displacement);
      }
  }
  if (has_frame())
    motions[0].displacement = frame_displacements(of_frame);
  return motions;
}

std::vector<Eigen::VectorXd> MachineAnimation::at_rest() const
{
  std::vector<Eigen::VectorXd> displacements;
  for (const Shape &part : parts_)
    displacements.push_back(Eigen::VectorXd::Zero(3 * static_cast<Eigen::Index>(part.points.size())));
  return displacements;
}

std::vector<Eigen::VectorXd> MachineAnimation::frame_mode(const Eigen::VectorXd &shape) const
{
  std::vector<Eigen::VectorXd> displacements = at_rest();
  if (has_frame())
    displacements[0] = frame_displacements(shape.head(scenery_.n_frame));
  return displacements;
}

std::vector<Eigen::VectorXd> MachineAnimation::machine_mode(const Eigen::VectorXd &shape) const
{
  std::vector<Eigen::VectorXd> displacements = frame_mode(shape);
  if (rest_.size() != shape.size())
    return displacements;
  std::size_t part = has_frame() ? 1 : 0;
  for (const std::vector<Eigen::Vector3d> &body : body_mode(scenery_, rest_, shape))
    displacements[part++] = column(body);
  return displacements;
}

} // namespace gestell::apps
