#include "fem/geometry/geo_script.h"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <map>
#include <set>
#include <sstream>
#include <string>

namespace gestell::fem
{

namespace
{

using Words = std::set<std::string>;
using Kind  = GeoToken::Kind;

/// The words of a text, separated by blanks.
Words words(const std::string &text)
{
  std::istringstream stream(text);
  return {std::istream_iterator<std::string>(stream), {}};
}

/// Permitted words of gmsh: those that only draw, compute, set sizes and mesh.
const Words language =
    words("newreg newp newl newc newll news newsl newv newf Abort Abs Acos Affine ArcCos Append ArcSin ArcTan "
          "ArcTan2 Asin Atan Atan2 BSpline Bezier Box Block BooleanCoherence BooleanCommon BooleanCut "
          "BooleanDifference BooleanFragments BooleanFuse BooleanIntersection BooleanSection BooleanUnion "
          "BoundingBox Call Catenary CatmullRom Ceil CenterOfMass Chamfer Characteristic Circle "
          "ClassifySurfaces Coherence Color Compound Cone Coordinates Cos Cosh Cpu CreateGeometry "
          "CreateTopology Curve Cylinder DefineConstant DefineNumber DefineString Degenerated Delete Dilate "
          "Disk Ellipse Ellipsis Ellipsoid Elliptic Else ElseIf EndFor EndIf Error Euclidian Exists Exp Extrude "
          "Fabs Field Fillet Find Floor Fmod For Function GMSH_MAJOR_VERSION GMSH_MINOR_VERSION "
          "GMSH_PATCH_VERSION GeoEntity Hide Hole Hypot If In Intersect Knots Layers Length LinSpace Line List "
          "Log Log10 LogSpace LowerCase LowerCaseIn Macro Mass MatrixOfInertia Max MeshAlgorithm MeshSize "
          "MeshSizeFromBoundary Min Modulo N2S NameToString NewModel Nurbs Order Parametric Parent Periodic "
          "Physical Pi Plane Point PolarSphere Printf Quadric QuadTriAddVerts QuadTriNoNewVerts Rand "
          "RecombLaterals Recombine RecombineMesh Rectangle Recursive RefineMesh RelocateMesh "
          "RenumberMeshElements RenumberMeshNodes ReorientMesh Return Reverse ReverseMesh Rotate Round Ruled "
          "ScaleLastLayer SetFactory SetMaxTag Sewing ShapeFromFile Show Sin Sinh Smoother Sphere Spline Split "
          "Sprintf Sqrt Str StrCat StrChoice StrCmp StrFind StrLen StrReplace StrSub Surface Symmetry SyncModel "
          "Tan Tanh ThickSolid ThruSections Today Torus TransfQuadTri Transfinite Translate UndefineConstant "
          "Unique UpperCase Using Volume Warning Wedge Wire");

/// Other words of gmsh, with the reason of their refusal.
std::map<std::string, std::string> refused_words()
{
  std::map<std::string, std::string> refused;
  const auto                         add = [&](const Words &these, const std::string &reason)
  {
    for (const std::string &word : these)
      refused[word] = reason;
  };
  add({"NonBlockingSystemCall", "OnelabAction", "OnelabRun", "Plugin", "Solver", "System", "SystemCall"},
      "runs a program");
  add({"CreateDir", "Draw", "Print", "Save", "SendToServer", "SetNumber", "SetString"},
      "writes files other than the mesh");
  add({"FileExists", "ListFromFile", "View", "Alias", "AliasWithOptions", "Combine", "CopyOptions"},
      "reads files other than the geometry");
  add({"AbsolutePath", "CodeName", "CurrentDir", "CurrentDirectory", "CurrentFileName", "DirName", "FixRelativePath",
       "GetEnv", "GetForced", "GetForcedStr", "GetNumber", "GetString", "GetStringValue", "GetValue",
       "GmshExecutableName", "MPI_Rank", "MPI_Size", "Memory", "TotalMemory"},
      "uses more than the geometry");
  add({"Exit", "Sleep"}, "stops this program");
  add({"S2N", "StringToName"}, "makes names that cannot be checked");
  add(words("AdaptMesh Betti Cohomology ColorTable DimNameSpace Homology INTERPOLATION_SCHEME Levelset "
            "NameStruct PartitionMesh Remesh SetCurrentWindow SetPartition SetTag Slide "
            "SplitCurrentWindowHorizontal SplitCurrentWindowVertical StrPrefix StrRelative Struct T2 T3 "
            "TIME TestLevel TextAttributes UnsplitWindow"),
      "is not needed to draw a frame");
  return refused;
}

const Words reads_files = {"Include", "Merge", "MergeWithBoundingBox", "ShapeFromFile"};
const Words prints      = {"Printf", "Warning", "Error"};
const Words block_ends  = {"Return", "EndFor", "EndIf", "Else"};

/// Permitted size fields; others read files or run programs.
const Words field_kinds = {
    "Attractor", "Ball",     "BoundaryLayer", "Box",    "Curvature", "Cylinder", "Distance",
    "Frustum",   "Gradient", "Laplacian",     "LonLat", "MathEval",  "Max",      "MaxEigenHessian",
    "Mean",      "Min",      "Octree",        "Param",  "Restrict",  "Threshold"};

/// Options of General that concern the terminal, the threads and the view.
const Words general_options = {"AbortOnError", "Axes",         "Color",     "ExpertMode", "InitialModule",
                               "NumThreads",   "Orthographic", "SmallAxes", "Terminal",   "Verbosity"};
const Words general_views   = {"Trackball", "Rotation", "Scale", "Translation", "Clip", "Light"};

/// Attributes of a constant between the brackets of DefineConstant.
const Words attributes = {"AutoCheck", "Choices", "Closed", "Help",  "Highlight", "Kind",     "Label",
                          "Max",       "Min",     "Name",   "Path",  "Range",     "ReadOnly", "ReadOnlyRange",
                          "ShortHelp", "Step",    "Units",  "Value", "Visible"};

/// Commands of two words, of a word and a number, of a word and a text.
const std::map<std::string, Words> of_words   = {{"Background", {"Field"}}, {"BoundaryLayer", {"Field"}}};
const Words                        of_numbers = {"Beta", "Bump", "Mesh", "Power", "Progression", "SetOrder"};
const Words                        of_texts   = {"OptimizeMesh", "SetName"};

bool begins_with_one_of(const std::string &word, const Words &beginnings)
{
  return std::any_of(beginnings.begin(), beginnings.end(),
                     [&](const std::string &beginning) { return word.rfind(beginning, 0) == 0; });
}

class GeoJudge
{
public:
  GeoJudge(const std::vector<GeoToken> &tokens, const RefuseLine &refuse)
      : tokens_(tokens), refuse_(refuse), closing_(tokens.size(), 0), of_constants_(tokens.size(), false)
  {
    find_closings();
  }

  std::vector<std::size_t> judge()
  {
    for (std::size_t i = 0; i < tokens_.size(); ++i)
      if (tokens_[i].kind == Kind::word)
        judge_word(i);
      else if (tokens_[i].kind == Kind::sign && tokens_[i].text == "]")
        judge_option_of_many(i);
    return files_;
  }

private:
  [[noreturn]] void refuse(std::size_t i, const std::string &what) const
  {
    refuse_(tokens_[i].line, what);
    std::abort(); // refuse_ throws
  }

  bool is(std::size_t i, const std::string &text) const { return i < tokens_.size() && tokens_[i].is(text); }
  bool is(std::size_t i, Kind kind) const { return i < tokens_.size() && tokens_[i].kind == kind; }
  bool opens(std::size_t i) const { return is(i, "(") || is(i, "[") || is(i, "{"); }

  /// Finds the closing bracket of every opening one, and the tokens in brackets of DefineConstant.
  void find_closings()
  {
    std::vector<std::size_t> open;
    std::size_t              n_constants = 0;
    const auto               is_constant = [this](std::size_t i) { return i > 0 && is(i - 1, "DefineConstant"); };
    for (std::size_t i = 0; i < tokens_.size(); ++i)
    {
      of_constants_[i] = n_constants > 0;
      if (opens(i))
      {
        open.push_back(i);
        n_constants += is_constant(i);
      }
      else if (is(i, ")") || is(i, "]") || is(i, "}"))
      {
        if (open.empty())
          refuse(i, "has a bracket that was not opened");
        n_constants -= is_constant(open.back());
        closing_[open.back()] = i;
        opening_[i]           = open.back();
        open.pop_back();
      }
    }
    if (!open.empty())
      refuse(open.back(), "has a bracket that is not closed");
  }

  void judge_word(std::size_t i)
  {
    const std::string &word    = tokens_[i].text;
    const bool         is_part = i > 0 && is(i - 1, ".");
    if (const auto refused = refused_.find(word); refused != refused_.end() && !is_part)
      refuse(i, word + " " + refused->second);
    if (reads_files.count(word) > 0)
      return judge_file(i);
    if (prints.count(word) > 0 && !is_part)
      judge_print(i);
    if (word == "Field" && is(i + 1, "["))
      judge_field(i);
    if (is(i + 1, ".") && !is_part)
      judge_option(i, i + 2);
    if (language.count(word) == 0 && !is_part)
      judge_place(i);
  }

  void judge_file(std::size_t i)
  {
    const bool        bracket = tokens_[i].text == "ShapeFromFile";
    const std::size_t name    = i + (bracket ? 2 : 1);
    if (!is(name, Kind::text) || (bracket ? !opens(i + 1) || closing_[i + 1] != name + 1 : !is(name + 1, ";")))
      refuse(i, tokens_[i].text + " must name its file by one string in quotes");
    files_.push_back(name);
  }

  void judge_print(std::size_t i)
  {
    const std::string &word = tokens_[i].text;
    if (!opens(i + 1) || !is(closing_[i + 1] + 1, ";"))
      refuse(i, word + " writes into a file; only " + word + "(...); is allowed");
  }

  void judge_field(std::size_t i)
  {
    const std::size_t after = closing_[i + 1] + 1;
    if (!is(after, "=") || (is(i - 1, "Background") && i > 0))
      return;
    const std::string kind = after + 1 < tokens_.size() ? tokens_[after + 1].text : "";
    if (field_kinds.count(kind) == 0)
      refuse(i, "the size field " + kind + " may read files or run programs");
  }

  /// Mesh.MeshSizeMax
  void judge_option(std::size_t i, std::size_t option)
  {
    const std::string &category = tokens_[i].text;
    const std::string  name     = option < tokens_.size() ? tokens_[option].text : "";
    const bool         command  = name.size() > 7 && name.compare(name.size() - 7, 7, "Command") == 0;
    if (!(category == "Mesh" || (category == "Geometry" && !command) ||
          (category == "General" && (general_options.count(name) > 0 || begins_with_one_of(name, general_views)))))
      refuse(i, category + "." + name + " may change more than the mesh");
  }

  /// View[0].Name; but Field[1].VIn
  void judge_option_of_many(std::size_t i)
  {
    const std::size_t open = opening_.at(i);
    if (is(i + 1, ".") && !(open > 0 && is(open - 1, "Field")))
      refuse(i, "sets an option of an object that is not a size field");
  }

  /// A word that is none of the language must be a variable, or the name of a macro.
  void judge_place(std::size_t i)
  {
    const std::string &word = tokens_[i].text;
    if (i > 0 && (is(i - 1, "Macro") || is(i - 1, "Function")))
      return;
    if (is(i + 1, Kind::text) || is(i + 1, Kind::number) || is(i + 1, Kind::word))
      judge_command(i);
    const bool begins = i == 0 || is(i - 1, ";") || is(i - 1, "}") || is(i - 1, ")") ||
                        (is(i - 1, Kind::word) && block_ends.count(tokens_[i - 1].text) > 0);
    if (begins && (is(i + 1, ";") || (opens(i + 1) && is(closing_[i + 1] + 1, ";"))) && !is_arrangement(i))
      refuse(i, "\"" + word + "\" is not in the list of safe commands");
  }

  /// Whether the word is the arrangement of a transfinite surface: "... = {1, 2, 3, 4} Left;"
  bool is_arrangement(std::size_t i) const
  {
    static const Words arrangements = {"Left", "Right", "Alternate", "AlternateLeft", "AlternateRight"};
    return arrangements.count(tokens_[i].text) > 0 && is(i + 1, ";");
  }

  void judge_command(std::size_t i)
  {
    const std::string &word = tokens_[i].text, &next = tokens_[i + 1].text;
    if (is(i + 1, Kind::word) && (next == "In" || next == "Using"))
      return;
    const auto pair = of_words.find(word);
    if (is(i + 1, Kind::word) && pair != of_words.end() && pair->second.count(next) > 0)
      return;
    if (!is(i + 1, Kind::text) && of_numbers.count(word) > 0)
      return;
    if (is(i + 1, Kind::text) && of_texts.count(word) > 0)
      return;
    if (attributes.count(word) > 0 && of_constants_[i])
      return;
    refuse(i, "\"" + word + " " + next + "\" is not in the list of safe commands");
  }

  const std::vector<GeoToken>             &tokens_;
  const RefuseLine                        &refuse_;
  std::vector<std::size_t>                 closing_; ///< by opening bracket
  std::map<std::size_t, std::size_t>       opening_; ///< by closing bracket
  std::vector<bool>                        of_constants_;
  std::vector<std::size_t>                 files_;
  const std::map<std::string, std::string> refused_ = refused_words();
};

} // namespace

std::vector<std::size_t> judge_geo(const std::vector<GeoToken> &tokens, const RefuseLine &refuse)
{
  return GeoJudge(tokens, refuse).judge();
}

} // namespace gestell::fem
