#include "fem/geometry/occ_snapshot.h"

#include <gmsh.h>

#include <BRepTools.hxx>
#include <BRep_Builder.hxx>

#include <unistd.h>

#include <filesystem>
#include <stdexcept>
#include <string>

namespace gestell::fem
{

namespace
{

class TemporaryFile
{
public:
  TemporaryFile()
      : path_(std::filesystem::temp_directory_path() / ("gestell_" + std::to_string(::getpid()) + "_shapes.brep"))
  {
  }
  ~TemporaryFile()
  {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile &)            = delete;
  TemporaryFile &operator=(const TemporaryFile &) = delete;

  std::string path() const { return path_.string(); }

private:
  std::filesystem::path path_;
};

} // namespace

TopoDS_Shape occ_snapshot()
{
  const TemporaryFile file;
  gmsh::write(file.path());
  TopoDS_Shape shape;
  if (!BRepTools::Read(shape, file.path().c_str(), BRep_Builder()))
    throw std::runtime_error("no shapes could be exchanged with OpenCASCADE through " + file.path());
  return shape;
}

} // namespace gestell::fem
