// A beam 100 x 10: edges of 5 everywhere, none at the rollers, which are rigid and need no mesh.
//   gmsh -2 -order 2 -format msh41 beam.geo -o beam.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 5;
Rectangle(1) = {-50, -5, 0, 100, 10};
side[] = Boundary{ Surface{1}; };
Physical Surface("beam") = {1};
Physical Curve("under") = {side[0]};
Physical Curve("over") = {side[2]};
