#include "apps/scene/build/damping_text.h"

#include <sstream>
#include <vector>

namespace gestell::apps
{
namespace
{

std::string joined(const std::vector<std::string> &ways)
{
  std::string text;
  for (const std::string &way : ways)
    text += (text.empty() ? "" : "; ") + way;
  return text.empty() ? "no damping of the frame itself" : text;
}

std::string rayleigh_text(double alpha, double beta)
{
  std::ostringstream text;
  text.precision(4);
  text << "Rayleigh damping, B = alpha M + beta C of the material with alpha = " << alpha << " 1/s, beta = " << beta
       << " s";
  return text.str();
}

std::string text_of(const fem::FrameSpecification &frame)
{
  std::vector<std::string> ways;
  if (frame.modal_damping_ratio.any())
    ways.push_back(frame.modal_damping_ratio.text());
  if (frame.rayleigh_mass > 0. || frame.rayleigh_stiffness > 0.)
    ways.push_back(rayleigh_text(frame.rayleigh_mass, frame.rayleigh_stiffness));
  std::string supports;
  for (const fem::Support &support : frame.supports)
    if (support.damping != fem::Vector3{})
      supports += (supports.empty() ? "dampers of the support " : ", ") + support.name;
  if (!supports.empty())
    ways.push_back(supports);
  return joined(ways);
}

std::string text_of(const coupling::FrameOfParts &frame)
{
  std::vector<std::string> ways;
  if (frame.modal_damping_ratio.any())
    ways.push_back(frame.modal_damping_ratio.text());
  for (const coupling::FramePart &part : frame.parts)
    if (const std::string own = text_of(part.geometry); own != joined({}))
      ways.push_back("of part " + part.name + " " + own);
  for (const coupling::FrameJoint &joint : frame.joints)
    if (!joint.bolts.damping.isZero(0.) || !joint.bolts.rotational_damping.isZero(0.) || joint.rod.damping > 0.)
      ways.push_back("dampers of the joint " + joint.name);
  return joined(ways);
}

std::string text_of(const fem::FrameMatrices &frame)
{
  std::vector<std::string> ways;
  if (frame.modal_damping_ratio.any())
    ways.push_back(frame.modal_damping_ratio.text());
  if (frame.B.nonZeros() > 0)
    ways.push_back("the damping matrix of the scene");
  return joined(ways);
}

} // namespace

std::string damping_text(const FrameRequest &frame)
{
  switch (frame.source)
  {
  case FrameSource::none:
    break;
  case FrameSource::geometry:
    return text_of(frame.geometry);
  case FrameSource::parts:
    return text_of(frame.parts);
  case FrameSource::matrices:
    return text_of(frame.matrices);
  case FrameSource::reduced_file:
    return "as in the reduced frame";
  }
  return {};
}

} // namespace gestell::apps
