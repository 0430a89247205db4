#pragma once

#include "apps/analysis/frf/frequency_response.h"
#include "coupling/modes/modes.h"
#include "coupling/periodic/response/linear_response.h"

#include <string>
#include <vector>

namespace gestell::apps
{

/// Responses to forces, at enough frequencies to resolve the peaks.
class ResponseSweep
{
public:
  /// @param masses  diagonal of M [n]: the threshold for rounding of a coordinate follows from the total kinetic energy
  ResponseSweep(coupling::LinearResponse machine, Eigen::VectorXd masses)
      : machine_(std::move(machine)), masses_(std::move(masses))
  {
  }

  void add_force(const Eigen::VectorXd &force); ///< [n]
  /// @param derivatives  number of time derivatives
  void add_answer(const coupling::LinearAnswer &answer, int derivatives);

  /**
   * Computes frequencies, values and peaks of response.pairs, which are ordered by forces, then responses.  Frequencies
   * are `requested` and
   *
   *   - those of the damped modes between them, with their half-power points,
   *   - midpoints, until no phase changes by more than 60 degrees between adjacent frequencies,
   *   - maxima of peaks.
   */
  void run(const std::vector<double> &requested, const std::vector<coupling::Mode> &modes, FrequencyResponse &response,
           std::vector<std::string> &warnings);

  const std::string &not_condensed() const { return machine_.not_condensed(); }

private:
  /// Amplitudes of all pairs at one frequency [Hz]; nan where an undamped mode is excited.
  struct Sample
  {
    double                            f;
    std::vector<std::complex<double>> values;
  };
  struct Answer
  {
    coupling::LinearAnswer signal;
    int                    derivatives;
  };

  /// Amplitude of a response; 0 if it is only rounding, for example because of symmetry.
  std::complex<double> value(const Answer &answer, const coupling::Vibration &vibration, Eigen::Index column) const;
  Sample               at(double f) const;
  double               amplitude(std::size_t pair, double f) const;
  std::vector<Sample>  sampled(std::vector<double> frequencies) const;
  void                 add_between(std::vector<Sample> &samples) const;
  void                 find_peaks(std::vector<Sample> &samples, FrequencyResponse &response) const;

  coupling::LinearResponse machine_;
  Eigen::VectorXd          masses_;
  Eigen::MatrixXd          forces_; // [n x n_from]
  std::vector<Answer>      answers_;
};

} // namespace gestell::apps
