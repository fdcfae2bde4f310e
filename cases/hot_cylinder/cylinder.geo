// The half of the section of a slice of a thick cylinder: radii 1 to 2, x is the radius. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 cylinder.geo -o cylinder.msh
Mesh.Algorithm = 5;

Point(1) = {1, 0, 0};
Point(2) = {2, 0, 0};
Point(3) = {2, 0.5, 0};
Point(4) = {1, 0.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

Transfinite Curve{1, 3} = 4 + 1;   // edges per curve
Transfinite Curve{2, 4} = 2 + 1;

Physical Surface("cylinder") = {1};
Physical Curve("ends") = {1, 3};
Physical Curve("bore") = {4};
Physical Curve("rim") = {2};
