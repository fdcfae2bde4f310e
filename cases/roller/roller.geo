// One roller of radius 5 between two plates 20 x 10. Edges of half a radius everywhere: nothing is drawn fine where they touch.
//   gmsh -2 -order 2 -format msh41 roller.geo -o roller.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 2.5;
Rectangle(1) = {-10, -10, 0, 20, 10};
Disk(2) = {0, 5, 0, 5};
Rectangle(3) = {-10, 10, 0, 20, 10};
lower[] = Boundary{ Surface{1}; };
rim[] = Boundary{ Surface{2}; };
upper[] = Boundary{ Surface{3}; };
Physical Surface("lower") = {1};
Physical Surface("roller") = {2};
Physical Surface("upper") = {3};
Physical Curve("bottom") = {lower[0]};
Physical Curve("lower.face") = {lower[2]};
Physical Curve("roller.rim") = {rim[0]};
Physical Curve("upper.face") = {upper[0]};
Physical Curve("top") = {upper[2]};
