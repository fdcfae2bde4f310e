// The half, x >= 0, of a strip of thickness 1. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 strip.geo -o strip.msh
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

length = 4;      // what is beyond is free of stress
touch  = 1.5;    // contact will reach to x = 1

Point(1) = {0, -0.5, 0};
Point(2) = {touch, -0.5, 0};
Point(3) = {length, -0.5, 0};
Point(4) = {length, 0.5, 0};
Point(5) = {touch, 0.5, 0};
Point(6) = {0, 0.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};
Line(4) = {4, 5};
Line(5) = {5, 6};
Line(6) = {6, 1};
Curve Loop(1) = {1:6};
Plane Surface(1) = {1};

Field[1] = MathEval;
Field[1].F = "0.3 + 0.25 * Max(0, x - 1.5)";
Background Field = 1;
Transfinite Curve{1, 5} = 5 + 1;
Transfinite Curve{6} = 3 + 1;

Physical Surface("strip") = {1};
Physical Curve("bottom") = {1};     // may touch
Physical Curve("top") = {5};        // may touch
Physical Curve("symmetry") = {6};   // x = 0
