// Sixteen blocks, 0 <= x <= 2, on fifteen lines that fall and rise in turn. Macro mesh: each triangle is cut again by mezha.
//   gmsh -2 -format msh41 blocks.geo -o blocks.msh
// Block i lies between line i and line i + 1; line 0 is the bottom, line 16 the top. Blocks share no point: each has its own
// sides of the contact lines, with 3 edges below and above in blocks 0, 2, ..., 14, and 4 in the others.
Mesh.Algorithm = 5;

n = 16;
For i In {0:n}
  level[i] = i / 2;       // height in the middle, x = 1
  tilt[i] = 0;            // rise from there to x = 2
  If (i > 0 && i < n)
    tilt[i] = (i % 2) ? -0.1 : 0.08;
  EndIf
EndFor

For i In {0:n - 1}
  k = 10 * (i + 1);
  Point(k + 1) = {0, level[i] - tilt[i], 0};
  Point(k + 2) = {2, level[i] + tilt[i], 0};
  Point(k + 3) = {2, level[i + 1] + tilt[i + 1], 0};
  Point(k + 4) = {0, level[i + 1] - tilt[i + 1], 0};
  Line(k + 1) = {k + 1, k + 2};   // bottom
  Line(k + 2) = {k + 2, k + 3};   // right
  Line(k + 3) = {k + 3, k + 4};   // top
  Line(k + 4) = {k + 4, k + 1};   // left
  Curve Loop(i + 1) = {(k + 1):(k + 4)};
  Plane Surface(i + 1) = {i + 1};
  Transfinite Curve{k + 1, k + 3} = ((i % 2) ? 4 : 3) + 1;
  Transfinite Curve{k + 2, k + 4} = 1 + 1;
  left[i] = k + 4;
  right[i] = k + 2;
  Physical Surface(Sprintf("block%02g", i)) = {i + 1};
EndFor

Physical Curve("left") = {left[]};     // on all blocks
Physical Curve("right") = {right[]};
Physical Curve("bottom") = {11};
Physical Curve("top") = {10 * n + 3};
For i In {1:n - 1}
  Physical Curve(Sprintf("below%02g", i)) = {10 * i + 3};         // the two sides of line i: of block i - 1,
  Physical Curve(Sprintf("above%02g", i)) = {10 * (i + 1) + 1};   // and of block i
EndFor
