// Three thirds of a hexagon, which meet at its centre. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 sectors.geo -o sectors.msh
// The bodies share no point. Third k begins at the angle from[k] and ends 120 degrees farther; it has 3 edges on its first
// side and 4 on its last.
Mesh.Algorithm = 5;

from[] = {-Pi / 6, Pi / 2, 7 * Pi / 6};   // right, left, bottom
For k In {0:2}
  n = 10 * (k + 1);
  Point(n) = {0, 0, 0};
  For i In {0:2}
    angle = from[k] + i * Pi / 3;
    Point(n + 1 + i) = {Cos(angle), Sin(angle), 0};
  EndFor
  Line(n + 1) = {n, n + 1};       // first side
  Line(n + 2) = {n + 1, n + 2};   // outside
  Line(n + 3) = {n + 2, n + 3};   // outside
  Line(n + 4) = {n + 3, n};       // last side
  Curve Loop(n) = {(n + 1):(n + 4)};
  Plane Surface(n) = {n};
  Transfinite Curve{n + 1} = 3 + 1;
  Transfinite Curve{n + 2, n + 3} = 3 + 1;
  Transfinite Curve{n + 4} = 4 + 1;
EndFor

Physical Surface("right") = {10};
Physical Surface("left") = {20};
Physical Surface("bottom") = {30};
Physical Curve("right.first") = {11};
Physical Curve("right.last") = {14};
Physical Curve("left.first") = {21};
Physical Curve("left.last") = {24};
Physical Curve("bottom.first") = {31};
Physical Curve("bottom.last") = {34};
Physical Curve("right.outside") = {12, 13};
Physical Curve("left.upper") = {22};
Physical Curve("left.lower") = {23};
Physical Curve("bottom.left") = {32};
Physical Curve("bottom.right") = {33};
