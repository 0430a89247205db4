// Straight-side press frame, nominal force 1600 kN: one welded part of steel plates, drawn in mm.
// x to the right, y to the rear, z up; symmetric about x = 0 and y = 0; the feet stand on z = 0.
//
//   gmsh press_frame.geo -0 -o press_frame.step        writes the STEP file (as mm, which is what is meant here)

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

// ---- main dimensions ------------------------------------------------------------------------------------------------
half_width   = 900;   // outer edges of the columns
half_depth   = 560;   // front and rear faces
inner        = 560;   // clear half width between the columns
web_plate    = 80;    // thickness of the web of a column
front_plate  = 80;    // thickness of the plates at the front and at the rear
foot_height  = 80;
bed_bottom   = 300;
table_height = 900;
table_plate  = 140;
crown_bottom = 2200;  // lower face of the crown
crown_top    = 2920;
crown_plate  = 70;    // lower and upper plate of the crown
crank_height = 2560;
bore_radius  = 120;
boss_radius  = 210;
boss_length  = 160;

parts() = {};         // plates to be welded
holes() = {};         // volumes to be cut away

// Box by its two corners, in any order of x0 and x1.
Macro Plate
  v = newv;
  Box(v) = {(x0 + x1 - Fabs(x1 - x0)) / 2, y0, z0, Fabs(x1 - x0), y1 - y0, z1 - z0};
  parts() += {v};
Return
Macro Opening
  v = newv;
  Box(v) = {(x0 + x1 - Fabs(x1 - x0)) / 2, y0, z0, Fabs(x1 - x0), y1 - y0, z1 - z0};
  holes() += {v};
Return

// ---- columns: C-sections, open to the outside, from the feet to the top; bulkheads stiffen them ---------------------
For side In {-1 : 1 : 2}
  y0 = -half_depth;  y1 = half_depth;

  x0 = side * inner;  x1 = side * (inner + web_plate); // web
  z0 = foot_height;  z1 = crown_top;  Call Plate;

  x0 = side * inner;  x1 = side * half_width; // flanges at the front and at the rear
  z0 = foot_height;  z1 = crown_top;
  y0 = -half_depth;  y1 = -half_depth + front_plate;  Call Plate;
  y0 = half_depth - front_plate;  y1 = half_depth;    Call Plate;

  y0 = -half_depth;  y1 = half_depth; // bulkheads at the table and at the crown
  z0 = table_height - 120;  z1 = table_height - 60;  Call Plate;
  z0 = crown_bottom;        z1 = crown_bottom + crown_plate;  Call Plate;

  // Through the web: opening at the bed, feed window, opening for the drive.
  x0 = side * (inner - 20);  x1 = side * (inner + web_plate + 20);
  y0 = -260;  y1 = 260;
  z0 = 340;   z1 = 680;   Call Opening;
  z0 = 980;   z1 = 1380;  Call Opening;
  z0 = 2350;  z1 = 2770;  Call Opening;

  // Two guides (gibs) for the slide on the inner plate.
  x0 = side * (inner - 80);  x1 = side * inner;
  z0 = 1440;  z1 = 2120;
  y0 = -440;  y1 = -300;  Call Plate;
  y0 = 300;   y1 = 440;   Call Plate;

  // Two feet.
  x0 = side * (inner + web_plate);  x1 = side * (half_width + 60);
  z0 = 0;  z1 = foot_height;
  y0 = -half_depth - 40;  y1 = -half_depth + 260;  Call Plate;
  y0 = half_depth - 260;  y1 = half_depth + 40;    Call Plate;
EndFor

// ---- bed: front and rear plate, ribs, table plate -------------------------------------------------------------------
x0 = -inner;  x1 = inner;
z0 = bed_bottom;  z1 = table_height;
y0 = -half_depth;  y1 = -half_depth + front_plate;  Call Plate;
y0 = half_depth - front_plate;  y1 = half_depth;    Call Plate;
y0 = -half_depth;  y1 = half_depth;
z0 = table_height - table_plate;  z1 = table_height;  Call Plate;   // table plate
x0 = -330;  x1 = -270;  z0 = bed_bottom + 120;  z1 = table_height - table_plate;  Call Plate;
x0 = 270;   x1 = 330;   Call Plate;

// Slug hole, and two T-slots from front to rear.
v = newv;
Cylinder(v) = {0, 0, table_height - table_plate - 20, 0, 0, table_plate + 40, 130};
holes() += {v};
For side In {-1 : 1 : 2}
  y0 = -half_depth - 20;  y1 = half_depth + 20;
  x0 = side * 400 - 30;  x1 = side * 400 + 30;  z0 = table_height - 50;  z1 = table_height + 20;  Call Opening;
  x0 = side * 400 - 60;  x1 = side * 400 + 60;  z0 = table_height - 90;  z1 = table_height - 50;  Call Opening;
EndFor

// ---- crown: a box with ribs, and bosses for the crankshaft ----------------------------------------------------------
x0 = -inner;  x1 = inner;  z0 = crown_bottom;  z1 = crown_top;
y0 = -half_depth;  y1 = -half_depth + front_plate;  Call Plate;
y0 = half_depth - front_plate;  y1 = half_depth;    Call Plate;
y0 = -half_depth;  y1 = half_depth;
x0 = -half_width;  x1 = half_width;
z0 = crown_top - crown_plate;  z1 = crown_top;  Call Plate;
x0 = -inner;  x1 = inner;
z0 = crown_bottom;  z1 = crown_bottom + crown_plate;  Call Plate;

x0 = -330;  x1 = 330;  y0 = -330;  y1 = 330;                         // openings for the connecting rod and for assembly
z0 = crown_bottom - 20;  z1 = crown_bottom + crown_plate + 20;  Call Opening;
z0 = crown_top - crown_plate - 20;  z1 = crown_top + 20;  Call Opening;

For side In {-1 : 1 : 2}
  v = newv;
  Cylinder(v) = {0, side * (half_depth + 40), crank_height, 0, -side * boss_length, 0, boss_radius};
  parts() += {v};
  v = newv;
  Cylinder(v) = {0, side * (half_depth + 60), crank_height, 0, -side * (boss_length + 40), 0, bore_radius};
  holes() += {v};
EndFor

// ---- weld, then cut -------------------------------------------------------------------------------------------------
first() = {parts(0)};
others() = {};
For i In {1 : #parts() - 1}
  others() += {parts(i)};
EndFor
welded() = BooleanUnion{ Volume{first()}; Delete; }{ Volume{others()}; Delete; };
frame()  = BooleanDifference{ Volume{welded()}; Delete; }{ Volume{holes()}; Delete; };

Printf("press frame: %g solid (must be 1)", #frame());
