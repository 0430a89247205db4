#include "coupling/exchange/matrices_of_file.h"

#include "coupling/exchange/dmig.h"
#include "coupling/exchange/element_matrix.h"
#include "coupling/exchange/harwell_boeing.h"
#include "coupling/exchange/indexed_matrix.h"
#include "coupling/exchange/text_file.h"
#include "coupling/frame/matrix_file.h"
#include "coupling/frame/petsc_binary.h"

#include <stdexcept>

namespace gestell::coupling
{

namespace
{

using Matrices = std::map<std::string, LabelledMatrix>;

enum class Form
{
  dmig,
  element,
  harwell_boeing,
  indexed,
  other
};

Form form_of(const std::string &name)
{
  if (is_petsc_file(name))
    return Form::other;
  TextFile file(name);
  if (file.next() && begins(file.line(), "%%MatrixMarket"))
    return Form::other;
  if (is_harwell_boeing(file))
    return Form::harwell_boeing;
  if (is_indexed_matrix(file))
    return Form::indexed;
  if (has_element_matrix(file))
    return Form::element;
  return has_dmig(file) ? Form::dmig : Form::other;
}

struct RoleNames
{
  std::string punched; ///< name in punch files of Nastran
  std::string type;    ///< name in Abaqus
  char        first;
  std::string word;
};

RoleNames names_of(MatrixRole role)
{
  switch (role)
  {
  case MatrixRole::mass:
    return {"MAAX", "MASS", 'M', "mass"};
  case MatrixRole::damping:
    return {"BAAX", "DAMPING", 'B', "damping"};
  case MatrixRole::stiffness:
    return {"KAAX", "STIFFNESS", 'K', "stiffness"};
  }
  throw std::logic_error("no such role");
}

/// The only name that begins with the letter; K4... is structural damping.
std::string only_one(const Matrices &matrices, char first)
{
  std::string only;
  for (const auto &[name, matrix] : matrices)
    if (!name.empty() && name[0] == first && name.rfind("K4", 0) != 0)
    {
      if (!only.empty())
        return "";
      only = name;
    }
  return only;
}

std::string list_of(const Matrices &matrices)
{
  std::string list;
  for (const auto &[name, matrix] : matrices)
    list += (list.empty() ? "" : ", ") + name;
  return list.empty() ? "no square one" : list;
}

} // namespace

Matrices matrices_of_file(const std::string &file, std::int64_t known_size)
{
  switch (form_of(file))
  {
  case Form::dmig:
    return read_dmig(file);
  case Form::element:
    return read_element_matrices(file);
  case Form::harwell_boeing:
    return {{"", read_harwell_boeing(file)}};
  case Form::indexed:
    return {{"", read_indexed_matrix(file)}};
  case Form::other:
    break;
  }
  return {{"", {read_matrix_file(file, known_size)}}};
}

const LabelledMatrix &matrix_for(const Matrices &matrices, MatrixRole role, const std::string &requested,
                                 const std::string &file)
{
  const RoleNames names = names_of(role);
  if (!requested.empty())
  {
    std::string capital = capitals(requested);
    if (const auto found = matrices.find(capital); found != matrices.end())
      return found->second;
    throw std::invalid_argument(file + ": has no matrix '" + requested + "'; it has " + list_of(matrices));
  }
  for (const std::string &name : {std::string(), names.punched, names.type, only_one(matrices, names.first)})
    if (const auto found = matrices.find(name); found != matrices.end())
      return found->second;
  throw std::invalid_argument(file + ": has no matrix " + names.punched + " or " + names.type + ", but " +
                              list_of(matrices) + "; write matrix_names = { " + names.word +
                              " = \"NAME\" } if one of them is the " + names.word +
                              ", otherwise let the program write it, or name another file");
}

} // namespace gestell::coupling
