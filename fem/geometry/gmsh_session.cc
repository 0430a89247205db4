#include "fem/geometry/gmsh_session.h"

#include <gmsh.h>

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Standard_Failure.hxx>

#include <stdexcept>
#include <typeinfo>
#include <vector>

namespace gestell::fem
{

namespace
{

// OpenCASCADE writes its statistics to standard output, which belongs to the answer of the program.
void silence_opencascade()
{
  const Handle(Message_Messenger) &messenger = Message::DefaultMessenger();
  messenger->ChangePrinters().Clear();
}

/// Whether the standard library threw the error in gmsh, such as std::stoi on a damaged file.
bool is_bare(const std::invalid_argument &error)
{
  const std::string words = error.what();
  return words.rfind("sto", 0) == 0 || words.find(' ') == std::string::npos;
}

// gmsh throws what its version likes: an integer, a string or an exception; OpenCASCADE throws its own.
std::string words_of_gmsh()
{
  try
  {
    throw;
  }
  catch (const std::runtime_error &error)
  {
    if (typeid(error) != typeid(std::runtime_error))
      throw; // of the caller's progress report, such as an interruption
    return error.what();
  }
  catch (const std::invalid_argument &error)
  {
    if (!is_bare(error))
      throw; // a message of ours
    return error.what();
  }
  catch (const std::logic_error &error) // std::length_error for a number of nodes that no vector can have
  {
    return error.what();
  }
  catch (const std::string &error)
  {
    return error;
  }
  catch (const char *error)
  {
    return error;
  }
  catch (int code)
  {
    return "code " + std::to_string(code);
  }
  catch (const Standard_Failure &failure)
  {
    return failure.GetMessageString();
  }
}

} // namespace

GmshSession::GmshSession()
{
  gmsh::initialize(0, nullptr, /* read configuration files */ false);
  gmsh::option::setNumber("General.Terminal", 0);
  gmsh::option::setNumber("General.NumThreads", 1);
  gmsh::option::setString("Geometry.OCCTargetUnit", "M");
  gmsh::logger::start();
  silence_opencascade();
}

GmshSession::~GmshSession()
{
  gmsh::logger::stop(); // otherwise the next session would begin with these messages
  gmsh::finalize();
}

void GmshSession::run(const std::function<void()> &action, const std::string &head, const std::string &remedy) const
{
  std::string failure;
  try
  {
    action();
    return;
  }
  catch (...)
  {
    failure = words_of_gmsh();
  }
  const std::string logged = errors();
  throw std::invalid_argument(head + (logged.empty() ? failure : logged) + remedy);
}

std::string GmshSession::errors() const
{
  std::vector<std::string> lines;
  gmsh::logger::get(lines);
  std::string text;
  for (const std::string &line : lines)
    if (line.rfind("Error: ", 0) == 0)
      text += (text.empty() ? "" : "; ") + line.substr(7);
  return text;
}

} // namespace gestell::fem
