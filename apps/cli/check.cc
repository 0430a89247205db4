#include "apps/cli/command.h"
#include "apps/cli/json_answer.h"
#include "apps/output/text/json.h"
#include "apps/scene/build/build_machine.h"
#include "apps/scene/build/build_measures.h"
#include "apps/scene/build/far_places.h"
#include "apps/scene/build/free_bodies.h"
#include "apps/scene/build/scene_summary.h"
#include "coupling/plugin/frame_service_loader.h"
#include "coupling/plugin/mesh_service.h"
#include "coupling/substructures/require_joints.h"
#include "fem/values/number_text.h"

#include <algorithm>
#include <iostream>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace gestell::apps
{

namespace
{

/// Contents of the frame's file, for people.
struct Geometry
{
  std::string text;
  double      diagonal = 0.; ///< [m]
};

/// Reads the frame's file and finds its surfaces and where they are, where this build can.
Geometry try_geometry(fem::FrameSpecification &frame, std::vector<std::string> &warnings,
                      std::map<std::string, PlacedFaces> *faces = nullptr)
{
  if (!coupling::has_frame_service())
    return {frame.cad + " is there; this build cannot read it"};
  const auto [found, notes, statements, centroids, of_faces, diagonal, curved] =
      coupling::mesh_service().inspect(frame);
  warnings.insert(warnings.end(), notes.begin(), notes.end());
  for (fem::InterfaceSpecification &interface : frame.interfaces)
    if (const auto centroid = centroids.find(interface.name); centroid != centroids.end() && !interface.position)
      interface.position = centroid->second;
  for (const fem::InterfaceSpecification &interface : frame.interfaces)
    if (const auto box = of_faces.find(interface.name); box != of_faces.end() && faces)
      (*faces)[interface.name] = {coupling::box_between(vector(box->second[0]), vector(box->second[1])),
                                  interface.position};
  std::string text = frame.cad + ": " + found + "; not meshed";
  for (const std::string &statement : statements)
    text += "\nframe: " + statement;
  return {text, diagonal};
}

/// How many [element.NAME] the scene has, whatever each of them becomes: of some a force, a mass, several contacts.
std::size_t elements_written(const Scene &scene)
{
  std::set<std::string> names;
  for (const auto &[name, place] : scene.element_places)
    if (name.find('.') == std::string::npos) // "guide.rear" is a part of "guide"
      names.insert(name);
  for (const JointRequest &joint : scene.joints)
    names.erase(joint.name);
  for (const MeasureRequest &measure : scene.measures)
    names.erase(measure.name);
  return names.size();
}

template <typename Named>
Json names_of(const std::vector<Named> &all)
{
  Json names = Json::array();
  for (const Named &one : all)
    names.push_back(one.name);
  return names;
}

std::string scene_json(const Scene &scene)
{
  Json elements = Json::array();
  for (const auto &[name, place] : scene.element_places)
    elements.push_back(name);
  Json run = nullptr;
  if (scene.run.options.end > scene.run.options.begin)
    run = {{"method", scene.run.options.method.method},
           {"begin_s", scene.run.options.begin},
           {"end_s", scene.run.options.end},
           {"step_s", scene.run.options.method.step},
           {"tolerance", scene.run.options.method.tolerance}};
  return json_text({{"scene", scene.name},
                    {"file", scene.file},
                    {"bodies", names_of(scene.bodies)},
                    {"elements", elements},
                    {"joints", names_of(scene.joints)},
                    {"signals", names_of(scene.signals)},
                    {"gravity_m_s2", scene.gravity},
                    {"run", run}});
}

int check(const CommonOptions &options)
{
  Scene                    scene    = read_scene(options.input, options.overrides, options.scripts);
  std::vector<std::string> warnings = check_scene(scene), notes;
  std::string              geometry;
  if (scene.frame.source == FrameSource::geometry)
  {
    std::map<std::string, PlacedFaces> faces;
    geometry       = try_geometry(scene.frame.geometry, notes, &faces).text;
    warnings       = check_scene(scene); // the places of interfaces are known now
    const auto far = places_far_from_faces(scene, faces);
    warnings.insert(warnings.end(), far.begin(), far.end());
  }
  std::vector<double> diagonals;
  for (coupling::FramePart &part : scene.frame.parts.parts)
  {
    const auto [text, diagonal] = try_geometry(part.geometry, notes);
    geometry += (geometry.empty() ? "" : "\nframe: ") + part.name + ": " + text;
    diagonals.push_back(diagonal);
  }
  if (scene.frame.source == FrameSource::parts)
  {
    coupling::require_meeting(scene.frame.parts, diagonals);
    warnings = check_scene(scene);
  }
  check_start(scene);
  warnings.insert(warnings.begin(), notes.begin(), notes.end());
  if (const std::string floating = floating_frame(scene); !floating.empty())
    warnings.push_back(floating);
  if (answers_in_json())
    answer_with(scene_json(scene));
  std::cout << scene.file << ": the scene \"" << scene.name
            << "\" is valid: " << count_text(scene.bodies.size(), "body", "bodies") << ", "
            << count_text(elements_written(scene), "element") << ", " << count_text(scene.signals.size(), "signal")
            << '\n';
  if (!geometry.empty())
    std::cout << "frame: " << geometry << '\n';
  for (const std::string &statement : scene.frame.matrices.statements)
    std::cout << "frame: " << statement << '\n';
  for (const std::string &line : scene_summary(scene))
    std::cout << "  " << line << '\n';
  if (!scene.joints.empty() && !places_known(scene))
    std::cout << "joints: assembled when the frame is created; the positions of interfaces without 'position' follow "
                 "from its file\n";
  for (const BodyRequest &body : scene.bodies)
    if (body.part)
      std::cout << body.part->found << '\n';
  constexpr std::size_t most = 30; // of one mistake in a scene of thousands of parts
  for (std::size_t i = 0; i < std::min(warnings.size(), most); ++i)
    std::cerr << "gestell: warning: " << warnings[i] << '\n';
  if (warnings.size() > most)
    std::cerr << "gestell: warning: and " << warnings.size() - most << " more\n";
  return exit_done;
}

} // namespace

Command check_command()
{
  return {
      "check", "validate a scene without computing", {"gestell check apps/scenes/press.toml"}, CommandInput::scene, {},
      check};
}

} // namespace gestell::apps
