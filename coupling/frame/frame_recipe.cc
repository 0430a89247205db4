#include "coupling/frame/frame_recipe.h"

#include "coupling/frame/frame_sources_hash.h"
#include "coupling/frame/sha256.h"
#include "coupling/frame/source_files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <filesystem>
#include <map>
#include <stdexcept>
#include <type_traits>

namespace gestell::coupling
{

namespace
{

const std::string beyond_files = "beyond its files";

/// Shortest digits that read back as the same number.
std::string text_of(double value)
{
  char digits[40];
  return {digits, std::to_chars(digits, digits + sizeof digits, value == 0. ? 0. : value).ptr}; // no minus zero
}

/// Collects ingredients.  A structured binding below names all members of every value: a new member does not compile
/// until it is added here or deliberately left out.
class Collector
{
public:
  void add(const std::string &name, const std::string &value) { recipe_.push_back({name, value}); }
  void add(const std::string &name, double value) { add(name, text_of(value)); }
  void add(const std::string &name, int value) { add(name, std::to_string(value)); }
  void add(const std::string &name, bool value) { add(name, std::string(value ? "yes" : "no")); }
  template <typename T>
  void add(const std::string &name, const std::optional<T> &value)
  {
    if (value)
      add(name, *value);
  }
  template <typename T, std::size_t n>
  void add(const std::string &name, const std::array<T, n> &values)
  {
    for (std::size_t i = 0; i < n; ++i)
      add(name + "." + std::to_string(i + 1), values[i]);
  }
  template <typename T>
  void add(const std::string &name, const std::vector<T> &values)
  {
    add(name, int(values.size()));
    for (std::size_t i = 0; i < values.size(); ++i)
      add(name + "." + std::to_string(i + 1), values[i]);
  }
  template <typename First, typename Second>
  void add(const std::string &name, const std::pair<First, Second> &value)
  {
    add(name, value.first);
    add(name + ".with", value.second);
  }
  template <typename T>
  void add(const std::string &name, const std::map<std::string, T> &values)
  {
    for (const auto &[key, value] : values)
      add(name + "." + key, value);
  }
  template <typename Enumeration, std::enable_if_t<std::is_enum_v<Enumeration>, int> = 0>
  void add(const std::string &name, Enumeration value)
  {
    add(name, static_cast<int>(value));
  }

  /// Values by their names in `name`.
  template <typename T, typename... Others>
  void members(const std::string &name, const char *member, const T &value, const Others &...others)
  {
    add(name + "." + member, value);
    if constexpr (sizeof...(others) > 0)
      members(name, others...);
  }

  void add(const std::string &name, const fem::Material &value)
  {
    const auto &[E, nu, rho, place, called] = value;
    members(name, "E", E, "nu", nu, "rho", rho);
    add(name + ".name", called); // the frame contains it
  }
  void add(const std::string &name, const fem::SurfaceSelector::Cylinder &value)
  {
    const auto &[axis, through, radius] = value;
    members(name, "axis", axis, "through", through, "radius", radius);
  }
  void add(const std::string &name, const fem::SurfaceSelector::Plane &value)
  {
    const auto &[normal, through] = value;
    add(name + ".normal", normal);
    add(name + ".through", through);
  }
  void add(const std::string &name, const fem::SurfaceSelector::Box &value)
  {
    const auto &[min, max] = value;
    add(name + ".min", min);
    add(name + ".max", max);
  }
  void add(const std::string &name, const fem::SurfaceSelector &value)
  {
    const auto &[cylinder, plane, box, group, tolerance, faces, place] = value;
    members(name, "cylinder", cylinder, "plane", plane, "box", box, "group", group, "tolerance", tolerance, "faces",
            faces);
  }
  void add(const std::string &name, const fem::Support &value)
  {
    const auto &[own, surfaces, kind, held, stiffness, damping, place, per_area, axes] = value;
    add(name, own);
    members(name, "surfaces", surfaces, "kind", kind, "held", held, "stiffness", stiffness, "damping", damping,
            "per_area", per_area, "axes", axes);
  }
  void add(const std::string &name, const fem::ModalRatios &value)
  {
    const auto &[constant, named, by_frequency] = value;
    add(name, constant);
    add(name + ".by_frequency", by_frequency);
    add(name + ".named", named);
  }
  void add(const std::string &name, const fem::NamedRatio &value)
  {
    const auto &[ratio, mode, from, to, points, shape, place] = value; // place: for messages
    add(name, ratio);
    members(name, "mode", mode, "from", from, "to", to, "points", points, "shape", Eigen::VectorXd(shape.real()),
            "phase", Eigen::VectorXd(shape.imag()));
  }
  void add(const std::string &name, const fem::AttachedMass &value)
  {
    const auto &[own, mass, inertia, centre, interface, surfaces, coupling, place] = value;
    add(name, own);
    members(name, "mass", mass, "inertia", std::vector<double>(inertia.data(), inertia.data() + inertia.size()),
            "centre", centre, "interface", interface, "surfaces", surfaces, "coupling", coupling);
  }
  void add(const std::string &name, const fem::InterfaceSpecification &value)
  {
    const auto &[own, surfaces, coupling, position, place, radius, degree, what] = value; // what: for messages
    add(name, own);
    members(name, "surfaces", surfaces, "coupling", coupling, "position", position, "radius", radius, "degree", degree);
  }
  void add(const std::string &name, const fem::CutSpecification &value)
  {
    const auto &[own, through, normal, place, first, about] = value;
    add(name, own);
    members(name, "through", through, "normal", normal, "first", first, "about", about);
  }
  void add(const std::string &name, const fem::StressPointSpecification &value)
  {
    const auto &[own, at, along, place] = value;
    add(name, own);
    add(name + ".at", at);
    add(name + ".along", along);
  }
  void add(const std::string &name, const fem::SurfaceLoad &value)
  {
    const auto &[surfaces, force, pressure, place] = value;
    members(name, "surfaces", surfaces, "force", force, "pressure", pressure);
  }
  void add(const std::string &name, const fem::Prestress &value)
  {
    const auto &[acceleration, loads, factor, tie_rods, interface_motion, place] = value;
    members(name, "acceleration", acceleration, "loads", loads, "factor", factor, "tie_rods", tie_rods,
            "interface_motion", interface_motion);
  }
  void add(const std::string &name, const fem::MeshOptions &value)
  {
    const auto &[size, surface_size, max_cells, gap, bodies, defeature, overlaps, curved, plates, layers, place] =
        value;
    members(name, "size", size, "surface", surface_size, "max_cells", max_cells, "gap", gap, "bodies", bodies,
            "defeature", defeature, "overlaps", overlaps, "curved", curved, "plates", plates, "layers", layers);
  }
  void add(const fem::FrameSpecification &value)
  {
    const auto &[cad, unit, mesh, material, materials, ratios, rayleigh_mass, rayleigh_stiffness, surfaces, supports,
                 interfaces, masses, cuts, stress_points, stress, parts, scripts, sew, place, prestress] = value;
    add_sources(cad);
    add("unit", unit);
    add("mesh", mesh);
    add("material", material);
    add("materials", materials);
    add("damping.ratio", ratios);
    add("damping.rayleigh mass", rayleigh_mass);
    add("damping.rayleigh stiffness", rayleigh_stiffness);
    add("surface", surfaces);
    add("support", supports);
    add("interface", interfaces);
    add("mass", masses);
    add("cut", cuts);
    add("stress point", stress_points);
    add("stress", stress);
    add("sew", sew);
    add("parts", parts);
    add("prestress", prestress); // last and only if there is one: other frames keep their keys
  }

  template <typename Number, int rows, int columns>
  void add(const std::string &name, const Eigen::Matrix<Number, rows, columns> &A)
  {
    add(name, Sha256().update(size_text(A)).update(A.data(), sizeof(Number) * std::size_t(A.size())).hexadecimal());
  }
  template <int order>
  void add(const std::string &name, const Eigen::SparseMatrix<double, order> &matrix)
  {
    Eigen::SparseMatrix<double, order> A = matrix;
    A.makeCompressed();
    const auto entries = std::size_t(A.nonZeros());
    add(name, Sha256()
                  .update(size_text(A))
                  .update(A.outerIndexPtr(), sizeof(int) * std::size_t(A.outerSize() + 1))
                  .update(A.innerIndexPtr(), sizeof(int) * entries)
                  .update(A.valuePtr(), sizeof(double) * entries)
                  .hexadecimal());
  }
  void add(const std::string &name, const fem::Interface &value)
  {
    const auto &[own, position, coordinate, sign, face] = value; // face: of parts, whose geometry counts
    add(name, own);
    members(name, "position", position, "coordinate", coordinate, "sign", sign);
  }
  void add(const std::string &name, const fem::FrameOutput &value)
  {
    const auto &[own, unit, on_q, on_v, under_acceleration, on_a, constant] = value;
    add(name, own);
    members(name, "unit", unit, "on_q", on_q, "on_v", on_v, "under_acceleration", under_acceleration, "on_a", on_a,
            "constant", constant);
  }
  void add(const std::string &name, const fem::Picture &value)
  {
    const auto &[points, triangles, displacement] = value;
    Sha256 hash;
    for (const auto &point : points)
      hash.update(point.data(), sizeof point);
    for (const auto &triangle : triangles)
      hash.update(triangle.data(), sizeof triangle);
    add(name + ".skin", hash.hexadecimal());
    add(name + ".displacement", displacement);
  }
  void add(const fem::FrameMatrices &value)
  {
    const auto &[M, B, C, ratios, modal_damping, interfaces, translations, acceleration_load, rigid_motions, centre,
                 outputs, picture, facts, mass, stress, n_cells, notes, statements] =
        value; // facts, stress and the last two: of cells only
    add("mass", M);
    add("damping", B);
    add("stiffness", C);
    add("damping.ratio", ratios);
    add("damping.Z", modal_damping.Z);
    add("damping.d", modal_damping.d);
    add("interface", interfaces);
    add("translations", translations);
    add("acceleration_load", acceleration_load);
    add("rigid_motions", rigid_motions);
    add("centre", centre);
    add("output", outputs);
    add("picture", picture);
    add("total mass", mass);
    add("cells", n_cells);
  }

  void add(const ReductionOptions &value)
  {
    const auto &[n_modes, tolerance, frequency, place, method, factor, eigensolver, inertia_relief] = value;
    add("reduction.method", method);
    if (n_modes >= 0)
      add("reduction.modes", n_modes);
    else
      add("reduction.tolerance", tolerance);
    add("reduction.frequency", frequency); // also the limits stated by the frame
    add("reduction.factor", factor);
    add("reduction.eigensolver", eigensolver);
    add("reduction.inertia relief", inertia_relief);
  }

  Recipe finished()
  {
    add("sources of the program", sources_of_frames());
    return std::move(recipe_);
  }

private:
  template <typename Matrix>
  static std::string size_text(const Matrix &A)
  {
    return std::to_string(A.rows()) + " x " + std::to_string(A.cols()) + ";";
  }

  void add_sources(const std::string &cad)
  {
    add("kind of file", std::filesystem::path(cad).extension().string());
    const SourceFiles sources = source_files(cad);
    for (std::size_t i = 0; i < sources.found.size(); ++i)
      add("source " + std::to_string(i + 1), sha256_of_file(sources.found[i]));
    add("missing", sources.missing);
    if (!sources.beyond.empty())
      add(beyond_files, sources.beyond);
  }

  Recipe recipe_;
};

std::runtime_error not_a_recipe()
{
  return std::runtime_error("its list of inputs cannot be read");
}

/// Reads "12 " at `at`.
std::size_t parse_length(const std::string &text, std::size_t &at)
{
  std::size_t length = 0;
  const auto  read   = std::from_chars(text.data() + at, text.data() + text.size(), length);
  if (read.ec != std::errc() || read.ptr == text.data() + text.size() || *read.ptr != ' ')
    throw not_a_recipe();
  at = std::size_t(read.ptr - text.data()) + 1;
  return length;
}

/// Reads `length` letters and the following separator.
std::string parse_word(const std::string &text, std::size_t &at, std::size_t length, char end)
{
  if (length >= text.size() - at || text[at + length] != end)
    throw not_a_recipe();
  const std::string word = text.substr(at, length);
  at += length + 1;
  return word;
}

} // namespace

std::string sources_of_frames()
{
  return frame_sources_hash;
}

Recipe recipe_of(const fem::FrameSpecification &frame, const ReductionOptions &options)
{
  Collector collector;
  collector.add(frame);
  collector.add(options);
  return collector.finished();
}

Recipe recipe_of(const fem::FrameMatrices &frame, const ReductionOptions &options)
{
  Collector collector;
  collector.add(frame);
  collector.add(options);
  return collector.finished();
}

// Lengths precede the words, so that the text is unambiguous.
std::string text_of(const Recipe &recipe)
{
  std::string text;
  for (const auto &[name, value] : recipe)
    text += std::to_string(name.size()) + ' ' + std::to_string(value.size()) + ' ' + name + '=' + value + '\n';
  return text;
}

Recipe parse_recipe(const std::string &text)
{
  Recipe recipe;
  for (std::size_t at = 0; at < text.size();)
  {
    const std::size_t name_length = parse_length(text, at), value_length = parse_length(text, at);
    const std::string name = parse_word(text, at, name_length, '=');
    recipe.push_back({name, parse_word(text, at, value_length, '\n')});
  }
  return recipe;
}

std::string content_key(const Recipe &recipe)
{
  return Sha256().update(text_of(recipe)).hexadecimal();
}

std::string beyond_the_files(const Recipe &recipe)
{
  const auto found = std::find_if(recipe.begin(), recipe.end(),
                                  [](const Ingredient &own) // of a part, with its name as prefix
                                  {
                                    return own.name.size() >= beyond_files.size() &&
                                           own.name.compare(own.name.size() - beyond_files.size(), std::string::npos,
                                                            beyond_files) == 0;
                                  });
  return found == recipe.end() ? "" : found->value;
}

std::vector<Difference> differences(const Recipe &first, const Recipe &second)
{
  std::map<std::string, std::string> left;
  for (const auto &[name, value] : second)
    left.emplace(name, value);
  std::vector<Difference> result;
  for (const auto &[name, value] : first)
  {
    const auto other = left.find(name);
    if (other == left.end())
      result.push_back({name, value, ""});
    else if (other->second != value)
      result.push_back({name, value, other->second});
    if (other != left.end())
      left.erase(other);
  }
  for (const auto &[name, value] : second)
    if (left.count(name))
      result.push_back({name, "", value});
  return result;
}

} // namespace gestell::coupling
