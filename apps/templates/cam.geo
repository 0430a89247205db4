// Stand of a cam drive: base plate, two pedestals with the bearings of the camshaft, and behind them a column whose head
// guides the follower.  In mm; camshaft along y through (0, 0, 200), follower along z; it stands on z = 0.

SetFactory("OpenCASCADE");
Geometry.OCCAutoFix = 0;

axis   = 200; // height of the camshaft
bore   = 25;  // radius of its bearings
guide  = 20;  // of the follower's
top    = 420;

Box(1) = {-150, -120, 0, 300, 320, 30};          // base plate
Box(2) = {-50, -100, 0, 100, 30, axis + 50};     // pedestals
Box(3) = {-50, 70, 0, 100, 30, axis + 50};
Box(4) = {-60, 130, 0, 120, 50, top};            // column
Box(5) = {-40, -40, top - 60, 80, 220, 60};      // head
Cylinder(6) = {0, -200, axis, 0, 400, 0, bore};  // bearings, not through the column
Box(7) = {-100, 110, 0, 200, 400, top};
Cylinder(8) = {0, 0, top - 100, 0, 0, 200, guide};

BooleanDifference(9)  = { Volume{6}; Delete; }{ Volume{7}; Delete; };
BooleanUnion(10)      = { Volume{1}; Delete; }{ Volume{2 : 5}; Delete; };
BooleanDifference(11) = { Volume{10}; Delete; }{ Volume{9, 8}; Delete; };
