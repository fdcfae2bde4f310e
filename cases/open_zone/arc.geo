// Two blocks on the arc of radius 7/2 about (0, -3), -2 <= x <= 2. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 arc.geo -o arc.msh
// The bodies share no point: each has its own side of the seam. Macro vertices lie on the arc itself, joined by straight
// chords; mezha moves the nodes that it adds onto the arc, because case.toml declares it as a [geometry].
Mesh.Algorithm = 6;

r = 3.5;
half = Asin(2 / r);   // half the angle of the arc
n_lower = 7;          // macro edges on the arc; the two sides do not match
n_upper = 6;

// Lower block, body 1. On the arc from right to left.
For i In {0:n_lower}
  Point(100 + i) = {r * Sin(half - 2 * half * i / n_lower), r * Cos(half - 2 * half * i / n_lower) - 3, 0};
EndFor
For i In {1:n_lower}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
Point(1) = {-2, -1.5, 0};
Point(2) = {2, -1.5, 0};
Line(1) = {1, 2};
Line(2) = {2, 100};
Line(3) = {100 + n_lower, 1};
Curve Loop(1) = {1, 2, 101:(100 + n_lower), 3};
Plane Surface(1) = {1};

// Upper block, body 2. On the arc from left to right.
For i In {0:n_upper}
  Point(200 + i) = {r * Sin(2 * half * i / n_upper - half), r * Cos(2 * half * i / n_upper - half) - 3, 0};
EndFor
For i In {1:n_upper}
  Line(200 + i) = {200 + i - 1, 200 + i};
EndFor
Point(11) = {2, 1.7, 0};
Point(12) = {-2, 1.7, 0};
Line(11) = {200 + n_upper, 11};
Line(12) = {11, 12};
Line(13) = {12, 200};
Curve Loop(2) = {201:(200 + n_upper), 11, 12, 13};
Plane Surface(2) = {2};

// Edges per curve.
Transfinite Curve{101:(100 + n_lower), 201:(200 + n_upper)} = 1 + 1;
Transfinite Curve{1} = 6 + 1;
Transfinite Curve{2, 3} = 2 + 1;
Transfinite Curve{11, 13} = 3 + 1;
Transfinite Curve{12} = 6 + 1;

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("lower.held") = {1, 2, 3};      // all sides but the arc
Physical Curve("upper.held") = {11, 12, 13};
Physical Curve("lower.seam") = {101:(100 + n_lower)};
Physical Curve("upper.seam") = {201:(200 + n_upper)};
