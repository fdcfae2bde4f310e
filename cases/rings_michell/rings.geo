// A quarter of two rings, 1 <= r <= 2 and 2 <= r <= 3. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 rings.geo -o rings.msh
// The bodies share no point: each has its own side of the seam. Macro vertices lie on the circles themselves, joined by straight
// chords; mezha moves the nodes that it adds onto the circles, because case.toml declares them as [geometry].
Mesh.Algorithm = 6;

a = 1;   // radii
b = 2;
c = 3;
n_bore = 4;    // macro edges on each quarter circle; the two sides of the seam do not match
n_inner = 5;
n_outer = 6;
n_rim = 7;

// Inner ring, body 1.
For i In {0:n_bore}
  Point(100 + i) = {a * Cos(Pi / 2 * i / n_bore), a * Sin(Pi / 2 * i / n_bore), 0};
EndFor
For i In {0:n_inner}
  Point(200 + i) = {b * Cos(Pi / 2 * i / n_inner), b * Sin(Pi / 2 * i / n_inner), 0};
EndFor
For i In {1:n_bore}
  Line(100 + i) = {100 + i - 1, 100 + i};
EndFor
For i In {1:n_inner}
  Line(200 + i) = {200 + i - 1, 200 + i};
EndFor
Line(1) = {100, 200};                     // on y = 0
Line(2) = {200 + n_inner, 100 + n_bore};  // on x = 0
Curve Loop(1) = {1, 201:(200 + n_inner), 2, -(100 + n_bore):-101};
Plane Surface(1) = {1};

// Outer ring, body 2.
For i In {0:n_outer}
  Point(300 + i) = {b * Cos(Pi / 2 * i / n_outer), b * Sin(Pi / 2 * i / n_outer), 0};
EndFor
For i In {0:n_rim}
  Point(400 + i) = {c * Cos(Pi / 2 * i / n_rim), c * Sin(Pi / 2 * i / n_rim), 0};
EndFor
For i In {1:n_outer}
  Line(300 + i) = {300 + i - 1, 300 + i};
EndFor
For i In {1:n_rim}
  Line(400 + i) = {400 + i - 1, 400 + i};
EndFor
Line(3) = {300, 400};                     // on y = 0
Line(4) = {400 + n_rim, 300 + n_outer};   // on x = 0
Curve Loop(2) = {3, 401:(400 + n_rim), 4, -(300 + n_outer):-301};
Plane Surface(2) = {2};

// Edges per curve.
Transfinite Curve{101:(100 + n_bore), 201:(200 + n_inner), 301:(300 + n_outer), 401:(400 + n_rim)} = 1 + 1;
Transfinite Curve{1, 2} = 2 + 1;
Transfinite Curve{3, 4} = 2 + 1;

Physical Surface("inner") = {1};
Physical Surface("outer") = {2};
Physical Curve("axis.x") = {1, 3};   // the cut along the x axis, on both bodies
Physical Curve("axis.y") = {2, 4};   // the cut along the y axis, on both bodies
Physical Curve("inner.bore") = {101:(100 + n_bore)};
Physical Curve("inner.seam") = {201:(200 + n_inner)};
Physical Curve("outer.seam") = {301:(300 + n_outer)};
Physical Curve("outer.rim") = {401:(400 + n_rim)};
