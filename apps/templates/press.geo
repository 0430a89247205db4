// Press frame: table and crown between two columns, drawn as solid bars in mm.  The crankshaft runs along y in bores of the
// crown, the slide between the columns; z up, symmetric about x = 0 and y = 0, it stands on z = 0.

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

window = 960;  // between the columns
column = 240;  // width of a column along x
depth  = 500;  // along y
height = 2800;
table  = 900;  // its upper face
crown  = 2260; // its lower face
axis   = 2560; // of the crankshaft
bore   = 120;  // radius
guide  = 40;   // thickness of the guides

outer = window/2 + column;
Box(1) = {-outer, -depth/2, 0, column, depth, height};
Box(2) = {window/2, -depth/2, 0, column, depth, height};
Box(3) = {-window/2, -depth/2, table - 400, window, depth, 400};
Box(4) = {-window/2, -depth/2, crown, window, depth, height - crown};
Box(5) = {-window/2, -depth/2, 1200, guide, depth, 900}; // guides of the slide on the columns
Box(6) = {window/2 - guide, -depth/2, 1200, guide, depth, 900};
Cylinder(7) = {0, -depth, axis, 0, 2*depth, 0, bore};

BooleanUnion(8)      = { Volume{1}; Delete; }{ Volume{2 : 6}; Delete; };
BooleanDifference(9) = { Volume{8}; Delete; }{ Volume{7}; Delete; };
