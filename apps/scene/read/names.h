#pragma once

#include "apps/scene/file/scene_table.h"
#include "apps/scene/values/requests.h"

#include <map>
#include <string>
#include <vector>

namespace gestell::apps
{

/// The objects of a scene that elements refer to by name, known before the frame is made.
class Names
{
public:
  /// @param interfaces  of the frame; any_interface: they are unknown until a file is read.
  Names(const std::vector<std::string> &interfaces, bool any_interface);

  void add_body(const BodyRequest &body) { bodies_.push_back(body); }
  void set_carrier(const std::string &body, const std::string &carrier);
  void add_place(const std::string &name, const PlaceRequest &place) { places_[name] = place; }
  void add_measure(const MeasureRequest &measure) { measures_.push_back(measure); }

  /// Marker named by a key of `table`: "ground", a body, or "frame.crown".
  std::string marker(const SceneTable &table, const std::string &key) const;
  std::string marker(const SceneTable &table, const std::string &key, const std::string &fallback) const;
  /// Point named by a key of `table`: a [place], or an object that marker() knows; `at` in the table gives the point.
  PlaceRequest place(const SceneTable &table, const std::string &key, const std::string &at = "at") const;
  PlaceRequest place(const SceneTable &table, const std::string &key, const std::string &at,
                     const std::string &fallback) const;
  /// Measure named by a key of `table`.
  const MeasureRequest &measure(const SceneTable &table, const std::string &key) const;
  const MeasureRequest *find_measure(const std::string &name) const; ///< null if there is none

  /// A coordinate of a body, or its rate, that an initial state may give: its name, and whether it is an angle.
  struct Coordinate
  {
    std::string name;
    bool        angle;
  };
  std::vector<Coordinate> coordinates(bool rates) const;

  /// The coordinate of that name: `crank` and `crank.angle` are the angle of a rotor or planar body, `slide` and
  /// `slide.displacement` the way of a slider; other names are unchanged.
  std::string coordinate(const std::string &name) const;
  /// The rotor or planar body whose angle is `name`, "crank.angle"; null if it is none.
  const BodyRequest *body_of_angle(const std::string &name) const;

  /// Body of the kind `kind` named by a key of `table`; of a rotor also by its angle.
  const BodyRequest &body(const SceneTable &table, const std::string &key, coupling::BodyKind kind) const;

  const BodyRequest              *find_body(const std::string &name) const; ///< null if there is none
  std::vector<std::string>        body_names() const;
  const std::vector<std::string> &interfaces() const { return interfaces_; }

private:
  std::vector<std::string>            interfaces_;
  bool                                any_interface_;
  std::vector<BodyRequest>            bodies_;
  std::map<std::string, PlaceRequest> places_;
  std::vector<MeasureRequest>         measures_;
};

/// Rejects names that cannot be referenced: empty, with dots, "frame", "ground".
void check_thing_name(const SceneTable &table);

} // namespace gestell::apps
