#include "tests/fuzz/target.h"

#include "coupling/frame/source_files.h"
#include "fem/geometry/cad_file.h"
#include "fem/geometry/geo_script.h"
#include "fem/geometry/inp/inp_file.h"
#include "fem/geometry/step_text.h"

#include <cmath>
#include <stdexcept>

namespace gestell::fuzz
{
namespace
{

using namespace gestell::fem;

CadSource source(const std::string &file)
{
  CadSource source;
  source.path  = file;
  source.place = "scene.toml:1: frame";
  return source;
}

void inp(const std::string &bytes)
{
  const std::string file = file_of("fed.inp", bytes);
  coupling::source_files(file);
  const InpMesh mesh = read_inp(source(file));
  promise(mesh.coordinates.size() == 3 * mesh.numbers.size(), "nodes without a place");
  for (const double x : mesh.coordinates)
    promise(std::isfinite(x), "a coordinate is not finite");
}

bool alike(const std::vector<GeoToken> &a, const std::vector<GeoToken> &b)
{
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (a[i].kind != b[i].kind || a[i].text != b[i].text || a[i].line != b[i].line)
      return false;
  return true;
}

/// What was judged is what is written for gmsh.
void geo(const std::string &bytes)
{
  const std::string file = file_of("fed.geo", bytes);
  coupling::source_files(file);
  const RefuseLine refuse = [](int line, const std::string &what)
  { throw std::invalid_argument("fed.geo:" + std::to_string(line) + ": " + what); };
  const std::vector<GeoToken> tokens = geo_tokens(bytes, refuse);
  for (const std::size_t i : judge_geo(tokens, refuse))
    promise(tokens.at(i).kind == GeoToken::Kind::text, "a file is named by something else than a text");
  promise(alike(geo_tokens(geo_text(tokens), refuse), tokens), "a script does not read back as it was judged");
}

void step(const std::string &bytes)
{
  const std::string file = file_of("fed.step", bytes);
  read_step_text(file);
  check_cad_file(source(file));
}

void msh(const std::string &bytes)
{
  check_cad_file(source(file_of("fed.msh", bytes)));
}

} // namespace

std::vector<Target> model_targets()
{
  return {{"inp", inp}, {"geo", geo}, {"msh", msh}, {"step", step}};
}

} // namespace gestell::fuzz
