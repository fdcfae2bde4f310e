// A quarter of a ring of two bonded materials, 1 <= r <= 1.5 <= r <= 2, in another ring, 2 <= r <= 3.
//   gmsh -2 -format msh41 rings.geo -o rings.msh
// Core and shell share the points and chords of "bond": they are one body. The outer ring has points of its own.
Mesh.Algorithm = 6;

a = 1;  d = 1.5;  b = 2;  c = 3;               // radii
n_bore = 4;  n_bond = 4;  n_inner = 5;  n_outer = 6;  n_rim = 7;

For i In {0:n_bore}
  Point(100 + i) = {a * Cos(Pi / 2 * i / n_bore), a * Sin(Pi / 2 * i / n_bore), 0};
EndFor
For i In {0:n_bond}
  Point(150 + i) = {d * Cos(Pi / 2 * i / n_bond), d * Sin(Pi / 2 * i / n_bond), 0};
EndFor
For i In {0:n_inner}
  Point(200 + i) = {b * Cos(Pi / 2 * i / n_inner), b * Sin(Pi / 2 * i / n_inner), 0};
EndFor
For i In {1:n_bore}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
For i In {1:n_bond}
  Line(150 + i) = {150 + i - 1, 150 + i};
EndFor
For i In {1:n_inner}
  Line(200 + i) = {200 + i - 1, 200 + i};
EndFor
Line(1) = {100, 150};
Line(2) = {150 + n_bond, 100 + n_bore};
Curve Loop(1) = {1, 151:(150 + n_bond), 2, -(100 + n_bore):-101};
Plane Surface(1) = {1};
Line(5) = {150, 200};
Line(6) = {200 + n_inner, 150 + n_bond};
Curve Loop(3) = {5, 201:(200 + n_inner), 6, -(150 + n_bond):-151};
Plane Surface(3) = {3};

For i In {0:n_outer}
  Point(300 + i) = {b * Cos(Pi / 2 * i / n_outer), b * Sin(Pi / 2 * i / n_outer), 0};
EndFor
For i In {0:n_rim}
  Point(400 + i) = {c * Cos(Pi / 2 * i / n_rim), c * Sin(Pi / 2 * i / n_rim), 0};
EndFor
For i In {1:n_outer}
  Line(300 + i) = {300 + i - 1, 300 + i};
EndFor
For i In {1:n_rim}
  Line(400 + i) = {400 + i - 1, 400 + i};
EndFor
Line(3) = {300, 400};
Line(4) = {400 + n_rim, 300 + n_outer};
Curve Loop(2) = {3, 401:(400 + n_rim), 4, -(300 + n_outer):-301};
Plane Surface(2) = {2};

Transfinite Curve{101:(100 + n_bore), 151:(150 + n_bond), 201:(200 + n_inner), 301:(300 + n_outer), 401:(400 + n_rim)} = 1 + 1;
Transfinite Curve{1, 2, 5, 6} = 1 + 1;
Transfinite Curve{3, 4} = 2 + 1;

Physical Surface("core") = {1};
Physical Surface("shell") = {3};
Physical Surface("outer") = {2};
Physical Curve("axis.x") = {1, 3, 5};
Physical Curve("axis.y") = {2, 4, 6};
Physical Curve("inner.bore") = {101:(100 + n_bore)};
Physical Curve("bond") = {151:(150 + n_bond)};
Physical Curve("inner.seam") = {201:(200 + n_inner)};
Physical Curve("outer.seam") = {301:(300 + n_outer)};
Physical Curve("outer.rim") = {401:(400 + n_rim)};
