#include "coupling/integration/newmark/newmark_methods.h"

#include "coupling/integration/newmark/newmark.h"
#include "coupling/integration/newmark/newmark_family.h"

#include <sstream>

namespace gestell::coupling
{

namespace
{

/// Common base of the methods of the family: all are Newmark's formulas with certain weights.
class FamilyMethod : public IntegrationMethod
{
public:
  std::unique_ptr<TimeIntegrator> make(const SecondOrderSystem &system, const MethodOptions &o) const override
  {
    Newmark::Options options = weights(o);
    options.step             = o.step;
    options.max_halvings     = o.max_halvings;
    options.newton           = o.newton;
    return std::make_unique<Newmark>(system, options);
  }
  Eigen::MatrixXd amplification_matrix(const MethodOptions &options, const TestOscillator &o) const override
  {
    return newmark_matrix(of_oscillator(options), o);
  }
  CharacteristicRoots roots(const MethodOptions &options, const TestOscillator &o) const override
  {
    return newmark_roots(of_oscillator(options), o);
  }
  std::string family() const override { return "Newmark"; }

protected:
  virtual Newmark::Options weights(const MethodOptions &options) const = 0;
  /// Weights for the balance at one instant, without weights of forces.
  static StepWeights balance(const Newmark::Options &o, double r)
  {
    const double d = r - 1., mean = 1. - o.gamma + o.gamma * r;
    return {d * d, d * mean, mean + d * (0.5 - o.beta + o.beta * r)};
  }

private:
  NewmarkFamily of_oscillator(const MethodOptions &options) const
  {
    const Newmark::Options o = weights(options);
    return {o.alpha_m, o.alpha_f, o.beta, o.gamma};
  }
};

std::string labelled(const std::string &name, double parameter)
{
  std::ostringstream text;
  text << name << " " << parameter;
  return text.str();
}

class NewmarkMethod final : public FamilyMethod
{
public:
  std::string name() const override { return "newmark"; }
  std::string meaning() const override { return "Newmark's formulas; beta = 1/4, gamma = 1/2 keep amplitudes."; }
  const std::vector<MethodParameter> &parameters() const override
  {
    static const std::vector<MethodParameter> all = {
        {"beta", "weight of the new acceleration in the displacement", 0.25, "zero or positive",
         [](double beta) { return beta >= 0.; }},
        {"gamma", "weight of the new acceleration in the velocity; numerical damping above 1/2", 0.5, "positive",
         [](double gamma) { return gamma > 0.; }}};
    return all;
  }
  std::string label(const MethodOptions &o) const override
  {
    std::ostringstream text;
    text << "Newmark " << number(o, "beta") << ", " << number(o, "gamma");
    return text.str();
  }
  std::optional<StepWeights> step_weights(const MethodOptions &o, double r) const override
  {
    return balance(weights(o), r);
  }
  std::optional<BilinearWeights> growing_weights(const MethodOptions &options) const override
  {
    const Newmark::Options o = weights(options);
    if (o.gamma >= 0.5)
      return {};
    return BilinearWeights{2. * o.gamma - 1., 4. * o.beta - 2. * o.gamma};
  }

protected:
  Newmark::Options weights(const MethodOptions &o) const override
  {
    Newmark::Options options;
    options.beta  = number(o, "beta");
    options.gamma = number(o, "gamma");
    return options;
  }
};

class HhtMethod final : public FamilyMethod
{
public:
  std::string name() const override { return "hht"; }
  std::string meaning() const override { return "Newmark's formulas with averaged forces (Hilber, Hughes, Taylor)."; }
  const std::vector<MethodParameter> &parameters() const override
  {
    static const std::vector<MethodParameter> all = {
        {"alpha", "numerical damping of high modes: none at 0, largest at -1/3", -0.05, "between -1/3 and 0",
         [](double alpha) { return alpha >= -1. / 3. && alpha <= 0.; }}};
    return all;
  }
  std::string label(const MethodOptions &o) const override { return labelled("HHT", number(o, "alpha")); }

protected:
  Newmark::Options weights(const MethodOptions &o) const override { return Newmark::hht(number(o, "alpha")); }
};

class GeneralisedAlphaMethod final : public FamilyMethod
{
public:
  std::string name() const override { return "generalised-alpha"; }
  std::string meaning() const override
  {
    return "Newmark's formulas with averaged inertia and forces (Chung, Hulbert).";
  }
  const std::vector<MethodParameter> &parameters() const override
  {
    static const std::vector<MethodParameter> all = {
        {"rho_inf", "spectral radius for modes that the step does not resolve", 0.8, "between 0 and 1",
         [](double rho) { return rho >= 0. && rho <= 1.; }}};
    return all;
  }
  std::string label(const MethodOptions &o) const override
  {
    return labelled("generalised alpha", number(o, "rho_inf"));
  }

protected:
  Newmark::Options weights(const MethodOptions &o) const override
  {
    return Newmark::generalised_alpha(number(o, "rho_inf"));
  }
};

class CentralDifferenceMethod final : public FamilyMethod
{
public:
  std::string                name() const override { return "central-difference"; }
  std::string                meaning() const override { return "Central differences; stable for omega h < 2."; }
  std::string                label(const MethodOptions &) const override { return "central differences"; }
  std::optional<StepWeights> step_weights(const MethodOptions &o, double r) const override
  {
    return balance(weights(o), r);
  }

protected:
  Newmark::Options weights(const MethodOptions &) const override { return Newmark::central_difference(); }
};

} // namespace

const IntegrationMethod &newmark_method()
{
  static const NewmarkMethod method;
  return method;
}

const IntegrationMethod &hht_method()
{
  static const HhtMethod method;
  return method;
}

const IntegrationMethod &generalised_alpha_method()
{
  static const GeneralisedAlphaMethod method;
  return method;
}

const IntegrationMethod &central_difference_method()
{
  static const CentralDifferenceMethod method;
  return method;
}

} // namespace gestell::coupling
