#pragma once

#include <array>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace gestell::mechanism
{

/**
 * Profile of a quantity over time: ramps from level to level with limited rate and rate of rate.
 *
 * A ramp over the difference D with the largest rate a and the largest rate of rate j ("jerk" for a speed) starts and
 * ends with an interval t_j of changing rate; between them, during t_c, the rate is a:
 *
 *     |D| >= a^2/j:   t_j = a/j,          t_c = |D|/a - t_j,      length 2 t_j + t_c
 *     |D| <  a^2/j:   t_j = sqrt(|D|/j),  t_c = 0,
 *
 * without a limit of j it is a straight line of length |D|/a, without any limit a jump.  Every piece is a polynomial of
 * second degree; the corners between pieces are events of the element that follows the profile.
 *
 * Source: L. Biagiotti, C. Melchiorri, Trajectory Planning for Automatic Machines and Robots, 2008, section 3.4.
 */
class Profile
{
public:
  static constexpr double unlimited = std::numeric_limits<double>::infinity();

  struct Ramp
  {
    double at           = 0.;        ///< [s], begin
    double to           = 0.;        ///< level at the end
    double rate         = unlimited; ///< a, > 0
    double rate_of_rate = unlimited; ///< j, > 0
  };

  /// Level c0 + c1 s + c2 s^2, s = t - begin [s].
  struct Piece
  {
    double                begin;
    std::array<double, 3> c;
    double                area = 0.; ///< integral of the profile up to begin

    double value(double t) const { return c[0] + (t - begin) * (c[1] + (t - begin) * c[2]); }
    double rate(double t) const { return c[1] + 2. * c[2] * (t - begin); }
    double integral(double t) const ///< from its start
    {
      const double s = t - begin;
      return s * (c[0] + s * (c[1] / 2. + s * c[2] / 3.));
    }
    bool is_zero() const { return c[0] == 0. && c[1] == 0. && c[2] == 0.; }
  };
  static constexpr int most_pieces = 4;
  /// Computes the pieces of a ramp between two levels, the last one after its end; returns their number.
  static int pieces_of(double from, const Ramp &ramp, Piece (&pieces)[most_pieces]);

  Profile(double constant = 0.); // NOLINT: a level is a profile

  /// @param name   of the element and the quantity, for messages: "speed drive: speed"
  /// @param from   level before the first ramp
  /// @param ramps  in the order of time, not overlapping
  /// @throws std::invalid_argument
  Profile(const std::string &name, double from, const std::vector<Ramp> &ramps);

  /// Index of the piece at the time t; at a corner that of the following one.
  std::size_t piece_at(double t) const;
  /// Value of a piece, also beyond its ends.
  double value(std::size_t piece, double t) const;
  /// Its slope, and its integral from t = 0.
  double rate(std::size_t piece, double t) const;
  double integral(std::size_t piece, double t) const;
  /// Whether the piece ends at a corner, and the time of this corner.
  bool   ends(std::size_t piece) const { return piece < corners_.size(); }
  double corner(std::size_t piece) const { return corners_[piece]; }
  bool   is_constant() const { return corners_.empty(); }
  /// Whether the piece is zero throughout.
  bool                is_zero(std::size_t piece) const;
  double              end() const { return corners_.empty() ? 0. : corners_.back(); } ///< [s], last corner
  std::vector<double> levels() const; ///< values at all corners, including the lowest and highest of the profile

private:
  void add(const Piece &piece);

  std::vector<double> corners_; ///< ascending; of two at the same time the piece between has no length and is omitted
  std::vector<Piece>  pieces_;  ///< one more than corners
};

} // namespace gestell::mechanism
