// Foot of 0.06 m x 0.2 m x 0.2 m along x in three hexahedra, in m.
SetFactory("OpenCASCADE");
Point(1) = {-0.06, -0.1, -0.1, 1};
line[] = Extrude {0, 0.2, 0} { Point{1}; Layers{1}; };
face[] = Extrude {0, 0, 0.2} { Curve{line[1]}; Layers{1}; Recombine; };
a[] = Extrude {0.02, 0, 0} { Surface{face[1]}; Layers{1}; Recombine; };
b[] = Extrude {0.02, 0, 0} { Surface{a[0]}; Layers{1}; Recombine; };
Extrude {0.02, 0, 0} { Surface{b[0]}; Layers{1}; Recombine; }
Mesh 3;
