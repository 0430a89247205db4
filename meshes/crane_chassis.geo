// Chassis of a mobile crane: two longitudinal box girders, eight cross plates that go through them, boxes between these
// under boom and cylinder, columns with the bores of the boom's pin, lugs with those of the cylinder's; plates 10 to 16 mm,
// drawn in mm.  x forward, y to the left, z up; the origin lies at the height of the axles midway between them; symmetric
// about y = 0.
//
//   gmsh crane_chassis.geo -0 -o crane_chassis.step        writes the STEP file (as mm, which is what is meant here)

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

// ---- dimensions -----------------------------------------------------------------------------------------------------
rear         = -2600; // ends
front        = 2600;
inner        = 330;   // inner and outer faces of the girders
outer        = 530;
bottom       = 200;   // their lower and upper faces
top          = 600;
web          = 12;    // plates of the girders
flange       = 16;
plate        = 10;    // cross plates; those of boxes and columns
box_plate    = 12;
pad          = 16;    // under the axles and under what stands on the chassis
axle         = 2100;  // in front of and behind the origin
column_rear  = -1200; // columns of the boom's pin
column_front = -600;
column_top   = 1930;
pin_x        = -900;
pin_z        = 1700;
pin_radius   = 60;
box_rear     = 350;   // box of the cylinder
box_front    = 650;
lug_half     = 110;   // lugs of the cylinder, half as long
lug_y        = 90;    // their inner faces
lug_plate    = 16;
lug_top      = 820;
foot_x       = 500;
foot_z       = 700;
foot_radius  = 45;

parts() = {};
Macro Plate // box from (x0, y0, z0) to (x1, y1, z1)
  v = newv;
  Box(v) = {x0, y0, z0, x1 - x0, y1 - y0, z1 - z0};
  parts() += {v};
Return

For side In {-1 : 1 : 2}
  near = side < 0 ? -outer : inner; // the face of lesser y
  far  = near + outer - inner;

  x0 = rear;  x1 = front; // girder
  z0 = bottom;  z1 = top;
  y0 = near;       y1 = near + web;  Call Plate;
  y0 = far - web;  y1 = far;         Call Plate;
  y0 = near;       y1 = far;
  z1 = bottom + flange;             Call Plate;
  z0 = top - flange;  z1 = top;     Call Plate;

  x0 = column_rear;  x1 = column_front; // column
  z0 = top;  z1 = column_top;
  y0 = near;       y1 = near + web;  Call Plate;
  y0 = far - web;  y1 = far;         Call Plate;
  y0 = near;       y1 = far;
  x0 = column_rear;               x1 = column_rear + box_plate;  Call Plate;
  x0 = column_front - box_plate;  x1 = column_front;             Call Plate;
  x0 = column_rear;               x1 = column_front;
  z0 = column_top - flange;  Call Plate;

  y0 = side < 0 ? -lug_y - lug_plate : lug_y; // lug
  y1 = y0 + lug_plate;
  x0 = foot_x - lug_half;  x1 = foot_x + lug_half;
  z0 = top;  z1 = lug_top;  Call Plate;

  For end In {-1 : 1 : 2} // pads
    y0 = near;  y1 = far;
    x0 = end * axle - 150;  x1 = end * axle + 150;
    z0 = bottom - pad;  z1 = bottom;  Call Plate;
    z0 = top;  z1 = top + pad;        Call Plate;
  EndFor
EndFor

y0 = -outer;  y1 = outer; // cross plates, through the girders
z0 = bottom;  z1 = top;
x0 = rear;              x1 = rear + plate;       Call Plate;
x0 = front - plate;     x1 = front;              Call Plate;
x0 = -axle - plate / 2; x1 = -axle + plate / 2;  Call Plate;
x0 = axle - plate / 2;  x1 = axle + plate / 2;   Call Plate;
x0 = column_rear;               x1 = column_rear + box_plate;  Call Plate;
x0 = column_front - box_plate;  x1 = column_front;             Call Plate;
x0 = box_rear;                  x1 = box_rear + box_plate;     Call Plate;
x0 = box_front - box_plate;     x1 = box_front;                Call Plate;

y0 = -inner;  y1 = inner; // lower and upper plates of the boxes
x0 = column_rear;  x1 = column_front;
z0 = bottom;  z1 = bottom + flange;  Call Plate;
z0 = top - flange;  z1 = top;        Call Plate;
x0 = box_rear;  x1 = box_front;
z0 = bottom;  z1 = bottom + flange;  Call Plate;
z0 = top - flange;  z1 = top;        Call Plate;

// ---- weld, then bore ------------------------------------------------------------------------------------------------
others() = {};
For i In {1 : #parts() - 1}
  others() += {parts(i)};
EndFor
welded() = BooleanUnion{ Volume{parts(0)}; Delete; }{ Volume{others()}; Delete; };

pin = newv;
Cylinder(pin) = {pin_x, -outer - 20, pin_z, 0, 2 * outer + 40, 0, pin_radius};
foot = newv;
Cylinder(foot) = {foot_x, -lug_y - lug_plate - 20, foot_z, 0, 2 * (lug_y + lug_plate) + 40, 0, foot_radius};
chassis() = BooleanDifference{ Volume{welded()}; Delete; }{ Volume{pin}; Volume{foot}; Delete; };

Printf("crane chassis: %g solid (must be 1)", #chassis());
