#include "apps/output/paraview/view_macro.h"

#include "fem/values/number_text.h"

namespace gestell::apps
{
namespace
{

const char *const macro_head =
    R"py(# Opens this result in ParaView: displacements enlarged, colours, arrows of velocities
# and, thicker, of the forces that elements exert on bodies.
#   paraview --script=view.py           or in ParaView: View > Python Shell > Run Script
#   pvbatch view.py picture.png         draws without a window
import inspect, os, sys
from paraview.simple import *

)py";

const char *const macro_body = R"py(
here = os.path.dirname(os.path.abspath(inspect.getsourcefile(lambda: 0) or "."))
if not os.path.exists(os.path.join(here, "motion.pvd")):
    here = os.getcwd()
motion = PVDReader(registrationName="motion", FileName=os.path.join(here, "motion.pvd"))
scene = GetAnimationScene()
scene.UpdateAnimationUsingDataTimeSteps()
scene.AnimationTime = min(motion.TimestepValues, key=lambda t: abs(t - begin))
view = GetActiveViewOrCreate("RenderView")
view.ViewTime = scene.AnimationTime
view.ViewSize = [1000, 800]
view.OrientationAxesVisibility = 1
view.OrientationAxesLabelColor = [0., 0., 0.]

warped = WarpByVector(registrationName="deformed", Input=motion)
warped.Vectors = ["POINTS", "displacement [m]"]
warped.ScaleFactor = times
shown = Show(warped, view)
ColorBy(shown, ("POINTS", "displacement [m]", "Magnitude"))
shown.RescaleTransferFunctionToDataRange(False, True)
shown.SetScalarBarVisibility(view, True)
bar = GetScalarBar(GetColorTransferFunction("displacement [m]"), view)
bar.TitleColor = bar.LabelColor = [0., 0., 0.]
bar.TitleFontSize = bar.LabelFontSize = 14
bar.Title, bar.ComponentTitle = "displacement [m]", ""
shown.Opacity = 0.6

if speed > 0.:
    arrows = Glyph(registrationName="velocities", Input=warped, GlyphType="Arrow")
    arrows.OrientationArray = ["POINTS", "velocity [m/s]"]
    arrows.ScaleArray = ["POINTS", "velocity [m/s]"]
    arrows.ScaleFactor = size / 12. / speed
    arrows.GlyphMode = "Uniform Spatial Distribution (Bounds Based)"
    arrows.MaximumNumberOfSamplePoints = 300
    drawn = Show(arrows, view)
    ColorBy(drawn, None)
    drawn.AmbientColor = drawn.DiffuseColor = [0.8, 0.2, 0.1]

if force > 0.:
    acting = PVDReader(registrationName="forces", FileName=os.path.join(here, "forces.pvd"))
    places = WarpByVector(registrationName="places of forces", Input=acting)
    places.Vectors = ["POINTS", "displacement [m]"]
    places.ScaleFactor = times
    pushes = Glyph(registrationName="forces on bodies", Input=places, GlyphType="Arrow")
    pushes.OrientationArray = ["POINTS", "force [N]"]
    pushes.ScaleArray = ["POINTS", "force [N]"]
    pushes.ScaleFactor = size / 6. / force
    pushes.GlyphMode = "All Points"
    shafts = Show(pushes, view)
    shafts.ColorArrayName = [None, ""]
    shafts.AmbientColor = shafts.DiffuseColor = [0.1, 0.5, 0.2]

if os.path.exists(os.path.join(here, "names.pvd")):
    names = PVDReader(registrationName="names", FileName=os.path.join(here, "names.pvd"))
    places = WarpByVector(registrationName="places of names", Input=names)
    places.Vectors = ["POINTS", "displacement [m]"]
    places.ScaleFactor = times
    written = Show(places, view)
    written.Opacity = 0.
    written.SelectionPointLabelVisibility = 1
    written.SelectionPointFieldDataArrayName = "body"
    written.SelectionPointLabelFontSize = 16
    written.SelectionPointLabelColor = [0., 0., 0.]
    QuerySelect(QueryString="(id >= 0)", FieldType="POINT", InsideOut=0, Source=places)

words = AnnotateTimeFilter(registrationName="time", Input=motion)
words.Format = "t = {time:f} s, displacements " + "%g" % times + " times"
written = Show(words, view)
written.Color = [0., 0., 0.]
written.FontSize = 16

view.CameraParallelProjection = 1
view.CameraFocalPoint = [0., 0., 0.]
view.CameraPosition = [0.55, -0.75, 0.36]
view.CameraViewUp = [0., 0., 1.]
view.Background = [1., 1., 1.]
try:
    view.UseColorPaletteForBackground = 0
except AttributeError:
    pass
ResetCamera(view)
Render(view)
if len(sys.argv) > 1 and sys.argv[-1].endswith(".png"):
    SaveScreenshot(sys.argv[-1], view, ImageResolution=[1000, 800])
)py";

} // namespace

std::string view_macro(const ViewMacro &view)
{
  return macro_head + ("times = " + exact_text(view.enlargement) + "  # enlargement of displacements\nbegin = ") +
         exact_text(view.time) + "  # [s], the main peak\nsize = " + exact_text(view.size) +
         "  # [m], of the machine\nspeed = " + exact_text(view.speed) +
         "  # [m/s], the largest at that time\nforce = " + exact_text(view.force) +
         "  # [N], the largest at that time\n" + macro_body;
}

} // namespace gestell::apps
