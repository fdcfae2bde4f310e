// Half of a disc of radius 1 in half of a large plate with a hole of radius 1, centre (0, 0), x >= 0. Macro mesh: each
// triangle is cut again by mezha.
//   gmsh -2 -format msh41 pin.geo -o pin.msh
//   gmsh -2 -format msh41 -setnumber rings 6 pin.geo -o large.msh
// The bodies share no point. Macro vertices lie on the circles, joined by straight chords; case.toml declares the circles
// as [geometry].
Mesh.Algorithm = 5;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

DefineConstant[ rings = 5 ];   // each doubles the radius of the plate, from 3.125: 5 give 100
n_pin = 14;                    // macro edges on each half circle; the two sides do not match
n_hole = 12;

// Pin, body 2. Points 100, 101, ... run along its rim from the bottom.
For i In {0:n_pin}
  angle = Pi * (i / n_pin - 0.5);
  Point(100 + i) = {Cos(angle), Sin(angle), 0};
EndFor
For i In {1:n_pin}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
Point(1) = {0, 0, 0};
Line(1) = {100 + n_pin, 1};
Line(2) = {1, 100};
Curve Loop(1) = {101:(100 + n_pin), 1, 2};
Plane Surface(1) = {1};

// Plate, body 1, next to the hole: from the rim to a ring of four chords. Points 200, 201, ... along the rim.
For i In {0:n_hole}
  angle = Pi * (i / n_hole - 0.5);
  Point(200 + i) = {Cos(angle), Sin(angle), 0};
EndFor
For i In {1:n_hole}
  Line(200 + i) = {200 + i - 1, 200 + i};
EndFor

// Plate, rings of four sectors; each is twice as large as the one before.
For k In {0:rings}
  r = 3.125 * 2^k;
  For i In {0:4}
    angle = Pi * (i / 4 - 0.5);
    Point(1000 + 10 * k + i) = {r * Cos(angle), r * Sin(angle), 0};
  EndFor
  For i In {1:4}
    Line(2000 + 10 * k + i) = {1000 + 10 * k + i - 1, 1000 + 10 * k + i};
  EndFor
EndFor
For k In {1:rings}
  For i In {0:4}
    Line(3000 + 10 * k + i) = {1000 + 10 * (k - 1) + i, 1000 + 10 * k + i};
  EndFor
  For i In {1:4}
    s = 100 + 10 * k + i;
    Curve Loop(s) = {2000 + 10 * (k - 1) + i, 3000 + 10 * k + i, -(2000 + 10 * k + i), -(3000 + 10 * k + i - 1)};
    Plane Surface(s) = {s};
    Transfinite Surface{s};
    plate[] += {s};
  EndFor
  axis[] += {3000 + 10 * k, 3000 + 10 * k + 4};
EndFor
Line(3) = {200, 1000};
Line(4) = {1004, 200 + n_hole};
Curve Loop(2) = {3, 2001:2004, 4, -(200 + n_hole):-201};
Plane Surface(2) = {2};

// Edge lengths: even in the pin, growing outwards in the plate.
Field[1] = MathEval;
Field[1].F = "Max(0.28, 0.24 + 0.7 * (Sqrt(x^2 + y^2) - 1))";
Background Field = 1;

// Edges per curve.
Transfinite Curve{101:(100 + n_pin), 201:(200 + n_hole)} = 1 + 1;
For k In {0:rings}
  Transfinite Curve{(2000 + 10 * k + 1):(2000 + 10 * k + 4)} = 1 + 1;
EndFor
Transfinite Curve{axis[]} = 1 + 1;
For k In {1:rings}
  Transfinite Curve{(3000 + 10 * k + 1):(3000 + 10 * k + 3)} = 1 + 1;
EndFor

Physical Surface("plate") = {2, plate[]};
Physical Surface("pin") = {1};
Physical Curve("symmetry") = {1, 2, 3, 4, axis[]};   // on both bodies
Physical Curve("hole.rim") = {201:(200 + n_hole)};
Physical Curve("pin.rim") = {101:(100 + n_pin)};
Physical Curve("far") = {(2000 + 10 * rings + 1):(2000 + 10 * rings + 4)};
