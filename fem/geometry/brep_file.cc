#include "fem/geometry/brep_file.h"

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>
#include <TopoDS_Shape.hxx>

#include <algorithm>
#include <fstream>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

namespace
{

/// " at line 37", or nothing if reading went to the end.
std::string place_of(std::ifstream &in)
{
  in.exceptions(std::ios::goodbit);
  const bool at_end = in.eof();
  in.clear();
  const std::streamoff bytes = in.tellg();
  if (at_end || bytes < 0)
    return "";
  in.seekg(0);
  std::string text(static_cast<std::size_t>(bytes), '\0');
  in.read(text.data(), bytes);
  return " at line " + std::to_string(1 + std::count(text.begin(), text.end(), '\n'));
}

} // namespace

void check_brep_file(const CadSource &source)
{
  std::ifstream in(source.path, std::ios::binary);
  if (!in)
    throw std::invalid_argument(source.place + ": " + source.path + " cannot be read; check its permissions.");
  in.exceptions(std::ios::failbit | std::ios::badbit);
  try
  {
    TopoDS_Shape       shape;
    const BRep_Builder builder;
    BRepTools::Read(shape, in, builder);
  }
  catch (const std::ios::failure &)
  {
    const std::string place = place_of(in);
    throw std::invalid_argument(source.place + ": " + source.path + " is damaged" +
                                (place.empty() ? ": it ends before its shapes do, as if a count were too large or an "
                                                 "entry were lost"
                                               : place + ": what stands there is not what is needed (a number)") +
                                "; copy or export it again.");
  }
}

} // namespace gestell::fem
