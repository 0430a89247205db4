#include "fem/geometry/cad_file.h"

#include "fem/geometry/msh_counts.h"
#include "fem/geometry/step_text.h"
#include "fem/values/message_text.h"
#include "fem/values/named_file.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <stdexcept>

namespace gestell::fem
{

namespace
{

const std::map<std::string, CadFile> kinds = {
    {".step", CadFile::step}, {".stp", CadFile::step},   {".brep", CadFile::brep},    {".geo", CadFile::geo},
    {".msh", CadFile::mesh},  {".inp", CadFile::abaqus}, {".stl", CadFile::triangles}};

std::string extension(const std::string &path)
{
  std::string end = std::filesystem::path(path).extension().string();
  std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
  return end;
}

/// The bytes [from, from + count) of the file, fewer at its end.
std::string bytes(const std::string &path, std::uintmax_t from, std::size_t count)
{
  std::ifstream in(path, std::ios::binary);
  in.seekg(static_cast<std::streamoff>(from));
  std::string text(count, '\0');
  in.read(text.data(), static_cast<std::streamsize>(count));
  text.resize(static_cast<std::size_t>(in.gcount()));
  return text;
}

constexpr std::size_t end_of_file = 1024; // bytes in which the first and the last words are searched

std::string head_of(const std::string &path)
{
  return bytes(path, 0, end_of_file);
}

std::string tail_of(const std::string &path, std::uintmax_t size)
{
  return bytes(path, size > end_of_file ? size - end_of_file : 0, end_of_file);
}

template <typename Refuse>
void check_step(const std::string &path, std::uintmax_t size, const Refuse &refuse)
{
  if (head_of(path).find("ISO-10303-21") == std::string::npos)
    refuse("is not a STEP file: it does not begin with \"ISO-10303-21;\"; export the model as STEP (AP203 or AP214).");
  if (tail_of(path, size).find("END-ISO-10303-21") == std::string::npos)
    refuse("is truncated: its last line is not \"END-ISO-10303-21;\"; copy or export it again.");

  const StepText text = read_step_text(path);
  if (text.n_missing > 0)
    refuse("is damaged, although its end is complete: " + std::to_string(text.n_missing) +
           " references lead to entities that are not in the file (#" + std::to_string(text.named_by) + " names #" +
           std::to_string(text.first_missing) + "); part of it is missing: copy or export it again.");
  if (!text.no_number.empty())
    refuse("is damaged: entity #" + std::to_string(text.no_number_in) + " holds \"" + text.no_number +
           "\" in place of a number, which OpenCASCADE cannot read; repair the model, and export it again.");
  if (text.n_entities > 0 && !text.has_unit)
    refuse("has no unit of length (no LENGTH_UNIT in a GLOBAL_UNIT_ASSIGNED_CONTEXT), so its lengths may be "
           "millimetres or metres; part of it is missing: copy or export it again.");
}

// OpenCASCADE never ends on a BREP file that was cut off.
template <typename Refuse>
void check_brep(const std::string &path, std::uintmax_t size, const Refuse &refuse)
{
  static const std::regex root_shape("\\*\\s*[-+ie][0-9]+ [0-9]+\\s*$");
  if (head_of(path).find("CASCADE Topology") == std::string::npos)
    refuse(
        "is not a BREP file of OpenCASCADE: \"CASCADE Topology\" is missing in its header; export the model as STEP.");
  if (!std::regex_search(tail_of(path, size), root_shape))
    refuse("is truncated: its last line does not name the root shape (such as \"+1 0\"); copy or export it again.");
}

} // namespace

bool is_mesh(CadFile file)
{
  return file == CadFile::mesh || file == CadFile::abaqus;
}

std::optional<CadFile> kind_of_file(const std::string &path)
{
  const auto kind = kinds.find(extension(path));
  return kind == kinds.end() ? std::nullopt : std::optional<CadFile>(kind->second);
}

bool is_step(const std::string &path)
{
  return kind_of_file(path) == CadFile::step;
}

CadFile check_cad_file(const CadSource &source)
{
  const std::string &path   = source.path;
  const auto         refuse = [&](const std::string &why)
  { throw std::invalid_argument(source.place + ": " + path + " " + why); };
  std::error_code ignored;
  if (path.empty())
    throw std::invalid_argument(source.place + ": no CAD file given; set cad to a .step, .stp, .brep, .geo, "
                                               ".msh or .inp file.");
  if (const std::string reason = why_unreachable(path); !reason.empty())
    refuse(reason + ".");
  if (!std::filesystem::exists(path, ignored))
    refuse("does not exist; relative paths start at the folder of the scene.");
  if (!std::filesystem::is_regular_file(path, ignored))
    refuse("is not a file; name the .step, .stp, .brep, .geo, .msh or .inp file itself.");
  const std::uintmax_t size = std::filesystem::file_size(path, ignored);
  if (size == 0)
    refuse("is empty; export the model again.");
  if (bytes(path, 0, 1).empty())
    refuse("cannot be read; check its permissions.");
  const auto kind = kind_of_file(path);
  if (!kind)
    refuse("ends in \"" + extension(path) +
           "\"; .step, .stp, .brep, .geo, .msh and .inp are read: export the model as STEP.");
  if (source.unit < 0.)
    throw std::invalid_argument(source.place + ": unit = " + text(source.unit) + " m; it must be > 0, or be omitted.");

  if (*kind == CadFile::brep)
    check_brep(path, size, refuse);
  if (*kind == CadFile::step)
    check_step(path, size, refuse);
  if (*kind == CadFile::mesh)
    if (const std::string defect = defect_of_counts(path); !defect.empty())
      refuse(defect);
  return *kind;
}

} // namespace gestell::fem
