// A slice of a thick cylinder, 1 <= x <= 2, 0 <= y <= .5. Macro mesh: mezha refines it.
//   gmsh -2 -format msh41 cylinder.geo -o cylinder.msh
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthMin = 0.35;
Mesh.CharacteristicLengthMax = 0.35;
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
Physical Surface("cylinder") = {1};
Physical Curve("ends") = {1, 3};
Physical Curve("out") = {2};
Physical Curve("in") = {4};
