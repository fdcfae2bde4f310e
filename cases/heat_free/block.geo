// A body with four uneven sides, at the right of the axis x = 0. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 block.geo -o block.msh
Mesh.Algorithm = 5;

Point(1) = {1, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2.5, 1, 0};
Point(4) = {0.5, 1.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Transfinite Curve{1, 2} = 2 + 1;   // edges per curve
Transfinite Curve{3, 4} = 3 + 1;

Physical Surface("block") = {1};
Physical Curve("sides") = {1:4};
