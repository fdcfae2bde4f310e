// A pin of radius 9.98 in the middle of a hole of radius 10, in a lug of radius 25 on a shank 50 wide.
//   gmsh -2 -order 2 -format msh41 lug.geo -o lug.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 7;
Mesh.MeshSizeFromCurvature = 16;
Disk(1) = {0, 0, 0, 25};
Rectangle(2) = {-25, -75, 0, 50, 75};
BooleanUnion(3) = { Surface{1}; Delete; }{ Surface{2}; Delete; };
Disk(4) = {0, 0, 0, 10};
BooleanDifference(5) = { Surface{3}; Delete; }{ Surface{4}; Delete; };
Disk(6) = {0, 0, 0, 9.98};
rim[] = Boundary{ Surface{6}; };
Transfinite Curve{rim[0]} = 14;
Physical Surface("lug") = {5};
Physical Surface("pin") = {6};
Physical Curve("lug.hole") = Curve In BoundingBox {-10.1, -10.1, -1, 10.1, 10.1, 1};
Physical Curve("lug.hole") -= {rim[0]};
Physical Curve("pin.rim") = {rim[0]};
Physical Curve("foot") = Curve In BoundingBox {-26, -75.1, -1, 26, -74.9, 1};
