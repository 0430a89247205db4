// a comment
SetFactory("OpenCASCADE");
DefineConstant[ w = {0.1, Min 0, Max 1, Name "width"} ];
lc = DefineNumber[ 0.2, Name "Parameters/lc" ];
Box(1) = {0, 0, 0, 1.5e-1, w, 0.3};
For i In {1:3}
  Point(10+i) = {i*w, 0, 0, lc};
EndFor
If (w > 0.05)
  Printf("%g", w);
Else
  Error("no");
EndIf
Macro Hole
  Cylinder(newv) = {x, y, 0, 0, 0, 1, r, 2*Pi};
Return
Call Hole;
Physical Volume("frame") = {1};
Field[1] = Box;
Field[1].VIn = 0.1;
Background Field = 1;
Transfinite Surface {1} = {1, 2, 3, 4} Left;
Mesh.MeshSizeMax = 0.1;
Include "part.geo";
Merge 'fed.geo';
/* end */
