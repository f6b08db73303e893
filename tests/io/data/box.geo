SetFactory("OpenCASCADE");
Box(1) = {0, 0, 0, 40, 20, 10};
Mesh.MeshSizeMin = 20; Mesh.MeshSizeMax = 20;
Physical Volume("part") = {1};
Physical Surface("clamped") = {1};
Physical Point(7) = {1};
