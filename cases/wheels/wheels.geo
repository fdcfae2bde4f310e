// A wheel of radius 4 on two of radius 6, each with a bore of radius 2: edges of half a radius, and of 2 in the upper one.
//   gmsh -2 -order 2 -format msh41 wheels.geo -o wheels.msh
SetFactory("OpenCASCADE");
Mesh.MeshSizeMax = 3;
height = Sqrt(51);
Disk(1) = {-7, 0, 0, 6};
Disk(2) = {7, 0, 0, 6};
Disk(3) = {0, height, 0, 4};
Disk(4) = {-7, 0, 0, 2};
Disk(5) = {7, 0, 0, 2};
Disk(6) = {0, height, 0, 2};
BooleanDifference(11) = { Surface{1}; Delete; }{ Surface{4}; Delete; };
BooleanDifference(12) = { Surface{2}; Delete; }{ Surface{5}; Delete; };
BooleanDifference(13) = { Surface{3}; Delete; }{ Surface{6}; Delete; };
left[] = Boundary{ Surface{11}; };
right[] = Boundary{ Surface{12}; };
upper[] = Boundary{ Surface{13}; };
MeshSize{ PointsOf{ Surface{13}; } } = 2;
Physical Surface("left") = {11};
Physical Surface("right") = {12};
Physical Surface("upper") = {13};
Physical Curve("left.rim") = {left[0]};
Physical Curve("right.rim") = {right[0]};
Physical Curve("upper.rim") = {upper[0]};
Physical Curve("axles") = {left[1], right[1]};
Physical Curve("hub") = {upper[1]};
