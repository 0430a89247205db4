#include "fem/geometry/inp/inp_file.h"

#include "fem/geometry/inp/inp_elements.h"
#include "fem/geometry/inp/inp_middle_nodes.h"
#include "fem/geometry/inp/inp_sets.h"
#include "fem/values/inp_lines.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace gestell::fem
{

namespace
{

class Reader
{
public:
  explicit Reader(const CadSource &source) : source_(source) {}

  InpMesh read()
  {
    read_file(source_.path);
    finish();
    return std::move(mesh_);
  }

private:
  struct Element
  {
    const InpElementKind    *kind;
    std::string              set;
    std::vector<std::size_t> nodes; ///< as in the file
  };
  struct Side
  {
    std::string surface, of, side; ///< `of`: number or set of elements
  };

  [[noreturn]] void refuse(const std::string &why) const
  {
    throw std::invalid_argument(source_.place + ": " + file_ + ":" + std::to_string(line_) + ": " + why);
  }

  void read_file(const std::string &path)
  {
    const std::string outer_file = file_;
    const int         outer_line = line_;
    InpLines          lines(path);
    if (!lines.opened())
      refuse("\"" + path + "\" cannot be read; write its path relative to the folder of this file.");
    const std::string itself = std::filesystem::weakly_canonical(path).string();
    if (!open_.insert(itself).second)
      refuse("\"" + path + "\" includes itself.");
    constexpr std::size_t deepest_include = 100;   // each is an open file
    constexpr std::size_t most_includes   = 10000; // a file that includes itself by several names would not end
    if (open_.size() > deepest_include || ++n_files_ > most_includes)
      refuse("files are nested more than " + std::to_string(deepest_include) + " levels deep, or included more than " +
             std::to_string(most_includes) + " times; write the mesh into one file.");
    file_ = path;
    while (lines.next())
    {
      line_ = lines.number();
      if (lines.is_keyword())
        begin(lines.keyword());
      else if (keyword_)
        take(lines.fields());
      else
        refuse("\"" + lines.text().substr(0, 40) + "\" precedes the first keyword; this is not an Abaqus input file.");
    }
    end_of_element();
    open_.erase(itself);
    file_ = outer_file;
    line_ = outer_line;
  }

  void begin(const InpKeyword &keyword)
  {
    end_of_element();
    if (keyword.name == "INCLUDE") // its lines replace the keyword
    {
      read_file(input_of(keyword, file_));
      return;
    }
    require_followed(keyword);
    keyword_         = keyword;
    const auto &name = keyword.name;
    kind_            = nullptr;
    node_set_        = name == "NODE" ? in_capitals(keyword["NSET"]) : "";
    if (name == "ELEMENT")
      begin_elements(in_capitals(keyword["TYPE"]));
    else if (name == "SOLID SECTION")
      sections_.push_back(in_capitals(keyword["ELSET"]));
    else if (name == "SURFACE" && keyword["TYPE"] != "" && in_capitals(keyword["TYPE"]) != "ELEMENT" &&
             in_capitals(keyword["TYPE"]) != "NODE")
      keyword_->name = ""; // analytical ones
    if (const std::string input = input_of(keyword, file_); !input.empty())
      read_file(input);
  }

  /// Whether a keyword or its lines describe the mesh.
  static bool is_of_mesh(const std::string &name)
  {
    static const std::set<std::string> known = {
        "HEADING", "PREPRINT", "NODE",     "ELEMENT", "NSET",         "ELSET", "SURFACE",      "SOLID SECTION",
        "PART",    "END PART", "ASSEMBLY", "SYSTEM",  "END ASSEMBLY", "END",   "END INSTANCE", "INSTANCE"};
    return known.count(name) > 0;
  }

  /// Refuses keywords that describe the mesh and are not supported.
  void require_followed(const InpKeyword &keyword)
  {
    const auto       &name = keyword.name;
    const std::string head = "*" + name + ": ", flat = "write the mesh flat, every node and element with its numbers.";
    if (name == "SHELL SECTION" || name == "BEAM SECTION" || name == "MEMBRANE SECTION" || name == "TRUSS SECTION")
      refuse(head + "only solid elements are read; model the frame as a solid, or import its matrices.");
    if ((name == "PART" || name == "INSTANCE") && ++n_parts_[name] > 1)
      refuse(head + "the file has several parts or instances; write it flat (in Abaqus: do not use parts and "
                    "assemblies in input files).");
    for (const char *rule : {"NGEN", "NFILL", "NCOPY", "NMAP", "ELGEN", "ELCOPY", "IMPORT"})
      if (name == rule)
        refuse(head + "generated nodes and elements are not read; " + flat);
    if (name == "IMPERFECTION")
      refuse(head + "transformed nodes are not supported; write nodes in their final position.");
    if (const std::string system = in_capitals(keyword["SYSTEM"]); name == "NODE" && !system.empty() && system != "R")
      refuse(head + "SYSTEM=" + system + ": cylindrical and spherical coordinates are not read; give x, y, z.");
    if (name == "NSET" && keyword.has("ELSET"))
      refuse(head + "node sets defined by elements are not read; list the nodes.");
    if (name == "SURFACE" && keyword.has("COMBINE"))
      refuse(head + "surfaces combined from other surfaces are not read; list the sides of the elements.");
    for (const char *tie : {"TIE", "EQUATION", "MPC", "RIGID BODY", "COUPLING", "KINEMATIC COUPLING"})
      if (name == tie)
      {
        ties_.insert("*" + name);
        return;
      }
    if (!is_of_mesh(name))
      left_.insert("*" + name);
  }

  void begin_elements(const std::string &type)
  {
    kind_ = inp_element_kind(type);
    if (kind_ == nullptr)
      refuse("elements of type " + (type.empty() ? std::string("\"\"") : type) +
             " are not read; mesh the frame with C3D4, C3D10, C3D8 and C3D20 only.");
    set_ = in_capitals((*keyword_)["ELSET"]);
  }

  void take(const std::vector<std::string> &fields)
  {
    const std::string &name = keyword_->name;
    if (fields.empty())
      return;
    if (name == "NODE")
      take_node(fields);
    else if (name == "ELEMENT")
      for (const std::string &field : fields)
        take_element(number(field));
    else if (name == "NSET" || name == "ELSET")
      take_set(fields, name == "NSET" ? node_sets_ : element_sets_);
    else if (name == "SURFACE" && in_capitals((*keyword_)["TYPE"]) == "NODE")
      node_sets_.add(in_capitals((*keyword_)["NAME"]), in_capitals(fields[0]));
    else if (name == "SURFACE" && fields.size() > 1)
      sides_.push_back({in_capitals((*keyword_)["NAME"]), in_capitals(fields[0]), in_capitals(fields[1])});
    else if (name == "SYSTEM")
      refuse("*SYSTEM: local coordinate systems are not read; give global x, y, z.");
    else if (name == "INSTANCE")
      refuse("*INSTANCE: the instance is moved; write the file flat, with the nodes in their final position.");
  }

  void take_node(const std::vector<std::string> &fields)
  {
    const std::size_t node = number(fields[0]);
    if (!nodes_.emplace(node, mesh_.numbers.size()).second)
      refuse("node " + std::to_string(node) + " is defined twice; give each node its own number.");
    mesh_.numbers.push_back(node);
    for (std::size_t d = 1; d <= 3; ++d)
      mesh_.coordinates.push_back(d < fields.size() && !fields[d].empty() ? value(fields[d]) : 0.);
    if (!node_set_.empty())
      node_sets_.add(node_set_, node);
  }

  void take_element(std::size_t entry)
  {
    if (element_ == 0)
    {
      if (entry == 0 || elements_.count(entry) > 0)
        refuse("element " + std::to_string(entry) + " is defined twice; give each element its own number.");
      element_ = entry;
      order_.push_back(entry);
      elements_[entry] = {kind_, set_, {}};
      return;
    }
    Element &element = elements_[element_];
    if (nodes_.count(entry) == 0)
      refuse("element " + std::to_string(element_) + " has node " + std::to_string(entry) +
             ", which is not defined; *NODE must precede *ELEMENT.");
    element.nodes.push_back(entry);
    if (static_cast<int>(element.nodes.size()) == kind_->n_nodes)
      element_ = 0;
  }

  void end_of_element()
  {
    if (element_ != 0)
      refuse("element " + std::to_string(element_) + " has " + std::to_string(elements_[element_].nodes.size()) +
             " nodes, " + std::to_string(kind_->n_nodes) + " are needed; the file may be truncated.");
  }

  void take_set(const std::vector<std::string> &fields, InpSets &sets)
  {
    const std::string set = in_capitals((*keyword_)[keyword_->name]);
    if (!keyword_->has("GENERATE"))
    {
      for (const std::string &field : fields)
        sets.add(set, in_capitals(field));
      return;
    }
    const std::size_t first = whole(fields[0]), last = fields.size() > 1 ? whole(fields[1]) : first;
    const std::size_t step = fields.size() > 2 ? std::max<std::size_t>(1, whole(fields[2])) : 1;
    if (last < first)
      refuse("GENERATE goes from " + fields[0] + " to " + fields[1] + "; give the lower number first.");
    sets.add({set, first, last, step, source_.place + ": " + file_ + ":" + std::to_string(line_)});
  }

  /// Limit of the members of all sets, and of all surfaces: each node and element may be in several.
  std::size_t most_members() const { return 1000000 + 100 * (nodes_.size() + elements_.size()); }

  std::size_t whole(const std::string &field) const
  {
    std::size_t result      = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), result);
    if (error != std::errc() || end != field.data() + field.size())
      refuse("\"" + field + "\" is not the number of a node or an element.");
    return result;
  }

  std::size_t number(const std::string &field) const
  {
    const std::size_t     result         = whole(field);
    constexpr std::size_t largest_number = 2147483647; // of a node or element: gmsh and the mesh count by int
    if (result > largest_number)
      refuse("number " + field + " of a node or an element is larger than " + std::to_string(largest_number) +
             "; number them from 1.");
    return result;
  }

  double value(std::string field) const
  {
    std::replace_if(
        field.begin(), field.end(), [](char c) { return c == 'D' || c == 'd'; }, 'E'); // of Fortran
    const char *begin       = field.data() + (field[0] == '+');
    double      result      = 0.;
    const auto [end, error] = std::from_chars(begin, field.data() + field.size(), result);
    if (error != std::errc() || end != field.data() + field.size() || !std::isfinite(result))
      refuse("\"" + field + "\" is not a coordinate.");
    return result;
  }

  static std::optional<std::size_t> as_number(const std::string &text)
  {
    std::size_t result      = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), result);
    return error == std::errc() && end == text.data() + text.size() ? std::optional(result) : std::nullopt;
  }

  const std::vector<std::size_t> &members(InpSets &sets, const std::string &name) const
  {
    try
    {
      return sets.members(name);
    }
    catch (const std::invalid_argument &error)
    {
      throw std::invalid_argument(source_.place + ": " + source_.path + ": " + error.what());
    }
  }

  void finish()
  {
    node_sets_.close(nodes_.size(), "nodes", most_members());
    element_sets_.close(elements_.size(), "elements", most_members());
    for (const std::size_t number : order_)
      if (const std::string &set = elements_.at(number).set; !set.empty())
        element_sets_.add(set, number);
    for (const std::string &name : node_sets_.names())
      mesh_.node_sets[name] = members(node_sets_, name);
    order_middles();
    add_solids();
    add_surface_elements();
    tell_what_is_left();
    for (const std::string &tie : ties_)
      mesh_.notes.push_back(tie + " is ignored: the tied parts must share nodes");
    for (const Side &side : sides_)
      add_side(side);
  }

  void tell_what_is_left()
  {
    constexpr std::size_t most_listed = 8; // names of a message
    std::string           names;
    std::size_t           n = 0;
    for (const std::string &name : left_)
      if (++n <= most_listed)
        names += (n > 1 ? ", " : "") + name;
    if (n > most_listed)
      names += " and " + std::to_string(n - most_listed) + " more";
    if (n > 0)
      mesh_.notes.push_back(names + (n > 1 ? " are" : " is") +
                            " not read: the file gives the mesh, the scene gives material, supports and loads");
  }

  void order_middles()
  {
    InpMiddleNodes middles(
        [this](std::size_t number)
        {
          const double *x = mesh_.coordinates.data() + 3 * nodes_.at(number);
          return Vector3{x[0], x[1], x[2]};
        });
    for (const std::size_t number : order_)
      if (Element &element = elements_.at(number); !middles.order(element.kind->gmsh_type, element.nodes))
        throw std::invalid_argument(
            source_.place + ": " + source_.path + ": the middle nodes of element " + std::to_string(number) +
            " are not on their edges, in any order common to all elements; " + element.kind->begin +
            " needs them edge by edge as in the Abaqus manual. Export the mesh again, or without middle nodes.");
    for (const std::string &note : middles.notes())
      mesh_.notes.push_back(note);
  }

  void add_solids()
  {
    std::unordered_map<std::size_t, std::string> section;
    for (const std::string &name : sections_)
      for (const std::size_t number : members(element_sets_, name))
        section[number] = name;
    std::map<std::pair<std::string, int>, std::size_t> block;
    for (const std::size_t number : order_)
    {
      const Element &element = elements_.at(number);
      if (element.kind->use != InpElementKind::Use::solid)
        continue;
      const auto         in      = section.find(number);
      const std::string &solid   = in == section.end() ? element.set : in->second;
      const auto [entry, is_new] = block.try_emplace({solid, element.kind->gmsh_type}, mesh_.elements.size());
      if (is_new)
        mesh_.elements.push_back({solid, element.kind->gmsh_type, {}, {}});
      InpMesh::Elements &to = mesh_.elements[entry->second];
      to.numbers.push_back(number);
      for (const int node : element.kind->order)
        to.nodes.push_back(element.nodes[node]);
    }
  }

  void add_surface_elements()
  {
    std::size_t n_surface = 0, n_lines = 0;
    for (const std::size_t number : order_)
    {
      const Element &element = elements_.at(number);
      n_lines += element.kind->use == InpElementKind::Use::line;
      if (element.kind->use != InpElementKind::Use::surface)
        continue;
      ++n_surface;
      std::vector<std::size_t> corners;
      for (const int node : element.kind->order)
        corners.push_back(element.nodes[node]);
      mesh_.faces[element.set].push_back(corners);
    }
    if (n_surface + n_lines > 0)
      mesh_.notes.push_back(std::to_string(n_surface) + " surface elements without a section only name surfaces; " +
                            std::to_string(n_lines) + " lines are ignored");
  }

  void add_side(const Side &side)
  {
    const auto direct = as_number(side.of);
    const auto of     = direct ? std::vector<std::size_t>{*direct} : members(element_sets_, side.of);
    const auto s      = side.side.size() == 2 && side.side[0] == 'S' ? side.side[1] - '1' : -1;
    for (const std::size_t number : of)
    {
      const auto element = elements_.find(number);
      if (element == elements_.end() || element->second.kind->use != InpElementKind::Use::solid)
        continue;
      const auto &faces = inp_faces(element->second.kind->gmsh_type);
      if (faces.empty())
        continue; // of a cell that will be refused with the number of its kind
      if (s < 0 || s >= static_cast<int>(faces.size()))
        refuse("surface \"" + side.surface + "\": " + side.side + " is not a side of element " +
               std::to_string(number) + "; S1 to S" + std::to_string(faces.size()) + " are.");
      std::vector<std::size_t> corners;
      for (const int corner : faces[s])
        corners.push_back(element->second.nodes[corner]);
      mesh_.faces[side.surface].push_back(corners);
      if (++n_sides_ > most_members())
        refuse("its surfaces have more than " + std::to_string(most_members()) +
               " element sides in total; remove those that are not needed.");
    }
  }

  const CadSource                             &source_;
  InpMesh                                      mesh_;
  std::string                                  file_;
  std::set<std::string>                        open_; // files
  int                                          line_ = 0;
  std::optional<InpKeyword>                    keyword_;
  const InpElementKind                        *kind_ = nullptr;
  std::string                                  set_, node_set_;
  std::size_t                                  element_ = 0; // being read
  std::unordered_map<std::size_t, std::size_t> nodes_;       // to their index
  std::unordered_map<std::size_t, Element>     elements_;
  std::vector<std::size_t>                     order_; // of the elements
  InpSets                                      node_sets_, element_sets_;
  std::vector<std::string>                     sections_;
  std::vector<Side>                            sides_;
  std::size_t                                  n_sides_ = 0, n_files_ = 0;
  std::map<std::string, int>                   n_parts_;
  std::set<std::string>                        ties_, left_;
};

} // namespace

InpMesh read_inp(const CadSource &source)
{
  return Reader(source).read();
}

} // namespace gestell::fem
