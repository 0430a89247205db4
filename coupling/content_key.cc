#include "coupling/content_key.h"

#include <openssl/evp.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <optional>
#include <regex>
#include <sstream>
#include <stdexcept>

namespace gestell::coupling
{

namespace
{

/// Raise it when a frame made from the same input comes out differently.
constexpr const char *making = "gestell 0.1 frame 1";

/// Text without ambiguity: "key=value;" with length of text before it, numbers exactly in hexadecimal.
class Canonical
{
public:
  Canonical &add(const char *key, const std::string &value)
  {
    text_ << key << '=' << value.size() << ':' << value << ';';
    return *this;
  }
  Canonical &add(const char *key, double value)
  {
    char digits[40];
    std::snprintf(digits, sizeof digits, "%a", value == 0. ? 0. : value); // no minus zero
    return add(key, std::string(digits));
  }
  Canonical &add(const char *key, int value) { return add(key, std::to_string(value)); }
  Canonical &add(const char *key, bool value) { return add(key, std::string(value ? "yes" : "no")); }
  Canonical &add(const char *key, const fem::Vector3 &value)
  {
    return add(key, value[0]).add(key, value[1]).add(key, value[2]);
  }
  Canonical &add(const char *key, const std::vector<std::string> &values)
  {
    add(key, int(values.size()));
    for (const auto &value : values)
      add(key, value);
    return *this;
  }
  std::string text() const { return text_.str(); }

private:
  std::ostringstream text_;
};

void add(Canonical &to, const fem::SurfaceSelector &selector)
{
  if (selector.cylinder)
    to.add("axis", selector.cylinder->axis)
        .add("through", selector.cylinder->through)
        .add("radius", selector.cylinder->radius);
  if (selector.plane)
    to.add("normal", selector.plane->normal).add("through", selector.plane->through);
  if (selector.box)
    to.add("min", selector.box->min).add("max", selector.box->max);
  if (selector.group)
    to.add("group", *selector.group);
  if (selector.tolerance)
    to.add("tolerance", *selector.tolerance);
  to.add("faces", selector.faces);
}

void add(Canonical &to, const fem::Material &material)
{
  to.add("E", material.E).add("nu", material.nu).add("rho", material.rho);
}

void add(Canonical &to, const fem::Support &support)
{
  to.add("support", support.name).add("surfaces", support.surfaces).add("kind", int(support.kind));
  for (const bool held : support.held)
    to.add("held", held);
  to.add("stiffness", support.stiffness).add("damping", support.damping);
  to.add("per area", support.per_area[0]).add("per area", support.per_area[1]);
  for (const auto &axis : support.axes)
    to.add("axis", axis);
}

void add(Canonical &to, const fem::InterfaceSpecification &interface)
{
  to.add("interface", interface.name).add("surfaces", interface.surfaces).add("coupling", int(interface.coupling));
  if (interface.position)
    to.add("position", *interface.position);
  if (interface.radius > 0.)
    to.add("radius", interface.radius);
}

void add(Canonical &to, const fem::ModalRatios &ratios)
{
  to.add("zeta", ratios.constant);
  for (const double zeta : ratios.by_mode)
    to.add("of mode", zeta);
  for (const auto &[hz, zeta] : ratios.by_frequency)
    to.add("at", hz).add("zeta", zeta);
}

void add(Canonical &to, const fem::AttachedMass &mass)
{
  to.add("mass", mass.name).add("kg", mass.mass);
  if (mass.centre)
    to.add("centre", *mass.centre);
  for (const double J : mass.inertia.reshaped())
    to.add("J", J);
  to.add("on", mass.interface).add("surfaces", mass.surfaces).add("coupling", int(mass.coupling));
}

std::string canonical(const fem::FrameSpecification &frame)
{
  Canonical to;
  to.add("kind", std::filesystem::path(frame.cad).extension().string()).add("unit", frame.unit);
  to.add("size", frame.mesh.size).add("max_cells", frame.mesh.max_cells);
  for (const auto &[name, size] : frame.mesh.surface_size)
    to.add("surface", name).add("size", size);
  add(to, frame.material);
  for (const auto &[solids, material] : frame.materials)
    add(to.add("solids", solids), material);
  add(to, frame.modal_damping_ratio);
  if (frame.rayleigh_mass > 0. || frame.rayleigh_stiffness > 0.)
    to.add("alpha", frame.rayleigh_mass).add("beta", frame.rayleigh_stiffness);
  for (const auto &[name, selector] : frame.surfaces)
  {
    to.add("surface", name);
    add(to, selector);
  }
  for (const auto &support : frame.supports)
    add(to, support);
  for (const auto &interface : frame.interfaces)
    add(to, interface);
  for (const auto &mass : frame.masses)
    add(to, mass);
  if (frame.stress)
    to.add("stress", true);
  for (const auto &cut : frame.cuts)
    to.add("cut", cut.name).add("through", cut.through).add("normal", cut.normal);
  return to.text();
}

std::string canonical(const ReductionOptions &options)
{
  Canonical to;
  to.add("n_modes", options.n_modes < 0 ? -1 : options.n_modes);
  if (options.n_modes < 0)
    to.add("tolerance", options.tolerance).add("frequency", options.frequency);
  return to.text();
}

class Sha256
{
public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free)
  {
    if (!context_ || EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr) != 1)
      throw std::runtime_error("content_key: SHA-256 of OpenSSL is not available");
  }
  void        update(const void *bytes, std::size_t size) { EVP_DigestUpdate(context_.get(), bytes, size); }
  std::string hexadecimal()
  {
    unsigned char bytes[EVP_MAX_MD_SIZE];
    unsigned int  size = 0;
    EVP_DigestFinal_ex(context_.get(), bytes, &size);
    std::string text;
    char        digits[3];
    for (unsigned int i = 0; i < size; ++i)
    {
      std::snprintf(digits, sizeof digits, "%02x", bytes[i]);
      text += digits;
    }
    return text;
  }

private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

void add_file(Sha256 &hash, const std::string &name)
{
  std::ifstream   file(name, std::ios::binary);
  std::error_code error;
  const auto      size = std::filesystem::file_size(name, error);
  if (!file || error)
    throw std::invalid_argument(name + ": cannot be read; check the path and its permissions");
  const std::string head = "file:" + std::to_string(size) + ";";
  hash.update(head.data(), head.size());
  std::vector<char> block(1 << 20);
  while (file.read(block.data(), std::streamsize(block.size())) || file.gcount() > 0)
    hash.update(block.data(), std::size_t(file.gcount()));
}

/// The files a frame is made from, in the order a script of gmsh (.geo) names them, each once; what is named but not
/// there counts by its name.
struct Sources
{
  std::vector<std::string> files, missing;
};

std::string text_of(const std::filesystem::path &path)
{
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Adds `path` and, if it is a script, all that it names: relative to its own folder, as gmsh reads it.
void collect(const std::filesystem::path &path, bool is_script, Sources &sources)
{
  const std::string file = path.lexically_normal().string();
  if (std::find(sources.files.begin(), sources.files.end(), file) != sources.files.end())
    return; // also where files include each other in a circle
  sources.files.push_back(file);
  if (!is_script)
    return;
  static const std::regex naming(R"re(\b(Include|Merge|ShapeFromFile)\s*\(?\s*"([^"\n]+)")re");
  const std::string       text = text_of(path);
  for (auto found = std::sregex_iterator(text.begin(), text.end(), naming); found != std::sregex_iterator(); ++found)
  {
    const std::filesystem::path target = path.parent_path() / (*found)[2].str();
    std::error_code             error;
    if (std::filesystem::is_regular_file(target, error))
      collect(target, (*found)[1] == "Include" || target.extension() == ".geo", sources);
    else
      sources.missing.push_back((*found)[2]);
  }
}

} // namespace

std::string content_key(const std::vector<std::string> &files, const std::string &text, const ReductionOptions &options)
{
  Sha256 hash;
  for (const auto &file : files)
    add_file(hash, file);
  Canonical head;
  head.add("making", std::string(making)).add("text", text).add("options", canonical(options));
  const std::string all = head.text();
  hash.update(all.data(), all.size());
  return hash.hexadecimal();
}

std::string content_key(const fem::FrameSpecification &frame, const ReductionOptions &options)
{
  Sources sources;
  collect(frame.cad, std::filesystem::path(frame.cad).extension() == ".geo", sources);
  Canonical to;
  for (const auto &name : sources.missing)
    to.add("missing", name);
  return content_key(sources.files, canonical(frame) + to.text(), options);
}

} // namespace gestell::coupling
