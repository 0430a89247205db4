#pragma once

#include <array>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#define GESTELL_SHOWN __attribute__((visibility("default")))

namespace gestell
{

/// Extremes of a signal with their times [s].
struct Peak
{
  std::string unit;
  double      min = 0., t_min = 0., max = 0., t_max = 0., final = 0.;
};

/// A change of the branch of a law: time [s], name of the element, kind.
struct Event
{
  double      t = 0.;
  std::string name, kind;
};

/// Results of a run.  Copies share them.
class GESTELL_SHOWN Run
{
public:
  const std::map<std::string, Peak> &peaks() const;
  const std::vector<Event>          &events() const;
  const std::vector<std::string>    &warnings() const;
  /// Reason for an early end of the run; empty: none.  Results up to then are available.
  const std::string &failure() const;

  const std::vector<double> &times() const; ///< [s] of the history
  /// History of a signal in SI, one value per time.
  /// @throws std::invalid_argument for an unknown name, with the most similar one
  std::vector<double> history(const std::string &signal) const;

  /// Writes report.html, history.csv and all other files of a result.
  /// @throws std::invalid_argument, std::runtime_error if they cannot be written
  void save(const std::string &folder) const;

  struct Parts;
  explicit Run(std::shared_ptr<const Parts> parts) : parts_(std::move(parts)) {}

private:
  std::shared_ptr<const Parts> parts_;
};

/// Natural modes of the coupled machine.
struct Modes
{
  std::vector<double>              frequencies_hz, damping_ratios;
  std::vector<std::string>         coordinates;
  std::vector<std::vector<double>> shapes; ///< by mode, then by coordinate; mass normalised
};

/// A force law of the calling program, F(t, u, v) [N or N m] of time, displacement or angle, and its rate.
struct Law
{
  std::function<double(double t, double u, double v)> force;
  /// dF/du and dF/dv; none: central differences, which cost four more calls of `force`
  std::function<std::array<double, 2>(double t, double u, double v)> derivative{};
};

/**
 * A scene as data: keys are set by their path, then the scene is computed.  Frames are reduced once and cached.
 *
 *     gestell::Scene scene("press_minimal.toml");
 *     scene.set("parameters.c_P", "950 kN/mm");
 *     const gestell::Run run = scene.run();
 *
 * Wrong input throws std::invalid_argument with location, value and remedy; a failed computation throws
 * std::runtime_error.
 */
class GESTELL_SHOWN Scene
{
public:
  explicit Scene(const std::string &file);
  /// A scene from a TOML string.
  /// @param folder  base of relative paths
  static Scene of_text(const std::string &text, const std::string &folder = ".");

  /// The value as for `--set`: a number in SI, or a string with a unit.
  Scene &set(const std::string &key, const std::string &value);
  Scene &set(const std::string &key, double value);
  /// The `force` of a "formula force": "element.buffer.force".
  Scene &set(const std::string &key, const Law &law);

  Run   run() const;
  Modes modes() const;

  struct Parts;

private:
  explicit Scene(std::shared_ptr<Parts> parts) : parts_(std::move(parts)) {}
  std::shared_ptr<const Parts> parts_; ///< replaced by set(), so that copies are unchanged
};

} // namespace gestell
