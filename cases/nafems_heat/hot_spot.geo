// A quarter of NAFEMS T1: a plate, 10 by 10, with a spot of radius 1 at its corner. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 hot_spot.geo -o hot_spot.msh
// The spot and the rest share points and lines: they are bonded parts of one body. Macro vertices lie on the circle itself, joined
// by straight chords; mezha moves the nodes that it adds onto the circle, because hot_spot.toml declares it as a [geometry].
Mesh.Algorithm = 6;

n = 4;   // macro edges on the quarter circle
Point(1) = {0, 0, 0};
Point(2) = {10, 0, 0};
Point(3) = {10, 10, 0};
Point(4) = {0, 10, 0};
For i In {0:n}
  Point(100 + i) = {Cos(Pi/2 * i/n), Sin(Pi/2 * i/n), 0};
EndFor
For i In {1:n}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
Line(1) = {1, 100};
Line(2) = {100, 2};
Line(3) = {2, 3};
Line(4) = {3, 4};
Line(5) = {4, 100 + n};
Line(6) = {100 + n, 1};
Curve Loop(1) = {1, 101:(100 + n), 6};
Plane Surface(1) = {1};
Curve Loop(2) = {2, 3, 4, 5, -(100 + n):-101};
Plane Surface(2) = {2};

Transfinite Curve{101:(100 + n)} = 1 + 1;
Field[1] = MathEval;
Field[1].F = "0.4*sqrt(x^2 + y^2 + 0.6)";   // edges grow with the distance from the spot
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Physical Surface("spot") = {1};
Physical Surface("rest") = {2};
Physical Curve("axis.x") = {1, 2};
Physical Curve("axis.y") = {5, 6};
Physical Curve("circle") = {101:(100 + n)};
