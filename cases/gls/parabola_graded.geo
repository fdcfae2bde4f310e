// Two bars on the parabola y = 4 + x - x^2/4, 0 <= x <= 4, graded to the corner (0, 4) and to the end of contact, x = 3.91. Macro
// mesh: mezha cuts each triangle again.
//   gmsh -2 -format msh41 parabola_graded.geo -o parabola_graded.msh
Mesh.Algorithm = 6;

lower() = {0.001, 0.002, 0.004, 0.008, 0.016, 0.032, 0.063, 0.125, 0.25, 0.45, 0.7, 0.95, 1.2, 1.45, 1.7, 1.95, 2.2, 2.45, 2.7, 2.95, 3.2, 3.42, 3.6, 3.74, 3.83, 3.88, 3.91, 3.94, 4};
upper() = {0.0012, 0.0025, 0.005, 0.01, 0.02, 0.04, 0.08, 0.16, 0.3, 0.5, 0.72, 0.96, 1.2, 1.44, 1.68, 1.92, 2.16, 2.4, 2.64, 2.88, 3.12, 3.34, 3.52, 3.68, 3.79, 3.86, 3.9, 3.93, 3.96, 4};

// Lower bar, body 1. Points 100, 101, ... run along the parabola from left to right.
Point(1) = {0, 0, 0};
Point(2) = {4, 0, 0};
Point(100) = {0, 4, 0};
n = #lower();
For i In {1:n}
  x = lower(i - 1);
  Point(100 + i) = {x, 4 + x - x^2 / 4, 0};
  Line(100 + i) = {100 + i, 100 + i - 1};   // from right to left
EndFor
Line(1) = {1, 2};
Line(2) = {2, 100 + n};
Line(3) = {100, 1};
Curve Loop(1) = {1, 2, (100 + n):101:-1, 3};
Plane Surface(1) = {1};

// Upper bar, body 2. Points 200, 201, ... likewise.
Point(3) = {4, 8, 0};
Point(4) = {0, 8, 0};
Point(200) = {0, 4, 0};
m = #upper();
For i In {1:m}
  x = upper(i - 1);
  Point(200 + i) = {x, 4 + x - x^2 / 4, 0};
  Line(200 + i) = {200 + i - 1, 200 + i};   // from left to right
EndFor
Line(4) = {200 + m, 3};
Line(5) = {3, 4};
Line(6) = {4, 200};
Curve Loop(2) = {201:(200 + m), 4, 5, 6};
Plane Surface(2) = {2};

// Edges per curve. A progression q makes each edge q times as long as the one before it, in the direction of the line.
Transfinite Curve{101:(100 + n)} = 1 + 1;
Transfinite Curve{201:(200 + m)} = 1 + 1;
Transfinite Curve{1} = 3 + 1;
Transfinite Curve{2} = 8 + 1 Using Progression 1 / 1.8;   // right, lower
Transfinite Curve{3} = 12 + 1 Using Progression 2;        // left, lower
Transfinite Curve{4} = 8 + 1 Using Progression 1.8;       // right, upper
Transfinite Curve{5} = 3 + 1;
Transfinite Curve{6} = 12 + 1 Using Progression 1 / 2;    // left, upper

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {3, 6};   // on both bodies
Physical Curve("top") = {5};
Physical Curve("lower.seam") = {101:(100 + n)};
Physical Curve("upper.seam") = {201:(200 + m)};
