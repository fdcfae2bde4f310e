// The strip of strip.geo, with short edges where it comes down onto its stop, at (0, -0.4).
//   gmsh -2 -format msh41 stop.geo -o stop.msh
Mesh.Algorithm = 6;

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

Field[1] = MathEval;
Field[1].F = "min(0.6, 0.025 + 0.25*sqrt(x^2 + (y + 0.4)^2))";   // edges by the distance from there
Background Field = 1;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.MeshSizeFromPoints = 0;

Physical Surface("copper") = {1};
Physical Surface("steel") = {2};
Physical Curve("middle") = {4, 7};          // x = 0: symmetry
Physical Curve("end") = {2, 5};
Physical Curve("bottom") = {1};
