# The wall of a curved duct, 2.5 mm thick, over 45 degrees, as a scan would give it: isosurface of a distance field (VTK's FlyingEdges3D), smoothed
# and decimated. mm.
import vtk
f = vtk.vtkImageData(); n = (132, 132, 60); h = 0.9
f.SetDimensions(*n); f.SetSpacing(h, h, h); f.SetOrigin(-6, -6, -0.5 * h * (n[2] - 1)); f.AllocateScalars(vtk.VTK_FLOAT, 1)
import math
R, r, t = 70.0, 18.0, 2.5
for k in range(n[2]):
    for j in range(n[1]):
        for i in range(n[0]):
            x, y, z = -6 + h * i, -6 + h * j, -0.5 * h * (n[2] - 1) + h * k
            d = math.hypot(math.hypot(x, y) - R, 1.0 * z) - r
            shell = abs(d) - 0.5 * t
            f.SetScalarComponentFromDouble(i, j, k, 0, max(shell, -y, 0.7071 * (y - x)))
iso = vtk.vtkFlyingEdges3D(); iso.SetInputData(f); iso.SetValue(0, 0.0); iso.ComputeNormalsOff()
smooth = vtk.vtkWindowedSincPolyDataFilter(); smooth.SetInputConnection(iso.GetOutputPort()); smooth.SetNumberOfIterations(60); smooth.SetPassBand(0.01)
dec = vtk.vtkQuadricDecimation(); dec.SetInputConnection(smooth.GetOutputPort()); dec.SetTargetReduction(0.95)
w = vtk.vtkSTLWriter(); w.SetFileTypeToBinary(); w.SetInputConnection(dec.GetOutputPort()); w.SetFileName("duct.stl"); w.Write()
print(iso.GetOutput().GetNumberOfPolys(), dec.GetOutput().GetNumberOfPolys())
