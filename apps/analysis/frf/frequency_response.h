#pragma once

#include "apps/output/text/csv.h"
#include "apps/output/values/answer.h"
#include "apps/output/values/coupling_descriptions.h"

#include <complex>
#include <string>
#include <vector>

namespace gestell::apps
{

/// A measured curve.
struct MeasuredResponse
{
  std::string                       file, name;    ///< name: from the file, may be empty
  int                               pair      = 0; ///< index in FrequencyResponse::pairs; the values have its unit
  bool                              has_phase = true;
  std::vector<double>               frequencies_hz;
  std::vector<std::complex<double>> values;
  std::string                       pair_name{}; ///< of the pair
};

template <class Visitor>
void describe(Visitor &v, const MeasuredResponse &x)
{
  v("file", x.file, "", "file of the measurement");
  v("name", x.name, "", "name in the file");
  v("pair", x.pair_name, "", "pair with which it is compared");
  v("points", x.values.size(), "", "number of frequencies");
}

/// Response at one point to a force at one point.
struct ResponsePair
{
  std::string                         from, to;
  std::string                         unit;            ///< "m/N"
  int                                 derivatives = 0; ///< of the displacement: 0 receptance, 1 mobility, 2 accelerance
  std::vector<std::complex<double>>   values;          ///< by frequency; nan where an undamped mode is excited
  std::vector<coupling::ResponsePeak> peaks;

  std::string name() const { return to + "/" + from; }
};

template <class Visitor>
void describe(Visitor &v, const ResponsePair &x)
{
  v("name", x.name(), "", "response over force");
  v("from", x.from, "", "location of the force");
  v("to", x.to, "", "location of the response");
  v("unit", x.unit, "", "of the amplitudes");
  v("peaks", x.peaks, "", "largest amplitudes");
}

/// Vibration of the machine, linearised at an operating point, per unit harmonic force.
struct FrequencyResponse
{
  std::string                   kind;                           ///< "receptance", "mobility", "accelerance"
  std::string                   at;                             ///< "start", "equilibrium", "undeformed"
  double                        t     = 0.;                     ///< [s] of the operating point
  bool                          moves = false;                  ///< the operating point is a motion, not at rest
  std::vector<std::string>      closed_contacts, open_contacts; ///< names of elements with clearance
  std::string                   not_condensed;      ///< why the full equations were solved; empty: they were condensed
  bool                          logarithmic = true; ///< frequency axis
  std::vector<double>           frequencies_hz;     ///< ascending
  std::vector<ResponsePair>     pairs;
  std::vector<MeasuredResponse> measured;
};

template <class Visitor>
void describe(Visitor &v, const FrequencyResponse &x)
{
  v("kind", x.kind, "", "receptance, mobility or accelerance");
  v("at", x.at, "", "operating point");
  v("t", x.t, "s", "its time");
  v("moves", x.moves, "", "whether the operating point is a motion");
  v("closed_contacts", x.closed_contacts, "", "elements with clearance that are closed there");
  v("open_contacts", x.open_contacts, "", "elements with clearance that are open there");
  v("points", x.frequencies_hz.size(), "", "number of frequencies");
  v("pairs", x.pairs, "", "pairs of response and force");
  v("measured", x.measured, "", "measured curves");
}

template <class Visitor>
void describe_answer(Visitor &v, const FrequencyResponse &x)
{
  v.maybe(true, "frf", x, "", "`frf`");
}

/// Sections of the report.
std::vector<Section> sections_of(const Result &result, const FrequencyResponse &response);

/// The highest peak of each pair.
Headline headline_of(const FrequencyResponse &response);

/// frf.csv: `frequency [Hz]`, then for each pair `NAME re [unit]`, `NAME im [unit]`, `NAME abs [unit]`, `NAME phase
/// [deg]`.
CsvTable frequency_response_csv(const FrequencyResponse &response);

} // namespace gestell::apps
