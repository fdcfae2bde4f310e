// The halves of the sections of a pellet, radius 4.1, and of a tube around it, radii 4.15 to 4.75; x is the radius. Macro mesh: each
// triangle is cut again by mezha.
//   gmsh -2 -format msh41 pellet.geo -o pellet.msh
Mesh.Algorithm = 5;

H = 2;   // height of the slice

// Pellet, body 1: from the axis on.
Point(1) = {0, 0, 0};
Point(2) = {4.1, 0, 0};
Point(3) = {4.1, H, 0};
Point(4) = {0, H, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};   // faces the tube
Line(3) = {3, 4};
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Tube, body 2.
Point(11) = {4.15, 0, 0};
Point(12) = {4.75, 0, 0};
Point(13) = {4.75, H, 0};
Point(14) = {4.15, H, 0};
Line(11) = {11, 12};
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};   // faces the pellet
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

// Edges per curve.
Transfinite Curve{1, 3} = 5 + 1;
Transfinite Curve{2, 4} = 3 + 1;
Transfinite Curve{11, 13} = 1 + 1;
Transfinite Curve{14, 12} = 4 + 1;

Physical Surface("pellet") = {1};
Physical Surface("tube") = {2};
Physical Curve("ends") = {1, 3, 11, 13};
Physical Curve("pellet.side") = {2};
Physical Curve("tube.bore") = {14};
