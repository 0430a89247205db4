// The chassis of ladder_chassis.geo in hexahedra: all its plates stand at right angles, so that the planes of their sides
// divide it into bricks, each with `layers` of cells through its thickness.
//
// The script meshes by itself; Mesh.MeshSizeMax, which is mesh.size of the scene, is the largest side of a cell.  Along the
// edges of every plate, where stresses change fast, cells are an eighth of it wide.

layers = 1;                    // of cells through every plate, at least
edge   = Mesh.MeshSizeMax / 8; // width of the cells along edges

// ---- dimensions, as in ladder_chassis.geo ---------------------------------------------------------------------------
length        = 3600;
half_width    = 400;
height        = 180;
flange        = 80;
web_plate     = 10;
flange_plate  = 12;
cross_bottom  = 30;
cross_top     = 150;
cross_flange  = 60;
cross_plate   = 10;
pad           = 16;
thickest      = 16; // plate: what is wider is no thickness

cross_at() = {0, 840, 1680, 2520, 3590};
axle_at()  = {500, 3000};
engine_at  = 2200;

// ---- the planes that divide it --------------------------------------------------------------------------------------
sides_x() = {0, 10, 60, 440, 560, 840, 850, 900, 1680, 1690, 1740, 2150, 2250, 2520, 2530, 2580, 2940, 3060, 3540, 3590, 3600};
sides_y() = {-half_width, -half_width + web_plate, -half_width + flange, half_width - flange, half_width - web_plate, half_width};
sides_z() = {-pad, 0, flange_plate, cross_bottom, cross_bottom + cross_plate, cross_top - cross_plate, cross_top,
             height - flange_plate, height, height + pad};

// Between sides that are no plate's, planes along each of them: one narrow cell, one of middle width.
sides() = {};
planes() = {};
Macro AlongEdges
  planes() = {sides(0)};
  For i In {1 : #sides() - 1}
    width = sides(i) - sides(i - 1);
    If (width > thickest + 1e-3 && width > 10 * edge)
      planes() += {sides(i - 1) + edge, sides(i - 1) + 4 * edge, sides(i) - 4 * edge, sides(i) - edge};
    ElseIf (width > thickest + 1e-3 && width > 3 * edge)
      planes() += {sides(i - 1) + edge, sides(i) - edge};
    EndIf
    planes() += {sides(i)};
  EndFor
Return
sides() = {sides_x()};
Call AlongEdges;
xs() = {planes()};
sides() = {sides_y()};
Call AlongEdges;
ys() = {planes()};
sides() = {sides_z()};
Call AlongEdges;
zs() = {planes()};
nx = #xs() - 1;
ny = #ys() - 1;
nz = #zs() - 1;

// ---- which bricks are steel -----------------------------------------------------------------------------------------
eps = 1e-3;
steel() = {};
For k In {0 : nz - 1}
  z = (zs(k) + zs(k + 1)) / 2;
  For j In {0 : ny - 1}
    y = Fabs((ys(j) + ys(j + 1)) / 2);
    For i In {0 : nx - 1}
      x = (xs(i) + xs(i + 1)) / 2;
      in_web    = y > half_width - web_plate && z > 0 && z < height;
      in_flange = y > half_width - flange && ((z > 0 && z < flange_plate) || (z > height - flange_plate && z < height));
      in_pad    = y > half_width - flange && z > height && Fabs(x - engine_at) < 50;
      in_cross  = 0;
      For a In {0 : #axle_at() - 1}
        in_pad = in_pad || (y > half_width - flange && z < 0 && Fabs(x - axle_at(a)) < 60);
      EndFor
      For c In {0 : #cross_at() - 1}
        begin = c == #cross_at() - 1 ? length - cross_flange : cross_at(c);
        in_cross = in_cross ||
          (y < half_width - web_plate && z > cross_bottom && z < cross_top &&
           ((x > cross_at(c) && x < cross_at(c) + cross_plate) ||
            (x > begin && x < begin + cross_flange && (z < cross_bottom + cross_plate || z > cross_top - cross_plate))));
      EndFor
      steel(i + nx * (j + ny * k)) = in_web || in_flange || in_pad || in_cross;
    EndFor
  EndFor
EndFor

// ---- points, edges, faces and bricks, numbered by their place in the lattice ----------------------------------------
// An edge, face or point is made by the first brick that has it; made() remembers.
px = nx + 1;
py = ny + 1;
n  = px * py * (nz + 1);
made_point() = {};
made_x() = {};  made_y() = {};  made_z() = {};
made_yz() = {}; made_zx() = {}; made_xy() = {};
For p In {0 : n - 1}
  made_point(p) = 0;
  made_x(p) = 0;  made_y(p) = 0;  made_z(p) = 0;
  made_yz(p) = 0; made_zx(p) = 0; made_xy(p) = 0;
EndFor

Macro Cells // along an edge of length `width`
  cells = Ceil(width / Mesh.MeshSizeMax - eps);
  If (width < thickest + eps && cells < layers)
    cells = layers;
  EndIf
Return
Macro MakePoint // p
  If (!made_point(p))
    made_point(p) = 1;
    kk = Floor((p + 0.5) / (px * py));
    jj = Floor((p - kk * px * py + 0.5) / px);
    Point(1 + p) = {xs(p - px * (jj + py * kk)), ys(jj), zs(kk)};
  EndIf
Return
Macro MakeX
  If (!made_x(p))
    made_x(p) = 1;
    Line(1 + p) = {1 + p, 2 + p};
    ii = p - px * Floor((p + 0.5) / px);
    width = xs(ii + 1) - xs(ii);  Call Cells;
    Transfinite Curve{1 + p} = 1 + cells;
  EndIf
Return
Macro MakeY
  If (!made_y(p))
    made_y(p) = 1;
    Line(1 + n + p) = {1 + p, 1 + px + p};
    jj = Floor((p + 0.5) / px) - py * Floor((p + 0.5) / (px * py));
    width = ys(jj + 1) - ys(jj);  Call Cells;
    Transfinite Curve{1 + n + p} = 1 + cells;
  EndIf
Return
Macro MakeZ
  If (!made_z(p))
    made_z(p) = 1;
    Line(1 + 2 * n + p) = {1 + p, 1 + px * py + p};
    kk = Floor((p + 0.5) / (px * py));
    width = zs(kk + 1) - zs(kk);  Call Cells;
    Transfinite Curve{1 + 2 * n + p} = 1 + cells;
  EndIf
Return

For k In {0 : nz - 1}
  For j In {0 : ny - 1}
    For i In {0 : nx - 1}
      If (steel(i + nx * (j + ny * k)))
        o = i + px * (j + py * k);
        For dz In {0 : 1}
          For dy In {0 : 1}
            For dx In {0 : 1}
              p = o + dx + px * dy + px * py * dz;  Call MakePoint;
            EndFor
          EndFor
        EndFor
        For a In {0 : 1}
          For b In {0 : 1}
            p = o + px * a + px * py * b;  Call MakeX;
            p = o + a + px * py * b;       Call MakeY;
            p = o + a + px * b;            Call MakeZ;
          EndFor
        EndFor
        For a In {0 : 1}
          p = o + a; // across x
          If (!made_yz(p))
            made_yz(p) = 1;
            Curve Loop(1 + p) = {1 + n + p, 1 + 2 * n + p + px, -(1 + n + p + px * py), -(1 + 2 * n + p)};
            Plane Surface(1 + p) = {1 + p};
            Transfinite Surface{1 + p};  Recombine Surface{1 + p};
          EndIf
          p = o + px * a; // across y
          If (!made_zx(p))
            made_zx(p) = 1;
            Curve Loop(1 + n + p) = {1 + 2 * n + p, 1 + p + px * py, -(1 + 2 * n + p + 1), -(1 + p)};
            Plane Surface(1 + n + p) = {1 + n + p};
            Transfinite Surface{1 + n + p};  Recombine Surface{1 + n + p};
          EndIf
          p = o + px * py * a; // across z
          If (!made_xy(p))
            made_xy(p) = 1;
            Curve Loop(1 + 2 * n + p) = {1 + p, 1 + n + p + 1, -(1 + p + px), -(1 + n + p)};
            Plane Surface(1 + 2 * n + p) = {1 + 2 * n + p};
            Transfinite Surface{1 + 2 * n + p};  Recombine Surface{1 + 2 * n + p};
          EndIf
        EndFor
        Surface Loop(1 + o) = {1 + o, 2 + o, 1 + n + o, 1 + n + o + px, 1 + 2 * n + o, 1 + 2 * n + o + px * py};
        Volume(1 + o) = {1 + o};
        Transfinite Volume{1 + o};
      EndIf
    EndFor
  EndFor
EndFor

Mesh 3;
