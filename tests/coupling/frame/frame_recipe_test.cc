#include "coupling/frame/frame_recipe.h"

#include "tests/support/frame_folder.h"
#include "tests/support/test.h"

#include <type_traits>

namespace gestell
{
namespace
{

namespace fs = std::filesystem;
using test::FrameFolder;

template <typename Frame>
std::string key_of(const Frame &frame, const coupling::ReductionOptions &options)
{
  return coupling::content_key(coupling::recipe_of(frame, options));
}

class ContentKey : public FrameFolder
{
protected:
  fem::FrameSpecification    frame;
  coupling::ReductionOptions options;
  void                       SetUp() override
  {
    FrameFolder::SetUp();
    frame.cad = (folder / "frame.step").string();
    std::ofstream(frame.cad) << "ISO-10303-21;";
    frame.material         = {210e9, 0.3, 7850., "scene.toml:3"};
    frame.surfaces["feet"] = {};
    frame.supports = {{"feet", {"feet"}, fem::SupportKind::clamped, {true, true, true}, {}, {}, "scene.toml:9"}};
  }
};

TEST_F(ContentKey, IsAHexadecimalNumberOf256Bits)
{
  const std::string key = key_of(frame, options);
  EXPECT_EQ(key.size(), 64u);
  EXPECT_EQ(key.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST_F(ContentKey, ForgetsPlacesAndPaths)
{
  const std::string key  = key_of(frame, options);
  auto              same = frame;
  same.place = same.material.place = same.supports[0].place = "elsewhere.toml:1";
  same.cad                                                  = (folder / "copy.step").string();
  fs::copy_file(frame.cad, same.cad);
  auto same_options    = options;
  same_options.place   = "elsewhere.toml:2";
  same_options.n_modes = -7; // as automatic as -1
  EXPECT_EQ(key_of(same, same_options), key);
}

/// Changes one value after another and follows which ingredients that changes.
template <typename Frame>
class IngredientsUnderChange
{
public:
  IngredientsUnderChange(const Frame &frame, const coupling::ReductionOptions &options)
      : frame_(frame), options_(options), before_(coupling::recipe_of(frame, options))
  {
  }

  /// Just this ingredient, and those whose names begin with its own and a dot.
  template <typename Change>
  void expect(const std::string &name, const Change &change)
  {
    Frame other   = frame_;
    auto  options = options_;
    if constexpr (std::is_invocable_v<Change, Frame &>)
      change(other);
    else
      change(options);
    bool found = false;
    for (const auto &difference : coupling::differences(before_, coupling::recipe_of(other, options)))
    {
      const std::string &changed = difference.name;
      EXPECT_TRUE(changed == name || changed.rfind(name + ".", 0) == 0) << changed << " under a change of " << name;
      found = found || changed == name;
      seen_.insert(changed);
    }
    EXPECT_TRUE(found) << name;
  }

  void expect_all_seen(const std::set<std::string> &of_the_program) const
  {
    for (const auto &ingredient : before_)
      EXPECT_TRUE(seen_.count(ingredient.name) + of_the_program.count(ingredient.name) > 0)
          << ingredient.name << ": no value here changes it";
  }

private:
  Frame                      frame_;
  coupling::ReductionOptions options_;
  coupling::Recipe           before_;
  std::set<std::string>      seen_;
};

fem::ModalRatios some_ratios()
{
  fem::ModalRatios ratios = 0.01;
  ratios.by_frequency     = {{10., 0.03}};
  ratios.named            = {{0.04, 2, 5., 6., {}, Eigen::VectorXcd::Ones(3), "there"}};
  return ratios;
}

/// Every value of a specification is given, so that each has an ingredient.
fem::FrameSpecification with_all_values(fem::FrameSpecification frame)
{
  const fem::Material cast_iron{110e9, 0.28, 7200., "", "cast iron"};
  frame.unit                = 1e-3;
  frame.mesh.surface_size   = {{"feet", 0.05}};
  frame.materials           = {{"rib*", cast_iron}};
  frame.modal_damping_ratio = some_ratios();
  frame.surfaces["feet"]    = {{{{0., 0., 1.}, {0., 0., 0.}, 0.1}},
                               {{{0., 0., 1.}, {0., 0., 0.}}},
                               {{{0., 0., 0.}, {1., 1., 1.}}},
                               "feet of steel",
                               1e-4,
                               2,
                               ""};
  frame.interfaces.push_back({"top", {"feet"}, fem::InterfaceCoupling::rigid, fem::Vector3{}, "", 0.01, 1});
  frame.masses.push_back(
      {"motor", 100., Eigen::Matrix3d::Identity(), fem::Vector3{}, "top", {"feet"}, fem::InterfaceCoupling::rigid, ""});
  frame.cuts.push_back({"middle", {0., 0., 1.}, {0., 0., 1.}, "", fem::Vector3{1., 0., 0.}, fem::Vector3{}});
  frame.stress_points.push_back({"root", {0., 0., 1.}, fem::Vector3{0., 1., 0.}, ""});
  return frame;
}

using Specification = fem::FrameSpecification;
using Matrices      = fem::FrameMatrices;
using Options       = coupling::ReductionOptions;

template <typename Frame>
void expect_options(IngredientsUnderChange<Frame> &recipe)
{
  recipe.expect("reduction.method", [](Options &o) { o.method = "free-interface"; });
  recipe.expect("reduction.tolerance", [](Options &o) { o.tolerance = 0.02; });
  recipe.expect("reduction.frequency", [](Options &o) { o.frequency = 100.; });
  recipe.expect("reduction.factor", [](Options &o) { o.factor = "cholmod"; });
  recipe.expect("reduction.eigensolver", [](Options &o) { o.eigensolver = "krylovschur"; });
  recipe.expect("reduction.inertia relief", [](Options &o) { o.inertia_relief = true; });
}

TEST_F(ContentKey, HasEveryValueAsAnIngredientOfItsOwn)
{
  std::ofstream(folder / "other.step") << "ISO-10303-21; ";
  std::ofstream(folder / "frame.brep") << "ISO-10303-21;";
  IngredientsUnderChange<Specification> recipe(with_all_values(frame), options);
  recipe.expect("source 1", [&](Specification &f) { f.cad = (folder / "other.step").string(); });
  recipe.expect("kind of file", [&](Specification &f) { f.cad = (folder / "frame.brep").string(); });
  recipe.expect("unit", [](Specification &f) { f.unit = 1.; });
  recipe.expect("mesh.size", [](Specification &f) { f.mesh.size = 0.08; });
  recipe.expect("mesh.surface.feet", [](Specification &f) { f.mesh.surface_size["feet"] = 0.06; });
  recipe.expect("mesh.max_cells", [](Specification &f) { f.mesh.max_cells = 1e6; });
  recipe.expect("mesh.gap", [](Specification &f) { f.mesh.gap = 1e-4; });
  recipe.expect("mesh.bodies", [](Specification &f) { f.mesh.bodies = 2; });
  recipe.expect("mesh.defeature", [](Specification &f) { f.mesh.defeature = 1e-3; });
  recipe.expect("mesh.overlaps", [](Specification &f) { f.mesh.overlaps = fem::Overlaps::once; });
  recipe.expect("mesh.curved", [](Specification &f) { f.mesh.curved = true; });
  recipe.expect("mesh.plates", [](Specification &f) { f.mesh.plates = fem::Plates::swept; });
  recipe.expect("mesh.layers", [](Specification &f) { f.mesh.layers = 2; });
  recipe.expect("material.E", [](Specification &f) { f.material.E *= 1. + 1e-15; });
  recipe.expect("material.nu", [](Specification &f) { f.material.nu = 0.31; });
  recipe.expect("material.rho", [](Specification &f) { f.material.rho = 7851.; });
  recipe.expect("material.name", [](Specification &f) { f.material.name = "another"; });
  recipe.expect("materials", [](Specification &f) { f.materials.push_back(f.materials[0]); });
  recipe.expect("materials.1", [](Specification &f) { f.materials[0].first = "web*"; });
  recipe.expect("materials.1.with.E", [](Specification &f) { f.materials[0].second.E = 120e9; });
  recipe.expect("materials.1.with.nu", [](Specification &f) { f.materials[0].second.nu = 0.27; });
  recipe.expect("materials.1.with.rho", [](Specification &f) { f.materials[0].second.rho = 7100.; });
  recipe.expect("materials.1.with.name", [](Specification &f) { f.materials[0].second.name = "GJL"; });
  recipe.expect("damping.ratio", [](Specification &f) { f.modal_damping_ratio = 0.02; });
  recipe.expect("damping.ratio.named", [](Specification &f) { f.modal_damping_ratio.named.resize(2); });
  recipe.expect("damping.ratio.by_frequency",
                [](Specification &f) {
                  f.modal_damping_ratio.by_frequency.push_back({20., 0.03});
                });
  recipe.expect("damping.ratio.by_frequency.1",
                [](Specification &f) { f.modal_damping_ratio.by_frequency[0].first = 11.; });
  recipe.expect("damping.ratio.by_frequency.1.with",
                [](Specification &f) { f.modal_damping_ratio.by_frequency[0].second = 0.04; });
  recipe.expect("damping.ratio.named.1", [](Specification &f) { f.modal_damping_ratio.named[0].ratio = 0.05; });
  recipe.expect("damping.ratio.named.1.mode", [](Specification &f) { f.modal_damping_ratio.named[0].mode = 3; });
  recipe.expect("damping.ratio.named.1.from", [](Specification &f) { f.modal_damping_ratio.named[0].from = 4.; });
  recipe.expect("damping.ratio.named.1.to", [](Specification &f) { f.modal_damping_ratio.named[0].to = 7.; });
  recipe.expect("damping.ratio.named.1.points",
                [](Specification &f) { f.modal_damping_ratio.named[0].points.resize(1); });
  recipe.expect("damping.ratio.named.1.shape", [](Specification &f) { f.modal_damping_ratio.named[0].shape[1] = 2.; });
  recipe.expect("damping.ratio.named.1.phase",
                [](Specification &f) { f.modal_damping_ratio.named[0].shape[1].imag(2.); });
  recipe.expect("damping.rayleigh mass", [](Specification &f) { f.rayleigh_mass = 2.; });
  recipe.expect("damping.rayleigh stiffness", [](Specification &f) { f.rayleigh_stiffness = 1e-5; });
  const auto surface = [&](const std::string &name, auto change)
  { recipe.expect("surface.feet." + name, [&](Specification &f) { change(f.surfaces["feet"]); }); };
  using Selector = fem::SurfaceSelector;
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::string direction = "." + std::to_string(i + 1);
    surface("cylinder.axis" + direction, [i](Selector &s) { s.cylinder->axis[i] += 0.5; });
    surface("cylinder.through" + direction, [i](Selector &s) { s.cylinder->through[i] += 0.5; });
    surface("plane.normal" + direction, [i](Selector &s) { s.plane->normal[i] += 0.5; });
    surface("plane.through" + direction, [i](Selector &s) { s.plane->through[i] += 0.5; });
    surface("box.min" + direction, [i](Selector &s) { s.box->min[i] += 0.5; });
    surface("box.max" + direction, [i](Selector &s) { s.box->max[i] += 0.5; });
    recipe.expect("support.1.held" + direction, [i](Specification &f) { f.supports[0].held[i] = false; });
    recipe.expect("support.1.stiffness" + direction, [i](Specification &f) { f.supports[0].stiffness[i] = 1e6; });
    recipe.expect("support.1.damping" + direction, [i](Specification &f) { f.supports[0].damping[i] = 1e3; });
    for (std::size_t j = 0; j < 3; ++j)
      recipe.expect("support.1.axes" + direction + "." + std::to_string(j + 1),
                    [i, j](Specification &f) { f.supports[0].axes[i][j] += 0.5; });
    recipe.expect("interface.1.position" + direction, [i](Specification &f) { (*f.interfaces[0].position)[i] = 0.1; });
    recipe.expect("mass.1.centre" + direction, [i](Specification &f) { (*f.masses[0].centre)[i] = 0.1; });
    recipe.expect("cut.1.through" + direction, [i](Specification &f) { f.cuts[0].through[i] += 0.5; });
    recipe.expect("cut.1.normal" + direction, [i](Specification &f) { f.cuts[0].normal[i] += 0.5; });
    recipe.expect("cut.1.first" + direction, [i](Specification &f) { (*f.cuts[0].first)[i] += 0.5; });
    recipe.expect("cut.1.about" + direction, [i](Specification &f) { (*f.cuts[0].about)[i] += 0.5; });
    recipe.expect("stress point.1.at" + direction, [i](Specification &f) { f.stress_points[0].at[i] += 0.5; });
    recipe.expect("stress point.1.along" + direction, [i](Specification &f) { (*f.stress_points[0].along)[i] += 0.5; });
  }
  surface("cylinder.radius", [](Selector &s) { s.cylinder->radius = 0.2; });
  surface("group", [](Selector &s) { s.group = "feet of iron"; });
  surface("tolerance", [](Selector &s) { s.tolerance = 1e-3; });
  surface("faces", [](Selector &s) { s.faces = 4; });
  recipe.expect("support", [](Specification &f) { f.supports.push_back(f.supports[0]); });
  recipe.expect("support.1", [](Specification &f) { f.supports[0].name = "table"; });
  recipe.expect("support.1.surfaces", [](Specification &f) { f.supports[0].surfaces.push_back("table"); });
  recipe.expect("support.1.surfaces.1", [](Specification &f) { f.supports[0].surfaces = {"table"}; });
  recipe.expect("support.1.kind", [](Specification &f) { f.supports[0].kind = fem::SupportKind::foundation; });
  recipe.expect("support.1.per_area.1", [](Specification &f) { f.supports[0].per_area[0] = true; });
  recipe.expect("support.1.per_area.2", [](Specification &f) { f.supports[0].per_area[1] = true; });
  recipe.expect("interface", [](Specification &f) { f.interfaces.push_back(f.interfaces[0]); });
  recipe.expect("interface.1", [](Specification &f) { f.interfaces[0].name = "crown"; });
  recipe.expect("interface.1.surfaces", [](Specification &f) { f.interfaces[0].surfaces.push_back("table"); });
  recipe.expect("interface.1.surfaces.1", [](Specification &f) { f.interfaces[0].surfaces = {"table"}; });
  recipe.expect("interface.1.coupling",
                [](Specification &f) { f.interfaces[0].coupling = fem::InterfaceCoupling::average; });
  recipe.expect("interface.1.radius", [](Specification &f) { f.interfaces[0].radius = 0.02; });
  recipe.expect("interface.1.degree", [](Specification &f) { f.interfaces[0].degree = 2; });
  recipe.expect("mass", [](Specification &f) { f.masses.push_back(f.masses[0]); });
  recipe.expect("mass.1", [](Specification &f) { f.masses[0].name = "gear"; });
  recipe.expect("mass.1.mass", [](Specification &f) { f.masses[0].mass = 101.; });
  for (int i = 0; i < 9; ++i)
    recipe.expect("mass.1.inertia." + std::to_string(i + 1),
                  [i](Specification &f) { f.masses[0].inertia.data()[i] = 3.; });
  recipe.expect("mass.1.interface", [](Specification &f) { f.masses[0].interface = "crown"; });
  recipe.expect("mass.1.surfaces", [](Specification &f) { f.masses[0].surfaces.push_back("table"); });
  recipe.expect("mass.1.surfaces.1", [](Specification &f) { f.masses[0].surfaces = {"table"}; });
  recipe.expect("mass.1.coupling", [](Specification &f) { f.masses[0].coupling = fem::InterfaceCoupling::average; });
  recipe.expect("cut", [](Specification &f) { f.cuts.push_back(f.cuts[0]); });
  recipe.expect("cut.1", [](Specification &f) { f.cuts[0].name = "foot"; });
  recipe.expect("stress point", [](Specification &f) { f.stress_points.push_back(f.stress_points[0]); });
  recipe.expect("stress point.1", [](Specification &f) { f.stress_points[0].name = "foot"; });
  recipe.expect("stress", [](Specification &f) { f.stress = true; });
  recipe.expect("parts", [](Specification &f) { f.parts = 3; });
  recipe.expect("sew", [](Specification &f) { f.sew = 1e-4; });
  expect_options(recipe);
  recipe.expect_all_seen({"sources of the program", "missing", "mass.1.inertia"});
}

TEST_F(ContentKey, OfAGivenNumberOfModesHasItInPlaceOfTheTolerance)
{
  options.n_modes = 12;
  IngredientsUnderChange<Specification> recipe(frame, options);
  recipe.expect("reduction.modes", [](Options &o) { o.n_modes = 13; });
  recipe.expect("reduction.frequency", [](Options &o) { o.frequency = 100.; }); // what the frame says of its limits
}

TEST_F(ContentKey, OfMatricesHasEveryValueAsAnIngredientOfItsOwn)
{
  Matrices matrices;
  matrices.M                   = Eigen::Matrix3d(Eigen::Vector3d(1., 2., 3.).asDiagonal()).sparseView();
  matrices.B                   = matrices.M;
  matrices.C                   = 4. * matrices.M;
  matrices.translations        = Eigen::MatrixXd::Zero(3, 3);
  matrices.modal_damping_ratio = some_ratios();
  matrices.interfaces          = {{"top", {}, {0, -1, -1, -1, -1, -1}, {1., 1., 1., 1., 1., 1.}}};
  matrices.outputs             = {{"cut.a", "N", Eigen::VectorXd::Ones(3), Eigen::VectorXd::Zero(3)}};
  IngredientsUnderChange<Matrices> recipe(matrices, options);
  recipe.expect("mass", [](Matrices &f) { f.M.coeffRef(0, 0) += 1e-15; });
  recipe.expect("mass", [](Matrices &f) { f.M.coeffRef(0, 1) = 0.; });
  recipe.expect("damping", [](Matrices &f) { f.B.coeffRef(0, 0) = 2.; });
  recipe.expect("stiffness", [](Matrices &f) { f.C.coeffRef(0, 0) = 2.; });
  recipe.expect("damping.ratio", [](Matrices &f) { f.modal_damping_ratio = 0.02; });
  recipe.expect("damping.ratio.named", [](Matrices &f) { f.modal_damping_ratio.named.resize(2); });
  recipe.expect("damping.ratio.by_frequency",
                [](Matrices &f) {
                  f.modal_damping_ratio.by_frequency.push_back({20., 0.03});
                });
  recipe.expect("damping.ratio.by_frequency.1", [](Matrices &f) { f.modal_damping_ratio.by_frequency[0].first = 11.; });
  recipe.expect("damping.ratio.by_frequency.1.with",
                [](Matrices &f) { f.modal_damping_ratio.by_frequency[0].second = 0.04; });
  recipe.expect("damping.ratio.named.1", [](Matrices &f) { f.modal_damping_ratio.named[0].ratio = 0.05; });
  recipe.expect("damping.ratio.named.1.mode", [](Matrices &f) { f.modal_damping_ratio.named[0].mode = 3; });
  recipe.expect("damping.ratio.named.1.from", [](Matrices &f) { f.modal_damping_ratio.named[0].from = 4.; });
  recipe.expect("damping.ratio.named.1.to", [](Matrices &f) { f.modal_damping_ratio.named[0].to = 7.; });
  recipe.expect("damping.ratio.named.1.points", [](Matrices &f) { f.modal_damping_ratio.named[0].points.resize(1); });
  recipe.expect("damping.ratio.named.1.shape", [](Matrices &f) { f.modal_damping_ratio.named[0].shape[1] = 2.; });
  recipe.expect("damping.ratio.named.1.phase", [](Matrices &f) { f.modal_damping_ratio.named[0].shape[1].imag(2.); });
  recipe.expect("damping.Z", [](Matrices &f) { f.modal_damping.Z = Eigen::MatrixXd::Ones(3, 1); });
  recipe.expect("damping.d", [](Matrices &f) { f.modal_damping.d = Eigen::VectorXd::Ones(1); });
  recipe.expect("interface", [](Matrices &f) { f.interfaces.push_back(f.interfaces[0]); });
  recipe.expect("interface.1", [](Matrices &f) { f.interfaces[0].name = "foot"; });
  for (std::size_t i = 0; i < 6; ++i)
  {
    const std::string motion = "." + std::to_string(i + 1);
    recipe.expect("interface.1.coordinate" + motion, [i](Matrices &f) { f.interfaces[0].coordinate[i] = 2; });
    recipe.expect("interface.1.sign" + motion, [i](Matrices &f) { f.interfaces[0].sign[i] = -1.; });
  }
  for (std::size_t i = 0; i < 3; ++i)
  {
    const std::string direction = "." + std::to_string(i + 1);
    recipe.expect("interface.1.position" + direction, [i](Matrices &f) { f.interfaces[0].position[i] = 1.; });
    recipe.expect("centre" + direction, [i](Matrices &f) { f.centre[i] = 1.; });
  }
  recipe.expect("translations", [](Matrices &f) { f.translations(2, 2) = 1.; });
  recipe.expect("acceleration_load", [](Matrices &f) { f.acceleration_load = Eigen::MatrixXd::Ones(3, 3); });
  recipe.expect("rigid_motions", [](Matrices &f) { f.rigid_motions = Eigen::MatrixXd::Ones(3, 6); });
  recipe.expect("output", [](Matrices &f) { f.outputs.push_back(f.outputs[0]); });
  recipe.expect("output.1", [](Matrices &f) { f.outputs[0].name = "cut.b"; });
  recipe.expect("output.1.unit", [](Matrices &f) { f.outputs[0].unit = "kN"; });
  recipe.expect("output.1.on_q", [](Matrices &f) { f.outputs[0].on_q[2] = 2.; });
  recipe.expect("output.1.on_v", [](Matrices &f) { f.outputs[0].on_v[2] = 2.; });
  recipe.expect("output.1.on_a", [](Matrices &f) { f.outputs[0].on_a = Eigen::VectorXd::Ones(3); });
  recipe.expect("output.1.under_acceleration", [](Matrices &f) { f.outputs[0].under_acceleration[1] = 2.; });
  recipe.expect("output.1.constant", [](Matrices &f) { f.outputs[0].constant = 2.; });
  recipe.expect("picture.skin", [](Matrices &f) { f.picture.points = {{0., 0., 1.}}; });
  recipe.expect("picture.skin", [](Matrices &f) { f.picture.triangles = {{0, 0, 0}}; });
  recipe.expect("picture.displacement", [](Matrices &f) { f.picture.displacement.resize(3, 3); });
  recipe.expect("total mass", [](Matrices &f) { f.mass = 6.; });
  recipe.expect("cells", [](Matrices &f) { f.n_cells = 6; });
  expect_options(recipe);
  recipe.expect_all_seen({"sources of the program"});
}

TEST(Recipe, ComesBackFromItsText)
{
  const coupling::Recipe recipe{{"a", "1"}, {"b=c\n3 4 d", ""}, {"", "\n\n"}};
  const std::string      text = coupling::text_of(recipe);
  EXPECT_EQ(coupling::text_of(coupling::parse_recipe(text)), text);
  for (const std::string broken : {"x", "1 1 a=1", "1 99999999999999999999 a=1\n", "9 1 a=1\n", "1 1 a:1\n"})
    EXPECT_THROW(coupling::parse_recipe(broken), std::runtime_error) << broken;
}

TEST(Recipe, DifferencesNameWhatIsOtherOrMissing)
{
  const auto found = coupling::differences({{"a", "1"}, {"b", "2"}, {"c", "3"}}, {{"a", "1"}, {"c", "4"}, {"d", "5"}});
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name + found[0].first + found[0].second, "b2");
  EXPECT_EQ(found[1].name + found[1].first + found[1].second, "c34");
  EXPECT_EQ(found[2].name + found[2].first + found[2].second, "d5");
}

TEST_F(ContentKey, OfAMissingFileIsRefused)
{
  frame.cad = (folder / "absent.step").string();
  EXPECT_THROW(key_of(frame, options), std::invalid_argument);
}

} // namespace
} // namespace gestell
