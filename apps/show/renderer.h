#pragma once

#include "apps/show/picture_request.h"

#include <vtkNew.h>
#include <vtkSmartPointer.h>

class vtkActor2D;
class vtkImageData;
class vtkPolyData;
class vtkRenderWindow;
class vtkRenderer;
class vtkScalarBarActor;
class vtkTextActor;

namespace gestell::apps
{

/// Read parts of one frame.
using Parts = std::vector<vtkSmartPointer<vtkPolyData>>;

/// @throws std::invalid_argument for a broken file, or one without points
Parts read_parts(const PictureFrame &frame);

/// Largest displacement of these parts [m] and the box around their points.
double largest_displacement(const Parts &parts);

/// Draws parts off screen: frames coloured by displacement, each body in one colour, axes, a colour bar, a caption.
class Renderer
{
public:
  Renderer(int width, int height);
  ~Renderer();

  /// Sets the camera so that the box [xmin, xmax, ymin, ...; m] fills the picture.
  void look_at(const double *box);

  /// Whether displacements have a size, which the colour bar shows; those of modes do not.
  enum class Sizes
  {
    known,
    unknown
  };

  /// @param most  displacement [m] at the end of the colour scale
  vtkSmartPointer<vtkImageData> draw(const Parts &parts, double enlargement, double most, const std::string &caption,
                                     Sizes sizes);

private:
  void add_part(vtkPolyData *part, double enlargement, double most);
  void add_names(vtkPolyData *part);

  vtkNew<vtkRenderWindow>   window_;
  vtkNew<vtkRenderer>       scene_, corner_;
  vtkNew<vtkTextActor>      caption_;
  vtkNew<vtkScalarBarActor> bar_;
};

} // namespace gestell::apps
