// Welded table for a motor: plate on four legs, with two rails.  In mm; z up, it stands on z = 0, the middle of the plate
// above the origin.

SetFactory("OpenCASCADE");

length = 1200; // of the plate, along x
width  = 800;  // along y
height = 700;  // of its top
plate  = 20;   // thickness
leg    = 80;   // edge of a leg
rail   = 60;   // height of the rails under the plate

Box(1) = {-length/2, -width/2, height - plate, length, width, plate};
n = 2;
For i In {-1 : 1 : 2}
  For j In {-1 : 1 : 2}
    Box(n) = {i*(length - leg)/2 - leg/2, j*(width - leg)/2 - leg/2, 0, leg, leg, height - plate};
    n += 1;
  EndFor
  Box(n) = {-length/2, i*(width - leg)/2 - leg/2, height - plate - rail, length, leg, rail};
  n += 1;
EndFor
Box(n) = {-150, -100, height, 300, 200, 20}; // seat of the motor

BooleanUnion(100) = { Volume{1}; Delete; }{ Volume{2 : n}; Delete; };
