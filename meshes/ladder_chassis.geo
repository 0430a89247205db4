// Ladder chassis of a truck: two C-section longitudinal members and five C-section cross members, welded of plates 10 to
// 16 mm thick, drawn in mm.  x forward, y to the left, z up; symmetric about y = 0; the lower flanges stand on z = 0.
//
//   gmsh ladder_chassis.geo -0 -o ladder_chassis.step      writes the STEP file (as mm, which is what is meant here)

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

// ---- dimensions -----------------------------------------------------------------------------------------------------
length        = 3600;
half_width    = 400;  // outer faces of the webs of the longitudinal members
height        = 180;  // of a longitudinal member
flange        = 80;   // its width, from the outer face of the web to the middle of the chassis
web_plate     = 10;
flange_plate  = 12;
cross_bottom  = 30;   // cross members stand between the flanges and butt on the webs
cross_top     = 150;
cross_flange  = 60;
cross_plate   = 10;
pad           = 16;   // thickness of the pads under axles and engine

cross_at() = {0, 840, 1680, 2520, 3590}; // x of the web of each cross member; its flanges point forward, of the last to the rear
axle_at()  = {500, 3000};                // x of the middle of the axle pads, 120 long
engine_at  = 2200;                       // x of the middle of the engine's, 100 long

parts() = {};
Macro Plate // box from (x0, y0, z0) to (x1, y1, z1)
  v = newv;
  Box(v) = {x0, y0, z0, x1 - x0, y1 - y0, z1 - z0};
  parts() += {v};
Return

For side In {-1 : 1 : 2}
  x0 = 0;  x1 = length;
  y0 = side < 0 ? -half_width : half_width - web_plate;
  y1 = y0 + web_plate;
  z0 = 0;  z1 = height;  Call Plate;
  y0 = side < 0 ? -half_width : half_width - flange;
  y1 = y0 + flange;
  z0 = 0;                      z1 = flange_plate;  Call Plate;
  z0 = height - flange_plate;  z1 = height;        Call Plate;
  For i In {0 : #axle_at() - 1}
    x0 = axle_at(i) - 60;  x1 = axle_at(i) + 60;
    z0 = -pad;  z1 = 0;  Call Plate;
  EndFor
  x0 = engine_at - 50;  x1 = engine_at + 50;
  z0 = height;  z1 = height + pad;  Call Plate;
EndFor

For i In {0 : #cross_at() - 1}
  last = i == #cross_at() - 1;
  y0 = -half_width + web_plate;  y1 = half_width - web_plate;
  x0 = cross_at(i);  x1 = x0 + cross_plate;
  z0 = cross_bottom;  z1 = cross_top;  Call Plate;
  x0 = last ? length - cross_flange : cross_at(i);  x1 = x0 + cross_flange;
  z0 = cross_bottom;               z1 = cross_bottom + cross_plate;  Call Plate;
  z0 = cross_top - cross_plate;    z1 = cross_top;                   Call Plate;
EndFor

// ---- weld -----------------------------------------------------------------------------------------------------------
others() = {};
For i In {1 : #parts() - 1}
  others() += {parts(i)};
EndFor
chassis() = BooleanUnion{ Volume{parts(0)}; Delete; }{ Volume{others()}; Delete; };

Printf("ladder chassis: %g solid (must be 1)", #chassis());
