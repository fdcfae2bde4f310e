// Twelve rollers of radius 5 between an inner ring 20-30 and an outer ring 40-50, all touching. Edges of half a roller's radius.
//   gmsh -2 -order 2 -format msh41 bearing.geo -o bearing.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 5;
Disk(1) = {0, 0, 0, 30};
Disk(2) = {0, 0, 0, 20};
BooleanDifference(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Disk(4) = {0, 0, 0, 50};
Disk(5) = {0, 0, 0, 40};
BooleanDifference(6) = { Surface{4}; Delete; }{ Surface{5}; Delete; };
inner[] = Boundary{ Surface{3}; };
outer[] = Boundary{ Surface{6}; };
Physical Surface("inner") = {3};
Physical Surface("outer") = {6};
Physical Curve("inner.track") = {inner[0]};
Physical Curve("bore") = {inner[1]};
Physical Curve("housing") = {outer[0]};
Physical Curve("outer.track") = {outer[1]};
For k In {1:12}
  Disk(10 + k) = {35 * Sin(Pi * (k - 1) / 6), -35 * Cos(Pi * (k - 1) / 6), 0, 5};
  rim[] = Boundary{ Surface{10 + k}; };
  MeshSize{ PointsOf{ Surface{10 + k}; } } = 2.5;
  Physical Surface(Sprintf("roller%02g", k)) = {10 + k};
  Physical Curve(Sprintf("roller%02g.rim", k)) = {rim[0]};
EndFor
