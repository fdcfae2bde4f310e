// Two bars on the parabola y = 4 + x - x^2/4, 0 <= x <= 4. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 bars.geo -o bars.msh
//   gmsh -2 -format msh41 -setnumber n_lower 4 -setnumber n_bottom 3 bars.geo -o matching.msh
// The bodies share no point: each has its own side of the contact line. Macro vertices lie on the parabola itself, joined by
// straight chords; mezha moves the nodes that it adds onto the curve, because case.toml declares it as a [geometry].
Mesh.Algorithm = 6;

DefineConstant[ n_lower = 5 ];    // macro edges of each body on the parabola: they do not match, but for matching.msh
DefineConstant[ n_upper = 4 ];
DefineConstant[ n_bottom = 2 ];

// Lower bar, body 1. Points 100, 101, ... run along the parabola from left to right, equally spaced in x.
Point(1) = {0, 0, 0};
Point(2) = {4, 0, 0};
For i In {0:n_lower}
  x = 4 * i / n_lower;
  Point(100 + i) = {x, 4 + x - x^2 / 4, 0};
EndFor
For i In {1:n_lower}
  Line(100 + i) = {100 + i, 100 + i - 1};   // from right to left
EndFor
Line(1) = {1, 2};
Line(2) = {2, 100 + n_lower};
Line(3) = {100, 1};
Curve Loop(1) = {1, 2, (100 + n_lower):101:-1, 3};
Plane Surface(1) = {1};

// Upper bar, body 2. Points 200, 201, ... likewise.
Point(3) = {4, 8, 0};
Point(4) = {0, 8, 0};
For i In {0:n_upper}
  x = 4 * i / n_upper;
  Point(200 + i) = {x, 4 + x - x^2 / 4, 0};
EndFor
For i In {1:n_upper}
  Line(200 + i) = {200 + i - 1, 200 + i};   // from left to right
EndFor
Line(4) = {200 + n_upper, 3};
Line(5) = {3, 4};
Line(6) = {4, 200};
Curve Loop(2) = {201:(200 + n_upper), 4, 5, 6};
Plane Surface(2) = {2};

// Edges per curve.
Transfinite Curve{101:(100 + n_lower)} = 1 + 1;
Transfinite Curve{201:(200 + n_upper)} = 1 + 1;
Transfinite Curve{1} = n_bottom + 1;
Transfinite Curve{2} = 3 + 1;   // right, lower
Transfinite Curve{3} = 3 + 1;   // left, lower
Transfinite Curve{4} = 2 + 1;   // right, upper
Transfinite Curve{5} = 2 + 1;   // top
Transfinite Curve{6} = 3 + 1;   // left, upper

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {3, 6};   // on both bodies
Physical Curve("top") = {5};
Physical Curve("lower.seam") = {101:(100 + n_lower)};
Physical Curve("upper.seam") = {201:(200 + n_upper)};
