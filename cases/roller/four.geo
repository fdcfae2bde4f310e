// Four rollers of radius 5 between two plates 48 x 10.
//   gmsh -2 -order 2 -format msh41 four.geo -o four.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 2.5;
Rectangle(1) = {-24, -10, 0, 48, 10};
Rectangle(2) = {-24, 10, 0, 48, 10};
lower[] = Boundary{ Surface{1}; };
upper[] = Boundary{ Surface{2}; };
Physical Surface("lower") = {1};
Physical Surface("upper") = {2};
Physical Curve("bottom") = {lower[0]};
Physical Curve("lower.face") = {lower[2]};
Physical Curve("upper.face") = {upper[0]};
Physical Curve("top") = {upper[2]};
For k In {1:4}
  Disk(2 + k) = {12 * k - 30, 5, 0, 5};
  rim[] = Boundary{ Surface{2 + k}; };
  Physical Surface(Sprintf("roller%g", k)) = {2 + k};
  Physical Curve(Sprintf("roller%g.rim", k)) = {rim[0]};
EndFor
