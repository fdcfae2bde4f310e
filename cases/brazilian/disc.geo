// A disc of radius 1. Its four points on the rim are not where the forces act.
//   gmsh -2 -format msh41 disc.geo -o disc.msh
r = 1;
h = .35;
turn = 22 * Pi / 180;
Point(1) = {0, 0, 0, h};
For k In {0:3}
  Point(2 + k) = {r * Cos(turn + k * Pi / 2), r * Sin(turn + k * Pi / 2), 0, h};
EndFor
For k In {0:3}
  Circle(1 + k) = {2 + k, 1, 2 + (k + 1) % 4};
EndFor
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Physical Curve("rim") = {1:4};
Physical Surface("disc") = {1};
