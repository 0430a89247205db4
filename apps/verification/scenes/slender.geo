// Bar of 2 m x 0.02 m x 0.02 m along x in 40 hexahedra, in m.
SetFactory("OpenCASCADE");
Point(1) = {0, -0.01, -0.01, 1};
line[] = Extrude {0, 0.02, 0} { Point{1}; Layers{1}; };
face[] = Extrude {0, 0, 0.02} { Curve{line[1]}; Layers{1}; Recombine; };
Extrude {2, 0, 0} { Surface{face[1]}; Layers{40}; Recombine; }
Mesh 3;
