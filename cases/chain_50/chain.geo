// Fifty blocks in a chain, 0 <= x <= 1, each 1 high. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 chain.geo -o chain.msh
// Blocks share no point: each has its own sides of the contact lines, with 3 edges below and above in blocks 0, 2, ..., and 4 in
// the others.
Mesh.Algorithm = 5;

n = 50;
For i In {0:n - 1}
  k = 10 * (i + 1);
  Point(k + 1) = {0, i, 0};
  Point(k + 2) = {1, i, 0};
  Point(k + 3) = {1, i + 1, 0};
  Point(k + 4) = {0, i + 1, 0};
  Line(k + 1) = {k + 1, k + 2};   // below
  Line(k + 2) = {k + 2, k + 3};   // right
  Line(k + 3) = {k + 3, k + 4};   // above
  Line(k + 4) = {k + 4, k + 1};   // left
  Curve Loop(i + 1) = {(k + 1):(k + 4)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Curve{k + 1, k + 3} = ((i % 2) ? 4 : 3) + 1;
  Transfinite Curve{k + 2, k + 4} = 2 + 1;
  axis[] += {k + 4};
  Physical Surface(Sprintf("block%02g", i)) = {i + 1};
EndFor

Physical Curve("symmetry") = {axis[]};   // on all blocks, x = 0
Physical Curve("bottom") = {11};
Physical Curve("top") = {10 * n + 3};
For i In {1:n - 1}
  Physical Curve(Sprintf("below%02g", i)) = {10 * i + 3};         // the two sides of line i: of block i - 1,
  Physical Curve(Sprintf("above%02g", i)) = {10 * (i + 1) + 1};   // and of block i
EndFor
