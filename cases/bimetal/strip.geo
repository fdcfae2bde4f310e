// Half of a strip of two layers, 0 <= x <= 20: heights 0.4 below and 0.6 above y = 0. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 strip.geo -o strip.msh
// The layers share the points and the line between them: they are bonded parts of one body.
Mesh.Algorithm = 5;

L = 20;
Point(1) = {0, -0.4, 0};
Point(2) = {L, -0.4, 0};
Point(3) = {L, 0, 0};
Point(4) = {0, 0, 0};
Point(5) = {L, 0.6, 0};
Point(6) = {0, 0.6, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 1};
Line(5) = {3, 5};
Line(6) = {5, 6};
Line(7) = {6, 4};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};
Curve Loop(2) = {5, 6, 7, -3};
Plane Surface(2) = {2};

// Edges per curve.
Transfinite Curve{1, 3, 6} = 36 + 1;
Transfinite Curve{2, 4, 5, 7} = 1 + 1;

Physical Surface("copper") = {1};
Physical Surface("steel") = {2};
Physical Curve("middle") = {4, 7};          // x = 0: symmetry
Physical Curve("copper.end") = {2};
Physical Curve("steel.end") = {5};
Physical Curve("bottom") = {1};
