#include "apps/output/paraview/surface_document.h"

#include "apps/output/text/svg.h"

#include <vtkCellArray.h>
#include <vtkCellData.h>
#include <vtkDataArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkZLibDataCompressor.h>

#include <cstdint>
#include <limits>
#include <stdexcept>

namespace gestell::apps
{
namespace
{

std::string type_name(const vtkDataArray &array)
{
  switch (array.GetDataType())
  {
  case VTK_FLOAT:
    return "Float32";
  case VTK_DOUBLE:
    return "Float64";
  case VTK_INT:
    return "Int32";
  case VTK_LONG:
  case VTK_LONG_LONG:
    return "Int64";
  default:
    throw std::logic_error(std::string("surface_document: arrays of ") + array.GetDataTypeAsString() + " have no name");
  }
}

/// A compressed array as files of VTK have it: numbers of blocks and bytes, then a single block.
std::string compressed(const char *bytes, std::size_t size)
{
  if (size > std::numeric_limits<std::uint32_t>::max())
    throw std::runtime_error("an array of " + std::to_string(size) + " bytes is too large for a ParaView file");
  vtkNew<vtkZLibDataCompressor> compressor;
  compressor->SetCompressionLevel(1); // the fastest: higher ones gain 3 %
  std::string block(compressor->GetMaximumCompressionSpace(size), '\0');
  block.resize(compressor->Compress(reinterpret_cast<const unsigned char *>(bytes), size,
                                    reinterpret_cast<unsigned char *>(block.data()), block.size()));
  const std::uint32_t head[] = {1, static_cast<std::uint32_t>(size), 0, static_cast<std::uint32_t>(block.size())};
  return std::string(reinterpret_cast<const char *>(head), sizeof head) + block;
}

/// Elements that describe arrays, and the arrays themselves.
class Document
{
public:
  explicit Document(StillArrays &still) : still_(still) {}

  void open(const std::string &element) { xml_ += '<' + element + ">\n"; }
  void close(const std::string &element) { xml_ += "</" + element + ">\n"; }

  /// @param skipped  values at the beginning that are left out
  /// @param still    name under which it is kept for further documents; empty: it changes
  void add(vtkDataArray &array, const std::string &name, vtkIdType skipped = 0, const std::string &still = "")
  {
    const std::size_t size = std::size_t(array.GetDataTypeSize()), n = std::size_t(array.GetNumberOfValues() - skipped);
    describe("DataArray", type_name(array), name,
             " NumberOfComponents=\"" + std::to_string(array.GetNumberOfComponents()) + "\" NumberOfTuples=\"" +
                 std::to_string(n / std::size_t(array.GetNumberOfComponents())) + '"');
    const auto all = [&] { return compressed(static_cast<const char *>(array.GetVoidPointer(skipped)), size * n); };
    if (still.empty())
      data_ += all();
    else if (const auto known = still_.find(still); known != still_.end())
      data_ += known->second;
    else
      data_ += still_[still] = all();
  }

  /// Texts end with a zero.
  void add(vtkStringArray &array)
  {
    std::string letters;
    for (vtkIdType i = 0; i < array.GetNumberOfValues(); ++i)
      letters += array.GetValue(i) + '\0';
    describe("Array", "String", array.GetName(),
             " NumberOfTuples=\"" + std::to_string(array.GetNumberOfValues()) + '"');
    data_ += compressed(letters.data(), letters.size());
  }

  void add(const std::string &section, vtkFieldData &fields, const std::string &attributes = "")
  {
    open(section + attributes);
    for (int i = 0; i < fields.GetNumberOfArrays(); ++i)
      if (auto *numbers = fields.GetArray(i))
        add(*numbers, numbers->GetName());
      else if (auto *texts = vtkStringArray::SafeDownCast(fields.GetAbstractArray(i)))
        add(*texts);
    close(section);
  }

  void add(const std::string &section, vtkCellArray &cells)
  {
    open(section);
    add(*cells.GetConnectivityArray(), "connectivity", 0, section + " connectivity");
    add(*cells.GetOffsetsArray(), "offsets", 1, section + " offsets");
    close(section);
  }

  std::string text() const
  {
    return "<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt32\" "
           "compressor=\"vtkZLibDataCompressor\">\n" +
           xml_ + "<AppendedData encoding=\"raw\">\n_" + data_ + "\n</AppendedData>\n</VTKFile>\n";
  }

private:
  void describe(const std::string &element, const std::string &type, const std::string &name, const std::string &shape)
  {
    xml_ += '<' + element + " type=\"" + type + "\" Name=\"" + escape_xml(name) + '"' + shape +
            " format=\"appended\" offset=\"" + std::to_string(data_.size()) + "\"/>\n";
  }

  StillArrays &still_;
  std::string  xml_, data_;
};

} // namespace

std::string surface_document(vtkPolyData &surface, StillArrays &still)
{
  const auto count = [](const char *name, vtkIdType n)
  { return std::string(" NumberOf") + name + "=\"" + std::to_string(n) + '"'; };
  Document document(still);
  document.open("PolyData");
  if (surface.GetFieldData()->GetNumberOfArrays() > 0)
    document.add("FieldData", *surface.GetFieldData());
  document.open("Piece" + count("Points", surface.GetNumberOfPoints()) + count("Verts", surface.GetNumberOfVerts()) +
                " NumberOfLines=\"0\" NumberOfStrips=\"0\"" + count("Polys", surface.GetNumberOfPolys()));
  document.add("PointData", *surface.GetPointData(), " Vectors=\"displacement [m]\"");
  document.add("CellData", *surface.GetCellData());
  document.open("Points");
  document.add(*surface.GetPoints()->GetData(), "Points", 0, "Points");
  document.close("Points");
  if (surface.GetNumberOfVerts() > 0)
    document.add("Verts", *surface.GetVerts());
  if (surface.GetNumberOfPolys() > 0)
    document.add("Polys", *surface.GetPolys());
  document.close("Piece");
  document.close("PolyData");
  return document.text();
}

} // namespace gestell::apps
