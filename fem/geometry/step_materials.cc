#include "fem/geometry/step_materials.h"

#include <STEPConstruct_UnitContext.hxx>
#include <StepBasic_ConversionBasedUnit.hxx>
#include <StepBasic_DerivedUnit.hxx>
#include <StepBasic_DerivedUnitElement.hxx>
#include <StepBasic_MeasureWithUnit.hxx>
#include <StepBasic_ProductDefinition.hxx>
#include <StepBasic_SiUnit.hxx>
#include <StepData_StepModel.hxx>
#include <StepRepr_CharacterizedDefinition.hxx>
#include <StepRepr_DescriptiveRepresentationItem.hxx>
#include <StepRepr_MeasureRepresentationItem.hxx>
#include <StepRepr_ProductDefinitionShape.hxx>
#include <StepRepr_PropertyDefinition.hxx>
#include <StepRepr_PropertyDefinitionRepresentation.hxx>
#include <StepRepr_Representation.hxx>
#include <StepRepr_RepresentedDefinition.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TransferBRep.hxx>
#include <Transfer_TransientProcess.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>

#include <cmath>
#include <utility>

namespace gestell::fem
{

namespace
{

/// Size by kilograms or metres, NAN for others, and the name of the SI unit.
using UnitSize = std::pair<double, StepBasic_SiUnitName>;

UnitSize size_of_si_unit(const Handle(StepBasic_NamedUnit) & unit)
{
  const auto si = Handle(StepBasic_SiUnit)::DownCast(unit);
  if (si.IsNull())
    return {NAN, StepBasic_sunMetre};
  const double prefix = si->HasPrefix() ? STEPConstruct_UnitContext::ConvertSiPrefix(si->Prefix()) : 1.;
  return {si->Name() == StepBasic_sunGram ? 1e-3 * prefix : prefix, si->Name()};
}

/// Inches and pounds are multiples of SI units; a file may name a unit as a multiple of itself.
UnitSize size_of_unit(const Handle(StepBasic_NamedUnit) & unit)
{
  const auto converted = Handle(StepBasic_ConversionBasedUnit)::DownCast(unit);
  if (converted.IsNull() || converted->ConversionFactor().IsNull())
    return size_of_si_unit(unit);
  UnitSize size = size_of_si_unit(converted->ConversionFactor()->UnitComponent().NamedUnit());
  size.first *= converted->ConversionFactor()->ValueComponent();
  return size;
}

/// [kg/m^3]; NAN without a unit of mass and one of length. Their exponents are known; those that OpenCASCADE writes are
/// wrong (g^3 cm^2).
double density_of(const StepBasic_MeasureWithUnit &measure)
{
  const auto unit = measure.UnitComponent().DerivedUnit();
  double     mass = NAN, length = NAN;
  for (int i = 1; !unit.IsNull() && i <= unit->NbElements(); ++i)
  {
    const auto [size, name] = size_of_unit(unit->ElementsValue(i)->Unit());
    if (name != StepBasic_sunGram && name != StepBasic_sunMetre)
      return NAN; // specific heat, for example
    (name == StepBasic_sunGram ? mass : length) = size;
  }
  return measure.ValueComponent() * mass / (length * length * length);
}

/// The part with a property, in place.
TopoDS_Shape part_of(const StepRepr_PropertyDefinition &property, const STEPControl_Reader &reader)
{
  const StepRepr_CharacterizedDefinition of = property.Definition();
  Handle(StepBasic_ProductDefinition) part  = of.ProductDefinition();
  if (const auto shape = of.ProductDefinitionShape(); part.IsNull() && !shape.IsNull())
    part = shape->Definition().ProductDefinition();
  return part.IsNull() ? TopoDS_Shape()
                       : TransferBRep::ShapeResult(reader.WS()->TransferReader()->TransientProcess(), part);
}

void add_material(ShapeLabel &label, const StepRepr_Representation &property)
{
  for (int i = 1; i <= property.NbItems(); ++i)
  {
    const auto item = property.ItemsValue(i);
    if (item.IsNull())
      continue;
    if (item->IsKind(STANDARD_TYPE(StepRepr_DescriptiveRepresentationItem)) && !item->Name().IsNull())
      label.material = item->Name()->ToCString();
    if (const auto measure = Handle(StepRepr_MeasureRepresentationItem)::DownCast(item);
        !measure.IsNull() && !measure->Measure().IsNull())
      if (const double density = density_of(*measure->Measure());
          density > 0. && std::isfinite(density) && !(label.density > 0.)) // the first is taken
        label.density = density;
  }
}

} // namespace

void read_step_materials(CadShape &shape, const STEPControl_Reader &reader)
{
  const auto entities = reader.StepModel();
  for (int i = 1; i <= entities->NbEntities(); ++i)
  {
    const auto property = Handle(StepRepr_PropertyDefinitionRepresentation)::DownCast(entities->Value(i));
    if (property.IsNull() || property->UsedRepresentation().IsNull())
      continue;
    const auto definition = property->Definition().PropertyDefinition();
    if (definition.IsNull() || definition->Name().IsNull() ||
        !definition->Name()->IsSameString(new TCollection_HAsciiString("material property"), false))
      continue;
    const TopoDS_Shape part = part_of(*definition, reader);
    if (part.IsNull())
      continue;
    TopTools_IndexedMapOfShape solids;
    TopExp::MapShapes(part, TopAbs_SOLID, solids);
    if (solids.IsEmpty()) // its shell is open
      solids.Add(part);
    for (int k = 1; k <= solids.Extent(); ++k)
      add_material(shape.labels[solids(k).TShape()], *property->UsedRepresentation());
  }
}

} // namespace gestell::fem
