#include "coupling/substructures/parts_recipe.h"

#include "fem/values/number_text.h"

#include <map>

namespace gestell::coupling
{

namespace
{

/// Ingredients of one thing, each with all its digits.
class Ingredients
{
public:
  Ingredients(Recipe &recipe, std::string head) : recipe_(recipe), head_(std::move(head)) {}

  void add(const std::string &name, const std::string &value) { recipe_.push_back({head_ + name, value}); }
  void add(const std::string &name, double value) { add(name, exact_text(value)); }
  void add(const std::string &name, bool value) { add(name, std::string(value ? "yes" : "no")); }
  void add(const std::string &name, const std::optional<double> &value)
  {
    if (value)
      add(name, *value);
  }
  template <int rows, int columns>
  void add(const std::string &name, const Eigen::Matrix<double, rows, columns> &A)
  {
    std::string text;
    for (Eigen::Index i = 0; i < A.size(); ++i)
      text += (i > 0 ? " " : "") + exact_text(A.data()[i]);
    add(name, text);
  }

private:
  Recipe     &recipe_;
  std::string head_;
};

void add_ratios(Ingredients &recipe, const fem::ModalRatios &value)
{
  const auto &[constant, named, by_frequency] = value;
  recipe.add("damping", constant);
  for (const auto &[frequency, zeta] : by_frequency)
    recipe.add("damping at " + exact_text(frequency), zeta);
  for (const fem::NamedRatio &one : named)
  {
    const auto &[ratio, mode, from, to, points, shape, place] = one; // place: for messages
    const std::string name =
        "damping of mode " + std::to_string(mode) + ", " + exact_text(from) + " to " + exact_text(to);
    recipe.add(name, ratio);
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      recipe.add(name + ", point", Eigen::Matrix<double, 3, 1>(points[i].data()));
      recipe.add(name + ", real", Eigen::Matrix<double, 3, 1>(shape.segment(3 * Eigen::Index(i), 3).real()));
      recipe.add(name + ", imaginary", Eigen::Matrix<double, 3, 1>(shape.segment(3 * Eigen::Index(i), 3).imag()));
    }
  }
}

void add_bolts(Ingredients &recipe, const BoltedJoint &value)
{
  const auto &[axes, stiffness, damping, rotational, rotational_damping, positions, preload] = value;
  recipe.add("axes", axes);
  recipe.add("stiffness", stiffness);
  recipe.add("damping", damping);
  recipe.add("rotational stiffness", rotational);
  recipe.add("rotational damping", rotational_damping);
  for (std::size_t i = 0; i < positions.size(); ++i)
    recipe.add("position." + std::to_string(i + 1), positions[i]);
  recipe.add("preload", preload);
}

void add_tie_rod(Ingredients &recipe, const TieRod &value)
{
  const auto &[diameter, E, rho, length, damping, prestress, material, tension] = value; // tension: of the prestress
  recipe.add("diameter", diameter);
  recipe.add("E", E);
  recipe.add("rho", rho);
  recipe.add("length", length);
  recipe.add("damping", damping);
  recipe.add("prestress", prestress);
  recipe.add("material", material); // part of the facts of the frame
}

void add_joint(Recipe &recipe, const FrameJoint &value)
{
  const auto &[name, kind, between, normal, bolts, rod, tolerance, keep, place] = value;
  Ingredients own(recipe, "joint." + name + ".");
  own.add("kind", double(int(kind)));
  own.add("first", between[0].name());
  own.add("second", between[1].name());
  own.add("normal", normal);
  own.add("tolerance", tolerance);
  own.add("keep", keep);
  if (kind == JointKind::bolts)
    add_bolts(own, bolts);
  if (kind == JointKind::tie_rod)
    add_tie_rod(own, rod);
}

} // namespace

Recipe recipe_of(const FrameOfParts &frame, const ReductionOptions &options)
{
  Recipe recipe;
  for (const FramePart &part : frame.parts)
  {
    const std::string head = "part." + part.name + ".";
    for (const Ingredient &own : recipe_of(part.geometry, options))
      recipe.push_back({head + own.name, own.value});
    Ingredients placement(recipe, head + "placement.");
    placement.add("axes", part.placement.Q);
    placement.add("origin", part.placement.at);
  }
  for (const FrameJoint &joint : frame.joints)
    add_joint(recipe, joint);
  Ingredients whole(recipe, "joined.");
  add_ratios(whole, frame.modal_damping_ratio);
  whole.add("all modes", frame.all_modes);
  if (frame.prestress) // others keep their keys
  {
    whole.add("prestress.acceleration", Eigen::Vector3d(frame.prestress->acceleration.data()));
    whole.add("prestress.factor", frame.prestress->factor);
    whole.add("prestress.tie rods", frame.prestress->tie_rods);
  }
  return recipe;
}

std::vector<ReducedFrame> equal_parts_once(const FrameOfParts &frame, const ReductionOptions &options,
                                           const PartReduction &reduce)
{
  std::map<std::string, std::size_t> known;
  std::vector<ReducedFrame>          reduced;
  for (const FramePart &part : frame.parts)
  {
    const auto [equal, is_new] = known.emplace(content_key(recipe_of(part.geometry, options)), reduced.size());
    reduced.push_back(is_new ? reduce(part) : ReducedFrame(reduced[equal->second]));
  }
  return reduced;
}

} // namespace gestell::coupling
