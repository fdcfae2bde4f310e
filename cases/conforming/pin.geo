// Half of a pin of radius .999 at the bottom of a hole of radius 1, centre (0, 0), in half of a large plate, x >= 0. Macro mesh:
// each triangle is cut again by mezha.
//   gmsh -2 -format msh41 pin.geo -o pin.msh
// The bodies touch at (0, -1) and share no point. Macro vertices lie on the circles, joined by straight chords; case.toml
// declares the circles. Edges are shorter towards the bottom.
Mesh.Algorithm = 5;
Mesh.CharacteristicLengthExtendFromBoundary = 0;
Mesh.CharacteristicLengthFromPoints = 0;

rings = 5;                     // each doubles the radius of the plate, from 3.125: 5 give 100
clearance = 0.001;             // radius of the hole less that of the pin
n_pin = 8;                     // macro edges on the lower half of the half circles; the two sides do not match
n_hole = 7;
n_top = 4;                     // on their upper half

// Pin, body 2, centre (0, -clearance). Points 100, 101, ... run along its rim from the bottom.
For i In {0:n_pin + n_top}
  angle = Pi / 2 * (i - n_pin) / ((i < n_pin) ? n_pin : n_top);
  Point(100 + i) = {(1 - clearance) * Cos(angle), (1 - clearance) * Sin(angle) - clearance, 0};
EndFor
For i In {1:n_pin + n_top}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
Point(1) = {0, -clearance, 0};
Line(1) = {100 + n_pin + n_top, 1};
Line(2) = {1, 100};
Curve Loop(1) = {101:(100 + n_pin + n_top), 1, 2};
Plane Surface(1) = {1};

// Plate, body 1, next to the hole: from the rim to a ring of four chords. Points 200, 201, ... along the rim.
For i In {0:n_hole + n_top}
  angle = Pi / 2 * (i - n_hole) / ((i < n_hole) ? n_hole : n_top);
  Point(200 + i) = {Cos(angle), Sin(angle), 0};
EndFor
For i In {1:n_hole + n_top}
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
Line(4) = {1004, 200 + n_hole + n_top};
Curve Loop(2) = {3, 2001:2004, 4, -(200 + n_hole + n_top):-201};
Plane Surface(2) = {2};

// Edge lengths: growing upwards in the pin, outwards in the plate.
Field[1] = MathEval;
Field[1].F = "0.2 + 0.7 * Max(0, Sqrt(x^2 + y^2) - 1) + 0.08 * (y + 1)";
Background Field = 1;

// Edges per curve.
Transfinite Curve{101:(100 + n_pin + n_top), 201:(200 + n_hole + n_top)} = 1 + 1;
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
Physical Curve("hole.rim") = {201:(200 + n_hole + n_top)};
Physical Curve("pin.rim") = {101:(100 + n_pin + n_top)};
Physical Curve("far") = {(2000 + 10 * rings + 1):(2000 + 10 * rings + 4)};
