// The two bars of example 1, y = 3 + x/6, 0 <= x <= 6, in macro meshes that are easy or hard.
//   gmsh -2 -format msh41 bars.geo -o bars.msh                                             6 edges against 7 on the contact line
//   gmsh -2 -format msh41 -setnumber upper 6 bars.geo -o matching.msh                      6 against 6
//   gmsh -2 -format msh41 -setnumber lower 2 -setnumber upper 40 bars.geo -o finer.msh     1:20
//   gmsh -2 -format msh41 -setnumber lower 40 -setnumber upper 2 bars.geo -o coarser.msh   20:1
//   gmsh -2 -format msh41 -setnumber kind 1 -setnumber lower 18 -setnumber upper 23 bars.geo -o upright.msh   angles of 5 degrees
//   gmsh -2 -format msh41 -setnumber kind 2 bars.geo -o flat.msh                                              the same, lying down
// moved.msh, turned.msh and others are bars.msh itself, moved by move.awk: see README.md.
DefineConstant[ lower = 6 ];   // edges on the contact line, lower bar
DefineConstant[ upper = 7 ];   // and upper bar
DefineConstant[ kind = 0 ];    // 0: even triangles; 1: one row of upright needles; 2: needles along the contact line

Mesh.Algorithm = 5;

// Lower bar, body 1.
Point(1) = {0, 0, 0};
Point(2) = {6, 0, 0};
Point(3) = {6, 4, 0};
Point(4) = {0, 3, 0};
Line(1) = {1, 2};
Line(2) = {2, 3};
Line(3) = {3, 4};   // contact line
Line(4) = {4, 1};
Curve Loop(1) = {1:4};
Plane Surface(1) = {1};

// Upper bar, body 2.
Point(11) = {0, 3, 0};
Point(12) = {6, 4, 0};
Point(13) = {6, 6, 0};
Point(14) = {0, 6, 0};
Line(11) = {11, 12};   // contact line
Line(12) = {12, 13};
Line(13) = {13, 14};
Line(14) = {14, 11};
Curve Loop(2) = {11:14};
Plane Surface(2) = {2};

Transfinite Curve{3} = lower + 1;
Transfinite Curve{11} = upper + 1;
If (kind == 0)
  Transfinite Curve{1, 13} = 4 + 1;
  Transfinite Curve{2, 4, 14} = 2 + 1;
  Transfinite Curve{12} = 1 + 1;
EndIf
If (kind == 1)
  Transfinite Curve{1} = lower + 1;
  Transfinite Curve{13} = upper + 1;
  Transfinite Curve{2, 4, 12, 14} = 1 + 1;
  Transfinite Surface{1, 2};
EndIf
If (kind == 2)
  // Rows from the contact line grow by 2: the first ones are about 0.09 high under edges of length 1.
  Transfinite Curve{1} = lower + 1;
  Transfinite Curve{13} = upper + 1;
  Transfinite Curve{2} = 5 + 1 Using Progression 1 / 2;
  Transfinite Curve{4} = 5 + 1 Using Progression 2;
  Transfinite Curve{12} = 5 + 1 Using Progression 2;
  Transfinite Curve{14} = 5 + 1 Using Progression 1 / 2;
  Transfinite Surface{1, 2};
EndIf

Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {1};
Physical Curve("left") = {4, 14};    // on both bodies
Physical Curve("right") = {2, 12};   // on both bodies
Physical Curve("top") = {13};
Physical Curve("lower.seam") = {3};
Physical Curve("upper.seam") = {11};
