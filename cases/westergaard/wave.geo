// Half a wave, 0 <= x <= 1, of two blocks that are three half waves high. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 wave.geo -o wave.msh
// The bodies share no point; 7 edges against 9 along the line that may touch. Edges grow away from it.
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

height = 3;

// Lower block, body 1.
Point(1) = {0, -height, 0};
Point(2) = {1, -height, 0};
Point(3) = {1, 0, 0};
Point(4) = {0, 0, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // may touch
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper block, body 2.
Point(11) = {0, 0, 0};
Point(12) = {1, 0, 0};
Point(13) = {1, height, 0};
Point(14) = {0, height, 0};
Line(11) = {11, 12};   // may touch
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

Field[1] = MathEval;
Field[1].F = "0.125 + 0.35 * Max(0, Sqrt(y^2) - 0.13)";
Background Field = 1;
Transfinite Curve{3} = 7 + 1;
Transfinite Curve{11} = 9 + 1;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
Physical Curve("top") = {13};
Physical Curve("symmetry") = {2, 4, 12, 14};   // on both bodies, at x = 0 and x = 1
