SetFactory("OpenCASCADE");
Cylinder(1) = {0,0,0, 0,0,10, 20, Pi/2};
Cylinder(2) = {0,0,0, 0,0,10, 12, Pi/2};
BooleanDifference(3) = { Volume{1}; Delete; }{ Volume{2}; Delete; };
Mesh.MeshSizeMin = 12; Mesh.MeshSizeMax = 12;
Physical Volume("ring") = {3};
