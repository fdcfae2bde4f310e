// Half of a layer of thickness 1 on half of a large half-plane, x >= 0. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 layer.geo -o layer.msh
//   gmsh -2 -format msh41 -setnumber rings 5 layer.geo -o large.msh
// The bodies share no point. Edges grow away from the contact, which will be 1.324 wide, and from the load at (0, 1).
Mesh.Algorithm = 6;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

DefineConstant[ rings = 4 ];   // each doubles the radius of the half-plane, from 6.25: 4 give 100

// Base, body 1: a quarter disc of radius 6.25.
Point(1) = {0, 0, 0};
Point(2) = {1.8, 0, 0};
Line(1) = {2, 1};   // may touch

// Base, rings of two sectors; each is twice as large as the one before. Points run from x = 0 to y = 0.
For k In {0:rings}
  r = 6.25 * 2^k;
  For i In {0:2}
    angle = Pi / 2 * (i / 2 - 1);
    Point(1000 + 10 * k + i) = {r * Cos(angle), r * Sin(angle), 0};
  EndFor
  For i In {1:2}
    Line(2000 + 10 * k + i) = {1000 + 10 * k + i - 1, 1000 + 10 * k + i};
  EndFor
EndFor
For k In {1:rings}
  For i In {0:2}
    Line(3000 + 10 * k + i) = {1000 + 10 * (k - 1) + i, 1000 + 10 * k + i};
  EndFor
  For i In {1:2}
    s = 100 + 10 * k + i;
    Curve Loop(s) = {2000 + 10 * (k - 1) + i, 3000 + 10 * k + i, -(2000 + 10 * k + i), -(3000 + 10 * k + i - 1)};
    Plane Surface(s) = {s};
    Transfinite Surface{s};
    base[] += {s};
  EndFor
  axis[] += {3000 + 10 * k};
EndFor
Line(2) = {1, 1000};
Line(3) = {1002, 2};
Curve Loop(1) = {1, 2, 2001, 2002, 3};
Plane Surface(1) = {1};

// Layer, body 2.
Point(11) = {0, 0, 0};
Point(12) = {1.8, 0, 0};
Point(13) = {6, 0, 0};
Point(14) = {6, 1, 0};
Point(15) = {0.4, 1, 0};
Point(16) = {0, 1, 0};
Line(11) = {11, 12};   // may touch
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 15};
Line(15) = {15, 16};   // loaded
Line(16) = {16, 11};
Curve Loop(2) = {11:16};
Plane Surface(2) = {2};

// Edge lengths. The two sides do not match.
Field[1] = MathEval;
Field[1].F = "0.20 + 0.75 * Sqrt(Max(0, x - 1.8)^2 + y^2)";
Field[2] = MathEval;
Field[2].F = "Min(0.16 + 0.6 * Sqrt(Max(0, x - 1.8)^2 + y^2), 0.07 + 0.5 * Sqrt(x^2 + (y - 1)^2))";
Field[3] = Restrict;
Field[3].IField = 1;
Field[3].FacesList = {1};
Field[3].EdgesList = {1, 2, 3};
Field[4] = Restrict;
Field[4].IField = 2;
Field[4].FacesList = {2};
Field[4].EdgesList = {11:16};
Field[5] = Min;
Field[5].FieldsList = {3, 4};
Background Field = 5;

// Edges per curve of the rings.
For k In {0:rings}
  Transfinite Curve{2000 + 10 * k + 1, 2000 + 10 * k + 2} = 1 + 1;
EndFor
For k In {1:rings}
  Transfinite Curve{(3000 + 10 * k):(3000 + 10 * k + 2)} = 1 + 1;
EndFor

Physical Surface("base") = {1, base[]};
Physical Surface("layer") = {2};
Physical Curve("symmetry") = {2, 16, axis[]};   // on both bodies
Physical Curve("base.top") = {1};
Physical Curve("layer.bottom") = {11};
Physical Curve("loaded") = {15};
Physical Curve("far") = {(2000 + 10 * rings + 1):(2000 + 10 * rings + 2)};
